# SPDX-License-Identifier: Apache-2.0
"""The report inside GitHub Actions: workflow commands that annotate lines, and Markdown for the job's summary."""

# No "from __future__ import annotations" here: it would take the name of the function below.

from collections.abc import Iterable
from itertools import groupby

from haros_ci.report import summary as counts_of
from haros_ci.report.escape import markdown, markdown_code, workflow_data, workflow_property
from haros_ci.report.message import label, plain, shorten
from haros_ci.results.result import Notification, Report, Result
from haros_ci.results.rule import Level

#: GitHub shows 10 annotations of each level a step and drops the rest (actions/toolkit, problem-matchers.md); its
#: 50 a job leave room for this step's 30.
MAX_PER_LEVEL = 10
COMMANDS = {Level.ERROR: "error", Level.WARNING: "warning", Level.NOTE: "notice"}
#: Past 1 MiB GitHub refuses the whole summary of a step.
MAX_SUMMARY = 1024 * 1024
MAX_ROWS = 500
MAX_TROUBLE = 50
MAX_TEXT = 500
MAX_PLACES = 5


def annotations(report: Report) -> str:
    """Workflow commands for tools that failed and for open findings, the worst first, one for each line of code.

    What the caps leave out is counted in a closing notice; known findings are never annotated.
    """
    commands = [(Level.ERROR, _command(Level.ERROR, {"title": "haros-ci"}, text)) for text in _alarms(report)]
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


def summary(report: Report, *, limit: int = MAX_SUMMARY) -> str:
    """GitHub-flavoured Markdown of at most *limit* bytes: verdict, trouble, a table of open findings, coverage."""
    counts = counts_of.count(report)
    head = [f"## haros-ci: {counts_of.headline(report, counts)}", "", counts_of.verdict(report, counts)]
    if known := counts_of.known(counts):
        head.append(f"Also {known}.")
    for alarm in _alarms(report):
        head += ["", "> [!CAUTION]", f"> {_text(alarm)}"]
    shown = sorted(report.shown(), key=lambda r: (r.level.rank, r.sort_key))
    tail = "\n".join(["", *_details(report), ""])
    table = ["", "| Level | Place | Finding | Rule |", "|---|---|---|---|"] if shown else []
    text = "\n".join([*head, *table, ""])
    rows, room = [], limit - len(text.encode()) - len(tail.encode()) - 200
    for result in shown[:MAX_ROWS]:
        row = _row(result)
        room -= len(row.encode()) + 1
        if room < 0:
            break
        rows.append(f"{row}\n")
    left = len(shown) - len(rows)
    note = (
        f"\n{counts_of.plural(left, 'more finding')} not in this table; the SARIF log has them all.\n" if left else ""
    )
    written = f"{text}{''.join(rows)}{note}{tail}"
    return written + _changes(report, limit - len(written.encode()))


def _changes(report: Report, room: int) -> str:
    """What the change does to the system, where a base revision is known and *room* bytes are enough."""
    if report.changes is None:
        return ""
    from haros_ci.report.diff_markdown import render

    text = f"\n### What changes in the system\n\n{render(report.changes)}"
    return text if len(text.encode()) <= room else ""


def _alarms(report: Report) -> tuple[str, ...]:
    """What must not be overlooked, even when nothing was found."""
    missing = counts_of.no_baseline(report)
    return (*((missing,) if missing else ()), *counts_of.failures(report))


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


def _row(result: Result) -> str:
    rules = ", ".join(markdown_code(shorten(rule, MAX_TEXT)) for rule in (result.full_id, *result.also))
    place = markdown_code(shorten(str(result.location), MAX_TEXT))
    return f"| {result.level.value} | {place} | {_text(plain(result))} | {rules} |"


def _details(report: Report) -> Iterable[str]:
    yield _text(counts_of.covered(report))
    if given_up := counts_of.given_up(report):
        yield _text(given_up)
    for sentence in report.coverage.unseen[:MAX_TROUBLE]:
        yield f"- Not seen: {_text(sentence)}"
    if len(report.coverage.unseen) > MAX_TROUBLE:
        yield f"- and {len(report.coverage.unseen) - MAX_TROUBLE:,} more not seen"
    notes = counts_of.notifications(report)
    if notes:
        yield ""
        yield f"<details><summary>{counts_of.plural(len(notes), 'message')} of tools and configuration</summary>\n"
        for note in notes[:MAX_TROUBLE]:
            place = f" {_place(note)}" if note.path else ""
            yield f"- {note.level.value}: {_text(note.tool or 'haros-ci')}{place}: {_text(note.message)}"
        if len(notes) > MAX_TROUBLE:
            yield f"- and {len(notes) - MAX_TROUBLE:,} more"
        yield "\n</details>"


def _place(note: Notification) -> str:
    return markdown_code(shorten(f"{note.path}:{note.line}" if note.line else f"{note.path}", MAX_TEXT))


def _text(text: str) -> str:
    return markdown(shorten(" ".join(text.split()), MAX_TEXT))
