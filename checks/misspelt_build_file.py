# SPDX-License-Identifier: Apache-2.0
"""package.xml and CMakeLists.txt under a name that no build tool looks for."""

from __future__ import annotations

import posixpath
from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Location, Project, is_slip
from haros_ci.api.packages import build_types

_MANIFEST, _CMAKE = "package.xml", "CMakeLists.txt"
#: What such a file has to hold: a name alone is no sign.
_IN_MANIFEST = ("<package", "<name>", "</package>")
_IN_CMAKE = ("project(", "project (", "catkin_package", "ament_package", "cmake_minimum_required")
#: Other files that are called nearly so.
_OTHER = frozenset(("packages.xml", "package.xsd", "package.html"))
_BUILDS = frozenset(("catkin", "ament_cmake", "cmake"))


def check(project: Project) -> Iterator[Finding]:
    names = project.workspace.names
    folders: dict[str, set[str]] = {}
    for path in names:
        folder, _, name = path.rpartition("/")
        if name in (_MANIFEST, _CMAKE) or is_meant(name):
            folders.setdefault(folder or ".", set()).add(name)
    roots = project.roots
    for folder, found in sorted(folders.items()):
        for name in sorted(found - {_MANIFEST, _CMAKE}):
            path = name if folder == "." else f"{folder}/{name}"
            right = is_meant(name)
            if right in found or _is_put_aside(name, right, found):
                continue
            if right == _CMAKE and folder in roots and _is_built(project, folder) and _has(project, path, _IN_CMAKE, 1):
                yield _finding(path, right, "the build of the package fails, for CMake finds no CMakeLists.txt")
            elif right == _MANIFEST and not _is_inside(folder, roots) and _has(project, path, _IN_MANIFEST, 3):
                yield _finding(path, right, "colcon and catkin see no package here")


def _is_put_aside(name: str, right: str, found: set[str]) -> bool:
    """Whether the manifest and the CMakeLists.txt of a directory have the same sign behind their names: a script, or a person, renames both back."""
    sign = name.removeprefix(right)
    return sign != name and {_MANIFEST + sign, _CMAKE + sign} <= found


def is_meant(name: str) -> str:
    """The file that a file called *name* is meant to be; "" for the right names and others."""
    if name in _OTHER:
        return ""
    for right in (_MANIFEST, _CMAKE):
        if name != right and (name.lower() == right.lower() or is_slip(name, right)):
            return right
    return ""


def _is_built(project: Project, folder: str) -> bool:
    """Whether the package is built by CMake; without a build type catkin is meant (REP 149)."""
    package = next(package for package in project.packages if package.path == folder)
    kinds = {element.text.strip() for element in build_types(package)}
    return kinds <= _BUILDS


def _is_inside(folder: str, roots: frozenset[str]) -> bool:
    """Whether a package is here, or around: then a second manifest is something else."""
    while folder != ".":
        if folder in roots:
            return True
        folder = posixpath.dirname(folder) or "."
    return "." in roots


def _has(project: Project, path: str, words: tuple[str, ...], count: int) -> bool:
    text = project.text(path)
    return sum(word in text for word in words) >= count


def _finding(path: str, right: str, effect: str) -> Finding:
    name = posixpath.basename(path)
    return Finding(
        at=Location(path, 1),
        message=f"{name} is not called {right}, and names of files are told apart by case and each letter: {effect}; rename it to {right}",
        about=(path,),
    )


CHECK = Check(
    id="misspelt-build-file",
    summary="package.xml or CMakeLists.txt under a misspelt name.",
    level=Level.ERROR,
    tags=("packages", "build"),
    project=check,
)
