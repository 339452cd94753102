# SPDX-License-Identifier: Apache-2.0
"""What tools get to see in place of the workspace: private copies of its analysed files, and nothing else.

No link, no device, no untracked file, no ``.git`` and no settings file of a tool lies there. For tools that follow includes the
copies are without those that lead out (inclusions.py).
"""

from __future__ import annotations

import errno
import os
from bisect import bisect_left
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path

from haros_ci.linters.inclusions import confined
from haros_ci.linters.linter import Linter
from haros_ci.linters.spelled_conditions import spelled
from haros_ci.linters.work import Work
from haros_ci.model.workspace import Workspace
from haros_ci.records import dataclass

#: Files that symbolic links inside the workspace may add: a link to a directory above itself must not multiply the tree.
MOST_BY_LINKS = 5_000


@dataclass(frozen=True, slots=True)
class ViewKind:
    """What decides which view a tool gets: the *languages* of the files in it, whether the tool *includes* files by itself,
    and whether it asks for the *names* of files that are not analysed.
    """

    languages: frozenset[str]
    includes: bool = False
    names: bool = False


def kind_of(linter: Linter) -> ViewKind:
    """The kind of view for *linter*, by the optional names of adapters: ``SEES``, languages of the files that it reads if these
    are not those that it analyses, ``FOLLOWS_INCLUDES`` and ``SEES_NAMES``.
    """
    return ViewKind(
        frozenset(getattr(linter, "SEES", linter.LANGUAGES)),
        includes=getattr(linter, "FOLLOWS_INCLUDES", False),
        names=getattr(linter, "SEES_NAMES", False),
    )


def views(workspace: Workspace, works: Iterable[Work], directory: Path) -> dict[str, Workspace]:
    """For each of *works* that has something to run, by its tool's name, the workspace with a view as its root.

    The views lie below *directory*; tools of one kind share one. Tools whose adapters are ``TRUSTED`` get none.
    """
    by_kind: dict[ViewKind, list[Work]] = {}
    for work in works:
        if work.missing and not getattr(work.linter, "TRUSTED", False):
            by_kind.setdefault(kind_of(work.linter), []).append(work)
    seen: dict[str, Workspace] = {}
    for number, (kind, those) in enumerate(by_kind.items()):
        root = directory / f"view{number}"
        needed = {path for work in those for unit in work.missing for path in (unit.file.path, *unit.dependencies)}
        _Layer(workspace, kind, root, needed).lay()
        seen.update((work.linter.NAME, replace(workspace, root=root)) for work in those)
    return seen


def of_cpp(workspace: Workspace, directory: Path) -> Workspace:
    """The workspace with a view at *directory*, which is made, as a compiler's front end gets it."""
    _Layer(workspace, ViewKind(frozenset({"cpp"}), includes=True), directory, set()).lay()
    return replace(workspace, root=directory)


class _Layer:
    """Lays one view: the files of its languages, and those *needed* besides."""

    def __init__(self, workspace: Workspace, kind: ViewKind, root: Path, needed: set[str]) -> None:
        self._workspace = workspace
        self._kind = kind
        self._root = root
        self._directories = {""}
        sources = {path: path for path in needed}
        seen = (file for file in workspace.files if file.language in kind.languages and not file.is_bulk)
        sources.update((file.path, file.path) for file in seen)
        sources.update(list(_by_links(workspace, sources))[:MOST_BY_LINKS])
        #: For each path in the view the file that it is a copy of.
        self._sources = sources

    def lay(self) -> None:
        """Copies of files; one that cannot be read any more is not there."""
        self._root.mkdir(0o700)
        for path, source in sorted(self._sources.items()):
            data = self._workspace.data(source)
            if data is not None:
                self._write(path, self._confined(path, data) if self._kind.includes else data)
        if self._kind.names:
            for path in sorted(self._workspace.names - self._sources.keys()):
                self._write(path, b"")

    def _confined(self, path: str, data: bytes) -> bytes:
        """Byte for byte: only ASCII has a meaning here."""
        text = data.decode("latin-1")
        made = confined(spelled(text), path.rpartition("/")[0], self._sources.__contains__)
        return data if made == text else made.encode("latin-1")

    def _write(self, path: str, data: bytes) -> None:
        executables = self._workspace.executables
        mode = 0o700 if executables is not None and path in executables else 0o600
        try:
            self._make(path.rpartition("/")[0])
            place = os.open(f"{self._root}/{path}", os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_CLOEXEC, mode)
        except OSError as err:
            if err.errno in (errno.ENOSPC, errno.EDQUOT, errno.EMFILE, errno.ENFILE):
                raise
            return  # a name that no directory can hold here: the tool says that the file is missing
        with open(place, "wb", buffering=0) as file:
            file.write(data)

    def _make(self, directory: str) -> None:
        """Makes a directory and those above it; step by step, as there may be a thousand of them."""
        missing = []
        while directory not in self._directories:
            missing.append(directory)
            directory = directory.rpartition("/")[0]
        for directory in reversed(missing):
            os.mkdir(f"{self._root}/{directory}", 0o700)
            self._directories.add(directory)


def _by_links(workspace: Workspace, sources: Mapping[str, str]) -> Iterator[tuple[str, str]]:
    """Where files are found by symbolic links of the workspace, and which: as links, they could lead out."""
    ordered = sorted(sources)
    for link, target in workspace.links:
        if target in sources:
            yield link, target
            continue
        prefix = f"{target}/"
        for path in ordered[bisect_left(ordered, prefix) : bisect_left(ordered, f"{target}0")]:
            yield f"{link}/{path.removeprefix(prefix)}", path
