# SPDX-License-Identifier: Apache-2.0
"""One tool's share of a run: which units it has to answer for, under which keys, and what it has answered so far."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Iterable, Iterator
from typing import Protocol

from haros_ci.linters import installed
from haros_ci.linters.linter import Linter, LintOptions, Program, Unit, When
from haros_ci.linters.rows import Answer
from haros_ci.model.workspace import Problem, Store, Workspace
from haros_ci.own_sources import OF_LINTERS, digest
from haros_ci.records import dataclass, field
from haros_ci.results.result import Notification, Result, Run, Tool
from haros_ci.results.rule import Level


class Tools(Protocol):
    """Which tools there are: those installed here, or those that other machines have had."""

    def program(self, linter: Linter, options: LintOptions) -> Program | None: ...

    def fingerprint(self, linter: Linter, workspace: Workspace, options: LintOptions) -> str: ...


class InstalledTools:
    """The tools of this machine."""

    def program(self, linter: Linter, options: LintOptions) -> Program | None:
        return linter.locate(options)

    def fingerprint(self, linter: Linter, workspace: Workspace, options: LintOptions) -> str:
        return linter.fingerprint(workspace, options)


@dataclass(slots=True)
class Work:
    """One tool's share of a run, filled in as answers arrive.

    ``keys`` are by the unit's path, as are the CPU ``seconds`` of what was run here. ``failures`` are sentences with the paths that
    are left without an answer.
    """

    linter: Linter
    program: Program
    fingerprint: str
    units: tuple[Unit, ...]
    keys: dict[str, str] = field(default_factory=dict)
    missing: list[Unit] = field(default_factory=list)
    results: set[Result] = field(default_factory=set)
    notifications: list[Notification] = field(default_factory=list)
    answered: set[str] = field(default_factory=set)
    failures: list[tuple[str, tuple[str, ...]]] = field(default_factory=list)
    seconds: dict[str, float] = field(default_factory=dict)

    @property
    def successful(self) -> bool:
        return not self.failures

    def take(self, unit: Unit, answer: Answer) -> None:
        self.answered.add(unit.file.path)
        self.results.update(answer.results)
        if unit.file.third_party:
            return  # a copy of another project has no findings, so none is missing
        for gave_up in answer.gave_up:
            note = f"{self.linter.NAME} could not analyse this file: {gave_up.message}"
            self.notifications.append(Notification(Level.WARNING, note, self.linter.NAME, gave_up.unit, gave_up.line))

    def fail(self, message: str, paths: tuple[str, ...]) -> None:
        self.failures.append((message, paths))
        path = paths[0] if len(paths) == 1 else None
        self.notifications.append(Notification(Level.ERROR, message, self.linter.NAME, path))


class Digests:
    """Content digests of workspace files, and cache keys made of them."""

    def __init__(self, workspace: Workspace) -> None:
        self._workspace = workspace
        self.known = {file.path: file.digest for file in workspace.files}
        self._others: dict[str, str] = {}
        self._settings: dict[str, str] = {}

    def key(self, tool: str, version: str, fingerprint: str, unit: Unit) -> str:
        parts = [
            digest(OF_LINTERS),
            tool,
            version,
            fingerprint,
            unit.group,
            unit.salt,
            unit.file.path,
            unit.file.digest,
        ]
        for path in unit.dependencies:
            parts += (path, self._of(path))
        for path in unit.settings:
            parts += ("settings", path, self._of_setting(path))
        return hashlib.sha256("\0".join(parts).encode("utf-8", "surrogatepass")).hexdigest()

    def _of(self, path: str) -> str:
        found = self.known.get(path) or self._others.get(path)
        if found is None:
            found = self._others[path] = _digest(self._workspace.text(path))
        return found

    def _of_setting(self, path: str) -> str:
        digest = self._settings.get(path)
        if digest is None:
            digest = self._settings[path] = _digest(self._workspace.setting(path))
        return digest


def _digest(text: str) -> str:
    return hashlib.sha256(text.encode("utf-8", "surrogatepass")).hexdigest()


def works(
    workspace: Workspace,
    linters: Iterable[Linter],
    options: LintOptions,
    store: Store,
    digests: Digests,
    tools: Tools,
) -> list[Work | Run]:
    """The work of each tool that applies, nothing of it done; a Run in place of it for one that is missing."""
    planned: list[Work | Run] = []
    for linter in linters:
        is_requested = linter.NAME in options.enabled
        if linter.NAME in options.disabled or (linter.WHEN is When.ASKED and not is_requested):
            continue
        try:
            work = _begun(linter, workspace, options, store, digests, tools)
        except ValueError as err:  # of a plug-in's adapter
            work = _broken(linter, f"{linter.NAME}: {err}")
        if work is not None:
            planned.append(work)
    return planned


def _begun(
    linter: Linter, workspace: Workspace, options: LintOptions, store: Store, digests: Digests, tools: Tools
) -> Work | Run | None:
    """What *linter* has to do; None if nothing, a failed run if it is missing."""
    plan = units_of(linter, workspace, options, store) if _concerns(linter, workspace) else ()
    units = tuple(asked_for(plan, workspace))
    is_requested = linter.NAME in options.enabled
    needed = is_requested or linter.WHEN is When.ALWAYS
    if not units and not needed:
        return None
    program = tools.program(linter, options)
    if program is None:
        return _missing(linter) if needed else None
    fingerprint = tools.fingerprint(linter, workspace, options)
    work = Work(linter, program, fingerprint, units)
    for unit in units:
        work.keys[unit.file.path] = digests.key(linter.NAME, program.version, fingerprint, unit)
    remarks: Callable[[Workspace, Iterable[str]], Iterable[Problem]] | None = getattr(linter, "remarks", None)
    if remarks is not None:
        for problem in remarks(workspace, sorted({unit.group for unit in units if unit.group})):
            work.notifications.append(
                Notification(Level.WARNING, problem.message, linter.NAME, problem.path, problem.line)
            )
    if not units and is_requested:
        note = f"{linter.NAME} found no file to analyse: the workspace has no file of its kind, or lacks the settings that it needs"
        work.notifications.append(Notification(Level.NOTE, note, linter.NAME))
    return work


def units_of(linter: Linter, workspace: Workspace, options: LintOptions, store: Store) -> Iterable[Unit]:
    """What *linter* has to answer for in *workspace*."""
    plan: Callable[[Workspace, LintOptions, Store], Iterable[Unit]] | None = getattr(linter, "plan", None)
    if plan is not None:
        return plan(workspace, options, store)
    files = (file for file in workspace.files if file.language in linter.LANGUAGES)
    return [Unit(file, dependencies=tuple(linter.dependencies(workspace, file))) for file in files]


def _concerns(linter: Linter, workspace: Workspace) -> bool:
    """Whether any file to report on is of the tool's languages; if not, its plan need not be made."""
    targets = workspace.targets
    return targets is None or any(f.path in targets and f.language in linter.LANGUAGES for f in workspace.files)


def asked_for(units: Iterable[Unit], workspace: Workspace) -> Iterator[Unit]:
    """Those of *units* that tell of a file that the run reports on, and in which somebody would mend something."""
    targets = workspace.targets
    unlinted = {file.path for file in workspace.files if not file.is_linted}
    for unit in units:
        paths = {unit.file.path, *unit.covers} - unlinted
        if paths and (targets is None or not targets.isdisjoint(paths)):
            yield unit


def _missing(linter: Linter) -> Run:
    how = installed.HOW.get(linter.NAME)
    install = f"install it ({how})" if how else "install it"
    return _broken(
        linter, f"{linter.NAME} is not installed, so nothing was checked with it; {install} or switch it off"
    )


def _broken(linter: Linter, message: str) -> Run:
    return Run(
        Tool(linter.NAME),
        notifications=(Notification(Level.ERROR, message, linter.NAME),),
        successful=False,
    )
