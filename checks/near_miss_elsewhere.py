# SPDX-License-Identifier: Apache-2.0
"""Two ends of one type in different launch files, or programs that none starts, that nobody connects to, and whose names are nearly the same."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import (
    ACTION,
    SERVICE,
    TOPIC,
    Check,
    Decidability,
    End,
    Finding,
    Level,
    Project,
    WholeGraph,
    is_moved,
    is_opaque,
    is_slip,
    may_be,
    named_at,
)

COMMON = frozenset({"tf", "tf_static", "clock", "rosout", "parameter_events", "diagnostics", "robot_description"})
#: More of one type than this say that the type tells nothing.
MOST = 40

Ends = list[tuple[End, str]]


def check(project: Project) -> Iterator[Finding]:
    graph = WholeGraph(project.systems)
    if len(graph.systems) < 2:
        return
    for giver_kind, taker_kind in (TOPIC, SERVICE, ACTION):
        givers, takers = _lonely(graph, giver_kind, taker_kind), _lonely(graph, taker_kind, giver_kind)
        for type_, takers_of_type in takers.items():
            givers_of_type = givers.get(type_, [])
            if len(givers_of_type) > MOST:
                continue
            is_alone = (
                len(givers_of_type) == len(takers_of_type) == 1 and project.package(type_.partition("/")[0]) is not None
            )
            for givers_here in givers_of_type:
                for taken in takers_of_type:
                    if _is_meant(graph, givers_here, taken, is_alone):
                        yield _finding(givers_here, taken)


def _lonely(graph: WholeGraph, kind: str, other: str) -> dict[str, list[Ends]]:
    """By type: the ends of each name that nobody is at the other side of, and nobody of a name that is not known may be."""
    found: dict[str, list[Ends]] = {}
    for (item, name), ends in graph.ends.items():
        if item != kind or graph.of(other, name) or name.rpartition("/")[2] in COMMON:
            continue
        types = {end.type for end, _ in ends}
        type_ = types.pop() if len(types) == 1 else None
        vague = (end for end in graph.vague.get(other, ()) if end.type in (None, type_))
        if type_ is not None and not any(may_be(end.name, name) for end in vague):
            found.setdefault(type_, []).append(ends)
    return found


def _is_meant(graph: WholeGraph, givers: Ends, taken: Ends, is_alone: bool) -> bool:
    """Whether the two names are one: a slip of the pen; or the same in another namespace, where nothing else comes into question."""
    if {name for _, name in givers} & {name for _, name in taken}:
        return False  # near-miss-name tells of one launch file
    giver, taker = givers[0][0], taken[0][0]
    if giver.node.type == taker.node.type or not (giver.in_source and taker.in_source):
        return False
    one, other = giver.name.split("/"), taker.name.split("/")
    differing = [pair for pair in zip(one, other) if pair[0] != pair[1]]
    if len(one) == len(other) and len(differing) == 1 and is_slip(*differing[0]):
        return True
    systems = {name for _, name in (*givers, *taken)}
    is_open = any(is_opaque(node) for name in systems for node in graph.systems[name].nodes)
    return is_alone and not is_open and is_moved(giver.name, taker.name)


def _finding(givers: Ends, taken: Ends) -> Finding:
    (giver, giver_system), (taker, taker_system) = givers[0], taken[0]
    return Finding(
        at=named_at(taker),
        message=(
            f"{taker.word} {taker.name} of {taker.node} ({taker_system}) and {giver.word} {giver.name} of "
            f"{giver.node} ({giver_system}) have the same type and nearly the same name, but do not connect, and no "
            "launch file or program has another partner for either: use one name for both, or remap one"
        ),
        about=(giver.name, taker.name),
        related=((named_at(giver), f"{giver.word} {giver.name} of {giver.node}"),),
    )


CHECK = Check(
    id="near-miss-elsewhere",
    summary="Nearly equal names of a publisher and a subscriber in different launch files or programs.",
    level=Level.WARNING,
    decidability=Decidability.HEURISTIC,
    tags=("names",),
    project=check,
)
