# SPDX-License-Identifier: Apache-2.0
"""Blocks of CMake's ``if`` that decide which of several packages is looked for, by what nothing in the package sets."""

from __future__ import annotations

from haros_ci.regex import regex
from haros_ci.workspace.cmake_parse import ParsedCommand

#: What CMake sets by itself, on this system or on others (cmake-variables(7)).
_OF_CMAKE = regex(
    r"_?CMAKE_|CTEST_|CPACK_|PROJECT_|ARG[CNV]|MSVC|WIN32|WINCE|WINDOWS|APPLE|MINGW|MSYS|CYGWIN|ANDROID|IOS|XCODE|BORLAND"
    r"|EMSCRIPTEN|WASM|(?:\w{0,20}BSD|QNX\w{0,20}|VXWORKS|HAIKU|SUNOS|HPUX|AIX)\Z"
)
#: Build tools: which of them there is, is the ROS of the package.
_TOOLS = frozenset(("catkin", "ament_cmake", "ament_cmake_auto", "ament_cmake_ros"))


def is_choice(command: ParsedCommand) -> bool:
    """Whether two branches or more of the block *command* of ``if`` look each for a package that no other one looks for."""
    found = [_found(body) for _, body in command.branches]
    everything = set().union(*found)
    if len(found) < 2 or everything & _TOOLS:
        return False
    times = {name: sum(name in group for group in found) for name in everything}
    return sum(any(times[name] == 1 for name in group) for group in found) > 1


def may_be_given(name: str) -> bool:
    """Whether who calls CMake, or a package that was found, may set the variable *name*, which nothing here has set.

    What nobody has looked for is not found.
    """
    return not name.endswith("_FOUND") and _OF_CMAKE.match(name) is None


def _found(body: list[ParsedCommand]) -> set[str]:
    """The packages that the commands of *body*, not those of blocks within, look for."""
    return {command.arguments[0].text for command in body if command.name == "find_package" and command.arguments}
