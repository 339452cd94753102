# SPDX-License-Identifier: Apache-2.0
"""Scripts by the Python and the client library that they are written for, and the modes that they are installed with."""

from __future__ import annotations

import re

from haros_ci.checking.project import ProjectPackage
from haros_ci.model.build import Installed
from haros_ci.regex import regex

_ROSPY = regex(r"^(?:import|from)[ \t]+rospy\b", re.MULTILINE)
#: A program that is ready for the other client library, or for none.
_EITHER = regex(
    r"\brclpy\b|\bROS_VERSION\b|^[ \t]*except\b[^\n]{0,100}\b(?:ImportError|ModuleNotFoundError)\b", re.MULTILINE
)

_MODES = ("USE_SOURCE_PERMISSIONS", "PERMISSIONS", "FILE_PERMISSIONS")


def rospy_programs(package: ProjectPackage) -> list[str]:
    """The programs that a package of ROS 2 installs and that are written for rospy alone, which it does not ask for either."""
    if package.ros != 2 or "rospy" in package.project.text(package.manifest_path):
        return []
    places = ("bin", f"lib/{package.name}")
    installed = (row.path for row in package.build.installed if row.kind != "directory" and row.destination in places)
    texts = {path: package.project.text(path) for path in installed}
    return [path for path, text in texts.items() if _ROSPY.search(text) and not _EITHER.search(text)]


def gives_modes(script: Installed, package: ProjectPackage) -> bool:
    """Whether the command says which modes the files get, or is not one that is known."""
    commands = [command for command in package.commands("install") if command.location == script.location]
    return not commands or any(word in command.arguments for command in commands for word in _MODES)


def changes_modes(package: ProjectPackage) -> bool:
    """Whether a command of the build sets modes by itself, of which files is not followed: ``execute_process(COMMAND chmod …)``."""
    return any("chmod" in word.lower() for command in package.build.commands for word in command.arguments)
