# SPDX-License-Identifier: Apache-2.0
"""The packages of a workspace: what they need of each other, how large they are, and which stand in a circle."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from typing import Any

from haros_ci.html_page.package_picture import package_picture
from haros_ci.html_page.pool import Pool
from haros_ci.model.build import Build
from haros_ci.model.package import Package
from haros_ci.model.workspace import Workspace

#: Tags of a manifest by what they are for.
KINDS = {
    "build_depend": "build",
    "build_export_depend": "build",
    "buildtool_depend": "build",
    "buildtool_export_depend": "build",
    "depend": "build",
    "exec_depend": "run",
    "run_depend": "run",
    "test_depend": "test",
}
#: Languages whose lines are counted one by one.
LANGUAGES = ("cpp", "python", "launch", "yaml", "interface", "cmake")
#: Interfaces that are shown with their fields.
MOST_INTERFACES = 3_000


def packages(pool: Pool, workspace: Workspace) -> list[dict[str, Any]]:
    """Each package by name: place, version, build type, lines by language, the packages that it needs, whether it is in a circle."""
    ordered = sorted(workspace.packages, key=lambda one: (one.name, one.path))
    lines: dict[str, Counter[str]] = {}
    files: Counter[str] = Counter()
    for file in workspace.files:
        name = file.package or ""
        files[name] += 1
        if not file.third_party:
            lines.setdefault(name, Counter())[file.language] += file.lines
    names = {one.name for one in ordered}
    circles = in_circles({one.name: _needed(one, names) for one in ordered})
    return [
        {
            "name": pool.text(one.name),
            "path": pool.text(one.path),
            "version": pool.text(one.version),
            "build": pool.text(one.build_type),
            "ros": one.ros or 0,
            "files": files[one.name],
            "lines": [lines.get(one.name, Counter())[language] for language in LANGUAGES],
            "needs": sorted(
                {
                    (pool.text(each.name), KINDS[each.kind], int(each.name in names))
                    for each in one.dependencies
                    if each.kind in KINDS and each.name != one.name
                }
            ),
            "circle": circles.get(one.name, -1),
        }
        for one in ordered
    ]


def picture(workspace: Workspace) -> dict[str, Any] | None:
    """The picture of the packages, in the order of their names; None if two have the same name, or there are too many."""
    names = {one.name for one in workspace.packages}
    if len(names) != len(workspace.packages):
        return None
    needs = {one.name: _needed(one, names) - {one.name} for one in workspace.packages}
    return package_picture(needs, in_circles(needs))


def _needed(package: Package, names: set[str]) -> set[str]:
    """What must be built before it."""
    return {one.name for one in package.dependencies if KINDS.get(one.kind) == "build" and one.name in names}


def in_circles(needs: Mapping[str, Iterable[str]]) -> dict[str, int]:
    """The packages that need themselves through others, by name, with the number of their circle from 0 (Tarjan 1972, without recursion)."""
    index: dict[str, int] = {}
    low: dict[str, int] = {}
    stack: list[str] = []
    on_stack: set[str] = set()
    found: dict[str, int] = {}
    for start in sorted(needs):
        if start in index:
            continue
        work = [(start, iter(sorted(needs[start])))]
        while work:
            name, rest = work[-1]
            if name not in index:
                index[name] = low[name] = len(index)
                stack.append(name)
                on_stack.add(name)
            for other in rest:
                if other not in index:
                    work.append((other, iter(sorted(needs.get(other, ())))))
                    break
                if other in on_stack:
                    low[name] = min(low[name], index[other])
            else:
                work.pop()
                if work:
                    low[work[-1][0]] = min(low[work[-1][0]], low[name])
                if low[name] == index[name]:
                    _close(name, stack, on_stack, found)
    return found


def _close(name: str, stack: list[str], on_stack: set[str], found: dict[str, int]) -> None:
    """Take what belongs to *name* off the stack; it is a circle if there is more than one."""
    at = stack.index(name)
    members = stack[at:]
    del stack[at:]
    on_stack.difference_update(members)
    if len(members) > 1:
        number = len(set(found.values()))
        found.update(dict.fromkeys(members, number))


def interfaces(pool: Pool, builds: Mapping[str, Build]) -> list[tuple[Any, ...]]:
    """Messages, services and actions of the workspace: name, kind, file, and the fields of each section (type, name, constant or default)."""
    every = sorted((each for build in builds.values() for each in build.interfaces), key=lambda i: (i.name, i.path))
    return [
        (
            pool.text(each.name),
            each.kind,
            pool.place_of(each.path),
            tuple(
                tuple((pool.text(f.written or f.type), pool.text(f.name), pool.text(f.value)) for f in section[:200])
                for section in each.sections
            ),
        )
        for each in every[:MOST_INTERFACES]
    ]
