# SPDX-License-Identifier: Apache-2.0
"""Whether the packages of a workspace are built against one of them."""

from __future__ import annotations

from haros_ci.checking.project import ProjectPackage

_KINDS = ("depend", "build_depend", "build_export_depend")
_COMMANDS = ("find_package", "catkin_package", "ament_export_dependencies")


def is_built_against(package: ProjectPackage) -> bool:
    """Whether another package of the workspace is built against *package*, or has those look for it that are built against itself."""
    return any(
        any(dependency.name == package.name and dependency.kind in _KINDS for dependency in other.raw.dependencies)
        or any(package.name in command.arguments for command in other.commands(*_COMMANDS))
        for other in package.project.packages
        if other is not package
    )
