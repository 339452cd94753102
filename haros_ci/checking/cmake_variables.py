# SPDX-License-Identifier: Apache-2.0
"""Whether what CMake finds sets the variables of a library."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.checking.project import ProjectPackage
from haros_ci.model.build import CMakeCommand

#: What find_package() finds that sets variables of its own name alone, in small letters.
_ALONE = frozenset(
    ("catkin", "boost", "pkgconfig", "threads", "opencv", "pythonlibs", "cmake_modules", "roslint", "rostest")
)


def may_set_variables(package: ProjectPackage, name: str) -> bool:
    """Whether CMake may set ``<name>_INCLUDE_DIRS`` or ``<name>_LIBRARIES``; upper and lower case are not distinguished; or whether catkin takes the name for a package that is found."""
    finds = [
        command
        for command in package.build.commands
        if command.name in ("find_package", "pkg_check_modules", "pkg_search_module")
    ]
    named = {
        word.lower()
        for find in finds
        for word in (find.arguments[:1] if find.arguments[:1] != ("catkin",) else find.arguments)
    }
    if (
        "$" in name
        or " " in name
        or name.lower() in named
        or not named <= _ALONE | {word.lower() for word in _components(finds)}
    ):
        return True
    if _is_brought(package, name):
        return True
    texts = (package.project.text(path) for path in {command.location.path for command in package.build.commands})
    return any(re.search(rf"(?i)\b{re.escape(name)}_(?:INCLUDE_DIRS?|LIBRARIES)\s+\S", text) for text in texts)


def _is_brought(package: ProjectPackage, name: str) -> bool:
    """Whether *name* is a package of ROS that another one may bring: the configuration of a catkin package finds what it exports.

    catkin_package() then takes a name behind DEPENDS for one behind CATKIN_DEPENDS.
    """
    project = package.project
    is_ros = project.package(name) is not None or bool(project.knowledge.is_package(name))
    finds = package.commands("find_package")
    found = {word for find in finds for word in find.arguments} - {"catkin", "REQUIRED", "COMPONENTS", "QUIET"}
    return is_ros and any(project.package(word) is not None or project.knowledge.is_package(word) for word in found)


def _components(finds: list[CMakeCommand]) -> Iterator[str]:
    """What is found by catkin, and the prefixes of pkg-config: they set variables of no other name."""
    for find in finds:
        yield from find.arguments if find.arguments[:1] == ("catkin",) else ()
        yield from find.arguments[:1] if find.name != "find_package" else ()
