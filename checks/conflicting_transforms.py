# SPDX-License-Identifier: Apache-2.0
"""Frames that several nodes say where they are, each in its own way, and frames that hang on themselves."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import combinations

from haros_ci.api import ALWAYS, Check, Finding, Level, Location, Project, System, command, together
from haros_ci.api.launch import FileUse, IncludeUse, ProgramUse
from haros_ci.api.robots import Broadcast, at_odds, broadcasts, called, origin


def check(project: Project) -> Iterator[Finding]:
    for system in project.systems:
        if not system.is_launched or cannot_start(system):
            continue
        by_child: dict[tuple[str, str], list[Broadcast]] = {}
        for broadcast in broadcasts(project, system):
            if broadcast.parent == broadcast.child:
                if origin(broadcast) != "robot":
                    yield _in_itself(broadcast, system)
                continue
            by_child.setdefault((broadcast.topic, broadcast.child), []).append(broadcast)
        by_nodes: dict[tuple[int, int], list[tuple[Broadcast, Broadcast]]] = {}
        for several in by_child.values():
            for one, other in combinations(several, 2):
                if at_odds(one, other):
                    by_nodes.setdefault((id(one.node), id(other.node)), []).append((one, other))
                    break
        for pairs in by_nodes.values():
            yield conflict(pairs, system)
        yield from circles(by_child, system)


def cannot_start(system: System) -> bool:
    """Whether launch stops before all nodes are there, whatever its arguments: that is a finding of another check.

    launch stops where an included file or a required argument is missing, that of ROS 2 also where a program is not found.
    """
    missing = (
        *(use for use in system.facts(FileUse) if use.kind == "include" and use.is_found is False),
        *(use for use in system.facts(IncludeUse) if use.missing),
        *(use for use in system.facts(ProgramUse) if use.is_found is False and use.ros == 2),
    )
    return any(use.presence == ALWAYS for use in missing)


def seen_with(system: System) -> str:
    """The launch file of *system*, and the command that starts it."""
    return f"in {system.launch[0]} (`{command(system, ())}`)"


def each_once(at: Location, places: Iterable[tuple[Location, str]]) -> tuple[tuple[Location, str], ...]:
    """*places* without *at*, and without those that are there already."""
    found: dict[Location, str] = {}
    for place, text in places:
        if place != at:
            found.setdefault(place, text)
    return tuple(found.items())


def conflict(pairs: list[tuple[Broadcast, Broadcast]], system: System) -> Finding:
    """One finding for all frames that two nodes are at odds about."""
    one, other = pairs[0]
    parents = one.parent != other.parent and one.parent is not None and other.parent is not None
    if parents:
        how = (
            f"in {one.parent!r} by {called(one.node)}, in {other.parent!r} by {called(other.node)}: tf allows a frame one parent "
            "only, so the frame jumps between two trees"
        )
    elif one.is_static != other.is_static:
        static = one if one.is_static else other
        how = (
            f"by {called(one.node)} and {called(other.node)}, of which {called(static.node)} sends a static transform: the result of a "
            "look-up depends on the order of arrival"
        )
    else:
        how = f"by {called(one.node)} and {called(other.node)}: look-ups jump between the two transforms"
    more = f" (and {len(pairs) - 1} more frames)" if len(pairs) > 1 else ""
    return Finding(
        at=other.at,
        message=f"frame {one.child!r}{more} is broadcast {how}; remove one of the broadcasters, or rename one frame; "
        f"{seen_with(system)}",
        about=(one.child, one.node, other.node),
        related=each_once(
            other.at,
            (
                (one.at, one.what),
                (other.node.location, f"starts {called(other.node)}"),
                (one.node.location, f"starts {called(one.node)}"),
            ),
        ),
        level=None if parents else Level.WARNING,
        apart=(one.child, str(one.at)),
    )


def _in_itself(broadcast: Broadcast, system: System) -> Finding:
    """A transform that tf does not take in (``TF_SELF_TRANSFORM``); nothing else suffers from it."""
    return Finding(
        at=broadcast.at,
        message=f"{broadcast.node} broadcasts frame {broadcast.child!r} in {broadcast.parent!r}: parent and child are the same frame, "
        f"and tf rejects the transform; name another parent, or remove the broadcaster; {seen_with(system)}",
        about=(broadcast.child, broadcast.node),
        level=Level.WARNING,
        apart=(broadcast.child,),
    )


def circles(by_child: dict[tuple[str, str], list[Broadcast]], system: System) -> Iterator[Finding]:
    """Frames each of which hangs on the next, and the last on the first."""
    parent = {key: every[0] for key, every in by_child.items() if len(every) == 1 and every[0].parent is not None}
    done: set[tuple[str, str]] = set()
    for start in parent:
        way: list[tuple[str, str]] = []
        here = start
        while here in parent and here not in done and here not in way:
            way.append(here)
            here = (here[0], parent[here].parent or "")
        if here in way:
            ring = [parent[pair] for pair in way[way.index(here) :]]
            names = " → ".join([*(item.child for item in ring), ring[0].child])
            if any(together(ring[0].node.presence, broadcast.node.presence) is None for broadcast in ring):
                continue
            yield Finding(
                at=ring[0].at,
                message=f"the frames {names} form a cycle: tf rejects cycles, so that look-ups between these frames fail; {seen_with(system)}",
                about=(*sorted(broadcast.child for broadcast in ring), *{id(e.node): e.node for e in ring}.values()),
                related=each_once(ring[0].at, ((broadcast.at, broadcast.what) for broadcast in ring[1:])),
            )
        done.update(way)


CHECK = Check(
    id="conflicting-transforms",
    summary="Frame broadcast by several nodes or with several parents, or a cycle of frames.",
    level=Level.ERROR,
    catalogue="T01",
    tags=("tf",),
    project=check,
)
