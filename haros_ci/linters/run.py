# SPDX-License-Identifier: Apache-2.0
"""The one runner behind every adapter: what is known comes from the cache, the rest from batches of processes."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from haros_ci.linters import rows, schedule
from haros_ci.linters.execute import Outcome, Task, execute
from haros_ci.linters.linter import GaveUp, Linter, LintOptions, Program, Unit, When
from haros_ci.linters.process import Processes
from haros_ci.linters.rows import Answer, Wanted
from haros_ci.model.workspace import Store, Workspace
from haros_ci.results.result import Notification, Result, Run, Tool
from haros_ci.results.rule import Level

#: Counts changes in what is stored; older entries are then never found.
SCHEMA = "1"
Progress = Callable[[str], None]


@dataclass(slots=True)
class _Work:
    """One tool's share of a run, filled in as answers arrive."""

    linter: Linter
    program: Program
    units: tuple[Unit, ...]
    keys: dict[str, str] = field(default_factory=dict)
    missing: list[Unit] = field(default_factory=list)
    results: set[Result] = field(default_factory=set)
    notifications: list[Notification] = field(default_factory=list)
    answered: set[str] = field(default_factory=set)
    successful: bool = True

    def take(self, unit: Unit, answer: Answer) -> None:
        self.answered.add(unit.file.path)
        self.results.update(answer.results)
        for gave_up in answer.gave_up:
            note = f"{self.linter.NAME} could not analyse this file: {gave_up.message}"
            self.notifications.append(Notification(Level.WARNING, note, self.linter.NAME, gave_up.unit, gave_up.line))

    def fail(self, message: str, path: str | None = None) -> None:
        self.successful = False
        self.notifications.append(Notification(Level.ERROR, message, self.linter.NAME, path))


def lint(
    workspace: Workspace,
    linters: Iterable[Linter],
    options: LintOptions,
    store: Store,
    wanted: Wanted,
    progress: Progress | None = None,
) -> tuple[Run, ...]:
    """One run per tool that applies, named after its adapter; ``rules`` are left empty.

    Only results that are *wanted* (tool, rule, path) and in files to report on are kept, sorted, each once. A tool that
    is missing although it always runs or was asked for, crashes, times out or talks nonsense makes its own run unsuccessful
    and nothing else. Answers are cached per file, failures never.
    """
    options = replace(options, root=options.root or workspace.root)
    digests = _Digests(workspace)

    def keep(tool: str, rule: str, path: str) -> bool:
        return workspace.reports_on(path) and wanted(tool, rule, path)

    works: list[_Work | Run] = []
    for linter in linters:
        asked = linter.NAME in options.enabled
        if linter.NAME in options.disabled or (linter.WHEN is When.ASKED and not asked):
            continue
        try:
            work = _begun(linter, workspace, options, store, keep, digests)
        except ValueError as err:  # of a plug-in's adapter
            work = _broken(linter, f"{linter.NAME}: {err}")
        if work is not None:
            works.append(work)
    incomplete = [work for work in works if isinstance(work, _Work) and work.missing]
    if incomplete:
        _analyse(incomplete, workspace, options, store, keep, digests, progress)
    return tuple(work if isinstance(work, Run) else _run(work, workspace) for work in works)


def _begun(
    linter: Linter, workspace: Workspace, options: LintOptions, store: Store, keep: Wanted, digests: _Digests
) -> _Work | Run | None:
    """What *linter* has to do, with what is known of it already; None if nothing, a failed run if it is missing."""
    plan = _plan(linter, workspace, options, store) if _concerns(linter, workspace) else ()
    units = tuple(unit for unit in plan if _is_asked_for(unit, workspace))
    asked = linter.NAME in options.enabled
    needed = asked or linter.WHEN is When.ALWAYS
    if not units and not needed:
        return None
    program = linter.locate(options)
    if program is None:
        return _missing(linter) if needed else None
    work = _Work(linter, program, units)
    fingerprint = linter.fingerprint(workspace, options)
    for unit in units:
        key = work.keys[unit.file.path] = digests.key(linter.NAME, program.version, fingerprint, unit)
        cached = store.get(linter.NAME, unit.file.path, key)
        answer = None if cached is None else rows.decode(cached, unit.file.path, keep, digests.known)
        if answer is None:
            work.missing.append(unit)
        else:
            work.take(unit, answer)
    if not units and asked:
        note = f"{linter.NAME} found nothing to analyse here"
        work.notifications.append(Notification(Level.NOTE, note, linter.NAME))
    return work


class _Digests:
    """Content digests of workspace files, and cache keys made of them."""

    def __init__(self, workspace: Workspace) -> None:
        self._workspace = workspace
        self.known = {file.path: file.digest for file in workspace.files}
        self._others: dict[str, str] = {}

    def key(self, tool: str, version: str, fingerprint: str, unit: Unit) -> str:
        parts = [SCHEMA, tool, version, fingerprint, unit.group, unit.salt, unit.file.path, unit.file.digest]
        for path in unit.dependencies:
            parts += (path, self._of(path))
        return hashlib.sha256("\0".join(parts).encode("utf-8", "surrogatepass")).hexdigest()

    def _of(self, path: str) -> str:
        digest = self.known.get(path) or self._others.get(path)
        if digest is None:
            text = self._workspace.text(path)
            digest = self._others[path] = hashlib.sha256(text.encode("utf-8", "surrogatepass")).hexdigest()
        return digest


def _plan(linter: Linter, workspace: Workspace, options: LintOptions, store: Store) -> Iterable[Unit]:
    plan: Callable[[Workspace, LintOptions, Store], Iterable[Unit]] | None = getattr(linter, "plan", None)
    if plan is not None:
        return plan(workspace, options, store)
    files = (file for file in workspace.files if file.language in linter.LANGUAGES)
    return [Unit(file, dependencies=tuple(linter.dependencies(workspace, file))) for file in files]


def _concerns(linter: Linter, workspace: Workspace) -> bool:
    """Whether any file to report on is of the tool's languages; if not, its plan need not be made."""
    targets = workspace.targets
    return targets is None or any(f.path in targets and f.language in linter.LANGUAGES for f in workspace.files)


def _is_asked_for(unit: Unit, workspace: Workspace) -> bool:
    return workspace.targets is None or not workspace.targets.isdisjoint((unit.file.path, *unit.covers))


def _missing(linter: Linter) -> Run:
    why = "is not installed, so nothing was checked with it; install it or switch it off"
    return _broken(linter, f"{linter.NAME} {why}")


def _broken(linter: Linter, message: str) -> Run:
    return Run(
        Tool(linter.NAME),
        notifications=(Notification(Level.ERROR, message, linter.NAME),),
        successful=False,
    )


def _analyse(
    works: Sequence[_Work],
    workspace: Workspace,
    options: LintOptions,
    store: Store,
    keep: Wanted,
    digests: _Digests,
    progress: Progress | None,
) -> None:
    """Runs what is missing, the longest batches first, and puts the answers where they belong."""
    import tempfile

    jobs: list[tuple[_Work, tuple[Unit, ...]]] = []
    for work in works:
        sound = []
        for unit in work.missing:
            if unit.file.path.isprintable():
                sound.append(unit)
            else:
                work.take(unit, Answer(gave_up=(GaveUp(unit.file.path, "its name has unprintable characters"),)))
        seconds = getattr(work.linter, "BATCH_SECONDS", schedule.BATCH_SECONDS)
        jobs += ((work, part) for part in schedule.batches(sound, work.linter.COST, seconds))
    jobs.sort(key=lambda job: -schedule.estimate(job[1], job[0].linter.COST))  # stable: equal ones stay in order
    total, done = sum(len(units) for _, units in jobs), 0
    processes = Processes()
    with tempfile.TemporaryDirectory(prefix="haros-ci-", ignore_cleanup_errors=True) as directory:

        def run_batch(index: int) -> Outcome:
            work, units = jobs[index]
            task = Task(work.linter, work.program, options, workspace, units)
            return execute(task, processes, Path(directory, str(index)))

        for index, outcome in _in_parallel(run_batch, len(jobs), options.jobs, processes):
            work, units = jobs[index]
            by_path = {unit.file.path: unit for unit in units}
            for path, answer in outcome.answers:
                name = work.linter.NAME
                try:
                    value = rows.encode(answer)
                    decoded = rows.decode(value, path, keep, digests.known)
                except TypeError:  # what a tool wrote need not be hashable, nor have an order
                    decoded = None
                if decoded is None:
                    work.fail(f"{name} failed: wrote what cannot be understood; without a result: {path}", path)
                    continue
                # What is reported now and what a warm run will report come from the same bytes.
                store.put(name, path, work.keys[path], value)
                work.take(by_path[path], decoded)
            for message, paths in outcome.failures:
                work.fail(message, paths[0] if len(paths) == 1 else None)
            done += len(units)
            if progress is not None:
                progress(f"{done}/{total} {work.linter.NAME}")


def _in_parallel(
    run_batch: Callable[[int], Outcome], count: int, jobs: int, processes: Processes
) -> Iterable[tuple[int, Outcome]]:
    """``run_batch(0 … count-1)`` on *jobs* threads, outcomes as they come; nothing survives an interruption."""
    try:
        if jobs == 1 or count <= 1:
            for index in range(count):
                yield index, run_batch(index)
            return
        from concurrent.futures import ThreadPoolExecutor, as_completed

        with ThreadPoolExecutor(max_workers=min(jobs, count)) as pool:
            futures = {pool.submit(run_batch, index): index for index in range(count)}
            try:
                for future in as_completed(futures):
                    yield futures[future], future.result()
            except BaseException:
                processes.stop()
                pool.shutdown(wait=False, cancel_futures=True)
                raise
    finally:
        processes.stop()


def _run(work: _Work, workspace: Workspace) -> Run:
    """The finished run. A file counts as analysed when every unit that speaks of it has answered."""
    answered: set[str] = set()
    silent: set[str] = set()
    for unit in work.units:
        (answered if unit.file.path in work.answered else silent).update((unit.file.path, *unit.covers))
    return Run(
        Tool(work.linter.NAME, work.program.version),
        results=tuple(sorted(work.results, key=lambda r: r.sort_key)),
        notifications=tuple(sorted(set(work.notifications), key=_order)),
        analysed=frozenset(path for path in answered - silent if workspace.reports_on(path)),
        successful=work.successful,
    )


def _order(notification: Notification) -> tuple[object, ...]:
    return (notification.path or "", notification.line or 0, notification.level.rank, notification.message)
