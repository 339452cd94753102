# SPDX-License-Identifier: Apache-2.0
"""C++ sources that no target compiles and no file includes: what they say never runs."""

from __future__ import annotations

import posixpath
import re
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from haros_ci.checking.project import Project, ProjectPackage

SUFFIXES = (".cpp", ".cc", ".cxx", ".c++")
#: Commands that may compile files that they do not name.
_FETCHING = (
    "aux_source_directory",
    "externalproject_add",
    "fetchcontent_declare",
    "ament_vendor",
    "include_external_msproject",
)
#: What stands behind ``#`` at the start of a word, in brackets or to the end of its line.
_COMMENT = re.compile(r"(?<![^\s()])#(?:\[(=*)\[.*?\]\1\]|[^\n]*)", re.DOTALL)
_NAME = re.compile(r"[\w.+-]+")


def unbuilt(project: Project) -> frozenset[str]:
    """The sources of all packages whose CMake files are known as a whole, and name them nowhere."""
    return frozenset(path for package in project.packages for path in loose(package))


def loose(package: ProjectPackage) -> list[str]:
    """The C++ sources of *package* that no target compiles, the text of no CMake file names and no file includes.

    None where something of its CMake files is unknown, or a command may compile what it does not name. A comment names nothing.
    """
    if not package.cmake.is_whole or package.commands(*_FETCHING):
        return []
    compiled = {path for target in package.build.targets for path in (*target.sources, *target.conditional_sources)}
    left = [file.path for file in package.files if file.path.endswith(SUFFIXES) and file.path not in compiled]
    if not left:
        return []
    named, included = _named(package), _included(package)
    return [
        path
        for path in left
        if not {posixpath.basename(path), _stem(path)} & named and posixpath.basename(path) not in included
    ]


def _named(package: ProjectPackage) -> set[str]:
    """The last parts of the paths in the package's CMake files, also in branches that are not followed.

    A word without an end counts as a name only where a variable makes names: ``${name}.cpp``.
    """
    inside = "" if package.path == "." else f"{package.path}/"
    files = (name for name in package.project.workspace.names if name.startswith(inside))
    texts = (package.project.text(name) for name in files if name.endswith(("CMakeLists.txt", ".cmake")))
    text = "\n".join(_COMMENT.sub(" ", each) for each in texts)
    words = set(_NAME.findall(text))
    return words if "}.c" in text else {word for word in words if word.endswith(SUFFIXES)}


def _stem(path: str) -> str:
    return posixpath.splitext(posixpath.basename(path))[0]


def _included(package: ProjectPackage) -> set[str]:
    """The last parts of all names that files of the workspace include."""
    programs = package.project.programs.values()
    return {posixpath.basename(name.strip('<>"')) for program in programs for name in program.includes}
