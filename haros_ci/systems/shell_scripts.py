# SPDX-License-Identifier: Apache-2.0
"""Shell scripts of packages that launch files start as nodes: one that only hands its words to a program is that program.

``rosrun p x "$@"``, ``ros2 run p x "$@"`` and ``python3 $(ros2 pkg prefix p)/lib/p/x "$@"`` are such, also behind lines that read the
environment of others (``source venv/bin/activate``). Without ``"$@"`` the names and remappings of the launch file would not
get there, and what else is in a script may start anything: that is not looked at.
"""

from __future__ import annotations

import posixpath
from collections.abc import Mapping

from haros_ci.model.build import Build
from haros_ci.model.workspace import Workspace
from haros_ci.records import dataclass, field
from haros_ci.regex import regex

_ENDINGS = (".sh", ".bash", ".zsh")
#: The first line of a script for a shell: ``#!/bin/sh``, ``#!/usr/bin/env bash``.
_FIRST = regex(r"#![^\n]{0,99}\b(?:ba|da|k|z)?sh\b")
#: Lines that start no program.
_IDLE = regex(r"(?:#[^\n]*|(?:set|source|\.)[ \t][^;&|`\n]*|)")
#: The one command of a script that hands its words on, to a program of a package.
_HANDS_ON = regex(
    r"""(?:exec[ \t]+)?(?:(?:rosrun|ros2[ \t]+run)[ \t]+(?P<package>[\w-]+)[ \t]+(?P<name>[\w.-]+)"""
    r"""|(?:python3?[ \t]+)?"?\$\(ros2[ \t]+pkg[ \t]+prefix[ \t]+(?P<own>[\w-]+)\)/lib/(?P=own)/(?P<file>[\w.-]+)"?)"""
    r"""[ \t]+(?:"\$@"|\$@|\$\{@\}|"\$\{@\}")[ \t]*"""
)


@dataclass(slots=True)
class ShellScripts:
    """The shell scripts of a workspace by package and the name that they are started by."""

    workspace: Workspace
    builds: Mapping[str, Build]
    _by_name: dict[str, list[str]] | None = field(default=None, init=False, repr=False, compare=False)

    def find(self, package: str, name: str) -> str:
        """The file of a *package* that is started by that *name*, as it is installed or as roslaunch looks for it below the package; "" without one.

        roslib's ``find_node`` takes any executable file of the name below the package's directory.
        """
        build = self.builds.get(package)
        for installed in build.installed if build is not None else ():
            called = installed.name or posixpath.basename(installed.path)
            if installed.kind == "program" and called == name and self._is_shell(installed.path):
                return installed.path
        if self._by_name is None:
            self._by_name = {}
            for path in sorted(self.workspace.names):
                self._by_name.setdefault(posixpath.basename(path), []).append(path)
        starts = [one.path for one in self.workspace.packages if one.name == package]
        below = (path for path in self._by_name.get(name, ()) if any(_holds(start, path) for start in starts))
        return next((path for path in below if self._is_shell(path)), "")

    def program(self, package: str, name: str) -> tuple[str, str] | None:
        """The package and name of the program that such a script hands its words to; None where it does anything else."""
        path = self.find(package, name) if package and "?" not in name else ""
        lines = (line.strip() for line in self.workspace.text(path).splitlines()) if path else ()
        commands = [line for line in lines if _IDLE.fullmatch(line) is None]
        match = _HANDS_ON.fullmatch(commands[0]) if len(commands) == 1 else None
        if match is None:
            return None
        return (match["package"], match["name"]) if match["package"] else (match["own"], match["file"])

    def _is_shell(self, path: str) -> bool:
        text = self.workspace.text(path)
        return _FIRST.match(text) is not None if text.startswith("#!") else path.endswith(_ENDINGS)


def _holds(directory: str, path: str) -> bool:
    return directory == "." or path.startswith(f"{directory}/")
