# SPDX-License-Identifier: Apache-2.0
"""One batch of files: from a process, or several if it fails, to answers."""

from __future__ import annotations

import os
import re
from dataclasses import replace
from pathlib import Path

from haros_ci.linters import footing
from haros_ci.linters.gate import Gate
from haros_ci.linters.linter import Batch, Finding, GaveUp, Linter, LintOptions, Output, Program, Unit, Unread
from haros_ci.linters.process import Processes, Stalled, TimedOut, Unstartable
from haros_ci.linters.rows import MOST, Answer
from haros_ci.linters.sandbox import Confinement
from haros_ci.model.workspace import Workspace
from haros_ci.records import dataclass
from haros_ci.results.result import Result

#: Processes that may follow one failed batch in the search for the file that spoils it.
RETRIES = 16
#: Files with which a tool may not get on before the rest of a batch is left out.
STALLS = 4
#: Seconds that each of them has at least, if the first one had as many.
SHORTEST = 10.0


@dataclass(frozen=True, slots=True)
class Task:
    """One batch to run; *units* are of one group. *workspace* is what the tool gets to see.

    If it is *confined*, the tool can open nothing else.
    """

    linter: Linter
    program: Program
    options: LintOptions
    workspace: Workspace
    units: tuple[Unit, ...]
    confined: bool = False
    gate: Gate | None = None

    def timeout(self, units: int) -> float:
        """Seconds that one process may take for so many of the units: what a search for a file takes is bounded by that for all."""
        whole = self.options.timeouts.get(self.linter.NAME, self.options.timeout)
        return whole if units == len(self.units) else max(whole * units / len(self.units), min(whole, SHORTEST))


@dataclass(frozen=True, slots=True)
class Outcome:
    """What became of one batch: answers by path, those of the adapter beside it, sentences on what failed with the paths concerned, CPU seconds by path."""

    answers: tuple[tuple[str, Answer], ...] = ()
    beside: tuple[tuple[str, Answer], ...] = ()
    failures: tuple[tuple[str, tuple[str, ...]], ...] = ()
    seconds: tuple[tuple[str, float], ...] = ()


def execute(task: Task, processes: Processes, scratch: Path) -> Outcome:
    """One batch; after a failure its halves, so that one file that a tool chokes on costs only itself.

    *scratch* is a directory of our own.
    """
    answers: list[tuple[str, Answer]] = []
    beside: list[tuple[str, Answer]] = []
    seconds: list[tuple[str, float]] = []
    failures: list[tuple[str, tuple[str, ...]]] = []
    waiting, stalled = [task.units], list[str]()
    for attempt in range(1 + RETRIES):
        if not waiting:
            break
        part = waiting.pop()
        paths = tuple(unit.file.path for unit in part)
        try:
            new_answers, more, spent = _ask(task, part, processes, scratch / str(attempt))
            answers += new_answers
            beside += more
            seconds += _shared(spent, part)
        except Unstartable as err:
            failures.append((_sentence(task, err, paths), paths))
        except Stalled as err:
            stalled.append(err.at.removeprefix(os.path.realpath(task.workspace.root) + "/"))
            lost = _lost_with(stalled, part, task.units)
            kept = tuple(unit for unit in part if unit not in lost)
            paths = tuple(unit.file.path for unit in lost)
            failures.append((_sentence(task, err, paths), paths))
            waiting += [kept] if kept else []
        except (TimedOut, _Failed) as err:
            if len(part) == 1 or attempt + len(waiting) + 2 > RETRIES:
                failures.append((_sentence(task, err, paths), paths))
            else:
                waiting += (part[len(part) // 2 :], part[: len(part) // 2])
    for part in waiting:
        paths = tuple(unit.file.path for unit in part)
        failures.append((_sentence(task, _Failed("not tried again"), paths), paths))
    return Outcome(tuple(answers), tuple(beside), tuple(failures), tuple(seconds))


def _lost_with(stalled: list[str], units: tuple[Unit, ...], every: tuple[Unit, ...]) -> tuple[Unit, ...]:
    """Those of *units* that are not tried again after a tool did not get on with the files *stalled*: the last one, and what includes it.

    After two such files also what shares a header with all of them; after STALLS, or if the file is none of *every*, all.
    """
    by_path = {unit.file.path: unit for unit in every}
    at = stalled[-1]
    if at not in by_path or len(stalled) >= STALLS:
        return units
    bad = {at}
    if len(stalled) > 1:
        bad |= set.intersection(*(set(by_path[path].dependencies) for path in stalled))
    return tuple(unit for unit in units if unit.file.path == at or not bad.isdisjoint(unit.dependencies))


def _shared(seconds: float, units: tuple[Unit, ...]) -> list[tuple[str, float]]:
    """What each unit has had of a process's time, by its size."""
    total = sum(unit.file.size + 1 for unit in units)
    return [(unit.file.path, seconds * (unit.file.size + 1) / total) for unit in units]


class _Failed(Exception):
    """The tool crashed, wrote too much, or wrote what it never writes."""


def _ask(
    task: Task, units: tuple[Unit, ...], processes: Processes, scratch: Path
) -> tuple[list[tuple[str, Answer]], list[tuple[str, Answer]], float]:
    """The answers, those of the adapter beside it, and the CPU seconds that they took."""
    workspace = task.workspace
    own, working = scratch / "own", scratch / "home"
    own.mkdir(parents=True)
    batch = Batch(workspace, tuple(unit.file for unit in units), task.options, own, units[0].group)
    try:
        command = task.linter.command(task.program, batch)
    except ValueError as err:  # of a plug-in's adapter
        raise _Failed(str(err)) from err
    confinement = None
    if task.confined:
        reads = (str(workspace.root), str(own), *footing.of_program(command.argv), *command.reads)
        confinement = Confinement(reads, (str(own), str(working), *footing.WRITTEN), command.talks)
    timeout = task.timeout(len(units))
    output = processes.run(
        command,
        root=workspace.root,
        scratch=working,
        timeout=timeout,
        confinement=confinement,
        tool=task.linter.NAME,
    )
    if output.truncated:
        raise _Failed("wrote more than it may")
    if output.code < 0:
        raise _Failed(f"was ended by signal {-output.code}")
    clean = _Cleaner(_here(own, working, workspace.root), task.gate)
    answers = _answers(task.linter, output, batch, units, clean, processes)
    other = task.options.beside.get(task.linter.NAME)
    beside = _answers(other, output, batch, units, clean, processes) if other is not None else []
    return answers, beside, output.seconds


def _answers(
    linter: Linter, output: Output, batch: Batch, units: tuple[Unit, ...], clean: _Cleaner, processes: Processes
) -> list[tuple[str, Answer]]:
    """What *linter* reads out of an output, by path; a run that is abandoned meanwhile is not waited for: Unstartable."""
    by_path = {unit.file.path: unit for unit in units}
    collected: dict[str, tuple[list[Result], list[GaveUp]]] = {path: ([], []) for path in by_path}
    try:
        for answer in linter.parse(output, batch):
            if processes.is_stopped:
                raise Unstartable("the run was abandoned")
            results, gave_up = collected[answer.unit]
            if isinstance(answer, Finding):
                if len(results) == MOST:
                    raise Unread(f"more than {MOST:,} findings for one file")
                results.append(clean.result(answer.result, by_path[answer.unit]))
            else:
                gave_up.append(replace(answer, message=clean.text(answer.message, by_path[answer.unit])))
    except Unread as err:
        raise _Failed(clean.text(str(err), units[0])) from err
    except (ValueError, KeyError, TypeError, IndexError, AttributeError, RecursionError) as err:
        words = clean.text(_last_words(output.stderr), units[0])
        raise _Failed(words or f"its output cannot be parsed ({err})") from err
    return [(path, Answer(tuple(found), tuple(reasons))) for path, (found, reasons) in sorted(collected.items())]


def _here(*directories: Path) -> re.Pattern[str]:
    """Matches this machine's directories, which must not get into an output."""
    names = {name for directory in directories for name in (str(directory), os.path.realpath(directory)) if name != "/"}
    return re.compile(rf"(?<![\w/.-])(?:{'|'.join(map(re.escape, sorted(names, reverse=True)))})(?:(/)|(?![\w.-]))")


class _Cleaner:
    """Texts of a tool without this machine's directories, and through the gate."""

    def __init__(self, here: re.Pattern[str], gate: Gate | None) -> None:
        self._here = here
        self._gate = gate

    def text(self, text: str, unit: Unit) -> str:
        text = self._here.sub(lambda match: "" if match[1] else ".", text) if "/" in text else text
        return text if self._gate is None else self._gate.cut(text, unit)

    def result(self, result: Result, unit: Unit) -> Result:
        message = self.text(result.message, unit)
        related = tuple(replace(r, message=self.text(r.message, unit)) for r in result.related)
        same = message == result.message and related == result.related
        return result if same else replace(result, message=message, related=related)


def _sentence(task: Task, error: Exception, paths: tuple[str, ...]) -> str:
    name = task.linter.NAME
    files = ", ".join(paths[:3]) + (f" and {len(paths) - 3} more" if len(paths) > 3 else "")
    if isinstance(error, Stalled):
        at = error.at.removeprefix(os.path.realpath(task.workspace.root) + "/")
        return f"{name} was stopped after {error.seconds:g} s with {at}; without a result: {files}"
    if isinstance(error, TimedOut):
        return f"{name} was stopped after {task.timeout(len(paths)):g} s; without a result: {files}"
    if isinstance(error, Unstartable):
        return f"{name} could not be started ({error}); without a result: {files}"
    return f"{name} failed: {error}; without a result: {files}"


def _last_words(stderr: bytes) -> str:
    """The last line that a tool wrote before it gave up: the exception of a traceback, the cause of a usage error."""
    lines = [line for line in stderr[-4000:].decode("utf-8", "replace").splitlines() if line.strip()]
    return lines[-1].strip()[:300] if lines else ""
