# SPDX-License-Identifier: Apache-2.0
"""The table as CSV: a row for each result, one line each, and no formula."""

from __future__ import annotations

import csv
import io
from dataclasses import replace

import pytest
from format_texts import LONG, TEXTS, report_saying
from hypothesis import given
from report_samples import (
    ARCHITECTURE,
    COMPARED,
    CPP,
    CPPCHECK_RUN,
    EMPTY,
    NULL_RESULT,
    PLAIN,
    PY,
    SCOPE_RESULT,
    SHAPES,
    SUPPRESSED,
)

from haros_ci.report.csv_table import COLUMNS, cell, render
from haros_ci.report.escape import terminal
from haros_ci.report.message import plain
from haros_ci.results.result import Report, is_open


def rows(text: str) -> list[dict[str, str]]:
    return list(csv.DictReader(io.StringIO(text, newline=""), strict=True))


def test_a_row_for_each_result() -> None:
    found = rows(render(PLAIN, package=lambda path: path.split("/")[0]))
    assert [row["rule"] for row in found] == [r.rule for r in PLAIN.results]
    [null] = [row for row in found if row["rule"] == "nullPointer"]
    id = null.pop("fingerprint")
    assert len(id) == 16
    assert null == {
        "level": "error", "open": "yes", "state": "", "suppressed": "", "tool": "cppcheck", "rule": "nullPointer",
        "catalogue": "", "path": CPP, "line": "7", "column": "4", "end_line": "7", "end_column": "5", "package": "base",
        "scope": "Odometry::update", "message": "Null pointer dereference: p.", "value": "", "limit": "", "subject": "",
        "also": "", "reason": "", "help": "https://cppcheck.sourceforge.io/",
    }  # fmt: skip
    [python] = [row for row in found if row["rule"] == "undefined-variable"]
    assert python["also"] == "ruff:F821"


def test_states_and_suppressions() -> None:
    found = rows(render(COMPARED))
    assert [(r["state"], r["open"]) for r in found if r["path"] == CPP] == [
        ("absent", "no"), ("updated", "no"), ("unchanged", "no"), ("new", "yes"),
    ]  # fmt: skip
    [updated] = [r for r in found if r["state"] == "updated"]
    assert (updated["value"], updated["limit"]) == ("12", "10")
    assert [(r["suppressed"], r["open"], r["reason"]) for r in rows(render(SUPPRESSED))] == [
        ("inSource", "no", "Read by the debugger"), ("external", "no", ""), ("", "yes", ""),
    ]  # fmt: skip


def test_architecture() -> None:
    [found] = [r for r in rows(render(ARCHITECTURE)) if r["tool"] == "haros-ci"]
    assert (found["catalogue"], found["subject"], found["path"]) == ("G06", "/base /odom /teleop", PY)


def test_nothing_found_is_the_header() -> None:
    assert render(EMPTY) == ",".join(COLUMNS) + "\n"


@pytest.mark.parametrize("text", ["=1+1", "+1", "-1", "@SUM(A1)", "＝1", "=cmd|' /C calc'!A0", "-"])
def test_formulas_are_text(text: str) -> None:
    assert cell(text) == f"'{text}"


@pytest.mark.parametrize("text", ["", "a=1", "a-b", "'x'", "1", " =1", "größe", "src/a.cpp", "::error::x", '"'])
def test_other_texts_stay(text: str) -> None:
    assert cell(text) == text


@pytest.mark.parametrize("report", [*SHAPES.values(), ARCHITECTURE])
def test_every_report(report: Report) -> None:
    found = rows(render(report))
    assert [row["open"] == "yes" for row in found] == [is_open(result) for result in report.results]
    assert len({row["fingerprint"] for row in found}) == len(found)
    turned = replace(report, runs=tuple(replace(r, results=r.results[::-1]) for r in report.runs))
    assert render(turned) == render(report)


@given(TEXTS, TEXTS)
def test_hostile_texts(text: str, package: str) -> None:
    report = report_saying(text)
    written = render(report, package=lambda path: package)
    assert written.count("\n") == 4 and "\r" not in written, "one line a row for readers that know no quotes"
    assert all(line.startswith("error,") for line in written.split("\n")[1:-1])
    for row, result in zip(rows(written), report.results, strict=True):
        assert row["message"] == cell(plain(result)) and row["package"] == cell(package)
        assert row["path"] == terminal(f"src/{text}")
        assert not any(value.startswith(("=", "+", "-", "@")) for value in row.values())


def test_a_message_of_a_megabyte_is_cut() -> None:
    report = replace(PLAIN, runs=(replace(CPPCHECK_RUN, results=(replace(NULL_RESULT, message=LONG), SCOPE_RESULT)),))
    assert len(render(report)) < 20_000
