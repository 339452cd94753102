# SPDX-License-Identifier: Apache-2.0
"""Counts and closing sentences that every form for people shares; texts come unescaped."""

from __future__ import annotations

from collections import Counter

from haros_ci.records import dataclass
from haros_ci.results.counted import counted, is_counted
from haros_ci.results.result import BaselineState, Notification, Report, is_open
from haros_ci.results.rule import Level

#: More open findings than this call for a baseline.
MANY = 50
#: Files that a tool has given up on, of which each is named with its reason.
MOST_GIVEN_UP = 5


@dataclass(frozen=True, slots=True)
class ResultCounts:
    """How many results there are of each kind; *errors*, *warnings* and *notes* are the open ones."""

    errors: int
    warnings: int
    notes: int
    failing: int
    unchanged: int
    updated: int
    absent: int
    suppressed: int
    counted: int

    @property
    def open(self) -> int:
        return self.errors + self.warnings + self.notes


def count(report: Report) -> ResultCounts:
    """Every result falls in one kind.

    It is absent, else a metric that is only counted, else suppressed, else open by level, else unchanged or updated.
    """
    kinds: Counter[str] = Counter()
    for run in report.runs:
        for result in run.results:
            if result.state is BaselineState.ABSENT:
                kinds["absent"] += 1
            elif is_counted(result):
                kinds["counted"] += 1
            elif result.suppressions:
                kinds["suppressed"] += 1
            elif is_open(result):
                kinds[result.level.value] += 1
            elif result.state is not None:
                kinds[result.state.value] += 1
    return ResultCounts(
        errors=kinds["error"],
        warnings=kinds["warning"],
        notes=kinds["note"],
        failing=len(report.failing()),
        unchanged=kinds["unchanged"],
        updated=kinds["updated"],
        absent=kinds["absent"],
        suppressed=kinds["suppressed"],
        counted=kinds["counted"],
    )


def compared(report: Report) -> bool:
    """Whether findings were matched against a baseline, so that the open ones are new."""
    return report.baseline is not None and report.baseline.available


def baseline(report: Report) -> str:
    """What findings were compared with, so that *new* has a meaning, else ""."""
    return f"Compared with {report.baseline.source}." if report.baseline and compared(report) else ""


def headline(report: Report, counts: ResultCounts) -> str:
    """``3 new findings: 1 error, 2 warnings``; never without what makes it less than the truth."""
    new = "new " if compared(report) else ""
    failed = len(report.failed_tools())
    but = (f"; {plural(failed, 'tool')} failed" if failed else "") + ("; no baseline" if no_baseline(report) else "")
    if not counts.open:
        return f"No {new}findings{but}"
    levels = [
        plural(number, noun)
        for number, noun in ((counts.errors, "error"), (counts.warnings, "warning"), (counts.notes, "note"))
        if number
    ]
    return f"{plural(counts.open, f'{new}finding')}: {', '.join(levels)}{but}"


def stood_for(report: Report) -> str:
    """How many findings are left to others in what people read, so that formats for programs have more of them, else ""."""
    shown = report.shown()
    left = sum(len(result.copies) for result in shown)
    if not left:
        return ""
    one = len(shown) == 1
    who, cause = ("It stands", "cause") if one else ("They stand", "causes")
    return f"{who} for {left:,} more of the same {cause}: SARIF and JSON list all {len(shown) + left:,}."


def known(counts: ResultCounts) -> str:
    """``known: 120 unchanged, 4 updated; gone: 7; suppressed: 12``, or "" if there is nothing of it."""
    old = [f"{n:,} {word}" for n, word in ((counts.unchanged, "unchanged"), (counts.updated, "updated")) if n]
    parts = [f"known: {', '.join(old)}"] if old else []
    parts += [f"gone: {counts.absent:,}"] if counts.absent else []
    parts += [f"suppressed: {counts.suppressed:,}"] if counts.suppressed else []
    return "; ".join(parts)


def metrics(report: Report) -> str:
    """How many metrics are beyond their limits, where they are counted rather than listed, else ""."""
    return counted(result for run in report.runs for result in run.results)


def verdict(report: Report, counts: ResultCounts) -> str:
    """What decides about failure as far as findings do."""
    if report.fail_on is None:
        return "Findings do not fail this run."
    threshold = f"at or above '{report.fail_on.value}'"
    if counts.failing:
        return f"{plural(counts.failing, 'finding')} {threshold} {'fails' if counts.failing == 1 else 'fail'} this run."
    return f"Nothing {'new ' if compared(report) else ''}{threshold}."


def no_baseline(report: Report) -> str:
    """Why there is no baseline although one was asked for, else ""."""
    if report.baseline is None or report.baseline.available:
        return ""
    reason = report.baseline.message or report.baseline.source
    return f"No baseline: {reason.rstrip('.')}. Every finding counts as new."


def covered(report: Report) -> str:
    """What was looked at, and with which tools."""
    coverage = report.coverage
    seen = [plural(coverage.packages, "package"), plural(coverage.files, "file")]
    if coverage.lines:  # those of C++ and Python
        seen.append(plural(coverage.lines, "line"))
    if coverage.targets is not None:
        seen.append(f"reporting on {plural(coverage.targets, 'file')}")
    tools = sorted({f"{run.tool.name} {run.tool.version}".strip() for run in report.runs if run.successful})
    return f"Looked at {', '.join(seen)}" + (f" with {', '.join(tools)}." if tools else " with no tool.")


def given_up(report: Report) -> str:
    """How many files each tool could not analyse, or not all of them, else ""."""
    messages = [f"{tool} on {plural(len(files), 'file')}" for tool, files in _given_up(report)]
    return f"Not analysed in full: {', '.join(messages)}." if messages else ""


def given_up_on(report: Report, printed: Level | None = None) -> tuple[tuple[str, str], ...]:
    """Place and reason for the first MOST_GIVEN_UP files of each tool, then how many more; a place "" for that.

    Tools are left out if all of their notifications are printed elsewhere: those at level *printed* or worse.
    """
    messages: list[tuple[str, str]] = []
    for tool, files in _given_up(report):
        first = {path: min(notes, key=lambda note: note.line or 0) for path, notes in sorted(files.items())}
        if printed is not None and all(note.level.rank <= printed.rank for note in first.values()):
            continue
        alike: dict[str, list[str]] = {}  # one reason at many files is one line
        for path, note in first.items():
            alike.setdefault(note.message.rstrip("."), []).append(path)
        for reason, paths in list(alike.items())[:MOST_GIVEN_UP]:
            note, more = first[paths[0]], sum(len(files[path]) - 1 for path in paths)
            place = f"{note.path}:{note.line}" if note.line else f"{note.path}"
            if len(paths) > 1:
                place += f" and {plural(len(paths) - 1, 'more file')}"
            messages.append((place, reason + (f"; and {plural(more, 'more reason')}" if more else "")))
        if left := sum(map(len, list(alike.values())[MOST_GIVEN_UP:])):
            messages.append(("", f"and {plural(left, 'more file')} of {tool}"))
    return tuple(messages)


def _given_up(report: Report) -> list[tuple[str, dict[str, list[Notification]]]]:
    """By tool, sorted, what it says of each file that it could not analyse."""
    files: dict[str, dict[str, list[Notification]]] = {}
    for note in notifications(report):
        if note.tool and note.path and not note.configuration:
            files.setdefault(note.tool, {}).setdefault(note.path, []).append(note)
    return sorted(files.items())


def notifications(report: Report) -> tuple[Notification, ...]:
    """All of them, each once, worst first, then by tool and place."""
    every = {*report.notifications, *(note for run in report.runs for note in run.notifications)}
    return tuple(
        sorted(every, key=lambda n: (n.level.rank, n.tool or "", n.path or "", n.line or 0, n.message, n.configuration))
    )


def failures(report: Report) -> tuple[str, ...]:
    """A sentence for each tool whose run did not succeed."""
    messages = []
    for run in sorted(report.runs, key=lambda run: run.tool.name):
        if not run.successful:
            why = next((n.message for n in run.notifications if n.level is Level.ERROR), "it did not finish")
            messages.append(f"{run.tool.name} failed: {why.rstrip('.')}. Its findings are missing or incomplete.")
    return tuple(messages)


def plural(number: int, noun: str) -> str:
    return f"{number:,} {noun}" if number == 1 else f"{number:,} {noun}s"
