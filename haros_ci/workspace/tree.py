# SPDX-License-Identifier: Apache-2.0
"""The files of a workspace as directories that build files can ask about: what exists, what a pattern matches."""

from __future__ import annotations

import posixpath
import re
from bisect import bisect_left
from fnmatch import translate
from itertools import takewhile

from haros_ci.model.workspace import Workspace
from haros_ci.workspace.cmake_parse import Script, parse_cmake

MAX_MATCHED = 20_000
_EXTRAS = ("CONFIG_EXTRAS", "CFG_EXTRAS", "CONFIG_EXTRAS_POST")


class PathTree:
    """Paths are root-relative, ``.`` is the root. All files of the workspace exist, those too that are not analysed, and directories with such."""

    def __init__(self, workspace: Workspace) -> None:
        self.workspace = workspace
        self.paths = sorted(workspace.names.union(file.path for file in workspace.files))
        self.files = frozenset(self.paths)
        self.listed = frozenset(file.path for file in workspace.files)
        directories = {"."}
        for path in self.paths:
            directory = path.rpartition("/")[0]
            while directory and directory not in directories:
                directories.add(directory)
                directory = directory.rpartition("/")[0]
        self.directories = frozenset(directories)
        self.looked_at = 0
        self._packages = {package.name: package for package in workspace.packages}
        self._extras: dict[str, tuple[tuple[str, str], ...]] = {}
        self._scripts: dict[str, Script] = {}

    def exists(self, path: str) -> bool:
        """Whether there is a file or directory, as far as was discovered; other files count if they have text."""
        return path in self.files or path in self.directories or bool(self.workspace.text(path))

    def is_file(self, path: str) -> bool:
        return path in self.files or bool(self.workspace.text(path))

    def script(self, path: str) -> Script:
        """The CMake file at *path*, read once."""
        script = self._scripts.get(path)
        if script is None:
            script = self._scripts[path] = parse_cmake(self.workspace.text(path))
        return script

    def has_package(self, name: str) -> bool:
        """Whether a package of that name is in the workspace."""
        return name in self._packages

    def extras(self, name: str) -> tuple[tuple[str, str], ...] | None:
        """The CMake files that a package runs in those who find it, each with a directory; None if it is not here.

        They are what CONFIG_EXTRAS (ament) and CFG_EXTRAS (catkin) name. Installed, they lie in one directory with
        those in the package's ``cmake``, which therefore stands for it.
        """
        package = self._packages.get(name)
        if package is None:
            return None
        if name not in self._extras:
            base = "" if package.path == "." else f"{package.path}/"
            found: list[str] = []
            for command in self.script(f"{base}CMakeLists.txt").commands:
                if command.name in ("ament_package", "ament_auto_package", "catkin_package"):
                    words = [argument.text for argument in command.arguments]
                    starts = [i for i, word in enumerate(words) if word in _EXTRAS]
                    found += [word for i in starts for word in takewhile(lambda w: not w.isupper(), words[i + 1 :])]
            home = f"{base}cmake"
            places = [f"{base}{word}" for word in found] + [f"{home}/{word}" for word in found]
            directory = home if home in self.directories else package.path
            self._extras[name] = tuple((path, directory) for path in places if path in self.files)
        return self._extras[name]

    def below(self, directory: str) -> list[str]:
        """The files below *directory*, sorted."""
        if directory == ".":
            return self.paths
        prefix = f"{directory}/"
        return self.paths[bisect_left(self.paths, prefix) : bisect_left(self.paths, f"{directory}0")]

    def glob(self, pattern: str, *, recurse: bool, directories: bool) -> list[str]:
        """The sorted paths that *pattern* matches; *recurse* looks for its last part in all directories below."""
        parts = [part.replace("[^", "[!") for part in pattern.split("/")]
        fixed = 0
        while fixed < len(parts) - 1 and not re.search(r"[*?[]", parts[fixed]):
            fixed += 1
        top = "/".join(parts[:fixed]) or "."
        try:
            matchers = [re.compile(translate(part)).match for part in parts[fixed:]]
        except re.error:  # a range the wrong way round
            return []
        found: dict[str, None] = {}
        skip = 0 if top == "." else len(top) + 1
        seen: set[str] = set()
        candidates = self.below(top)[:MAX_MATCHED]
        self.looked_at += len(candidates)
        for path in candidates:
            names = path[skip:].split("/")
            if not recurse and len(names) > len(matchers):
                names = names[: len(matchers)]
                path = path[:skip] + "/".join(names)
                if not directories or path in seen:
                    continue
                seen.add(path)
            if len(names) < len(matchers) or (not recurse and len(names) != len(matchers)):
                continue
            heads = matchers[:-1]
            if all(match(name) for match, name in zip(heads, names, strict=False)) and matchers[-1](names[-1]):
                found[path] = None
        return sorted(found)

    def module(self, name: str, roots: tuple[tuple[str, str], ...]) -> str:
        """The file of a Python module, by the longest of *roots* that fits; "" if it is not there."""
        for root, directory in sorted(roots, key=lambda pair: -len(pair[0])):
            if root and name != root and not name.startswith(f"{root}."):
                continue
            rest = (name[len(root) :].lstrip(".") if root else name).replace(".", "/")
            stem = posixpath.normpath(posixpath.join(directory, rest))
            for path in (f"{stem}.py", f"{stem}/__init__.py"):
                if path in self.files:
                    return path
        return ""
