# SPDX-License-Identifier: Apache-2.0
"""Comma-separated values (RFC 4180, lines end in LF): a row for each result, also for those that are not open.

Cells that a spreadsheet would take for a formula get an apostrophe before them. ``state`` is new, unchanged, updated or
absent, empty where no baseline was matched; ``open`` is yes for what the text format shows. Trouble with tools is no row.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Callable

from haros_ci.report.escape import terminal, web_address
from haros_ci.report.message import number, plain
from haros_ci.results.result import Report, Result, is_open
from haros_ci.results.rule import Rule
from haros_ci.results.stable_id import stable_ids

#: In this order; new ones are added at the end. The first is ours, so that no row begins with a foreign word.
COLUMNS = (
    "level", "open", "state", "suppressed", "tool", "rule", "catalogue", "path", "line", "column", "end_line",
    "end_column", "package", "scope", "message", "value", "limit", "subject", "also", "fingerprint", "reason", "help",
)  # fmt: skip
#: What begins a formula, in full width too (OWASP, CSV injection); tabs and line ends are gone before.
_FORMULA = tuple("=+-@＝＋－＠")


def render(report: Report, *, package: Callable[[str], str] = lambda path: "") -> str:
    """The table with its header. *package* gives the package of a path, "" for none."""
    rules = {(run.tool.name, rule.id): rule for run in report.runs for rule in run.rules}
    table = io.StringIO()
    rows = csv.writer(table, lineterminator="\n")
    rows.writerow(COLUMNS)
    for id, result in stable_ids(report.results):
        rows.writerow(_row(result, id, rules.get((result.tool, result.rule)), package(result.location.path)))
    return table.getvalue()


def cell(text: str) -> str:
    """*text* as one line that no spreadsheet computes."""
    line = terminal(text)
    return f"'{line}" if line.startswith(_FORMULA) else line


def _row(result: Result, id: str, rule: Rule | None, package: str) -> tuple[str | int | float | None, ...]:
    place = result.location
    why = result.reason or next((s.justification for s in result.suppressions if s.justification), "")
    return (
        result.level.value,
        "yes" if is_open(result) else "no",
        result.state.value if result.state else None,
        " ".join(sorted({cell(s.kind) for s in result.suppressions})),
        cell(result.tool),
        cell(result.rule),
        cell(rule.catalogue) if rule else None,
        cell(place.path),
        place.line,
        place.column,
        place.end_line,
        place.end_column,
        cell(package),
        cell(result.scope or (result.identity.scope if result.identity else "")),
        cell(plain(result)),
        number(result.value),
        number(result.limit),
        cell(" ".join(result.subject)),
        cell(" ".join(result.also)),
        id,
        cell(why),
        web_address(rule.help_uri) if rule else None,
    )
