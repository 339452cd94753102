# SPDX-License-Identifier: Apache-2.0
"""Packages of the workspace that depend on each other in a circle, so that no order to build them in exists."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from haros_ci.api import Check, Finding, Level, Project, ProjectPackage
from haros_ci.api.packages import BUILD, EXPORTED, Dependency, circles, holds, needs, place

#: The needed package by name, with the dependency that says so.
Edges = Mapping[str, Dependency]


#: The kinds that catkin orders by; the others count for what is needed to run these (catkin_pkg's topological_order).
ORDERING = (*BUILD, "test_depend")
#: Packages that are looked at for the shortest of several circles; and those that are named.
MAX_STEPS = 200_000
SHOWN = 20


def check(project: Project) -> Iterator[Finding]:
    reported: set[tuple[str, ...]] = set()
    for tool, ros in (("colcon", 2), ("catkin", 1)):
        packages = {package.name: package for package in project.packages if package.ros in (ros, None)}
        edges = {name: _edges(packages, package) for name, package in packages.items()}
        for group in circles({name: tuple(needed) for name, needed in edges.items()}):
            if tool == "colcon" and not any(packages[name].ros == 2 for name in group):
                continue
            cycle = _shortest(group, edges, tool)
            if cycle and cycle not in reported:
                reported.add(cycle)
                yield _finding(packages, cycle, edges, tool)


def _edges(packages: Mapping[str, ProjectPackage], package: ProjectPackage) -> dict[str, Dependency]:
    """What comes before *package* where a build tool orders: all kinds but doc_depend, one that orders first."""
    found: dict[str, Dependency] = {}
    for need in needs(package, *ORDERING, *EXPORTED):
        if need.name in packages and need.name != package.name and holds(package, need.condition):
            known = found.get(need.name)
            if known is None or known.kind not in ORDERING:
                found[need.name] = need
    return found


def _steps(cycle: tuple[str, ...]) -> Iterable[tuple[str, str]]:
    return zip(cycle, (*cycle[1:], cycle[0]))


def _finding(
    packages: Mapping[str, ProjectPackage], cycle: tuple[str, ...], edges: Mapping[str, Edges], tool: str
) -> Finding:
    way = [
        (place(packages[one], edges[one][other]), f"{one} needs {other} ({edges[one][other].kind})")
        for one, other in _steps(cycle)
    ]
    more = (f"{len(cycle) - SHOWN} more",) if len(cycle) > SHOWN else ()
    shown = " -> ".join((*cycle[:SHOWN], *more, cycle[0]))
    return Finding(
        at=way[0][0],
        message=f"{shown}: the packages depend on each other in a cycle, so {tool} finds no build order and stops; remove "
        "one of the dependencies",
        about=tuple(sorted(cycle)),
        related=tuple(way[1:SHOWN]),
    )


def _shortest(group: frozenset[str], edges: Mapping[str, Edges], tool: str) -> tuple[str, ...]:
    """The shortest cycle in *group* that *tool* refuses; () if there is none.

    colcon refuses any, as dependencies of all kinds come first. To catkin a circle of run dependencies alone is none.
    """
    best: tuple[str, ...] = ()
    left = MAX_STEPS
    for one in sorted(group):
        if best and left < 0:
            break
        for other, need in sorted(edges[one].items()):
            if other in group and (tool == "colcon" or need.kind in ORDERING):
                way, steps = _way(other, one, group, edges)
                left -= steps
                found = (one, *way)
                if not best or len(found) < len(best):
                    best = found
        if len(best) == 2:
            break
    return best


def _way(start: str, end: str, group: frozenset[str], edges: Mapping[str, Edges]) -> tuple[tuple[str, ...], int]:
    """The shortest way from *start* to what needs *end*, both ends of it included, and how many packages were looked at for it."""
    came: dict[str, str | None] = {start: None}
    queue = [start]
    while queue:
        name = queue.pop(0)
        if end in edges[name]:
            way = [name]
            while (before := came[way[-1]]) is not None:
                way.append(before)
            return tuple(reversed(way)), len(came)
        for needed in sorted(edges[name]):
            if needed in group and needed not in came:
                came[needed] = name
                queue.append(needed)
    return (), len(came)


CHECK = Check(
    id="dependency-cycle",
    summary="Packages that depend on each other in a cycle.",
    level=Level.ERROR,
    catalogue="M06",
    tags=("packages",),
    project=check,
)
