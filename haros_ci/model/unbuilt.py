# SPDX-License-Identifier: Apache-2.0
"""Which C++ sources no target compiles, where the CMake of their package is known as a whole."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Collection, Iterable

from haros_ci.model.build import Build
from haros_ci.model.package import Package
from haros_ci.regex import regex

SUFFIXES = (".cpp", ".cc", ".cxx", ".c++")
#: Commands that may compile files that they do not name.
_FETCHING = frozenset(
    (
        "aux_source_directory",
        "externalproject_add",
        "fetchcontent_declare",
        "ament_vendor",
        "include_external_msproject",
    )
)
#: Beginnings of what the evaluator says where a part of the build is not seen.
_UNSEEN = regex(r"add_subdirectory\(|include\(|\w+\(\) is not known; what it builds|the name of this |its CMake ")
#: Without one of them a package is built in another way: for the other ROS, or by itself as an external project.
_LAST = {
    1: frozenset(("catkin_package", "catkin_metapackage", "cs_export")),
    2: frozenset(("ament_package", "ament_auto_package", "autoware_ament_auto_package")),
}
#: What stands behind ``#`` at the start of a word, in brackets or to the end of its line.
_COMMENT = regex(r"(?<![^\s()])#(?:\[(=*)\[.*?\]\1\]|[^\n]*)", re.DOTALL)
_NAME = regex(r"[\w.+-]+")


def is_whole(build: Build, package: Package) -> bool:
    """Whether all files and commands that may make something were followed, to the command that ends a package's CMake."""
    last = _LAST.get(package.ros or 0, frozenset())
    is_ended = package.build_type == "cmake" or any(command.name in last for command in build.commands)
    return bool(build.commands) and is_ended and not any(_UNSEEN.match(problem.message) for problem in build.problems)


def is_cmake(path: str) -> bool:
    """Whether the file at *path* holds commands of CMake."""
    return path.endswith(("CMakeLists.txt", ".cmake"))


def uncompiled(build: Build, package: Package, paths: Iterable[str], texts: Iterable[str]) -> list[str]:
    """The C++ sources among *paths* that no target compiles and no CMake file of the package, of *texts*, names.

    None where something of its CMake files is unknown, or a command may compile what it does not name. A comment names nothing;
    what stands in branches that are not followed does.
    """
    if not is_whole(build, package) or any(command.name in _FETCHING for command in build.commands):
        return []
    compiled = {path for target in build.targets for path in (*target.sources, *target.conditional_sources)}
    left = [path for path in paths if path.endswith(SUFFIXES) and path not in compiled]
    named = _named(texts) if left else frozenset()
    return [path for path in left if not {posixpath.basename(path), _stem(path)} & named]


def not_included(paths: Iterable[str], included: Collection[str]) -> list[str]:
    """Those of *paths* whose last part is none of *included*, the last parts of what files include."""
    return [path for path in paths if posixpath.basename(path) not in included]


def _named(texts: Iterable[str]) -> frozenset[str]:
    """The last parts of the paths in CMake files. A word without an end counts as a name only where a variable makes names: ``${name}.cpp``."""
    text = "\n".join(_COMMENT.sub(" ", text) for text in texts)
    words = frozenset(_NAME.findall(text))
    return words if "}.c" in text else frozenset(word for word in words if word.endswith(SUFFIXES))


def _stem(path: str) -> str:
    return posixpath.splitext(posixpath.basename(path))[0]
