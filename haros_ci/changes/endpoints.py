# SPDX-License-Identifier: Apache-2.0
"""The ends of a node on both sides: topics, services, actions and declared parameters, and their quality of service."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import fields, replace

from haros_ci.changes.change import ADDED, CHANGED, REMOVED, RENAMED, Difference, shown
from haros_ci.changes.names import is_known, likeness, may_be_same, relative, too_many
from haros_ci.changes.nodes import identity, program, said_ends
from haros_ci.model.architecture import Endpoint, Node, Qos
from haros_ci.records import dataclass, field

#: The kinds of ends whose changes are reported, in words.
WORDS = {
    "publishers": "publisher",
    "subscribers": "subscriber",
    "servers": "service server",
    "clients": "service client",
    "action_servers": "action server",
    "action_clients": "action client",
    "getters": "parameter",
    "parameters": "parameter",
}
#: From this likeness on, one name is taken for the other's new one.
RENAMED_FROM = 0.6

#: Where a file of the base is now.
Moved = Callable[[str], str]


@dataclass(slots=True)
class Compared:
    """What is found: *differences*, and how many more there would be if all were known."""

    differences: list[Difference] = field(default_factory=list)
    not_known: int = 0
    #: Ends of both sides that are the same one.
    pairs: list[tuple[Endpoint, Endpoint]] = field(default_factory=list)


@dataclass(frozen=True, slots=True)
class NodePair:
    """A node at the base and at head, with what each knows of itself."""

    base: Node
    head: Node
    configuration: str
    moved: Moved

    def difference(self, what: str, action: str, name: str, **more: object) -> Difference:
        node = self.base if action == REMOVED else self.head
        return Difference(
            what=what,
            action=action,
            name=name,
            node=node.name,
            program=program(node),
            configuration=self.configuration,
            **more,  # type: ignore[arg-type]  # fields of Change by name
        )


def compare_ends(sides: NodePair, outcome: Compared) -> None:
    """Compare all ends of the two nodes; what is unknown on one side is not reported."""
    is_other = identity(sides.base) != identity(sides.head)  # then what is known of programs is no news
    base, head = _by_kind(sides.base, is_other), _by_kind(sides.head, is_other)
    for kind in WORDS:
        _compare_kind(sides, kind, base.get(kind, []), head.get(kind, []), outcome)


def _by_kind(node: Node, only_source: bool) -> dict[str, list[Endpoint]]:
    found: dict[str, list[Endpoint]] = {}
    for end in said_ends(node):
        if not (only_source and end.source == "known-node"):
            found.setdefault(end.kind, []).append(end)
    return found


def _compare_kind(sides: NodePair, kind: str, base: list[Endpoint], head: list[Endpoint], outcome: Compared) -> None:
    if not base and not head:
        return
    left, right = _named(base, sides.base), _named(head, sides.head)
    removed: list[tuple[str, Endpoint]] = []
    new: list[tuple[str, Endpoint]] = []
    for name, ends in left.items():
        others = right.get(name, [])
        for end, other in _matched(ends, others):
            if end is not None and other is not None:
                outcome.pairs.append((end, other))
                outcome.differences += _changed(sides, end, other)
            elif end is not None:
                removed.append((name, end))
            elif other is not None:
                new.append((name, other))
    new += [(name, end) for name, ends in right.items() if name not in left for end in ends]
    removed, new = _only_known(sides, removed, new, outcome)
    for end, other in _renamed(sides, removed, new):
        removed = [item for item in removed if item[1] is not end]
        new = [item for item in new if item[1] is not other]
        outcome.pairs.append((end, other))
        outcome.differences.append(
            sides.difference(
                WORDS[kind], RENAMED, other.name, aspect="name", before=end.name, after=other.name, base=end.location,
                head=other.location, old_name=end.name,
            )
        )  # fmt: skip
        outcome.differences += _changed(sides, end, other)
    outcome.differences += (_one_sided(sides, REMOVED, end) for _, end in removed)
    outcome.differences += (_one_sided(sides, ADDED, end) for _, end in new)


def _named(ends: Iterable[Endpoint], node: Node) -> dict[str, list[Endpoint]]:
    """The ends by their names before remapping, as seen from the node; of those that say the same, one."""
    found: dict[str, dict[tuple[object, ...], Endpoint]] = {}
    for end in ends:
        same = (end.type, end.qos, end.queue_size, shown(end.value))
        found.setdefault(relative(end.original_name, node.name), {}).setdefault(same, end)
    return {name: list(item.values()) for name, item in found.items()}


def _matched(base: list[Endpoint], head: list[Endpoint]) -> Iterator[tuple[Endpoint | None, Endpoint | None]]:
    """Ends of one name on both sides, the likest together. A further one of a type that is there anyway is no difference."""
    left, right = list(base), list(head)
    for is_same in (_is_equal, _has_type):
        for end in list(left):
            other = next((endpoint for endpoint in right if is_same(end, endpoint)), None)
            if other is not None:
                left.remove(end)
                right.remove(other)
                yield end, other
    while left and right:
        yield left.pop(0), right.pop(0)
    yield from ((end, None) for end in left if all(end.type not in (None, endpoint.type) for endpoint in head))
    yield from ((None, end) for end in right if all(end.type not in (None, endpoint.type) for endpoint in base))


def _is_equal(end: Endpoint, other: Endpoint) -> bool:
    return _has_type(end, other) and end.qos == other.qos and shown(end.value) == shown(other.value)


def _has_type(end: Endpoint, other: Endpoint) -> bool:
    return end.type == other.type


Found = list[tuple[str, Endpoint]]


def _only_known(sides: NodePair, removed: Found, new: Found, outcome: Compared) -> tuple[Found, Found]:
    """Those of which the other side cannot have one under a name that is not known there."""
    lost = {id(end) for name, end in removed if any(_may_be(name, end, *other) for other in new)}
    found = {id(end) for name, end in new if any(_may_be(*other, name, end) for other in removed)}
    outcome.not_known += len(lost)
    removed = [item for item in removed if id(item[1]) not in lost]
    new = [item for item in new if id(item[1]) not in found]
    if removed and _doubts(sides.head) - _doubts(sides.base):
        outcome.not_known += len(removed)
        removed = []
    if new and _doubts(sides.base) - _doubts(sides.head):
        outcome.not_known += len(new)
        new = []
    return removed, new


def _may_be(name: str, end: Endpoint, other_name: str, other: Endpoint) -> bool:
    if None not in (end.type, other.type) and end.type != other.type:
        return False
    return name != other_name and may_be_same(name, other_name)


def _doubts(node: Node) -> frozenset[str]:
    """Why not all ends of *node* are known."""
    return frozenset(unknown.reason for unknown in node.unknowns if unknown.field == "endpoints")


def _renamed(sides: NodePair, removed: Found, new: Found) -> Iterator[tuple[Endpoint, Endpoint]]:
    """An end under a new name: in the same file, of the same type and default, the name alike or no other in question."""
    if too_many(removed, new):
        return
    ranked = []
    for place, (name, end) in enumerate(removed):
        fitting = [(number, item) for number, item in enumerate(new) if _fits(sides, end, item[1])]
        alone = len(fitting) == 1 and sum(_fits(sides, endpoint, fitting[0][1][1]) for _, endpoint in removed) == 1
        for number, (other_name, _) in fitting:
            like = likeness(name, other_name)
            if like >= RENAMED_FROM or (alone and end.kind not in ("parameters", "getters")):
                ranked.append((-like, place, number))
    taken: set[int] = set()
    for _, place, number in sorted(ranked):
        end, other = removed[place][1], new[number][1]
        if not {id(end), id(other)} & taken:
            taken |= {id(end), id(other)}
            yield end, other


def _fits(sides: NodePair, end: Endpoint, other: Endpoint) -> bool:
    if end.location is None or other.location is None or end.type is None or end.type != other.type:
        return False
    if not (is_known(end.name) or is_known(other.name)) and end.kind in ("publishers", "subscribers"):
        return False
    same_file = sides.moved(end.location.path) == other.location.path
    return same_file and (end.kind not in ("parameters", "getters") or shown(end.value) == shown(other.value))


def _one_sided(sides: NodePair, action: str, end: Endpoint) -> Difference:
    what = WORDS[end.kind]
    text = _described(end)
    place = {"base": end.location} if action == REMOVED else {"head": end.location}
    text_of = {"before": text} if action == REMOVED else {"after": text}
    return sides.difference(what, action, end.name, **place, **text_of)


def _described(end: Endpoint) -> str:
    """The type, and of a parameter its default."""
    if end.kind not in ("parameters", "getters"):
        return end.type or "?"
    if "value" in {unknown.field for unknown in end.unknowns} or (end.value is None and end.type is None):
        return end.type or "?"
    return f"{end.type or '?'}" if end.value is None else f"{end.type or '?'} = {shown(end.value)}"


def _changed(sides: NodePair, end: Endpoint, other: Endpoint) -> Iterator[Difference]:
    """What is otherwise at an end that is there on both sides."""
    what = WORDS[end.kind]
    for aspect, before, after in _aspects(end, other):
        yield sides.difference(
            "QoS" if aspect == "QoS" else what,
            CHANGED,
            other.name,
            aspect=aspect if aspect != "QoS" else what,
            before=before,
            after=after,
            base=end.location,
            head=other.location,
        )


def _aspects(end: Endpoint, other: Endpoint) -> Iterator[tuple[str, str | None, str | None]]:
    unknown = {unknown.field for side in (end, other) for unknown in side.unknowns}
    if end.type != other.type and None not in (end.type, other.type) and is_known(f"{end.type}{other.type}"):
        yield "type", end.type, other.type
    if end.kind in ("parameters", "getters"):
        if "value" not in unknown and shown(end.value) != shown(other.value):
            yield "default", _default(end), _default(other)
        if (
            "read_only" not in unknown
            and end.read_only != other.read_only
            and None not in (end.read_only, other.read_only)
        ):
            yield "read-only", shown(end.read_only), shown(other.read_only)
        if "range" not in unknown and end.range != other.range:
            yield "range", in_words(end.range), in_words(other.range)
    yield from _quality(end, other)


def _default(end: Endpoint) -> str | None:
    return None if end.value is None else shown(end.value)


def in_words(limits: tuple[float | None, float | None, float | None] | None) -> str | None:
    """``0.0 … 1.0, step 0.1``."""
    if limits is None:
        return None
    low, high, step = limits
    text = f"{'' if low is None else low} … {'' if high is None else high}".strip()
    return text if not step else f"{text}, step {step}"


def _quality(end: Endpoint, other: Endpoint) -> Iterator[tuple[str, str | None, str | None]]:
    if end.qos is not None and other.qos is not None:
        # haros: ignore[arguments-out-of-order] both ways: what the one has, and what the other has
        before, after = qos_words(end.qos, other.qos), qos_words(other.qos, end.qos)
        if before != after:
            yield "QoS", before, after
    elif end.qos is other.qos is None:
        old = _queue(end, other)
        new = _queue(other, end)  # haros: ignore[arguments-out-of-order] the other way
        if old != new:
            yield "QoS", old, new


def qos_words(qos: Qos, other: Qos) -> str:
    """In words the policies in which *qos* differs from *other*, those left out that are not known on one side."""
    parts = []
    for item in fields(qos):
        mine, theirs = getattr(qos, item.name), getattr(other, item.name)
        if mine == theirs or "?" in (mine, theirs):
            continue
        if item.name == "depth" and "keep_all" in (qos.history, other.history):
            continue
        parts.append(f"{item.name} {'default' if mine is None else mine}")
    return ", ".join(parts)


def _queue(end: Endpoint, other: Endpoint) -> str:
    parts = []
    if end.queue_size != other.queue_size and None not in (end.queue_size, other.queue_size):
        parts.append(f"queue {end.queue_size}")
    if end.latched != other.latched and None not in (end.latched, other.latched):
        parts.append("latched" if end.latched else "not latched")
    return ", ".join(parts)


def with_users(difference: Difference, users: Iterable[str]) -> Difference:
    return replace(difference, users=tuple(sorted({*difference.users, *users} - {difference.node})))
