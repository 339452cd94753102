# SPDX-License-Identifier: Apache-2.0
"""What checks say without a look at C++: it holds as long as nothing but the text of C++ files is another.

A check is asked first on a workspace that refuses the texts and programs of these files, the call graph, the base revision and other launch arguments.
What it says there cannot depend on any of them, whatever it remembers on the way: all that it shares with other checks was made of the same workspace.
A check that asks for more is asked again where programs are seen, too, and texts by three functions alone: which words stand in one (``Codebase.look``,
``Project.text_with``), what it includes (``Project.glance``), and all of it, which is noted. What it says there holds where words and includes are the same,
programs have only moved, and what was read is no file that has changed. One that asks for still more is asked on all of the workspace.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence, Set
from dataclasses import replace
from typing import NoReturn

from haros_ci.checking.check import Check
from haros_ci.checking.checked import Checked, Unseen
from haros_ci.checking.project import Project
from haros_ci.checking.run import run_checks, run_on_project
from haros_ci.checking.system import System
from haros_ci.checking.unstarted import OF_A_LINE
from haros_ci.model.workspace import Problem, Reader, Workspace
from haros_ci.records import dataclass
from haros_ci.results.result import Graph, Result
from haros_ci.syntax import Program

#: The language of the files that are refused.
LANGUAGE = "cpp"


class Refused(BaseException):
    """A check has asked for what is not to be seen. What catches the exceptions of a check's own lets it pass."""


def refuse(*_: object) -> NoReturn:
    """In place of what is not to be seen."""
    raise Refused


class NoRobots:
    """In place of what reads robot descriptions: what that could not read to its end is reported besides."""

    problems: tuple[Problem, ...] = ()
    of_files = of_command = staticmethod(refuse)


@dataclass(frozen=True, slots=True)
class PartReader:
    """A reader that refuses the files at *hidden*, and the first bytes of any, which no digest covers; all where there is no *inner* one."""

    inner: Reader | None
    hidden: frozenset[str]

    def _of(self, path: str) -> Reader:
        if self.inner is None or path in self.hidden:
            raise Refused
        return self.inner

    def text(self, path: str) -> str:
        """As ``Reader.text``."""
        return self._of(path).text(path)

    def data(self, path: str) -> bytes | None:
        """As ``Reader.data``."""
        return self._of(path).data(path)

    def head(self, path: str, length: int) -> bytes:
        """Refused."""
        raise Refused


class PartPrograms(Mapping[str, Program]):
    """Programs by path, without those at *hidden*; nor are all of them gone through."""

    def __init__(self, inner: Mapping[str, Program], hidden: frozenset[str]) -> None:
        self._inner, self._hidden = inner, hidden

    def __getitem__(self, path: str) -> Program:
        if path in self._hidden:
            raise Refused
        return self._inner[path]

    def __iter__(self) -> Iterator[str]:
        raise Refused

    def __len__(self) -> int:
        raise Refused


def hidden_in(workspace: Workspace) -> frozenset[str]:
    """The paths of the files that are refused."""
    return frozenset(file.path for file in workspace.files if file.language == LANGUAGE)


def without_text(workspace: Workspace) -> Workspace:
    """*workspace* with a reader that refuses C++ files, and nothing in their rows that tells of their text."""
    hidden = hidden_in(workspace)
    files = tuple(
        replace(file, digest="", size=0, lines=0) if file.language == LANGUAGE else file for file in workspace.files
    )
    settings = None if workspace.settings is None else PartReader(None, frozenset())
    return replace(workspace, files=files, reader=PartReader(workspace.reader, hidden), settings=settings)


@dataclass(frozen=True, slots=True)
class Held:
    """What the *checks*, by their ids, have said of a part: *results* with the *graphs* that they are drawn in."""

    checks: frozenset[str] = frozenset()
    results: tuple[Result, ...] = ()
    graphs: tuple[Graph, ...] = ()

    @staticmethod
    def found(ids: frozenset[str], checked: Iterable[Checked]) -> Held:
        """What the checks of these *ids* said."""
        one = _of(checked, ids)
        return Held(ids, one.results, one.graphs)

    def of(self, checks: Iterable[Check]) -> Checked:
        """What those of *checks* have said."""
        ids = self.checks.intersection(check.id for check in checks)
        return _of((Checked(self.results, self.graphs),), ids)


def _of(checked: Iterable[Checked], ids: frozenset[str]) -> Checked:
    every = tuple(checked)
    results = tuple(result for one in every for result in one.results if result.rule in ids)
    names = {result.graph for result in results}
    return Checked(results, tuple(graph for one in every for graph in one.graphs if graph.name in names))


@dataclass(frozen=True, slots=True)
class Part:
    """What checks are asked on first: a workspace of which C++ is not seen, or, *with_programs*, its programs.

    There *words* are looked up in all texts, and the files at the paths *read* are read, by one check or another.
    """

    project: Project
    systems: Sequence[System]
    with_programs: bool = False
    words: Set[str] = frozenset()
    read: Set[str] = frozenset()

    def of_systems(self, check: Check, tool: str) -> Checked | None:
        """What *check* says of the systems; None if it asks for more, or does not come to its end."""
        try:
            return self._whole(check, run_checks((check,), self.systems, tool, refuse))
        except Refused:
            return None

    def of_project(self, check: Check, tool: str, markers: Sequence[str]) -> Checked | None:
        """What *check* says of the workspace; None if it asks for more, or does not come to its end."""
        try:
            return self._whole(check, run_on_project((check,), self.project, tool, markers))
        except Refused:
            return None

    def _whole(self, check: Check, found: Checked) -> Checked | None:
        if found.notifications or check.id in OF_A_LINE:
            return None
        ids = frozenset((check.id,))
        unseen = Unseen(programs=ids)
        if self.with_programs:
            unseen = Unseen(texts=ids, words=frozenset(self.words), read=frozenset(self.read))
        return replace(found, unseen=unseen)
