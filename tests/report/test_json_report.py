# SPDX-License-Identifier: Apache-2.0
"""The JSON document: its documented keys, its counts, its order."""

from __future__ import annotations

import json
import re
from dataclasses import replace

import pytest
from report_samples import ARCHITECTURE, COMPARED, CPP, EMPTY, FAILED, HOSTILE, PLAIN, SHAPES, hostile

from haros_ci.report import json_report
from haros_ci.results.result import Report, is_open


@pytest.mark.parametrize("report", SHAPES.values(), ids=SHAPES)
def test_keys_are_those_documented(report: Report) -> None:
    written = json.loads(json_report.render(report))
    documented = set(re.findall(r"[A-Za-z]+", json_report.__doc__ or ""))
    assert written["schemaVersion"] == 1
    for part in (
        written,
        written["counts"],
        written["coverage"],
        *written["runs"],
        *written["results"],
        *written["notifications"],
    ):
        assert set(part) <= documented
    assert len(written["results"]) == len(report.results)


def test_a_result() -> None:
    result = json.loads(json_report.render(COMPARED))["results"][-1]
    assert result["rule"] == "nullPointer" and result["open"] is True and result["state"] == "new"
    assert (result["path"], result["line"], result["column"], result["endLine"], result["endColumn"]) == (
        CPP,
        7,
        4,
        7,
        5,
    )
    assert result["message"] == "Null pointer dereference: p." and result["scope"] == "Odometry::update"
    assert result["related"] == [
        {"path": CPP, "line": 6, "column": 12, "message": "Assignment 'p=0', assigned value is 0"}
    ]


def test_a_finding_of_the_architecture() -> None:
    [result] = [r for r in json.loads(json_report.render(ARCHITECTURE))["results"] if r["tool"] == "haros-ci"]
    assert result["subject"] == ["/base", "/odom", "/teleop"]
    assert result["roles"] == ["publishers base/base", "subscribers base/teleop"]
    assert result["flow"][1] == {
        "path": "base/launch/base.launch",
        "line": 4,
        "column": None,
        "message": "remaps odom to /odom",
    }
    assert (result["graph"], result["edges"]) == (
        "base/launch/base.launch",
        [["node:/base", "topic:/odom"], ["topic:/odom", "node:/teleop"]],
    )
    plain = json.loads(json_report.render(PLAIN))["results"][0]
    assert (plain["roles"], plain["flow"], plain["graph"], plain["edges"]) == ([], [], None, [])


def test_counts_add_up() -> None:
    counts = json.loads(json_report.render(COMPARED))["counts"]
    assert counts == {
        "open": 3,
        "errors": 2,
        "warnings": 0,
        "notes": 1,
        "failing": 2,
        "unchanged": 1,
        "updated": 1,
        "absent": 1,
        "suppressed": 0,
        "counted": 0,
        "copies": 0,
    }
    for report in SHAPES.values():
        counts = json.loads(json_report.render(report))["counts"]
        kinds = ("open", "unchanged", "updated", "absent", "suppressed", "counted")
        assert sum(counts[kind] for kind in kinds) == len(report.results)


def test_copies_are_counted_apart() -> None:
    """As many as text leaves out of its headline."""
    first = COMPARED.results[0]
    copied = {id(result): first.location for result in COMPARED.results if result is not first}
    counts = json.loads(json_report.render(COMPARED, copied))["counts"]
    assert counts["copies"] == sum(is_open(result) for result in COMPARED.results if result is not first) > 0


def test_failures_and_missing_baselines() -> None:
    written = json.loads(json_report.render(FAILED))
    assert {run["tool"]: run["successful"] for run in written["runs"]} == {
        "cppcheck": False,
        "clang-tidy": False,
        "pylint": True,
    }
    assert written["baseline"]["available"] is False and len(written["notifications"]) == 4


def test_nothing() -> None:
    written = json.loads(json_report.render(EMPTY))
    assert written["results"] == [] and written["baseline"] is None and written["provenance"] is None


def test_one_result_is_one_line() -> None:
    assert sum(line.startswith('{"tool"') for line in json_report.render(PLAIN).splitlines()) == 4


@pytest.mark.parametrize("text", HOSTILE)
def test_hostile_texts_are_ascii(text: str) -> None:
    written = json_report.render(hostile(text))
    assert written.isascii() and len(json.loads(written)["results"]) == 2


@pytest.mark.parametrize("report", SHAPES.values(), ids=SHAPES)
def test_order_of_input_does_not_matter(report: Report) -> None:
    turned = replace(report, runs=tuple(replace(r, results=r.results[::-1]) for r in report.runs[::-1]))
    assert json_report.render(turned) == json_report.render(report)
