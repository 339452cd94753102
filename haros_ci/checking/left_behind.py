# SPDX-License-Identifier: Apache-2.0
"""Ends of topics, services and actions that a change has left alone with a name, in whatever launch file they run.

``haros_ci/checking/changed.py`` compares each configuration with itself; here all configurations of a revision count as one system: launch files that
run side by side on a robot are seldom included by a common one. The places are those of the head, whatever has changed the name: the code,
a remapping rule, a namespace, a launch argument, or a parameter that holds the name.
"""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.changes.names import likeness, may_be_same, relative
from haros_ci.checking.changed import both, lost_in
from haros_ci.checking.kinds import ACTION, SERVICE, TOPIC
from haros_ci.checking.project import Project
from haros_ci.checking.system import End
from haros_ci.checking.whole_graph import COMMON, OTHER, WholeGraph, is_opaque
from haros_ci.records import dataclass

RENAMED, REMOVED, RETYPED = "renamed", "removed", "retyped"
#: The end itself has another name, which nobody gives; those that it was connected to are still where they were.
MOVED_AWAY = "moved away"
_GIVES = frozenset(pair[0] for pair in (TOPIC, SERVICE, ACTION))


@dataclass(frozen=True, slots=True, kw_only=True)
class LeftBehind:
    """*ends* at *name*, whose other side is gone: *action* says what has become of *before*, an end of the base, which is *now* at head.

    *together* says that one configuration had both at the base. *certain* says that no node of unknown ends runs with any of *ends*.
    """

    name: str
    action: str
    ends: tuple[End, ...]
    before: End
    now: End | None
    together: bool
    certain: bool


def left_behind(project: Project) -> Iterator[LeftBehind]:
    """What a change has left alone, but for what ``lost_in`` tells of a single configuration; nothing without a base revision."""
    if project.base is None:
        return
    before, after = WholeGraph(project.base.systems), WholeGraph(project.systems)
    reported = {(lost.kind, end.name) for lost in lost_in(project) for end in lost.left}
    for (kind, name), ends in before.ends.items():
        if name.rpartition("/")[2] in COMMON or (_word(kind), name) in reported:
            continue
        others = before.of(OTHER[kind], name)
        left = [
            placed for placed in after.of(OTHER[kind], name) if (OTHER[kind], name, placed[0].node.type) in before.held
        ]
        if others and left:
            is_removed = not after.of(kind, name)
            found = _alone(project, before, after, ends, left) if is_removed else _retyped(before, after, ends, left)
            if found is not None:
                reported.add((_word(kind), name))
                yield found
    yield from _inside(project, before, after, reported)
    yield from _moved_away(before, after, reported)


def _inside(
    project: Project, before: WholeGraph, after: WholeGraph, reported: set[tuple[str, str]]
) -> Iterator[LeftBehind]:
    """What is alone in its own configuration, though another launch file has the name: one end has another, which nobody else has."""
    for old, new in both(project):
        if old.raw == new.raw:
            continue
        was, now = WholeGraph((old,)), WholeGraph((new,))
        for (kind, name), ends in was.ends.items():
            if (
                (_word(kind), name) in reported
                or name.rpartition("/")[2] in COMMON
                or now.of(kind, name)
                or not new.is_launched
            ):
                continue
            others = was.of(OTHER[kind], name)
            left = [
                placed for placed in now.of(OTHER[kind], name) if (OTHER[kind], name, placed[0].node.type) in was.held
            ]
            found = _alone(project, was, now, ends, left) if others and left else None
            if found is None or found.now is None:
                continue
            partners = after.of(OTHER[kind], found.now.name)
            if not any((end.kind, end.name, end.node.type) in before.held for end, _ in partners):
                reported.add((_word(kind), name))
                yield found


def _moved_away(before: WholeGraph, after: WholeGraph, reported: set[tuple[str, str]]) -> Iterator[LeftBehind]:
    """Subscribers and clients under a new name that nobody gives, while what they were connected to is still given."""
    for (kind, name), ends in before.ends.items():
        partners = after.of(OTHER[kind], name) if kind not in _GIVES else []
        if (
            not partners
            or not before.of(OTHER[kind], name)
            or name.rpartition("/")[2] in COMMON
            or (_word(kind), name) in reported
        ):
            continue
        types = {end.type for end, _ in partners} - {None}
        for end, system in ends:
            still = (other_end for other_end, place in after.of(kind, name) if place == system)
            if (
                end.type not in types
                or not end.in_source
                or any(other_end.node.type == end.node.type for other_end in still)
            ):
                continue
            now = _now(before, after, end, system)
            if now is None or after.of(OTHER[kind], now.name) or _is_provided_elsewhere(after, now):
                continue
            if _may_be_there(before, after, OTHER[kind], now.name, types):
                continue
            together = any(item == system for _, item in before.of(OTHER[kind], name))
            reported.add((_word(kind), name))
            yield LeftBehind(
                name=name,
                action=MOVED_AWAY,
                ends=(now,),
                before=end,
                now=partners[0][0],
                together=together,
                certain=False,
            )
            break


def _word(kind: str) -> str:
    return "topic" if kind in TOPIC else "service" if kind in SERVICE else "action"


def _alone(
    project: Project, before: WholeGraph, after: WholeGraph, ends: list[tuple[End, str]], left: list[tuple[End, str]]
) -> LeftBehind | None:
    """What becomes of those *left* where all *ends* of the other side have another name or are gone."""
    kind, name = ends[0][0].kind, ends[0][0].name
    types = {end.type for end, _ in ends} - {None}
    left = [placed for placed in left if placed[0].type in types]
    if not left or _may_be_there(before, after, kind, name, types):
        return None
    for end, system in ends:
        now = _now(before, after, end, system)
        if now is None:
            continue
        if kind not in _GIVES and (after.of(OTHER[kind], now.name) or _is_provided_elsewhere(after, now)):
            return None  # it listens to something else now
        return _made(before, after, RENAMED, ends, left, (end, now))
    removed = [end for end in ends if kind in _GIVES and _is_taken_away(project, after, *end)]
    return _made(before, after, REMOVED, ends, left, (removed[0][0], None)) if len(removed) == len(ends) else None


def _may_be_there(before: WholeGraph, after: WholeGraph, kind: str, name: str, types: set[str | None]) -> bool:
    """Whether an end of a name that is not known may be it, or something says the name to a node of unknown ends."""
    were = {(end.node.type, end.name, end.type) for end in before.vague.get(kind, ())}
    for end in after.vague.get(kind, ()):
        is_new = (end.node.type, end.name, end.type) not in were
        if is_new and (end.type is None or end.type in types) and may_be_same(end.name, name):
            return True
    text = name.lstrip("/")
    return text in after.texts and text not in before.texts


def _now(before: WholeGraph, after: WholeGraph, end: End, system: str) -> End | None:
    """The end of the head that *end* of the base is: of its program and type, under a name that the program did not have."""
    found = [
        (other_end, name)
        for other_end, name in after.by_program.get((end.kind, end.node.type), ())
        if other_end.type == end.type and (end.kind, other_end.name, end.node.type) not in before.held
    ]
    found = [placed for placed in found if placed[1] == system] or (found if system not in after.systems else [])
    if not found:
        return None
    inside = relative(end.original_name, end.node.name)

    def rank(placed: tuple[End, str]) -> tuple[bool, bool, float, str]:
        other = placed[0]
        is_same = relative(other.original_name, other.node.name) == inside
        return not is_same, other.node.name != end.node.name, -likeness(other.name, end.name), other.name

    best = min(found, key=rank)[0]
    is_same = relative(best.original_name, best.node.name) == inside
    return best if is_same or len({other_end.name for other_end, _ in found}) == 1 else None


def _is_provided_elsewhere(after: WholeGraph, now: End) -> bool:
    """Whether a node of unknown ends runs with *now*, so that it may give what *now* takes."""
    systems = {name for end, name in after.of(now.kind, now.name)}
    return not any(after.systems[name].is_launched for name in systems) or any(
        _has_opaque(after, name) for name in systems
    )


def _has_opaque(graph: WholeGraph, system: str) -> bool:
    """Whether a configuration has a node of unknown ends."""
    return any(is_opaque(node) for node in graph.systems[system].nodes)


def _is_taken_away(project: Project, after: WholeGraph, end: End, system: str) -> bool:
    """Whether *end*, or its node, is certainly gone: its package and its configuration are there, and nothing of them is unknown."""
    if project.package(end.node.package) is None or system not in after.systems:
        return False
    nodes = [node for node in after.systems[system].nodes if node.type == end.node.type]
    return not any(is_opaque(node) for node in nodes) and not any(
        other.type == end.type and (other.kind == end.kind) and not other.known for node in nodes for other in node.ends
    )


def _retyped(
    before: WholeGraph, after: WholeGraph, ends: list[tuple[End, str]], left: list[tuple[End, str]]
) -> LeftBehind | None:
    """Those *left* with the old type where all of the other side have another one; in one configuration topic-type-mismatch says so."""
    kind, name = ends[0][0].kind, ends[0][0].name
    now = after.of(kind, name)
    old, new = {end.type for end, _ in ends}, {end.type for end, _ in now}
    if len(old) != 1 or None in old | new or old & new or kind not in _GIVES:
        return None
    systems = {system for _, system in now}
    left = [(end, system) for end, system in left if end.type in old and system not in systems]
    same = [end for end, _ in now if end.node.type == ends[0][0].node.type]
    if not left or not same or {system for _, system in after.of(OTHER[kind], name)} & systems:
        return None
    return _made(before, after, RETYPED, ends, left, (ends[0][0], same[0]))


def _made(
    before: WholeGraph,
    after: WholeGraph,
    action: str,
    ends: list[tuple[End, str]],
    left: list[tuple[End, str]],
    change: tuple[End, End | None],
) -> LeftBehind | None:
    """The finding, unless a node of unknown ends has come to all those *left*."""
    certain = []
    for placed in list(left):
        system = placed[1]
        known = before.programs.get(system, frozenset())
        if any(is_opaque(node) and node.type not in known for node in after.systems[system].nodes):
            left.remove(placed)
        elif after.systems[system].is_launched and not _has_opaque(after, system):
            certain.append(placed)
    if not left:
        return None
    shared = {system for _, system in ends}
    return LeftBehind(
        name=ends[0][0].name,
        action=action,
        ends=tuple(end for end, _ in left),
        before=change[0],
        now=change[1],
        together=any(system in shared and after.systems[system].is_launched for _, system in left),
        certain=bool(certain),
    )
