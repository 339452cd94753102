# SPDX-License-Identifier: Apache-2.0
"""Whether the packages of a workspace are built against one of them."""

from __future__ import annotations

from haros_ci.checking.project import ProjectPackage
from haros_ci.model.build import CMakeCommand

_KINDS = ("depend", "build_depend", "build_export_depend")
_COMMANDS = ("find_package", "ament_export_dependencies")
#: What stands behind LIBRARIES of catkin_package() is a library of the package itself, and no other package.
_NOT_OTHERS = ("INCLUDE_DIRS", "LIBRARIES", "CFG_EXTRAS", "EXPORTED_TARGETS")


def is_built_against(package: ProjectPackage) -> bool:
    """Whether another package of the workspace is built against *package*, or has those look for it that are built against itself."""
    return any(
        any(dependency.name == package.name and dependency.kind in _KINDS for dependency in other.raw.dependencies)
        or any(package.name in command.arguments for command in other.commands(*_COMMANDS))
        or any(_is_exported(package.name, command) for command in other.commands("catkin_package"))
        for other in package.project.packages
        if other is not package
    )


def _is_exported(name: str, command: CMakeCommand) -> bool:
    """Whether catkin_package() names the package *name*: those that are built against the one that it stands in look for it."""
    keywords = ("CATKIN_DEPENDS", "DEPENDS")
    return any(name in command.after(word, *_NOT_OTHERS, *keywords) for word in keywords)
