# SPDX-License-Identifier: Apache-2.0
"""Packages that CMake finds, and that nothing else of a package uses."""

from __future__ import annotations

import re
from collections.abc import Iterable

from haros_ci.checking.known_commands import is_well_known
from haros_ci.checking.needs import Need
from haros_ci.checking.project import ProjectPackage
from haros_ci.checking.provision import Provisions
from haros_ci.regex import regex

#: The beginnings of names of packages that only the build needs.
BUILD_TOOLS = (
    "ament_cmake",
    "rosidl_default_generators",
    "catkin",
    "message_generation",
    "cmake_modules",
    "eigen3_cmake_module",
)
#: The core of ROS, whose headers are named otherwise.
_CORE = frozenset(
    ("roscpp", "rclcpp", "roslib", "rosconsole", "rostime", "roscpp_traits", "roscpp_serialization", "cpp_common")
)
_INCLUDE = regex(r"^[ \t]*#[ \t]*include[ \t]*[<\"]([^<>\"\n]{1,200})[>\"]", re.MULTILINE)
_DEFINED = regex(r"^[ \t]*(?:function|macro)[ \t]*\([ \t]*(\w{1,100})", re.IGNORECASE | re.MULTILINE)
#: Commands that pass on what find_package() found; to name a package there uses nothing of it.
_PASSING = ("ament_target_dependencies", "ament_export_dependencies")


def idle_commands(package: ProjectPackage, name: str, uses: Iterable[Need], provisions: Provisions) -> tuple[str, ...]:
    """The commands that alone name the package *name*, find_package() and those that pass it on; empty where a source, interface or launch file uses it,
    or what comes with it.
    """
    if any(use.is_header or use.what != f"find_package({name})" for use in uses) or name.startswith(BUILD_TOOLS):
        return ()
    word = re.compile(rf"\b{re.escape(name)}\b")
    passing: list[str] = []
    for command in package.build.commands:
        is_found = command.name == "find_package"
        if command.name in _PASSING:
            passing += [command.name] if name in command.arguments else []
            continue
        if name.lower() in command.name or (not is_found and any(name in argument for argument in command.arguments)):
            return ()
        if (
            is_found
            and command.arguments[:1] != ("catkin",)
            and any(name in argument for argument in command.arguments[1:])
        ):
            return ()
    if _calls_unknown(package) or _is_mentioned(package, name, word) or _leads_to_headers(package, name, provisions):
        return ()  # a package that is found may define the command
    return "find_package", *dict.fromkeys(passing)


def _is_mentioned(package: ProjectPackage, name: str, word: re.Pattern[str]) -> bool:
    """Whether a file of the package but for its CMake has the name, or includes what the package *name* provides."""
    known = package.project.knowledge
    for file in package.files:
        if file.language == "cmake":
            continue
        if file.language == "cpp" and name in _CORE:
            return True  # headers of generated messages need it
        text = package.project.text(file.path)
        if word.search(text) or any(
            name in (known.provider_of_header(found[1]) or ()) for found in _INCLUDE.finditer(text)
        ):
            return True
    return False


def _calls_unknown(package: ProjectPackage) -> bool:
    """Whether CMake calls a command that nothing which is known defines: a package that is found brings it."""
    called = {command.name for command in package.build.commands if not is_well_known(command.name)}
    if not called:
        return False
    files = (path for path in package.project.workspace.names if path.endswith((".cmake", "CMakeLists.txt")))
    defined = {found[1].lower() for path in files for found in _DEFINED.finditer(package.project.text(path))}
    return not called <= defined


def _leads_to_headers(package: ProjectPackage, name: str, provisions: Provisions) -> bool:
    """Whether sources include headers of what comes with *name*, and find_package() names nothing else that brings them: the path to them
    may come with *name* alone, as that of Eigen does.
    """
    known = package.project.knowledge
    found = {word for command in package.commands("find_package") for word in command.arguments} - {name}
    by_others = found.union(*(known.provider_of_cmake(word) or () for word in found))
    by_others = by_others.union(*(provisions.closure(word, package.ros) for word in sorted(by_others)))
    inner = provisions.closure(name, package.ros) - {name}
    for file in package.files if inner else ():
        if file.language == "cpp":
            for included in _INCLUDE.finditer(package.project.text(file.path)):
                providers = known.provider_of_header(included[1]) or frozenset()
                if providers & inner and not providers & by_others:
                    return True
    return False
