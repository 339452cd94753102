# SPDX-License-Identifier: Apache-2.0
"""Reviewdog's diagnostic format (rdjson, a DiagnosticResult of its reviewdog.proto): the open findings with their fixes.

Columns count bytes of UTF-8 from 1, ends are exclusive. A finding on a whole file has no range. A fix is a suggestion where
it is one replacement in the finding's own file; of a file whose lines readers count differently there are none. The
format has no place for what is known, suppressed or gone, nor for trouble with tools.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any

from haros_ci import PROJECT_URL
from haros_ci.model.location import Location
from haros_ci.report.escape import terminal, web_address
from haros_ci.report.message import label, plain
from haros_ci.report.source_lines import Reader, lines_of
from haros_ci.results.fix import Edit, Fix, Point, applied, is_counted_alike
from haros_ci.results.result import Report, Result
from haros_ci.results.rule import Level, Rule

SEVERITIES = {Level.ERROR: "ERROR", Level.WARNING: "WARNING", Level.NOTE: "INFO"}
MOST = 2**31 - 1  # an int32 of the protocol; one number above it makes the whole document unreadable
MAX_LINES = 20  # of one suggestion made of several edits
Lines = Callable[[str], list[str]]


def render(report: Report, *, source: Reader | None = None) -> str:
    """The document, one finding a line; ASCII. *source* gives a file's text, without which most columns are left out."""
    read = source or (lambda path: "")
    lines = lines_of(read)
    rules = {(run.tool.name, rule.id): rule for run in report.runs for rule in run.rules}
    tools = {run.tool.name: web_address(run.tool.information_uri) for run in report.runs}
    found = [
        json.dumps(_diagnostic(result, rules.get((result.tool, result.rule)), tools.get(result.tool), lines, read))
        for result in report.shown()
    ]
    head = json.dumps({"source": {"name": "haros-ci", "url": PROJECT_URL}})[:-1]
    body = ",\n".join(found)
    return f'{head}, "diagnostics": [\n{body}\n]}}\n' if found else f'{head}, "diagnostics": []}}\n'


def byte_column(line: str, column: int) -> int | None:
    """*column* (code points, from 1) of *line* in bytes of UTF-8; the end of the line at most, None if there is no line."""
    if not line and column > 1:
        return None
    return len(line[: column - 1].encode("utf-8", "replace")) + 1


def _diagnostic(result: Result, rule: Rule | None, url: str | None, lines: Lines, read: Reader) -> dict[str, Any]:
    snippet = result.identity.snippet if result.identity else ""
    near = [{"message": label(n), "location": _location(n.location, lines)} for n in result.related]
    suggestions = [made for fix in result.fixes if (made := _suggestion(fix, result.location.path, lines, read))]
    return {
        "message": plain(result),
        "location": _location(result.location, lines, snippet),
        "severity": SEVERITIES[result.level],
        "source": _with_url("name", result.tool, url),
        "code": _with_url("value", result.full_id, web_address(rule.help_uri) if rule else None),
        **({"suggestions": suggestions} if suggestions else {}),
        **({"related_locations": near} if near else {}),
    }


def _with_url(key: str, text: str, url: str | None) -> dict[str, str]:
    return {key: terminal(text), **({"url": url} if url else {})}


def _location(place: Location, lines: Lines, snippet: str = "") -> dict[str, Any]:
    """*snippet* stands for the line where the source is not at hand."""
    path = {"path": terminal(place.path)}
    if place.line is None or place.line > MOST:
        return path
    last = place.end_line or place.line
    start = _position((place.line, place.column), lines(place.path), snippet)
    end = _position((last, place.end_column), lines(place.path), snippet if last == place.line else "")
    if "column" not in start or "column" not in end:
        exact = "column" not in start and last > place.line and last <= MOST
        return {**path, "range": {"start": start, **({"end": {"line": last}} if exact else {})}}
    after = (end["line"], end["column"]) >= (start["line"], start["column"])
    return {**path, "range": {"start": start, **({"end": end} if after else {})}}


def _position(point: tuple[int, int | None], lines: list[str], snippet: str = "") -> dict[str, int]:
    line, column = point
    text = (lines[line - 1] if line <= len(lines) else "") or snippet
    at = byte_column(text, column) if column else None
    return {"line": line, **({"column": at} if at else {})}


def _suggestion(fix: Fix, path: str, lines: Lines, read: Reader) -> dict[str, Any] | None:
    """What *fix* makes of *path* as one replacement, None where it cannot be said so."""
    if any(edit.is_executable or edit.path != path for edit in fix.edits) or not fix.edits:
        return None
    text = read(path)
    if not text or not is_counted_alike(text):
        return None
    edits = sorted(fix.edits, key=lambda edit: (edit.start, edit.end))
    start, end = edits[0].start, max(edit.end for edit in edits)
    if len(edits) > 1 and end[0] - start[0] >= MAX_LINES:
        return None
    try:
        new = _replacement(text, edits, start, end)
    except ValueError:
        return None
    if not new.isascii() and any("\ud800" <= character <= "\udfff" for character in new):
        return None
    here = lines(path)
    if any(line > len(here) or column > len(here[line - 1]) + 1 for line, column in (start, end)):
        return None
    return {"range": {"start": _position(start, here), "end": _position(end, here)}, "text": new}


def _replacement(text: str, edits: list[Edit], start: Point, end: Point) -> str:
    """What stands between *start* and *end* of *text* after *edits*; ValueError where they do not fit."""
    head = len(text) - len(applied(text, [Edit("", (1, 1), start)]))
    rest = len(applied(text, [Edit("", start, end)])) - head
    after = applied(text, edits)
    return after[head : len(after) - rest]
