# SPDX-License-Identifier: Apache-2.0
"""Paths in launch files, ``$(find package)/rest``, and the files of the workspace they lead to."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Mapping

from haros_ci.model.workspace import Workspace
from haros_ci.records import dataclass
from haros_ci.regex import regex
from haros_ci.substitutions.names import Text, quoted

#: What ``$(dirname)`` of a file outside any package begins with: the root of the workspace.
ROOT = "$(workspace)"

_FIND = regex(r"\$\(find ([^\s()]+)\)(.*)\Z", re.DOTALL)


@dataclass(frozen=True, slots=True)
class Place:
    """The root-relative *path* that a text leads to, or why none is known; *outside* if no file of ours is meant."""

    path: str | None
    reason: str = ""
    outside: bool = False


@dataclass(frozen=True, slots=True)
class Files:
    """The workspace by paths and packages."""

    workspace: Workspace
    directories: Mapping[str, str]
    listed: frozenset[str]
    links: Mapping[str, str]

    def has(self, path: str) -> bool:
        return path in self.listed or self.workspace.text(path) != ""

    def why_not(self, path: str) -> str:
        """Why the file at *path* is not read: as the end of a sentence."""
        names = self.workspace.names
        return "is no text file of the workspace" if not names or path in names else "is not in the workspace"

    def place(self, text: Text) -> Place:
        """Where *text*, an absolute path to roslaunch, leads; only paths below packages and ``$(dirname)`` do."""
        if not text.known:
            return Place(None, text.reasons[0])
        raw = text.raw
        match = _FIND.match(raw)
        if match:
            package, rest = match.groups()
            if package not in self.directories:
                return Place(None, f"package {quoted(package)} is not in the workspace", outside=True)
            start = self.directories[package]
        elif raw.startswith(ROOT):
            start, rest = ".", raw[len(ROOT) :]
        elif raw.startswith(("/", "~")):
            return Place(None, f"{quoted(raw)} is an absolute path; use $(find package)/...")
        else:
            return Place(None, f"{quoted(raw)} depends on where roslaunch is started; use $(find package)/...")
        path = posixpath.normpath(f"{start}/{rest}")
        if path.startswith("../") or path in (".", "..") or path.startswith("/"):
            return Place(None, f"{quoted(raw)} leads out of the workspace", outside=True)
        return Place(self.real(path))

    def real(self, path: str) -> str:
        """*path* with symbolic links followed, as often as there are any."""
        for _ in self.links:
            prefixes = (path[:end] for end in (*(n for n, char in enumerate(path) if char == "/"), len(path)))
            link = next((prefix for prefix in prefixes if prefix in self.links), None)
            if link is None:
                break
            path = self.links[link] + path[len(link) :]
        return path

    def directory_of(self, path: str) -> str:
        """The directory of *path* as launch files name it, ``$(find package)/launch``."""
        directory = posixpath.dirname(path) or "."
        inner = None
        for name, start in self.directories.items():
            holds = start == "." or directory == start or directory.startswith(start + "/")
            if holds and (inner is None or len(start) > len(self.directories[inner])):
                inner = name
        if inner is None:
            return ROOT if directory == "." else f"{ROOT}/{directory}"
        start = self.directories[inner]
        rest = directory if start == "." else directory[len(start) :].lstrip("/")
        return f"$(find {inner})" + (f"/{rest}" if rest not in ("", ".") else "")


def files_of(workspace: Workspace) -> Files:
    """*workspace* ready to be looked up; of packages of one name the first by path counts."""
    directories: dict[str, str] = {}
    for package in sorted(workspace.packages, key=lambda package: package.path):
        directories.setdefault(package.name, package.path)
    return Files(workspace, directories, frozenset(file.path for file in workspace.files), dict(workspace.links))
