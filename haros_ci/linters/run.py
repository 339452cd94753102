# SPDX-License-Identifier: Apache-2.0
"""The one runner behind every adapter: what is known comes from the cache, the rest from batches of processes."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from time import perf_counter
from typing import TypeVar

from haros_ci.linters import rows, schedule
from haros_ci.linters.execute import Outcome, Task, execute
from haros_ci.linters.gate import Gate
from haros_ci.linters.linter import REFUTED, SILENCED, GaveUp, Linter, LintOptions, Unit
from haros_ci.linters.process import Processes
from haros_ci.linters.recorded import Recorded
from haros_ci.linters.rows import Answer, IsSelected
from haros_ci.linters.view import views
from haros_ci.linters.work import Digests, InstalledTools, Work, works
from haros_ci.model.workspace import Store, Workspace
from haros_ci.results.result import Notification, Run, Tool
from haros_ci.scratch import place_in_memory, scratch_directory
from haros_ci.timing import Spent, side_by_side, timed

T = TypeVar("T")
Progress = Callable[[str], None]
Declined = Callable[[Workspace, Iterable[Unit]], dict[str, str]]


@timed("linters")
def lint(
    workspace: Workspace,
    linters: Iterable[Linter],
    options: LintOptions,
    store: Store,
    is_selected: IsSelected,
    progress: Progress | None = None,
    recorded: Recorded | None = None,
) -> tuple[Run, ...]:
    """One run per tool that applies, named after its adapter; ``rules`` are left empty.

    Only results for which *is_selected* (tool, rule, path) is true, in files to report on, are kept, sorted, without duplicates. A tool that
    is missing although it always runs or was asked for, crashes, times out or talks nonsense makes its own run unsuccessful
    and nothing else. Answers are cached per file, failures never. With *recorded* answers no tool is started.
    """
    options = replace(options, root=options.root or workspace.root)
    digests = Digests(workspace)

    unlinted = {file.path for file in workspace.files if not file.is_linted}

    def keep(tool: str, rule: str, path: str) -> bool:
        if not workspace.reports_on(path) or path in unlinted:
            return False
        return rule == SILENCED or is_selected(tool, rule.removeprefix(REFUTED), path)

    planned = works(workspace, linters, options, store, digests, InstalledTools() if recorded is None else recorded)
    complete(
        [work for work in planned if isinstance(work, Work)],
        workspace,
        options,
        store,
        keep,
        digests,
        progress,
        recorded,
    )
    return tuple(work if isinstance(work, Run) else _run(work, workspace) for work in planned)


def complete(
    works: Sequence[Work],
    workspace: Workspace,
    options: LintOptions,
    store: Store,
    keep: IsSelected,
    digests: Digests,
    progress: Progress | None = None,
    recorded: Recorded | None = None,
) -> None:
    """Answer for all units: with what is *recorded*, else from the store and by running the tools."""
    for work in works:
        _recall(work, store if recorded is None else recorded, keep, digests)
    incomplete = [work for work in works if work.missing]
    if incomplete and recorded is not None:
        recorded.settle(incomplete)
    elif incomplete:
        _analyse(incomplete, workspace, options, store, keep, digests, progress)


def _recall(work: Work, store: Store | Recorded, keep: IsSelected, digests: Digests) -> None:
    """Take what is known; what is not is then missing. A file that no tool can be asked about is not missed."""
    name = work.linter.NAME
    for unit in work.units:
        path = unit.file.path
        if not path.isprintable():
            work.take(unit, Answer(gave_up=(GaveUp(path, "its name has unprintable characters"),)))
            continue
        cached = store.get(name, path, work.keys[path])
        answer = None if cached is None else rows.decode(cached, path, keep, digests.known)
        if answer is None:
            work.missing.append(unit)
        else:
            work.take(unit, answer)


def _decline(work: Work, workspace: Workspace, store: Store) -> None:
    """Takes out of what is missing the files that the adapter does not ask its tool about, each with the reason."""
    declined: Declined | None = getattr(work.linter, "declined", None)
    reasons = {} if declined is None else declined(workspace, work.missing)
    for unit in work.missing:
        path = unit.file.path
        if path in reasons:
            answer = Answer(gave_up=(GaveUp(path, reasons[path]),))
            store.put(work.linter.NAME, path, work.keys[path], rows.encode(answer))
            work.take(unit, answer)
    work.missing = [unit for unit in work.missing if unit.file.path not in reasons]


def _analyse(
    works: Sequence[Work],
    workspace: Workspace,
    options: LintOptions,
    store: Store,
    keep: IsSelected,
    digests: Digests,
    progress: Progress | None,
) -> None:
    """Runs what is missing, the longest batches first, and puts the answers where they belong."""
    jobs: list[tuple[Work, tuple[Unit, ...]]] = []
    for work in works:
        _decline(work, workspace, store)
        seconds = schedule.seconds_of(work.linter, schedule.estimate(work.missing, work.linter.COST))
        jobs += ((work, part) for part in schedule.batches(work.missing, work.linter.COST, seconds))
    jobs.sort(key=lambda job: -schedule.estimate(job[1], job[0].linter.COST))  # stable: equal ones stay in order
    total, done = sum(len(units) for _, units in jobs), 0
    processes = Processes()
    size = sum(file.size for file in workspace.files)
    with scratch_directory("haros-ci-", place_in_memory(size)) as directory:
        # Whoever trusts the workspace lets tools use what lies in it: plug-ins, settings that name files.
        seen = {} if options.trust_config else views(workspace, works, directory)

        gates = {work.linter.NAME: Gate(workspace, work.linter, work.program) for work in works}

        def run_batch(index: int) -> tuple[Outcome, float]:
            work, units = jobs[index]
            name = work.linter.NAME
            confined = name in seen
            gate = gates[name] if confined else None
            view = seen.get(name, workspace)
            task = Task(work.linter, work.program, options, view, units, confined, gate)
            began = perf_counter()
            return execute(task, processes, directory / str(index)), perf_counter() - began

        for index, (outcome, busy) in _in_parallel(run_batch, len(jobs), options.jobs, processes):
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
                    work.fail(f"{name} failed: its output cannot be parsed; without a result: {path}", (path,))
                    continue
                # What is reported now and what a warm run will report come from the same bytes.
                store.put(name, path, work.keys[path], value)
                work.take(by_path[path], decoded)
            keep_beside(work, outcome.beside, workspace, options, store, digests)
            for message, paths in outcome.failures:
                work.fail(message, paths)
            work.seconds.update(outcome.seconds)
            side_by_side("linters", work.linter.NAME, Spent(busy, sum(seconds for _, seconds in outcome.seconds)))
            done += len(units)
            if progress is not None:
                progress(f"{done}/{total} {work.linter.NAME}")


def keep_beside(
    work: Work,
    answers: Iterable[tuple[str, Answer]],
    workspace: Workspace,
    options: LintOptions,
    store: Store,
    digests: Digests,
) -> None:
    """Put where the adapter beside that of *work* looks for them what it has read out of the same process; what it gave up on is asked again."""
    other = options.beside.get(work.linter.NAME)
    if other is None:
        return
    fingerprint = other.fingerprint(workspace, options)
    units = {unit.file.path: unit for unit in work.units}
    for path, answer in answers:
        if not answer.gave_up:
            key = digests.key(other.NAME, work.program.version, fingerprint, units[path])
            store.put(other.NAME, path, key, rows.encode(answer))


def _in_parallel(run_batch: Callable[[int], T], count: int, jobs: int, processes: Processes) -> Iterable[tuple[int, T]]:
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


def _run(work: Work, workspace: Workspace) -> Run:
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
