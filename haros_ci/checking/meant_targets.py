# SPDX-License-Identifier: Apache-2.0
"""What is meant by names of CMake targets, exported libraries and dependencies that a package does not have."""

from __future__ import annotations

from functools import lru_cache

from haros_ci.checking.likeness import is_slip
from haros_ci.checking.project import ProjectPackage
from haros_ci.checking.wording import alternatives, listed
from haros_ci.model.build import CMakeCommand
from haros_ci.model.slips import equally_near

#: Names that are compared with one that is not known.
MAX_NAMES = 300
#: What exports libraries; catkin_package() has them behind LIBRARIES.
_OF_LIBRARIES = ("catkin_package", "ament_export_libraries")
#: Those of catkin_package().
KEYWORDS_OF_CATKIN = (
    *("INCLUDE_DIRS", "LIBRARIES", "CATKIN_DEPENDS", "DEPENDS", "CFG_EXTRAS", "EXPORTED_TARGETS"),
    *("SKIP_CMAKE_CONFIG_GENERATION", "SKIP_PKG_CONFIG_GENERATION"),
)


def is_slip_of_target(package: ProjectPackage, name: str) -> bool:
    """Whether *name* differs by a slip from a target of the package."""
    return any(is_slip(name, target) for target in list(package.cmake.targets)[:MAX_NAMES])


def target_hint(package: ProjectPackage, command: CMakeCommand, wrong: tuple[str, ...]) -> str:
    """What to write in *command* instead of the names that are *wrong*, as the end of a message."""
    return _hint(package, command, wrong[0]) if len(wrong) == 1 else _hint_of_several(package, command, wrong)


def _hint(package: ProjectPackage, command: CMakeCommand, name: str) -> str:
    """What to write instead of *name*."""
    if name in package.cmake.targets:
        return _hint_of_program(package, command, name) if _is_library(command, name) else ""
    near = _near(package, command, name)
    if near and command.name == "ament_export_dependencies" and _squeezed(near[0]) == _squeezed(name):
        return f"; write {near[0]}, as find_package() has it here"
    names = meant_targets(package, command, name)
    if _is_library(command, name) and not names and package.cmake.targets:
        return f"; {_takes_libraries(command)}, and the package builds none: remove the name"
    if meant := alternatives(near):
        return f"; did you mean {meant}?"
    return "; correct the name, or remove it" if command.name == "ament_export_dependencies" else _instead(names)


def _hint_of_program(package: ProjectPackage, command: CMakeCommand, name: str) -> str:
    """What to write instead of the program *name* behind LIBRARIES: a library of the package that does not stand there."""
    if package.cmake.targets[name].kind != "executable":
        return ""
    if not meant_targets(package, command, name):
        return f"; {_takes_libraries(command)}, and the package builds none: remove the name"
    meant = alternatives([library for library in _near(package, command, name) if library not in command.arguments])
    return f"; did you mean {meant}?" if meant else f"; {_takes_libraries(command)}: remove the name"


def _takes_libraries(command: CMakeCommand) -> str:
    where = "LIBRARIES" if command.name == "catkin_package" else f"{command.name}()"
    return f"{where} takes libraries"


def _hint_of_several(package: ProjectPackage, command: CMakeCommand, wrong: tuple[str, ...]) -> str:
    """What to write instead of the libraries *wrong*: for each another one, or nothing."""
    near = [_near(package, command, name) for name in wrong]
    meant = [found[0] for found in near if len(found) == 1]
    if len(meant) == len(wrong) == len(set(meant)):
        return f"; did you mean {listed(meant)}?"
    names = [candidate for candidate in meant_targets(package, command, wrong[0]) if candidate not in command.arguments]
    return f"{_instead(names)}: write the right ones, or remove the names" if names else "; remove the names"


def _is_library(command: CMakeCommand, name: str) -> bool:
    return command.name in _OF_LIBRARIES and name not in command.after("INCLUDE_DIRS", *KEYWORDS_OF_CATKIN)


def meant_targets(package: ProjectPackage, command: CMakeCommand, name: str) -> list[str]:
    """What the unknown *name* in *command* may be meant for: packages that are found, libraries, or all targets."""
    if command.name == "ament_export_dependencies":
        return sorted(
            {word for other_command in package.commands("find_package") for word in other_command.arguments[:1]}
        )
    names = sorted(package.cmake.targets)
    if _is_library(command, name):  # an executable is no library that others could link
        return [item for item in names if package.cmake.targets[item].kind != "executable"]
    return names


def _near(package: ProjectPackage, command: CMakeCommand, name: str) -> list[str]:
    """Those that *name* may be meant for, none nearer than another; empty where none is like it."""
    names = meant_targets(package, command, name)
    near = _by_squeezed(tuple(names)).get(_squeezed(name), [])
    if _is_library(command, name) and not near:
        near = _only_installed(package, names)
    near = near[:1] or [*equally_near(name[:100], names[:MAX_NAMES])]
    return near


def _only_installed(package: ProjectPackage, libraries: list[str]) -> list[str]:
    """The one of *libraries* that the package installs; none where there are several, or what it installs is not known."""
    keywords = "ARCHIVE LIBRARY RUNTIME EXPORT DESTINATION PUBLIC_HEADER INCLUDES OBJECTS COMPONENT".split()
    words = {word for command in package.commands("install") for word in command.after("TARGETS", *keywords)}
    found = [name for name in libraries if name in words]
    return found if len(found) == 1 and not any("$" in word for word in words) else []


@lru_cache(maxsize=4)
def _by_squeezed(names: tuple[str, ...]) -> dict[str, list[str]]:
    """Those that differ in nothing else together, in their order: what is unknown in a package is looked up in the same names."""
    found: dict[str, list[str]] = {}
    for name in names:
        found.setdefault(_squeezed(name), []).append(name)
    return found


def _squeezed(name: str) -> str:
    """*name* without what names of CMake, ROS and file systems differ in: case, hyphens and underscores."""
    return name.replace("-", "").replace("_", "").lower()


def _instead(targets: list[str]) -> str:
    """What to write for a name that is like none of *targets*."""
    if not targets:
        return "; remove the name"
    more = f" and {len(targets) - 3} more" if len(targets) > 3 else ""
    return f"; the package builds {', '.join(targets[:3])}{more}"
