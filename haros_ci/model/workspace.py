# SPDX-License-Identifier: Apache-2.0
"""The read-only view of the files under analysis that every stage after discovery gets."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Protocol

from haros_ci.model.package import Package, SourceFile
from haros_ci.records import dataclass

#: As many bytes as the header and the count of a binary STL.
HEAD = 84


class Reader(Protocol):
    """What a Workspace reads through; the implementation lives in the workspace room."""

    def text(self, path: str) -> str:
        """The decoded text of a file, newlines as they stand, BOM removed; "" if it cannot be read."""
        ...

    def data(self, path: str) -> bytes | None:
        """The bytes of a file; None if it cannot be read."""
        ...

    def head(self, path: str, length: int) -> bytes:
        """The first *length* bytes of any file below the root; b"" if it cannot be read."""
        ...


class Store(Protocol):
    """A cache of JSON values by content key. A miss is None; a hit is data, not trust: readers check its shape."""

    def get(self, group: str, path: str, key: str) -> object | None: ...

    def put(self, group: str, path: str, key: str, value: object) -> None: ...

    def get_text(self, group: str, path: str, key: str) -> str | None:
        """The same as the JSON text that it is kept as, for a reader of its own."""

    def put_text(self, group: str, path: str, key: str, text: str) -> None:
        """Put a value that is JSON text already, of ASCII characters on one line."""


@dataclass(frozen=True, slots=True)
class Buffer:
    """What an editor has of the file at *path*, relative to the root: its *data* count instead of those on disk, if there are any."""

    path: str
    data: bytes


@dataclass(frozen=True, slots=True)
class Problem:
    """An input that could not be read or understood: *path* (and *line*) say where, *message* what and what to do.

    *is_certain* is False where something outside the workspace may understand it.
    """

    path: str
    message: str
    line: int | None = None
    is_certain: bool = True


#: The problem of a file that is read all the same.
LATIN_1 = "not UTF-8; decoded as Latin-1. Save it as UTF-8"


@dataclass(frozen=True, slots=True)
class FirstUse:
    """A file that is as the base revision has it, at *origins*, and that changed files use as code, perhaps for the first time; the *problem* says how.

    *directory* is the one around it that is never entered, "" where there is none.
    """

    problem: Problem
    origins: tuple[str, ...]
    directory: str = ""


@dataclass(frozen=True, slots=True)
class Hiding:
    """What a change does that would keep its files from being analysed, where a base revision is asked for.

    *warnings* are on markers that do not count, *notes* on changed files in directories that are never analysed, *unread* on changed files
    that cannot be analysed, which become findings. *used* are files that are what they were and that changed ones use as code. *later* are the paths of packages with a manifest that is not the base's: others of
    their name come first. *databases* are compile databases that it brings or alters: none is read.
    """

    warnings: tuple[Problem, ...] = ()
    notes: tuple[Problem, ...] = ()
    unread: tuple[Problem, ...] = ()
    used: tuple[FirstUse, ...] = ()
    later: tuple[str, ...] = ()
    databases: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Workspace:
    """Packages and files at one revision.

    ``root`` is the directory on disk that paths are relative to. ``files`` is sorted by path. ``targets`` are the
    paths to report on when file arguments were given, None for all. ``problems`` become notifications; ``faults``
    are malformed manifests, which become findings. ``links`` are symbolic links, sorted, each with the file or directory
    inside the workspace that it leads to. ``names`` are the paths of all files, those included that are not analysed (meshes,
    maps); empty where that is not known. ``executables`` are those of the paths that can be scripts whose execute bit is set, None
    where that is not known: on a file system without modes. ``settings`` is where the settings of linters are read instead
    of here: at the base revision of a change, so that it cannot bring its own. ``hiding`` is what a change does to escape.
    ``unfetched`` are the directories that git has as commits of other repositories, and that are empty here.
    """

    root: Path
    packages: tuple[Package, ...]
    files: tuple[SourceFile, ...]
    reader: Reader
    targets: frozenset[str] | None = None
    problems: tuple[Problem, ...] = ()
    faults: tuple[Problem, ...] = ()
    links: tuple[tuple[str, str], ...] = ()
    names: frozenset[str] = frozenset()
    executables: frozenset[str] | None = None
    settings: Reader | None = None
    hiding: Hiding = Hiding()
    unfetched: frozenset[str] = frozenset()

    def text(self, path: str) -> str:
        """The decoded text of the file at *path*; "" if it is not there or not text."""
        return self.reader.text(path)

    def setting(self, path: str) -> str:
        """The text of the settings file of a linter at *path*, as it counts for this run; "" if there is none."""
        return (self.settings or self.reader).text(path)

    def data(self, path: str) -> bytes | None:
        """The bytes of the listed file at *path* as they lie on disk; None if it is no regular file there any more."""
        return self.reader.data(path)

    def head(self, path: str) -> bytes:
        """The first bytes of a file that is no text, to recognise its format; b"" if it is not there."""
        return self.reader.head(path, HEAD) if path in self.names else b""

    def package_finder(self) -> Callable[[str], str | None]:
        """What tells the name of the package that a path lies in, None if it lies in none."""
        homes = {package.path: package.name for package in self.packages}

        def package_of(path: str) -> str | None:
            while path not in ("", "."):
                path = path.rpartition("/")[0] or "."
                if path in homes:
                    return homes[path]
            return None

        return package_of

    def reports_on(self, path: str) -> bool:
        """Whether this run reports findings in *path*."""
        return self.targets is None or path in self.targets
