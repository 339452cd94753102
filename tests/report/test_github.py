# SPDX-License-Identifier: Apache-2.0
"""Annotations and job summaries: ranked, capped, escaped."""

from __future__ import annotations

import re
from dataclasses import replace

import pytest
from report_samples import (
    COMPARED,
    CPP,
    CPPCHECK_RUN,
    EMPTY,
    FAILED,
    HOSTILE,
    NULL_RESULT,
    PLAIN,
    SCOPE_RESULT,
    SHAPES,
    SUPPRESSED,
    hostile,
)

from haros_ci.model.location import Location
from haros_ci.report import github
from haros_ci.report.markdown import MAX_ROWS
from haros_ci.results.result import BaselineState, Notification, Related, Report, Result
from haros_ci.results.rule import Level

COMMAND = re.compile(r"::(error|warning|notice) [A-Za-z]+=[^:,]*(,[A-Za-z]+=[^:,]*)*::.+")


def of(*results: Result) -> Report:
    return replace(PLAIN, runs=(replace(CPPCHECK_RUN, results=results),))


def lines(count: int, level: Level, first: int = 1) -> list[Result]:
    return [replace(SCOPE_RESULT, level=level, location=Location(CPP, n)) for n in range(first, first + count)]


def test_annotations() -> None:
    undefined = "file=base/scripts/teleop.py,line=7,endLine=7,col=23,endColumn=32,title=pylint%3Aundefined-variable"
    null = f"file={CPP},line=7,endLine=7,col=4,endColumn=5,title=cppcheck%3AnullPointer"
    docstring = "file=base/scripts/teleop.py,title=pylint%3Amissing-module-docstring"
    scope = f"file={CPP},line=5,endLine=5,col=9,title=cppcheck%3AvariableScope"
    assert github.annotations(PLAIN).splitlines() == [
        f"::error {undefined}::Undefined variable 'undefined'.",
        f"::error {null}::Null pointer dereference: p.%0A{CPP}:6:12: Assignment 'p=0', assigned value is 0",
        f"::notice {docstring}::Missing module docstring.",
        f"::notice {scope}::The scope of the variable 'x' can be reduced.",
    ]


def test_other_ends_stand_below_the_message() -> None:
    near = tuple(Related(Location(CPP, n), f"end {n}") for n in range(1, 9))
    [said] = github.annotations(of(replace(NULL_RESULT, related=near))).splitlines()
    assert said.partition("::Null")[2] == (
        " pointer dereference: p." + "".join(f"%0A{CPP}:{n}: end {n}" for n in range(1, 6)) + "%0Aand 3 more places"
    )
    [said] = github.annotations(
        of(replace(NULL_RESULT, related=(Related(Location("::error::x", 1), "a%\nb"),)))
    ).splitlines()
    assert said.endswith("p.%0A::error::x:1: a%25 b")


def test_one_annotation_for_a_line() -> None:
    other = replace(SCOPE_RESULT, location=Location(CPP, 7, 8))
    assert github.annotations(of(NULL_RESULT, other)) == (
        f"::error file={CPP},line=7,endLine=7,col=4,endColumn=5,title=2 findings::Null pointer dereference: p. "
        "[cppcheck:nullPointer]%0AThe scope of the variable 'x' can be reduced. [cppcheck:variableScope]\n"
    )


def test_only_open_findings_are_annotated() -> None:
    assert "variableScope" not in github.annotations(COMPARED)
    assert "variableScope" not in github.annotations(SUPPRESSED)
    assert github.annotations(EMPTY) == ""
    known = replace(NULL_RESULT, state=BaselineState.UNCHANGED)
    assert github.annotations(of(known)) == ""


def test_failed_tools_and_missing_baselines_come_first() -> None:
    said = github.annotations(FAILED).splitlines()
    assert said[0] == "::error title=haros-ci::No baseline: the clone is shallow. Every finding counts as new."
    assert said[1].startswith("::error title=haros-ci::clang-tidy failed: ")
    assert said[2].startswith("::error title=haros-ci::cppcheck failed: timed out after 600 s.")


def test_caps() -> None:
    report = of(*lines(14, Level.ERROR), *lines(9, Level.WARNING, 100), *lines(30, Level.NOTE, 200))
    said = github.annotations(report).splitlines()
    counts = [sum(line.startswith(f"::{kind} ") for line in said) for kind in ("error", "warning", "notice")]
    assert counts == [10, 9, 10]
    assert said[-1] == (
        "::notice title=haros-ci::25 more findings not annotated here; the job summary and the SARIF log have them."
    )


def test_merged_findings_are_counted_one_by_one() -> None:
    twice = [result for n in range(1, 12) for result in lines(1, Level.ERROR, n) * 2]
    assert "::2 more findings not annotated" in github.annotations(of(*twice))


def test_within_the_caps_nothing_is_counted() -> None:
    assert "not annotated" not in github.annotations(of(*lines(10, Level.ERROR), *lines(9, Level.NOTE, 100)))


@pytest.mark.parametrize("text", HOSTILE)
def test_hostile_annotations(text: str) -> None:
    for line in github.annotations(hostile(text)).split("\n")[:-1]:
        assert COMMAND.fullmatch(line), line
        assert line.isprintable()


def test_summary() -> None:
    said = github.summary(FAILED)
    assert said.startswith("## haros-ci: 4 findings: 2 errors, 2 notes; 2 tools failed; no baseline\n")
    assert said.count("> [!CAUTION]") == 3 and "No baseline" in said and "clang-tidy failed" in said
    rows = [line for line in said.splitlines() if line.startswith("| ")][1:]
    assert [row.split(" | ")[0] for row in rows] == ["| error", "| error", "| note", "| note"]
    assert "- Not seen: base/gen is generated when building.\n" in said
    assert "timed out after 600 s" in said and "Latin-1" in said


@pytest.mark.parametrize("report", [EMPTY, PLAIN, COMPARED], ids=["empty", "plain", "compared"])
def test_summary_without_trouble(report: Report) -> None:
    said = github.summary(report)
    assert not any(word in said for word in ("CAUTION", "No baseline", "failed", "<details>", "not in this table"))


def test_summary_shows_new_findings_and_counts_known_ones() -> None:
    said = github.summary(COMPARED)
    assert "3 new findings" in said and "Also known: 1 unchanged, 1 updated; gone: 1." in said
    assert "variableScope" not in said


def test_summary_is_cut_to_rows() -> None:
    said = github.summary(of(*lines(MAX_ROWS + 7, Level.WARNING)))
    assert said.count("| warning |") == MAX_ROWS
    assert "\n7 more findings not in this table" in said


@pytest.mark.parametrize("limit", [3_000, 10_000, 30_000])
def test_summary_is_cut_to_bytes(limit: int) -> None:
    said = github.summary(of(*(replace(r, message="größe " * 50) for r in lines(200, Level.WARNING))), limit=limit)
    assert limit * 0.6 < len(said.encode()) <= limit
    rows = said.count("| warning |")
    assert f"\n{200 - rows} more findings not in this table" in said


def test_the_largest_summary_is_accepted() -> None:
    worst = "\\" * 10_000
    notes = tuple(Notification(Level.WARNING, worst, worst, f"{n}{worst}") for n in range(1000))
    results = (replace(r, message=worst, rule=worst, also=(worst,) * 9) for r in lines(2000, Level.WARNING))
    assert len(github.summary(replace(of(*results), notifications=notes)).encode()) <= 1024 * 1024


@pytest.mark.parametrize("text", HOSTILE)
def test_hostile_summaries(text: str) -> None:
    said = github.summary(hostile(text))
    tags = set(re.findall(r"<[^>]*>?", said))
    assert tags <= {"<code>", "</code>", "<details>", "</details>", "<summary>", "</summary>"}
    assert not re.search(r"@[A-Za-z]|&#64;[A-Za-z](?![^<]*</code>)|\]\(|!\[i|`|https?://", said)
    rows = [line for line in said.splitlines() if line.startswith("|")]
    assert [row.count("|") for row in rows] == [5] * len(rows)


@pytest.mark.parametrize("report", SHAPES.values(), ids=SHAPES)
def test_order_of_input_does_not_matter(report: Report) -> None:
    turned = replace(report, runs=tuple(replace(r, results=r.results[::-1]) for r in report.runs[::-1]))
    assert github.annotations(turned) == github.annotations(report)
    assert github.summary(turned) == github.summary(report)
