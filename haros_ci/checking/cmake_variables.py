# SPDX-License-Identifier: Apache-2.0
"""Whether what CMake finds sets the variables of a library."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.checking.project import ProjectPackage
from haros_ci.checking.provision import is_of_ros
from haros_ci.model.build import CMakeCommand

#: What find_package() finds that sets variables of its own name alone, in small letters.
_ALONE = frozenset(
    ("catkin", "boost", "pkgconfig", "threads", "opencv", "pythonlibs", "cmake_modules", "roslint", "rostest")
)


def may_set_variables(package: ProjectPackage, name: str) -> bool:
    """Whether CMake may set ``<name>_INCLUDE_DIRS`` or ``<name>_LIBRARIES``; upper and lower case are not distinguished."""
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
    texts = (package.project.text(path) for path in {command.location.path for command in package.build.commands})
    return any(re.search(rf"(?i)\b{re.escape(name)}_(?:INCLUDE_DIRS?|LIBRARIES)\s+\S", text) for text in texts)


def is_found_by_others(package: ProjectPackage, name: str) -> bool:
    """Whether packages that catkin finds may find the package *name* for themselves; behind DEPENDS it is then what it is behind CATKIN_DEPENDS.

    catkin/cmake/catkin_package.cmake (``_FOUND_CATKIN_PROJECT``), and catkin/cmake/template/pkgConfig.cmake.in, which finds dependencies.
    """
    finds = [find for find in package.commands("find_package") if find.arguments[:1] == ("catkin",)]
    return any(find.after("COMPONENTS") for find in finds) and is_of_ros(name, package.project)


def _components(finds: list[CMakeCommand]) -> Iterator[str]:
    """What is found by catkin, and the prefixes of pkg-config: they set variables of no other name."""
    for find in finds:
        yield from find.arguments if find.arguments[:1] == ("catkin",) else ()
        yield from find.arguments[:1] if find.name != "find_package" else ()
