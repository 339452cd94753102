# SPDX-License-Identifier: Apache-2.0
"""Whether the files are there that launch files name: in the source of the package that owns them, or installed by its build."""

from __future__ import annotations

import posixpath
import re
from collections import Counter
from collections.abc import Mapping
from dataclasses import replace
from itertools import islice

from haros_ci.model.build import Build, Installed, WrittenFile
from haros_ci.model.launch_facts import FileUse
from haros_ci.model.program_words import before_return
from haros_ci.model.similar_files import similar_files
from haros_ci.model.submodules import absent, is_below
from haros_ci.model.workspace import Workspace
from haros_ci.records import dataclass, field
from haros_ci.regex import regex
from haros_ci.substitutions.files import Files, files_of

_START = regex(r"\$\((find-pkg-share|find-pkg-prefix|find|workspace)(?: ([^\s()]+))?\)(.*)\Z", re.DOTALL)
#: What makes files while a package is built, or fetches them.
_MAKES = regex(
    r"configure_file|add_custom_command|add_custom_target|ExternalProject|FetchContent|download|\binstall\s*\(\s*(CODE|SCRIPT)\b"
    r"|\bfile\s*\(\s*(DOWNLOAD|GENERATE|WRITE|COPY|APPEND|CREATE_LINK|ARCHIVE_EXTRACT)|execute_process|xacro_add|urlretrieve",
    re.IGNORECASE,
)
#: Files that are written by hand, whatever else a build makes.
_BY_HAND = (".launch", ".launch.py", ".launch.xml", "_launch.py", ".rviz", ".launch.yaml", ".vcg")
_BUILD_FILES = ("CMakeLists.txt", "setup.py", "setup.cfg", "pyproject.toml")
MAX_SIMILAR = 4
MAX_ALIKE = 2_000
#: Shorter names say nothing outside of their package.
MIN_NAME = 5
#: Paths that may be looked at, all together.
MAX_STEPS = 30_000_000


@dataclass(slots=True)
class Finder:
    """Looks for files by how launch files name them. *builds* say what each package installs."""

    workspace: Workspace
    builds: Mapping[str, Build]
    files: Files = field(init=False)
    names: frozenset[str] = field(init=False)
    directories: frozenset[str] = field(init=False)
    #: Submodules that are not checked out.
    absent: frozenset[str] = field(init=False)
    #: Files that builds write, by their paths.
    written: Mapping[str, WrittenFile] = field(init=False)
    #: Steps that are left: when they are used up, nothing more is said to be missing.
    steps: int = MAX_STEPS
    _doubled: frozenset[str] = field(init=False)
    _listed: dict[str, tuple[str, ...]] = field(default_factory=dict, init=False)
    _scripts: dict[str, str] = field(default_factory=dict, init=False)
    _found: dict[tuple[str, str], FileUse] = field(default_factory=dict, init=False)

    def __post_init__(self) -> None:
        self.files = files_of(self.workspace)
        self.names = self.workspace.names | {file.path for file in self.workspace.files}
        directories: set[str] = set()
        for path in self.names:
            while (path := path.rpartition("/")[0]) and path not in directories:
                directories.add(path)
        self.directories = frozenset(directories)
        self.absent = absent(self.workspace)
        self.written = {made.path: made for build in self.builds.values() for made in build.written}
        every = Counter(package.name for package in self.workspace.packages)
        self._doubled = frozenset(name for name, count in every.items() if count > 1)

    def completed(self, use: FileUse) -> FileUse:
        """*use* with its owner, and whether it is found."""
        key = (use.kind, use.text)
        known = self._found.get(key)
        if known is None:
            known = self._found[key] = self._look_up(use)
        start = self.files.directories.get(known.package or "", "")
        above = {use.location.path, *(place.path for place in use.included)}  # to include one of them is to go round
        return replace(
            use,
            package=known.package,
            inner=known.inner,
            path=known.path,
            is_found=known.is_found,
            similar=tuple(path for path in known.similar if posixpath.normpath(f"{start}/{path}") not in above),
        )

    def _look_up(self, use: FileUse) -> FileUse:
        match = _START.match(use.text)
        if match is None:
            return use
        kind, name, rest = match[1], match[2] or "", match[3]
        inner = posixpath.normpath("./" + rest.strip("/"))
        if kind == "workspace":
            path = posixpath.normpath(f"{name or '.'}/{inner}")
            owner = self._owner(path)
            if owner is None:
                found = self._there(path)
                return replace(use, path=path, is_found=True if found else None)
            name, inner = owner
        elif kind == "find-pkg-prefix":
            share = f"share/{name}/"
            if not inner.startswith(share):
                return replace(use, package=name, inner=inner)
            inner = inner[len(share) :]
        start = self.files.directories.get(name)
        if start is None:
            return replace(use, package=name, inner=inner)
        path = posixpath.normpath(f"{start}/{inner}")
        if path.startswith(("../", "/")) or path == ".." or inner.startswith(".."):
            return replace(use, package=name, inner=inner)
        made = replace(use, package=name, inner=inner, path=path)
        installed = self._installed(name, posixpath.normpath(f"share/{name}/{inner}"))
        if installed is not None:
            return replace(made, path=installed, is_found=True)
        if self._there(path):
            return replace(made, path=self.files.real(path), is_found=True)
        if is_below(path, self.absent) or self._may_be_made(name, start, inner):
            return made
        return replace(made, is_found=False, similar=self._similar(name, start, inner))

    def is_installed(self, path: str) -> bool | None:
        """Whether the package around the file installs it; None where nobody can tell."""
        root = next((name for name, start in self.files.directories.items() if start == "."), None)
        owner = self._owner(path) or (None if root is None else (root, path))
        if owner is None or owner[0] not in self.builds:
            return None
        name, inner = owner
        covered = [posixpath.normpath(entry.path) for entry in self._entries(name)]
        if any(path == one or path.startswith(f"{one}/") for one in covered):
            return True
        return None if self._is_hidden(name, self.files.directories[name], inner) else False

    def _owner(self, path: str) -> tuple[str, str] | None:
        """The package around *path*, and the path inside it."""
        best: tuple[str, str] | None = None
        for name, start in self.files.directories.items():
            if path.startswith(f"{start}/") and (best is None or len(start) > len(best[0])):
                best = (start, name)
        return None if best is None else (best[1], path[len(best[0]) + 1 :])

    def _there(self, path: str) -> bool:
        real = self.files.real(path)
        return real in self.names or real in self.directories or self.files.has(real)

    def _installed(self, package: str, inside: str) -> str | None:
        """What the build of *package* installs as *inside*, a path below the prefix."""
        for entry in self._entries(package):
            if entry.kind == "directory":
                start = posixpath.normpath(entry.destination)
                if inside == start or inside.startswith(start + "/"):
                    path = posixpath.normpath(f"{entry.path}/{posixpath.relpath(inside, start)}")
                    if self._there(path):
                        return path
            elif inside == posixpath.normpath(f"{entry.destination}/{entry.name or posixpath.basename(entry.path)}"):
                if self._there(entry.path):
                    return entry.path
        return None

    def _entries(self, package: str) -> tuple[Installed, ...]:
        build = self.builds.get(package)
        return build.installed if build is not None else ()

    def _may_be_made(self, package: str, start: str, inner: str) -> bool:
        """Whether the build may make or install the file in a way that is not known, perhaps under that name from elsewhere."""
        if self._is_hidden(package, start, inner):
            return True
        base = posixpath.basename(inner)
        prefix = "" if start == "." else f"{start}/"
        covered = [posixpath.normpath(entry.path) for entry in self._entries(package)]
        return any(
            not any(path == one or path.startswith(f"{one}/") for one in covered)
            for path in self.below(prefix)
            if path.endswith(f"/{base}") or path == base
        )

    def _is_hidden(self, package: str, start: str, inner: str) -> bool:
        """Whether the build may do with the file what cannot be read from it."""
        if self.steps < 0 or self.is_doubled(package) or package not in self.builds:
            return True
        text = self.script(package, start)
        base = posixpath.basename(inner)
        stem = base.partition(".")[0]
        if not text or re.search(rf"(?<![\w.-]){re.escape(stem)}(?![\w-])", text) and base in text:
            return True
        if _MAKES.search(text) and not base.endswith(_BY_HAND):
            return True
        inside = posixpath.normpath(f"share/{package}/{inner}")
        for entry in self._entries(package):
            where = posixpath.normpath(entry.destination)
            if "${" in entry.path + entry.destination or "$<" in entry.path + entry.destination:
                return True
            if entry.kind == "directory" and inside.startswith(where + "/") and not self._there(entry.path):
                return True  # a directory that the build makes
        return False

    def is_doubled(self, package: str) -> bool:
        """Whether several packages have that name, so that it is not known which is meant."""
        return package in self._doubled

    def has_build_file(self, start: str) -> bool:
        """Whether the package at *start* has a file at its top that builds it."""
        prefix = "" if start == "." else f"{start}/"
        return any(prefix + name in self.names for name in _BUILD_FILES)

    def script(self, package: str, start: str) -> str:
        """The texts of what builds *package*."""
        if package not in self._scripts:
            prefix = "" if start == "." else f"{start}/"
            paths = [prefix + name for name in _BUILD_FILES]
            paths += [path for path in self.below(prefix) if path.endswith((".cmake", "/CMakeLists.txt"))]
            texts = ((path, self.workspace.text(path)) for path in dict.fromkeys(paths))
            is_cmake = (".cmake", "CMakeLists.txt")
            self._scripts[package] = "\n".join(
                before_return(text) if path.endswith(is_cmake) else text for path, text in texts
            )
        return self._scripts[package]

    def below(self, prefix: str) -> tuple[str, ...]:
        """The paths of all files that begin so, sorted."""
        if prefix not in self._listed:
            self.steps -= len(self.names)
            self._listed[prefix] = tuple(sorted(path for path in self.names if path.startswith(prefix)))
        self.steps -= len(self._listed[prefix])
        return self._listed[prefix]

    def _similar(self, name: str, start: str, inner: str) -> tuple[str, ...]:
        """Files of the package *name* that may be meant: of the same name elsewhere, else of a similar one, else the one of that name in the workspace."""
        prefix = "" if start == "." else f"{start}/"
        below = self.below(prefix)
        base = posixpath.basename(inner)
        suffix = ".launch" if ".launch" in base else posixpath.splitext(base)[1]
        alike = islice((path for path in below if suffix in path), MAX_ALIKE)
        same = (path for path in below if path.endswith(f"/{base}") or path == base)
        self.steps -= 2 * len(below) + 200 * min(len(below), MAX_ALIKE)
        own = dict.fromkeys(path[len(prefix) :] for path in (*islice(same, MAX_ALIKE), *alike))
        found = similar_files(inner, own, name, MAX_SIMILAR)
        return found or self._elsewhere(base, prefix)

    def _elsewhere(self, base: str, prefix: str) -> tuple[str, ...]:
        """The one file of the name *base* that the workspace has outside of the package below *prefix*, as seen from there."""
        if not prefix or len(base.partition(".")[0]) < MIN_NAME or self.steps < 0:
            return ()
        self.steps -= len(self.names)
        found = [path for path in self.names if path.endswith(f"/{base}") and not path.startswith(prefix)]
        return (posixpath.relpath(found[0], prefix),) if len(found) == 1 else ()
