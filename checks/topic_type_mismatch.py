# SPDX-License-Identifier: Apache-2.0
"""Publishers and subscribers of one topic that disagree on its type."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.api import (
    Channel,
    Check,
    Condition,
    End,
    Finding,
    Level,
    Location,
    System,
    by_types,
    can_meet,
    is_never_made,
    line_of,
    named_at,
    rule_of,
    way_to,
)

#: Lines of one statement.
_STATEMENT = 3
#: Defaults of parameters that have to be set: no names of topics.
PLACEHOLDERS = ("unknown", "undefined", "unset", "none", "todo")


def check(system: System) -> Iterator[Finding]:
    by_place: dict[tuple[Location, str, str], dict[Channel | End, None]] = {}
    lines: dict[str, list[str]] = {}  # of each file
    for topic in system.topics:
        if len(topic.types) < 2 or topic.name.rpartition("/")[2].lower() in PLACEHOLDERS:
            continue
        types = _Types(topic, system, lines)
        for pair, ends in by_types(topic.publishers, topic.subscribers, types.differ).items():
            about = by_place.setdefault((named_at(_wrong(tuple(ends))), *pair), {})
            about[topic] = None
            about.update(dict.fromkeys(ends))
        if not topic.subscribers:
            yield from _among(topic, topic.publishers, types)
        if not topic.publishers:
            yield from _among(topic, topic.subscribers, types)
    for (_, published, taken), about in by_place.items():
        yield _finding(tuple(about), published, taken)


class _Types:
    """The types that each end of a topic may have, whichever of the alternatives in its code it is."""

    def __init__(self, topic: Channel, system: System, lines: dict[str, list[str]]) -> None:
        self._system = system
        self._lines = lines
        self._known: dict[End, frozenset[str | None]] = {}
        self._choices: dict[tuple[int, str], set[str | None]] = {}
        self._at: dict[tuple[int, str, str, int], list[End]] = {}
        text = None if system.workspace is None else system.workspace.text
        for end in (end for end in topic.ends if not is_never_made(end, text)):
            own = (id(end.node), end.kind)
            self._at.setdefault((*own, end.location.path, end.location.line or 0), []).append(end)
            if _is_choice(end):
                self._choices.setdefault(own, set()).add(end.type)

    def differ(self, one: End, other: End) -> bool:
        """Whether the types of two ends differ."""
        if one.type is None or other.type is None or one.implicit or other.implicit:
            return False
        types, others = self._of(one), self._of(other)
        if None in types | others or types & others:
            return False
        sums = self._system.whole.sums if one.node.ros == 1 == other.node.ros else None
        return sums is None or not any(sums.are_one(str(first), str(second)) for first in types for second in others)

    def _of(self, end: End) -> frozenset[str | None]:
        """Its type, and those of the ends that the same node has instead: under other conditions that may hold, or in other releases."""
        if end not in self._known:
            own, at = (id(end.node), end.kind), end.location.line or 0
            if _is_choice(end):
                self._known[end] = frozenset(self._choices.get(own, {end.type}))
            else:
                near = range(at - _STATEMENT, at + _STATEMENT + 1)
                beside = (
                    other.type
                    for line in near
                    for other in self._at.get((*own, end.location.path, line), ())
                    if self._is_beside(end.location.path, *sorted((at, line)))
                )
                self._known[end] = frozenset((end.type, *beside))
        return self._known[end]

    def _is_beside(self, path: str, first: int, last: int) -> bool:
        """Whether ends on two lines are the two sides of one conditional expression, which the model has no condition for."""
        if self._system.workspace is None:
            return False
        if path not in self._lines:
            self._lines[path] = self._system.workspace.text(path).split("\n")
        text = "\n".join(self._lines[path][max(first - 2, 0) : last])
        return re.search(r"\?[^:]+:|\sif\b.+\selse\b", text, re.DOTALL) is not None


def _is_choice(end: End) -> bool:
    return bool(end.conditions) or end.raw.source == "known-node"


def _finding(about: tuple[Channel | End, ...], published: str, taken: str) -> Finding:
    """One mistake, however many topics and nodes it has to do with."""
    topics = [channel for channel in about if isinstance(channel, Channel)]
    all_ends = tuple(end for end in about if isinstance(end, End))
    ends = tuple(end for end in all_ends if end.name == topics[0].name)
    publishers = [end for end in ends if end.kind == "publishers"]
    subscribers = [end for end in ends if end.kind == "subscribers"]
    wrong = _wrong(ends)
    takes = f"{_nodes(subscribers)} subscribe{('s' if len(subscribers) == 1 else '')} to {topics[0]} as {taken}"
    gives = f"{_nodes(publishers)} publish{'es' if len(publishers) == 1 else ''} {published}"
    more = f"; so do {len(topics) - 1} more topics" if len(topics) > 1 else ""
    return Finding(
        at=named_at(wrong),
        message=f"{takes}, but {gives}: the two do not connect, and no message arrives; use one type in both{_advice(wrong)}{more}",
        about=about,
        related=tuple((end.location, f"{end.node}: {end.word} of {end.type}") for end in all_ends),
        flow=way_to(wrong),
    )


def _wrong(ends: tuple[End, ...]) -> End:
    """The end that is most likely wrong: remapped, of the smaller side, a subscriber; if it can be, one of the workspace."""
    sides = [[end for end in ends if end.kind == kind] for kind in ("subscribers", "publishers")]
    sides.sort(key=len)
    ordered = [end for side in sides for end in side]
    remapped = next((end for end in ordered if rule_of(end) is not None), None)
    return remapped or next((end for end in ordered if end.in_source), ordered[0])


def _advice(end: End) -> str:
    return "" if rule_of(end) is None else f"; {end.original_name} is remapped to {end.name} here"


def _nodes(ends: list[End]) -> str:
    names = sorted({end.node.name for end in ends})
    first = min((end for end in ends if end.node.name == names[0]), key=lambda end: end.location.sort_key)
    more = f" and {len(names) - 1} more" if len(names) > 1 else ""
    return f"{names[0]}{more} ({line_of(first.location)})"


def _is_optional(one: End, other: End) -> bool:
    """Whether a program has one of two ends in builds with an option alone, as for a driver that need not be there: under ``#if`` and not ruled out."""
    if one.node.raw.process != other.node.raw.process or one.node.type != other.node.type:
        return False
    first, second = ({(c.location, c.condition) for c in end.conditions if _is_asked(c)} for end in (one, other))
    return first != second


def _other(one: End, other: End) -> str:
    return "also" if one.node.name == other.node.name else other.node.name


def _is_asked(condition: Condition) -> bool:
    """Whether it is an ``#if`` that a build decides: one on a name."""
    return condition.statement == "#if" and re.search(r"[A-Za-z_]", condition.condition.partition(" ")[2]) is not None


def _among(topic: Channel, ends: tuple[End, ...], types: _Types) -> Iterator[Finding]:
    """Ends of one kind without another end in the system: who is there outside of it fits one of their types."""
    for one, other in can_meet(ends, ends):
        if types.differ(one, other) and not _is_optional(one, other):
            wrong = next((end for end in (other, one) if rule_of(end) is not None), other)
            verb, effect = (
                ("publishes", "a subscriber receives the messages of one of the two only")
                if other.kind == "publishers"
                else ("subscribes to", "one of the two receives no message, whatever the publisher's type is")
            )
            yield Finding(
                at=named_at(wrong),
                message=f"{one.node} {verb} {topic} as {one.type}, and {_other(one, other)} as {other.type} ({line_of(one.location)}, "
                f"{line_of(other.location)}): {effect}; use one type in both{_advice(wrong)}",
                about=(topic, one, other),
                related=tuple((end.location, f"{end.node}: {end.word} of {end.type}") for end in (one, other)),
                flow=way_to(wrong),
            )
            return


CHECK = Check(
    id="topic-type-mismatch",
    summary="Publisher and subscriber of a topic with different message types.",
    level=Level.ERROR,
    catalogue="G06",
    tags=("topics",),
    run=check,
)
