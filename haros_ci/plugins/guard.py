# SPDX-License-Identifier: Apache-2.0
"""What stands between a plug-in and a run: whatever it raises, or says wrongly, is trouble of its own and loses nothing else."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from typing import Any, TypeVar

from haros_ci.checking.check import Check, Finding
from haros_ci.checking.project import Project
from haros_ci.checking.system import Channel, End, System, SystemNode
from haros_ci.linters import linter as adapters
from haros_ci.linters.linter import Batch, Command, GaveUp, Linter, LintOptions, Output, Program, Unit, When
from haros_ci.model.location import Location
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Store, Workspace
from haros_ci.results.fix import Fix
from haros_ci.results.result import Report, Result
from haros_ci.results.rule import Level

T = TypeVar("T")


def guarded_check(check: Check) -> Check:
    """*check*, whose findings are looked at before they are believed."""

    def on_system(system: System) -> Iterator[Finding]:
        yield from _findings(check.run, system, system.workspace)

    def on_project(project: Project) -> Iterator[Finding]:
        yield from _findings(check.project, project, project.workspace)

    return replace(
        check,
        run=on_system if check.run is not None else None,
        project=on_project if check.project is not None else None,
    )


def _findings(
    look: Callable[[Any], Iterable[Finding]] | None, seen: Any, workspace: Workspace | None
) -> Iterator[Finding]:
    assert look is not None
    paths = None if workspace is None else {file.path for file in workspace.files} | workspace.names
    try:
        for finding in look(seen) or ():
            yield sound(finding, paths)
    except SystemExit as err:
        raise RuntimeError(f"it called exit({err.code})") from err


def sound(finding: object, paths: set[str] | None) -> Finding:
    """*finding*, if it is one and stands in the workspace; TypeError or ValueError says what is wrong with it."""
    if not isinstance(finding, Finding):
        raise TypeError(f"a check yields findings, not {type(finding).__name__}")
    if not isinstance(finding.message, str) or not finding.message.strip():
        raise TypeError("a finding's message is a text")
    if not (finding.level is None or isinstance(finding.level, Level)):
        raise TypeError("a finding's level is a Level")
    for item in _tuple(finding.about, "about"):
        if not isinstance(item, (str, End, SystemNode, Channel)):
            raise TypeError(f"a finding is about ends, nodes, channels and names, not {type(item).__name__}")
    _place(finding.at, paths)
    for place, text in (*_tuple(finding.related, "related"), *_tuple(finding.flow, "flow")):
        _place(place, paths)
        if not isinstance(text, str):
            raise TypeError("what is to be seen at a place is a text")
    if not all(isinstance(name, str) for name in _tuple(finding.apart, "apart")):
        raise TypeError("'apart' are names")
    for fix in _tuple(finding.fixes, "fixes"):
        if not isinstance(fix, Fix):
            raise TypeError("a fix is a Fix")
        for edit in fix.edits:
            _place(Location(edit.path), paths)
    return finding


def _tuple(value: object, name: str) -> tuple[Any, ...]:
    if not isinstance(value, tuple):
        raise TypeError(f"a finding's '{name}' is a tuple")
    return value


def _place(place: object, paths: set[str] | None) -> None:
    if not isinstance(place, Location) or not isinstance(place.path, str):
        raise TypeError("a place is a Location")
    numbers = (place.line, place.column, place.end_line, place.end_column)
    if any(number is not None and (type(number) is not int or number < 1) for number in numbers):
        raise ValueError(f"lines and columns count from 1: {place}")
    if paths is not None and place.path not in paths:
        raise ValueError(f"{place.path} is no file of the workspace")


class GuardedLinter:
    """An adapter of a plug-in: what it answers is kept under the plug-in's digest; what it raises comes out as ValueError."""

    def __init__(self, linter: Linter, digest: str) -> None:
        self.NAME: str = linter.NAME
        self.LANGUAGES: frozenset[str] = frozenset(linter.LANGUAGES)
        self.WHEN: When = linter.WHEN
        self.COST: float = linter.COST
        self._linter = linter
        self._digest = digest
        if hasattr(linter, "BATCH_SECONDS"):
            self.BATCH_SECONDS = linter.BATCH_SECONDS
        if hasattr(linter, "plan"):
            self.plan = self._plan

    def locate(self, options: LintOptions) -> Program | None:
        program: Program | None = _kept_in(lambda: _a(self._linter.locate(options), Program, type(None)))
        return program

    def fingerprint(self, workspace: Workspace, options: LintOptions) -> str:
        own = _kept_in(lambda: _a(self._linter.fingerprint(workspace, options), str))
        return f"{self._digest} {own}"

    def dependencies(self, workspace: Workspace, file: SourceFile) -> tuple[str, ...]:
        return _kept_in(lambda: tuple(_a(path, str) for path in self._linter.dependencies(workspace, file)))

    def _plan(self, workspace: Workspace, options: LintOptions, store: Store) -> tuple[Unit, ...]:
        plan: Any = getattr(self._linter, "plan")  # noqa: B009 - it is no part of the protocol
        return _kept_in(lambda: tuple(_a(unit, Unit) for unit in plan(workspace, options, store)))

    def command(self, program: Program, batch: Batch) -> Command:
        command: Command = _kept_in(lambda: _a(self._linter.command(program, batch), Command))
        return command

    def parse(self, output: Output, batch: Batch) -> tuple[adapters.Finding | GaveUp, ...]:
        return _kept_in(lambda: tuple(self._own(message) for message in self._linter.parse(output, batch)))

    def _own(self, answer: object) -> adapters.Finding | GaveUp:
        found = _a(answer, adapters.Finding, GaveUp)
        if isinstance(found, adapters.Finding) and _a(found.result, Result).tool != self.NAME:
            raise ValueError(f"a result of the tool {found.result.tool!r}, not of {self.NAME!r}")
        return found  # type: ignore[no-any-return]  # what the plug-in returns, looked at above


def _a(value: Any, *kinds: type) -> Any:
    if not isinstance(value, kinds):
        raise TypeError(f"{type(value).__name__} in place of {kinds[0].__name__}")
    return value


def _kept_in(call: Callable[[], T]) -> T:
    """What *call* returns; ValueError in place of everything that it raises."""
    try:
        return call()
    except SystemExit as err:
        raise ValueError(f"its adapter called exit({err.code})") from err
    except Exception as err:
        raise ValueError(f"its adapter failed: {type(err).__name__}: {err}") from err


def guarded_renderer(name: str, plugin: str, render: Callable[[Report], str]) -> Callable[[Report], str]:
    """*render*, which says in a RuntimeError what is wrong when there is no text."""

    def safe(report: Report) -> str:
        try:
            text = render(report)
        except (Exception, SystemExit) as err:
            raise RuntimeError(f"the format {name} of plug-in {plugin} failed: {type(err).__name__}: {err}") from err
        if not isinstance(text, str):
            raise RuntimeError(f"the format {name} of plug-in {plugin} gave {type(text).__name__} in place of a text")
        return text

    return safe
