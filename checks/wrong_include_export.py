# SPDX-License-Identifier: Apache-2.0
"""Include directories that a package exports and that are not there (catkin_package.cmake, ament_cmake_export_include_directories)."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Project, ProjectPackage, regex
from haros_ci.api.packages import CMakeCommand, may_appear

_KEYWORDS = (
    "LIBRARIES",
    "CATKIN_DEPENDS",
    "DEPENDS",
    "CFG_EXTRAS",
    "EXPORTED_TARGETS",
    "INCLUDE_DIRS",
    "SKIP_CMAKE_CONFIG_GENERATION",
)
#: Further words of ``install``.
_INSTALL = ("DESTINATION", "DIRECTORY", "FILES", "FILES_MATCHING", "PATTERN", "REGEX", "PERMISSIONS", "COMPONENT", "OPTIONAL", "EXCLUDE")  # fmt: skip
#: Where headers are installed.
_INCLUDED = regex(r"\$\{CATKIN_(?:PACKAGE|GLOBAL)_INCLUDE_DESTINATION\}|(?:\$\{CMAKE_INSTALL_PREFIX\}/)?include(?:/|$)")
#: Commands that make no directory of headers.
_QUIET = frozenset(
    ("catkin_package", "include_directories", "target_include_directories", "project", "install", "find_package", "set_target_properties")
)  # fmt: skip


def check(project: Project) -> Iterator[Finding]:
    for package in project.packages if project.workspace.names else ():
        for command in package.commands("catkin_package"):
            words = command.after("INCLUDE_DIRS", *_KEYWORDS)
            for word in dict.fromkeys(words):
                finding = _of_catkin(package, command, word)
                if finding is not None:
                    yield finding


def _of_catkin(package: ProjectPackage, command: CMakeCommand, word: str) -> Finding | None:
    if word == "${BUILD}" or (
        word.startswith("${BUILD}/") and not word.startswith(("${BUILD}/devel", "${BUILD}/include"))
    ):
        if _installs_generated(package):
            return None
        return Finding(
            at=command.location,
            message=f"catkin_package(INCLUDE_DIRS) of {package.name} exports a directory of the build space: catkin warns, and packages that "
            "use an installed one do not find the headers; generate them below ${CATKIN_DEVEL_PREFIX}/include and install them",
            about=(package.name, word),
            level=Level.WARNING,
        )
    path = command.place(word)
    if path is None or command.is_conditional or package.project.exists(path) or _is_made(package, path):
        return None
    return Finding(
        at=command.location,
        message=f"catkin_package(INCLUDE_DIRS) of {package.name} exports {word}, which does not exist: CMake stops here; git does not store empty "
        "directories: remove the word, or add the headers",
        about=(package.name, word),
        apart=(word,),
    )


def _installs_generated(package: ProjectPackage) -> bool:
    """Whether headers of the build space are installed, so that what uses an installed package finds them."""
    for command in package.commands("install"):
        target = next(iter(command.after("DESTINATION", *_INSTALL)), "")
        if not _INCLUDED.match(target):
            continue
        files = command.after("FILES", *_INSTALL)
        is_made = "FILES" in command.arguments and not files  # a variable that another command has filled
        if is_made or any(word.startswith("${BUILD}") for word in (*files, *command.after("DIRECTORY", *_INSTALL))):
            return True
    return False


def _is_made(package: ProjectPackage, path: str) -> bool:
    makers = (command for command in package.build.commands if command.name not in _QUIET)
    named = any(maker.place(word) == path or f"{path}/" in word for maker in makers for word in maker.arguments)
    return named or path == "." or may_appear(package, path, {command.name for command in package.build.commands})


CHECK = Check(
    id="wrong-include-export",
    summary="Exported include directory that does not exist or lies in the build space.",
    level=Level.ERROR,
    tags=("build",),
    project=check,
)
