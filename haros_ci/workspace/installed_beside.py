# SPDX-License-Identifier: Apache-2.0
"""Programs that a package installs from outside of its directory: ``install(PROGRAMS ../scripts/talk.py DESTINATION lib/demo)``.

``install(DIRECTORY)`` installs programs where it keeps the permissions (USE_SOURCE_PERMISSIONS: cmake.org/cmake/help/latest/command/install.html).
"""

from __future__ import annotations

import posixpath
from collections.abc import Callable, Collection, Iterable, Iterator

from haros_ci.model.package import SourceFile
from haros_ci.workspace.cmake_parse import parse_cmake

#: What stands for the directory of a CMakeLists.txt at the top of a package.
_HERE = ("${CMAKE_CURRENT_SOURCE_DIR}/", "${CMAKE_CURRENT_LIST_DIR}/", "${CMAKE_SOURCE_DIR}/", "${PROJECT_SOURCE_DIR}/")


def keeps_permissions(words: Iterable[str]) -> bool:
    """Whether the *words* of install(DIRECTORY) install programs as programs, and all that are there."""
    words = set(words)
    return "USE_SOURCE_PERMISSIONS" in words and words.isdisjoint(("PATTERN", "REGEX"))


def installed_beside(files: Iterable[SourceFile], text: Callable[[str], str]) -> tuple[str, ...]:
    """The files and directories outside of packages that their CMakeLists.txt install programs from, by path."""
    return tuple(
        path
        for file in files
        if file.package is not None and posixpath.basename(file.path) == "CMakeLists.txt"
        for path in _named(file.path, file.package, text(file.path))
    )


def _named(cmake: str, package: str, text: str) -> Iterator[str]:
    for command in parse_cmake(text).commands if "../" in text else ():
        words = [argument.text for argument in command.arguments]
        is_python = command.name == "catkin_install_python"
        if not is_python and not (command.name == "install" and words[:1] in (["PROGRAMS"], ["DIRECTORY"])):
            continue
        if "DESTINATION" not in words or (words[0] == "DIRECTORY" and not keeps_permissions(words)):
            continue
        end = words.index("DESTINATION")
        goal = words[end + 1] if len(words) > end + 1 else ""
        if goal.rstrip("/") not in (f"lib/{package}", "lib/${PROJECT_NAME}") and "BIN_DESTINATION" not in goal:
            continue
        for word in words[1:end]:
            word = next((word.removeprefix(here) for here in _HERE if word.startswith(here)), word)
            if word.startswith("../") and "$" not in word:
                yield posixpath.normpath(posixpath.join(posixpath.dirname(cmake), word))


def is_program(path: str, places: Iterable[str], executables: Collection[str] | None) -> bool:
    """Whether the file at *path* is one of *places*, or a program below one; *executables* are those whose execute bit is set, None if nobody knows."""
    is_runnable = executables is None or path in executables
    return any(path == place or (is_runnable and path.startswith(f"{place}/")) for place in places)
