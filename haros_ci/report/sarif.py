# SPDX-License-Identifier: Apache-2.0
"""The report as a SARIF 2.1.0 log, one run per tool; sarif-om is loaded only when a log is written."""

from __future__ import annotations

from dataclasses import replace
from typing import Literal

from haros_ci import PROJECT_URL, __version__
from haros_ci.report.sarif_limits import GITHUB, Limits, fit, for_github, shed, without_graphs
from haros_ci.report.source_lines import Reader
from haros_ci.results.result import Notification, Report, Run, Tool
from haros_ci.results.rule import Level

Audience = Literal["archive", "github"]


def render(report: Report, *, audience: Audience = "archive", source: Reader | None = None) -> str:
    """The log as JSON text; see ``log``."""
    return log(report, audience=audience, source=source)[0]


def log(
    report: Report,
    *,
    audience: Audience = "archive",
    source: Reader | None = None,
    limits: Limits = GITHUB,
) -> tuple[str, tuple[Notification, ...]]:
    """The log as JSON text, and what was cut from it to stay within *limits*, which the log's notifications say, too.

    ``archive`` keeps every result with its baseline state, suppressions and context. ``github`` leaves out what code
    scanning would show wrongly or ignores; known results stay, since a result that is missing from the default
    branch's upload closes its alert. *source* gives the text around results; without it only their own lines are quoted.
    """
    from haros_ci.report import sarif_run

    runs = runs_of(report)
    if audience == "github":
        runs = for_github(runs)
    runs, notes = fit(runs, limits)
    text = sarif_run.write_log(runs, report, audience, source)
    keep, too_big = sum(len(run.results) for run in runs), _size(text, limits.bytes)
    if too_big > limits.bytes and any(run.graphs for run in runs) and audience == "archive":
        runs, messages = without_graphs(runs)
        notes += messages
        text = sarif_run.write_log(runs, report, audience, source)
        too_big = _size(text, limits.bytes)
    while too_big > limits.bytes and keep:
        keep = min(keep - 1, int(keep * limits.bytes / too_big * 0.95))
        fewer, messages = shed(runs, keep)
        text = sarif_run.write_log(fewer, report, audience, source)
        too_big = _size(text, limits.bytes)
        if too_big <= limits.bytes or not keep:
            notes += messages
    return text, notes


def runs_of(report: Report) -> tuple[Run, ...]:
    """The runs in a stable order, own before imported, with the report's own notifications in the run they speak of.

    What speaks of no tool's run goes to the first; a report without runs gets an empty one of haros-ci itself.
    """
    runs = sorted(report.runs, key=lambda run: (run.imported, run.tool.name, run.tool.version))
    if not runs:
        runs = [Run(Tool("haros-ci", __version__, PROJECT_URL))]
    names = {run.tool.name: i for i, run in reversed(list(enumerate(runs)))}
    more: list[list[Notification]] = [[] for _ in runs]
    for notification in (*_general(report), *report.notifications):
        more[names.get(notification.tool or "", 0)].append(notification)
    return tuple(
        replace(
            run,
            results=tuple(sorted(run.results, key=lambda r: r.sort_key)),
            notifications=(*run.notifications, *more[i]),
        )
        for i, run in enumerate(runs)
    )


def _general(report: Report) -> list[Notification]:
    """What the report says of the whole in other forms: a missing baseline, and what could not be seen."""
    messages = [Notification(Level.NOTE, sentence) for sentence in report.coverage.unseen]
    if report.baseline and not report.baseline.available:
        messages.append(
            Notification(Level.WARNING, f"No baseline: {report.baseline.message or report.baseline.source}")
        )
    return messages


def _size(text: str, limit: int) -> int:
    """The compressed size in bytes, or the plain one where that is below *limit* already."""
    if len(text) <= limit:
        return len(text)
    import gzip

    return len(gzip.compress(text.encode("ascii"), 6, mtime=0))
