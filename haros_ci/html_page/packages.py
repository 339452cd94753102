# SPDX-License-Identifier: Apache-2.0
"""The packages of a workspace: what they need of each other, how large they are, and which stand in a circle."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from typing import Any

from haros_ci.html_page.package_picture import package_picture
from haros_ci.html_page.pool import Pool
from haros_ci.model.build import Build
from haros_ci.model.cycles import in_circles
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
    lines = _lines(workspace)
    files = Counter(file.package or "" for file in workspace.files)
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
                    (pool.text(dependency.name), KINDS[dependency.kind], int(dependency.name in names))
                    for dependency in one.dependencies
                    if dependency.kind in KINDS and dependency.name != one.name
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
    lines = {name: sum(counts[language] for language in LANGUAGES) for name, counts in _lines(workspace).items()}
    return package_picture(needs, in_circles(needs), lines)


def _lines(workspace: Workspace) -> dict[str, Counter[str]]:
    """Lines by package and language, without what third parties have written."""
    found: dict[str, Counter[str]] = {}
    for file in workspace.files:
        if not file.third_party:
            found.setdefault(file.package or "", Counter())[file.language] += file.lines
    return found


def _needed(package: Package, names: set[str]) -> set[str]:
    """What must be built before it."""
    return {one.name for one in package.dependencies if KINDS.get(one.kind) == "build" and one.name in names}


def interfaces(pool: Pool, builds: Mapping[str, Build]) -> list[tuple[Any, ...]]:
    """Messages, services and actions of the workspace: name, kind, file, and the fields of each section (type, name, constant or default)."""
    every = sorted(
        (interface for build in builds.values() for interface in build.interfaces), key=lambda i: (i.name, i.path)
    )
    return [
        (
            pool.text(interface.name),
            interface.kind,
            pool.place_of(interface.path),
            tuple(
                tuple((pool.text(f.written or f.type), pool.text(f.name), pool.text(f.value)) for f in section[:200])
                for section in interface.sections
            ),
        )
        for interface in every[:MOST_INTERFACES]
    ]
