# SPDX-License-Identifier: Apache-2.0
"""The report inside GitHub Actions: workflow commands that annotate lines, and Markdown for the job's summary."""

# No "from __future__ import annotations" here: it would take the name of the function below.

import re
from itertools import groupby

from haros_ci.report import summary as counts_of
from haros_ci.report.escape import workflow_data, workflow_property
from haros_ci.report.markdown import alarms_of
from haros_ci.report.markdown import render as as_markdown
from haros_ci.report.message import label, plain, shorten
from haros_ci.results.result import Report, Result
from haros_ci.results.rule import Level

#: GitHub shows 10 annotations of each level a step and drops the rest (actions/toolkit, problem-matchers.md); its
#: 50 a job leave room for this step's 30.
MAX_PER_LEVEL = 10
COMMANDS = {Level.ERROR: "error", Level.WARNING: "warning", Level.NOTE: "notice"}
#: Past 1 MiB GitHub refuses the whole summary of a step.
MAX_SUMMARY = 1024 * 1024
MAX_TEXT = 500
MAX_PLACES = 5


def annotations(report: Report) -> str:
    """Workflow commands for tools that failed and for open findings, the worst first, one for each line of code.

    What the caps leave out is counted in a closing notice; known findings are never annotated.
    """
    commands = [(Level.ERROR, _command(Level.ERROR, {"title": "haros-ci"}, text)) for text in alarms_of(report)]
    merged = [tuple(group) for _, group in groupby(report.shown(), lambda r: (r.location.path, r.location.line))]
    merged.sort(key=_worst_rank)
    weights = [0] * len(commands) + [len(group) for group in merged]
    commands += [_annotation(group) for group in merged]
    room = {Level.ERROR: MAX_PER_LEVEL, Level.WARNING: MAX_PER_LEVEL, Level.NOTE: MAX_PER_LEVEL - 1}
    written, rest = [], 0
    for (level, command), weight in zip(commands, weights):
        if room[level]:
            room[level] -= 1
            written.append(command)
        else:
            rest += weight
    if rest:
        more = (
            f"{counts_of.plural(rest, 'more finding')} not annotated here; the job summary and the SARIF log have them."
        )
        written.append(_command(Level.NOTE, {"title": "haros-ci"}, more))
    return "".join(f"{command}\n" for command in written)


def summary(report: Report, *, limit: int = MAX_SUMMARY, blob: str = "") -> str:
    """GitHub-flavoured Markdown of at most *limit* bytes for ``GITHUB_STEP_SUMMARY``; *blob* as ``blob_address`` gives it."""
    return as_markdown(report, limit=limit, blob=blob)


def blob_address(server: str, repository: str, commit: str) -> str:
    """Where the files of a commit can be read; "" unless all three look as GitHub writes them."""
    if not re.fullmatch(r"https://[\w.-]{1,100}(?::[0-9]{1,5})?", server, re.A):
        return ""
    if not re.fullmatch(r"[\w.-]{1,100}/[\w.-]{1,100}", repository, re.A):
        return ""
    return f"{server}/{repository}/blob/{commit}" if re.fullmatch(r"[0-9a-f]{40}|[0-9a-f]{64}", commit) else ""


def _worst_rank(group: tuple[Result, ...]) -> int:
    return min(result.level.rank for result in group)


def _annotation(group: tuple[Result, ...]) -> tuple[Level, str]:
    """One command for all findings of one line, as GitHub shows only some of several."""
    ranked = sorted(group, key=lambda r: r.level.rank)
    first, place = ranked[0], ranked[0].location
    properties: dict[str, str] = {"file": place.path}
    if place.line is not None:
        properties["line"] = properties["endLine"] = str(place.line)
        if place.column is not None:
            properties["col"] = str(place.column)
            if place.end_column is not None and place.end_line in (None, place.line):
                properties["endColumn"] = str(place.end_column)
    properties["title"] = first.full_id if len(ranked) == 1 else f"{len(ranked)} findings"
    if len(ranked) == 1:
        return first.level, _command(first.level, properties, _with_places(first))
    return first.level, _command(first.level, properties, "\n".join(f"{plain(r)} [{r.full_id}]" for r in ranked))


def _with_places(result: Result) -> str:
    """The message, and below it where the other ends of the finding stand: an annotation has no links."""
    places = [f"{near.location}: {label(near)}" for near in result.related[:MAX_PLACES]]
    more = len(result.related) - len(places)
    return "\n".join([plain(result), *places, *([f"and {more:,} more places"] if more else [])])


def _command(level: Level, properties: dict[str, str], message: str) -> str:
    written = ",".join(f"{name}={workflow_property(value)}" for name, value in properties.items())
    return f"::{COMMANDS[level]} {written}::{workflow_data(shorten(message, 4 * MAX_TEXT))}"
