# SPDX-License-Identifier: Apache-2.0
"""JUnit XML, for the test pages of Jenkins, GitLab and others: a suite for each tool, a case for each file.

A file that a tool looked at and found nothing in is a case that passed. An open finding is a failure, whatever its level. A case
has one ``failure`` at most, as readers (Jenkins, GitLab) show only the first: its text has a line for each finding. What
the baseline knows, what is suppressed and what is gone stands in the case's ``system-out``. A file that the tool gave up on is ``skipped``; a tool
that failed has a case of its own with an ``error``. There are no times.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import groupby

from haros_ci.report import summary
from haros_ci.report.message import label, plain, sentence, shorten
from haros_ci.report.xml_tags import HEAD, lines, tag
from haros_ci.results.result import BaselineState, Notification, Report, Result, Run, is_open
from haros_ci.results.rule import Level

OWN = "haros-ci"
MAX_PLACES = 5
MAX_NOTES = 200  # of one suite; the rest is counted


def render(report: Report) -> str:
    """The document; the same results and files give the same bytes."""
    suites = [_suite(run) for run in sorted(report.runs, key=lambda run: (run.imported, run.tool.name))]
    general = _general(report)
    if general:
        suites.append(general)
    totals = {name: sum(counts[name] for counts, _ in suites) for name in ("tests", "failures", "errors")}
    body = "".join(text for _, text in suites)
    return f"{HEAD}{tag('testsuites', {'name': OWN, **totals, 'time': '0'})}\n{body}</testsuites>\n"


def _suite(run: Run) -> tuple[dict[str, int], str]:
    name = f"{run.tool.name} (imported)" if run.imported else run.tool.name
    results = sorted(run.results, key=lambda result: result.sort_key)
    by_path = {path: tuple(group) for path, group in groupby(results, lambda result: result.location.path)}
    notes = sorted(set(run.notifications), key=_note_key)
    given_up = {note.path: note for note in reversed(notes) if note.path and not note.configuration}
    cases = []
    if not run.successful:
        cases.append(("errors", _broken(run, name)))
    for path in sorted({*by_path, *run.analysed, *given_up}):
        is_requested = path in run.analysed or path in by_path
        cases.append(_case(path, name, by_path.get(path, ()), None if is_requested else given_up.get(path)))
    return _written(name, run.tool.version, cases, [_note(note) for note in notes])


def _general(report: Report) -> tuple[dict[str, int], str] | None:
    """What belongs to no tool: trouble with inputs and configuration, and a baseline that could not be had."""
    notes = [_note(note) for note in sorted(set(report.notifications), key=_note_key)]
    missing = summary.no_baseline(report)
    if not notes and not missing:
        return None
    return _written(f"{OWN} (inputs)", "", [], ([f"error: {missing}"] if missing else []) + notes)


def _written(name: str, version: str, cases: list[tuple[str, str]], notes: list[str]) -> tuple[dict[str, int], str]:
    kinds = [kind for kind, _ in cases]
    counts = {"tests": len(cases), **{kind: kinds.count(kind) for kind in ("failures", "errors", "skipped")}}
    text = [tag("testsuite", {"name": name, **counts, "time": "0"})]
    if version:
        text += ["<properties>", tag("property", {"name": "version", "value": version}, closed=True), "</properties>"]
    text += [case for _, case in cases]
    if notes:
        more = [f"and {len(notes) - MAX_NOTES:,} more messages"] if len(notes) > MAX_NOTES else []
        text.append(f"<system-err>{lines(notes[:MAX_NOTES] + more)}</system-err>")
    return counts, "".join(f"{line}\n" for line in [*text, "</testsuite>"])


def _case(path: str, suite: str, results: tuple[Result, ...], gave_up: Notification | None) -> tuple[str, str]:
    """The kind ("" for passed) and the element."""
    failing = [result for result in results if is_open(result)]
    inner, kind = [], ""
    if failing:
        kind = "failures"
        inner.append(_failure(failing))
    elif gave_up is not None:
        kind = "skipped"
        inner.append(tag("skipped", {"message": shorten(_note(gave_up), 500)}, closed=True))
    if known := [f"{_state(result)}: {_line(result)}" for result in results if not is_open(result)]:
        inner.append(f"<system-out>{lines(known)}</system-out>")
    attributes: dict[str, str | int | None] = {"classname": f"{OWN}.{suite}", "name": path, "time": "0"}
    if not inner:
        return kind, tag("testcase", attributes, closed=True)
    return kind, "\n".join([tag("testcase", attributes), *inner, "</testcase>"])


def _failure(failing: list[Result]) -> str:
    worst = min(failing, key=lambda result: result.level.rank)
    at = "" if worst.location.line is None else f"line {worst.location.line}: "
    more = f" (and {summary.plural(len(failing) - 1, 'more finding')})" if len(failing) > 1 else ""
    head = {"type": worst.full_id, "message": f"{at}{plain(worst)}{more}"}
    return f"{tag('failure', dict(head))}{lines(text for result in failing for text in _with_places(result))}</failure>"


def _broken(run: Run, name: str) -> str:
    messages = [note for note in sorted(set(run.notifications), key=_note_key) if note.level is Level.ERROR]
    why = sentence(messages[0].message) if messages else "It did not finish."
    head = tag("testcase", {"classname": f"{OWN}.{name}", "name": "the tool itself", "time": "0"})
    message = f"{run.tool.name} failed: {why} Its findings are missing or incomplete."
    error = f"{tag('error', {'type': 'tool', 'message': message})}{lines(map(_note, messages[:MAX_NOTES]))}</error>"
    return "\n".join([head, error, "</testcase>"])


def _with_places(result: Result) -> Iterator[str]:
    yield _line(result)
    for near in result.related[:MAX_PLACES]:
        yield f"  {near.location}: note: {label(near)}"
    if len(result.related) > MAX_PLACES:
        yield f"  and {len(result.related) - MAX_PLACES:,} more places"


def _line(result: Result) -> str:
    return f"{result.location}: {result.level.value}: {plain(result)} [{', '.join((result.full_id, *result.also))}]"


def _state(result: Result) -> str:
    if result.state is BaselineState.ABSENT:
        return "gone"
    return "suppressed" if result.suppressions else result.state.value if result.state else "known"


def _note_key(note: Notification) -> tuple[object, ...]:
    return (note.level.rank, note.path or "", note.line or 0, note.message, note.configuration)


def _note(note: Notification) -> str:
    place = "" if not note.path else f"{note.path}:{note.line}: " if note.line else f"{note.path}: "
    return f"{note.level.value}: {place}{sentence(note.message)}"
