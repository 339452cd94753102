# SPDX-License-Identifier: Apache-2.0
"""GitLab's Code Quality report and Reviewdog's rdjson: their schemas, exact columns in bytes, ids that last."""

from __future__ import annotations

import json
from dataclasses import replace
from typing import Any

import pytest
from format_texts import LONG, TEXTS, report_saying
from hypothesis import given
from hypothesis import strategies as st
from report_samples import (
    ARCHITECTURE,
    COMPARED,
    CPP,
    CPPCHECK_RUN,
    EMPTY,
    FAILED,
    NULL_RESULT,
    PLAIN,
    PY,
    SCOPE_RESULT,
    SHAPES,
    SOURCES,
    UNDEFINED_RESULT,
)

from haros_ci.model.location import Location
from haros_ci.report import gitlab, rdjson
from haros_ci.report.escape import terminal
from haros_ci.report.message import plain
from haros_ci.results.fix import Edit, Fix, applied
from haros_ci.results.result import Report, Result
from haros_ci.results.rule import Rule


def of(*results: Result) -> Report:
    return replace(PLAIN, runs=(replace(CPPCHECK_RUN, results=results),))


def entries(report: Report) -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = json.loads(gitlab.render(report))
    return found


def source(path: str) -> str:
    return SOURCES.get(path, "")


def diagnostics(report: Report, read: Any = source) -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = json.loads(rdjson.render(report, source=read))["diagnostics"]
    return found


def is_unicode(value: str) -> bool:
    return not any("\ud800" <= character <= "\udfff" for character in value)


# -- GitLab


def test_code_quality() -> None:
    first, *_ = (e for e in entries(PLAIN) if e["check_name"] == "cppcheck:nullPointer")
    id = first.pop("fingerprint")
    assert len(id) == 16 and int(id, 16) >= 0
    assert first == {
        "type": "issue",
        "check_name": "cppcheck:nullPointer",
        "description": "cppcheck:nullPointer: Null pointer dereference: p.",
        "categories": ["Security"],
        "severity": "critical",
        "location": {"path": CPP, "lines": {"begin": 7, "end": 7}},
    }
    assert {e["severity"] for e in entries(PLAIN)} == {"critical", "info"}


@pytest.mark.parametrize("report", [*SHAPES.values(), ARCHITECTURE])
def test_entries_are_the_open_findings_each_with_an_id_of_its_own(report: Report) -> None:
    found = entries(report)
    assert [e["description"] for e in found] == [f"{terminal(r.full_id)}: {plain(r)}" for r in report.shown()]
    assert len({e["fingerprint"] for e in found}) == len(found)
    for entry in found:  # what GitLab's schema asks for, and stops reading without
        assert {type(entry[key]) for key in ("description", "fingerprint", "severity", "check_name")} == {str}
        assert entry["severity"] in ("info", "minor", "major", "critical", "blocker")
        assert entry["location"]["lines"]["begin"] >= 1 and entry["location"]["path"]


def test_nothing_found_is_an_empty_array() -> None:
    assert gitlab.render(EMPTY) == "[]\n"
    assert gitlab.render(replace(FAILED, runs=FAILED.runs[1:2])) == "[]\n", "a tool that failed is no finding"


def test_a_finding_on_a_whole_file_is_on_its_first_line() -> None:
    [whole] = entries(of(replace(SCOPE_RESULT, location=Location(CPP))))
    assert whole["location"]["lines"] == {"begin": 1, "end": 1}


@pytest.mark.parametrize(
    ("tags", "category"),
    [(("style",), "Style"), (("metrics", "x"), "Complexity"), ((), "Bug Risk"), (("security", "style"), "Security")],
)
def test_categories(tags: tuple[str, ...], category: str) -> None:
    rule = Rule("variableScope", "x", tags=tags)
    report = replace(PLAIN, runs=(replace(CPPCHECK_RUN, rules=(rule,), results=(SCOPE_RESULT,)),))
    assert entries(report)[0]["categories"] == [category]


@given(TEXTS)
def test_code_quality_of_hostile_texts(text: str) -> None:
    written = gitlab.render(report_saying(text))
    assert written.isascii() and not written.startswith("\ufeff")
    [entry] = json.loads(written)
    assert entry["location"]["path"] == terminal(f"src/{text}")
    assert entry["check_name"] == terminal(f"{text}:{text}") and is_unicode(entry["description"])


# -- rdjson


def test_rdjson() -> None:
    document = json.loads(rdjson.render(PLAIN, source=source))
    assert document["source"]["name"] == "haros-ci" and document["source"]["url"].startswith("https://")
    [found] = [d for d in document["diagnostics"] if d["code"]["value"] == "cppcheck:nullPointer"]
    assert found == {
        "message": "Null pointer dereference: p.",
        "location": {
            "path": CPP,
            "range": {"start": {"line": 7, "column": 4}, "end": {"line": 7, "column": 5}},
        },
        "severity": "ERROR",
        "source": {"name": "cppcheck", "url": "https://cppcheck.sourceforge.io/"},
        "code": {"value": "cppcheck:nullPointer", "url": "https://cppcheck.sourceforge.io/"},
        "related_locations": [
            {
                "message": "Assignment 'p=0', assigned value is 0",
                "location": {"path": CPP, "range": {"start": {"line": 6, "column": 12}}},
            }
        ],
    }


def test_columns_are_bytes() -> None:
    [found] = diagnostics(replace(PLAIN, runs=(replace(PLAIN.runs[1], results=(UNDEFINED_RESULT,)),)))
    line = SOURCES[PY].split("\n")[6].encode()
    span = found["location"]["range"]
    assert line[span["start"]["column"] - 1 : span["end"]["column"] - 1] == b"undefined"
    assert span["start"]["column"] == 23 + 2 + 4, "ö and ß take two bytes, the others three"


@given(st.text(st.characters(exclude_categories=["Cs"]), max_size=20), st.data())
def test_any_column_in_bytes(line: str, data: Any) -> None:
    column = data.draw(st.integers(1, len(line) + 1))
    at = rdjson.byte_column(line, column)
    assert at is not None
    assert line.encode()[: at - 1].decode() == line[: column - 1]


@pytest.mark.parametrize(
    ("place", "span"),
    [
        (Location(CPP), None),
        (Location(CPP, 5), {"start": {"line": 5}}),
        (Location(CPP, 5, 2), {"start": {"line": 5, "column": 2}}),
        (Location(CPP, 5, None, 6, None), {"start": {"line": 5}, "end": {"line": 6}}),
        (Location(CPP, 5, 2, 6, 3), {"start": {"line": 5, "column": 2}, "end": {"line": 6, "column": 3}}),
        (Location(CPP, 5, 2, None, 8), {"start": {"line": 5, "column": 2}, "end": {"line": 5, "column": 8}}),
        (Location(CPP, 5, 8, 5, 2), {"start": {"line": 5, "column": 8}}),
        (Location(CPP, 5, 999, 5, 1000), {"start": {"line": 5, "column": 17}, "end": {"line": 5, "column": 17}}),
        (Location(CPP, 999, 4, 999, 6), {"start": {"line": 999}}),
        (Location("gone.cpp", 5, 2), {"start": {"line": 5}}),
        (Location("gone.cpp", 5, 1), {"start": {"line": 5, "column": 1}}),
        (Location(CPP, 2**31, 1), None),
    ],
)
def test_ranges(place: Location, span: dict[str, Any] | None) -> None:
    [found] = diagnostics(of(replace(SCOPE_RESULT, location=place)))
    assert found["location"].get("range") == span


def test_the_snippet_stands_for_a_line_that_is_not_at_hand() -> None:
    [found] = diagnostics(of(NULL_RESULT), lambda path: "")
    assert found["location"]["range"]["start"] == {"line": 7, "column": 4}


def offset(text: str, position: dict[str, int]) -> int:
    lines = text.encode().split(b"\n")
    return sum(len(line) + 1 for line in lines[: position["line"] - 1]) + position["column"] - 1


def suggested(text: str, suggestion: dict[str, Any]) -> str:
    """*text* with a suggestion made, as a reader of the format does: in bytes."""
    start, end = (offset(text, suggestion["range"][key]) for key in ("start", "end"))
    data = text.encode()
    return (data[:start] + suggestion["text"].encode() + data[end:]).decode()


TEXT = "größe = 1\nß漢 = x\r\nlast"


def fixed(*edits: Edit) -> Report:
    return of(replace(SCOPE_RESULT, location=Location("a.py", 1, 1), fixes=(Fix("mend it", edits),)))


@pytest.mark.parametrize(
    "edits",
    [
        (Edit("a.py", (1, 4), (1, 6), "ß漢"),),
        (Edit("a.py", (2, 3), (2, 3), "\n\t!"),),
        (Edit("a.py", (1, 1), (2, 1), ""),),
        (Edit("a.py", (3, 5), (3, 5), "\n"),),
        (Edit("a.py", (2, 6), (2, 7), "y"), Edit("a.py", (1, 9), (1, 10), "2")),
        (Edit("a.py", (1, 1), (1, 1), "a"), Edit("a.py", (3, 1), (3, 5), "")),
    ],
)
def test_suggestions_do_what_the_fix_does(edits: tuple[Edit, ...]) -> None:
    [found] = diagnostics(fixed(*edits), lambda path: TEXT)
    [suggestion] = found["suggestions"]
    assert suggested(TEXT, suggestion) == applied(TEXT, edits)


@pytest.mark.parametrize(
    "edits",
    [
        (),
        (Edit.executable("a.py"),),
        (Edit("b.py", (1, 1), (1, 2), "x"),),
        (Edit("a.py", (1, 1), (1, 2), "x"), Edit("b.py", (1, 1), (1, 2), "x")),
        (Edit("a.py", (9, 1), (9, 2), "x"),),
        (Edit("a.py", (1, 30), (1, 31), "x"),),
        (Edit("a.py", (1, 1), (1, 5), "x"), Edit("a.py", (1, 3), (1, 6), "y")),
        (Edit("a.py", (1, 1), (1, 2), "\ud800"),),
    ],
    ids=["none", "mode", "other file", "two files", "beyond", "past its line", "overlap", "no text"],
)
def test_what_is_no_suggestion(edits: tuple[Edit, ...]) -> None:
    [found] = diagnostics(fixed(*edits), lambda path: TEXT)
    assert "suggestions" not in found


def test_edits_far_apart_and_odd_line_ends_are_no_suggestion() -> None:
    far = (Edit("a.py", (1, 1), (1, 1), "x"), Edit("a.py", (40, 1), (40, 1), "y"))
    assert "suggestions" not in diagnostics(fixed(*far), lambda path: "a\n" * 60)[0]
    assert "suggestions" not in diagnostics(fixed(Edit("a.py", (1, 1), (1, 2), "x")), lambda path: "a\x0cb\n")[0]


@pytest.mark.parametrize("report", [*SHAPES.values(), ARCHITECTURE])
def test_diagnostics_are_the_open_findings(report: Report) -> None:
    found = diagnostics(report)
    assert [d["message"] for d in found] == [plain(r) for r in report.shown()]
    for diagnostic in found:
        assert diagnostic["severity"] in ("ERROR", "WARNING", "INFO")
        assert all(key in diagnostic for key in ("location", "source", "code"))
        assert diagnostic["code"].get("url", "https://").startswith(("https://", "http://"))


@given(TEXTS, TEXTS)
def test_rdjson_of_hostile_texts(text: str, code: str) -> None:
    written = rdjson.render(report_saying(text), source=lambda path: f"a\nb\n{code}\n")
    assert written.isascii()
    [found] = json.loads(written)["diagnostics"]
    assert found["location"]["path"] == terminal(f"src/{text}")
    assert found["code"]["value"] == terminal(f"{text}:{text}")
    assert is_unicode(json.dumps(found, ensure_ascii=False))


@pytest.mark.parametrize("render", [gitlab.render, rdjson.render])
def test_a_message_of_a_megabyte_is_cut(render: Any) -> None:
    assert 1_000 < len(render(of(replace(NULL_RESULT, message=LONG)))) < 20_000


@pytest.mark.parametrize("render", [gitlab.render, rdjson.render])
@pytest.mark.parametrize("report", [PLAIN, COMPARED, FAILED, ARCHITECTURE])
def test_the_order_of_runs_and_results_does_not_matter(render: Any, report: Report) -> None:
    turned = replace(report, runs=tuple(replace(r, results=r.results[::-1]) for r in report.runs[::-1]))
    assert render(turned) == render(report)
