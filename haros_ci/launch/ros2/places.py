# SPDX-License-Identifier: Apache-2.0
"""Paths in ROS 2 launch files, ``$(find-pkg-share package)/rest``, and the files of the workspace they lead to."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Mapping
from typing import Any

from haros_ci.model.build import Build
from haros_ci.model.location import Location
from haros_ci.model.workspace import Workspace
from haros_ci.records import dataclass, field
from haros_ci.regex import regex
from haros_ci.substitutions.files import Files, Place, files_of
from haros_ci.substitutions.names import Text, quoted

_START = regex(r"\$\((find-pkg-share|find-pkg-prefix|workspace) ([^\s()]+)\)(.*)\Z", re.DOTALL)
#: Why a file is not known that the package has elsewhere.
BY_SETUP = "setup.py may install, as it computes data_files when it runs"
#: How many paths are remembered with what they lead to.
MAX_FOUND = 10_000


@dataclass(slots=True)
class Places:
    """Where files lie in the workspace that launch files name by the places they are installed in.

    *builds* say what CMake and setup.py install; without them a package's share directory is taken for its source.
    """

    workspace: Workspace
    builds: Mapping[str, Build] = field(default_factory=dict)
    files: Files = field(init=False)
    #: Parameter files that have been parsed, by path and text; they are read only.
    parsed: dict[tuple[str, Text], Any] = field(default_factory=dict, init=False, repr=False, compare=False)
    #: What has been made of parsed files, by what it is and their identity, after what it is made of, which keeps that identity its own.
    made: dict[tuple[object, ...], tuple[Any, Any]] = field(default_factory=dict, init=False, repr=False, compare=False)
    #: What launch files write into files that they make, or the reason why that is not known, by the path and why a part of it is not known, with the place.
    written: dict[tuple[str, tuple[str, ...]], tuple[Any, Location]] = field(
        default_factory=dict, init=False, repr=False, compare=False
    )
    #: What paths lead to, by their texts.
    found: dict[str, Place] = field(default_factory=dict, init=False, repr=False, compare=False)
    #: What else is remembered of files, by what it is and their paths.
    remembered: dict[tuple[str, str], Any] = field(default_factory=dict, init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        self.files = files_of(self.workspace)

    def find(self, text: str) -> Place:
        """The file that *text* leads to, or why none is known; *outside* if no file of ours is meant.

        Paths begin with ``$(find-pkg-share pkg)``, ``$(find-pkg-prefix pkg)`` or ``$(workspace dir)``; nothing outside
        of the workspace is ever looked at.
        """
        if text not in self.found:
            if len(self.found) >= MAX_FOUND:
                self.found.clear()
            self.found[text] = self._find(text)
        return self.found[text]

    def _find(self, text: str) -> Place:
        match = _START.match(text)
        if match is None:
            if text.startswith(("/", "~", "file:")):
                return Place(None, f"{quoted(text)} is an absolute path outside of the workspace", outside=True)
            return Place(None, f"{quoted(text)} depends on where launch is started; begin with $(find-pkg-share ...)")
        kind, name, rest = match.groups()
        inner = posixpath.normpath("./" + rest.strip("/")) if rest.startswith("/") or not rest else None
        if inner is None:
            return Place(None, f"{quoted(text)} names no file in a directory; put a / behind the package")
        if kind == "workspace":
            return self._inside(posixpath.normpath(f"{name}/{inner}"), text)
        if name not in self.files.directories:
            return Place(None, f"package {quoted(name)} is not in the workspace", outside=True)
        if kind == "find-pkg-prefix":
            share = f"share/{name}"
            if inner != share and not inner.startswith(share + "/"):
                return self._installed(name, inner) or Place(
                    None, f"{quoted(text)} is made by the build, or not installed", outside=True
                )
            inner = posixpath.relpath(inner, share)
        return self._installed(name, posixpath.normpath(f"share/{name}/{inner}")) or self._inside(
            posixpath.normpath(f"{self.files.directories[name]}/{inner}"), text
        )

    def read(self, text: str) -> tuple[str | None, str, str]:
        """The root-relative path and content of the file *text* leads to; None and the reason if there is none."""
        place = self.find(text)
        if place.path is None:
            return None, "", place.reason
        if not self.files.has(place.path):
            is_hidden = self.may_be_installed(place.path)
            reason = f"is what {BY_SETUP}" if is_hidden else self.files.why_not(place.path)
            return None, "", f"{quoted(place.path)} {reason}"
        return place.path, self.workspace.text(place.path), ""

    def may_be_installed(self, path: str) -> bool:
        """Whether setup.py may put another file of the package around *path* there: one of the name, by ``data_files`` that are computed when it runs."""
        around = (
            name for name, start in self.files.directories.items() if start == "." or path.startswith(f"{start}/")
        )
        name = max(around, key=lambda name: len(self.files.directories[name]), default="")
        build = self.builds.get(name)
        if build is None or not build.computes_data_files:
            return False
        start, base = self.files.directories[name], posixpath.basename(path)
        prefix = "" if start == "." else f"{start}/"
        names = self.workspace.names | self.files.listed
        return any(other.startswith(prefix) and posixpath.basename(other) == base for other in names)

    def _installed(self, package: str, inside: str) -> Place | None:
        """What the build of *package* installs as *inside*, a path below the prefix; None if it does not say."""
        build = self.builds.get(package)
        for entry in build.installed if build is not None else ():
            if entry.kind == "directory":
                start = posixpath.normpath(entry.destination)
                if inside == start or inside.startswith(start + "/"):
                    path = posixpath.normpath(f"{entry.path}/{posixpath.relpath(inside, start)}")
                    if self._is_here(path):
                        return Place(self.files.real(path))
            elif inside == posixpath.normpath(f"{entry.destination}/{entry.name or posixpath.basename(entry.path)}"):
                return Place(self.files.real(entry.path)) if self._is_here(entry.path) else None
        return None

    def _is_here(self, path: str) -> bool:
        return not path.startswith(("../", "/")) and path != ".." and self.files.has(self.files.real(path))

    def _inside(self, path: str, text: str) -> Place:
        if path.startswith(("../", "/")) or path == "..":
            return Place(None, f"{quoted(text)} leads out of the workspace", outside=True)
        return Place(self.files.real(path))
