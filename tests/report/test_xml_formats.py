# SPDX-License-Identifier: Apache-2.0
"""JUnit and Checkstyle: well-formed whatever the texts are, and read back as what was found."""

from __future__ import annotations

import re
from dataclasses import replace
from xml.etree import ElementTree

import pytest
from format_texts import LONG, TEXTS, report_saying
from hypothesis import given
from report_samples import (
    ARCHITECTURE,
    COMPARED,
    CPP,
    CPPCHECK_RUN,
    EMPTY,
    FAILED,
    IMPORTED,
    NULL_RESULT,
    PLAIN,
    PY,
    SCOPE_RESULT,
    SHAPES,
    SUPPRESSED,
)

from haros_ci.model.location import Location
from haros_ci.report import checkstyle, junit
from haros_ci.report.escape import terminal
from haros_ci.report.message import plain
from haros_ci.report.xml_tags import escaped, lines
from haros_ci.results.result import Notification, Report, Result, Run, Tool
from haros_ci.results.rule import Level


def parsed(text: str) -> ElementTree.Element:
    return ElementTree.fromstring(text.encode("utf-8"))


def shown_as(text: str) -> str:
    """What a reader of XML must get for *text*: what a terminal shows, without the two that XML has no place for."""
    return terminal(text).replace("\ufffe", "�").replace("\uffff", "�")


def case(report: Report, name: str) -> ElementTree.Element:
    [found] = [c for c in parsed(junit.render(report)).iter("testcase") if c.get("name") == name]
    return found


def of(*results: Result) -> Report:
    return replace(PLAIN, runs=(replace(CPPCHECK_RUN, results=results),))


# -- XML itself


@given(TEXTS)
def test_xml_gives_back_what_a_terminal_shows(text: str) -> None:
    element = parsed(f'<a b="{escaped(text)}">{lines([text])}</a>')
    assert element.get("b") == shown_as(text)
    assert (element.text or "") == shown_as(text)


@pytest.mark.parametrize("text", ["::error::x", "  ::warning file=x::y"])
def test_no_line_is_a_command_to_a_runner(text: str) -> None:
    written = lines(["a", text])
    assert not re.search(r"^\s*::", written, re.MULTILINE)
    assert parsed(f"<a>{written}</a>").text == f"a\n{text}"


@pytest.mark.parametrize("text", ["a::b", ":a", "", "a:: b", "größe 漢字 👩‍🚀", "100 %"])
def test_other_lines_stay(text: str) -> None:
    assert lines([text]) == text


# -- JUnit


def test_a_suite_for_each_tool_and_a_case_for_each_file() -> None:
    clean = replace(CPPCHECK_RUN, analysed=frozenset({CPP, "base/src/clean.cpp"}))
    root = parsed(junit.render(replace(PLAIN, runs=(PLAIN.runs[1], clean))))
    suites = [(s.get("name"), s.get("tests"), s.get("failures"), s.get("errors")) for s in root]
    assert suites == [("cppcheck", "2", "1", "0"), ("pylint", "1", "1", "0")]
    assert (root.get("tests"), root.get("failures"), root.get("errors")) == ("3", "2", "0")
    cases = {c.get("name"): len(c) for c in root[0].iter("testcase")}
    assert cases == {"base/src/clean.cpp": 0, CPP: 1}
    assert {c.get("classname") for c in root[0].iter("testcase")} == {"haros-ci.cppcheck"}


def test_a_case_has_one_failure_with_a_line_for_each_finding() -> None:
    [failure] = case(PLAIN, CPP)
    assert failure.get("type") == "cppcheck:nullPointer"
    assert failure.get("message") == "line 7: Null pointer dereference: p. (and 1 more finding)"
    assert (failure.text or "").splitlines() == [
        f"{CPP}:5:9: note: The scope of the variable 'x' can be reduced. [cppcheck:variableScope]",
        f"{CPP}:7:4: error: Null pointer dereference: p. [cppcheck:nullPointer]",
        f"  {CPP}:6:12: note: Assignment 'p=0', assigned value is 0",
    ]
    assert case(PLAIN, PY)[0].get("message") == "line 7: Undefined variable 'undefined'. (and 1 more finding)"


def test_a_finding_on_a_whole_file_has_no_line() -> None:
    assert case(of(replace(SCOPE_RESULT, location=Location(CPP))), CPP)[0].get("message", "").startswith("The scope")


def test_known_gone_and_suppressed_findings_stand_beside_the_failure() -> None:
    failure, known = case(COMPARED, CPP)
    assert (failure.text or "").count(" error: ") == 1 and "variableScope" not in (failure.text or "")
    assert [line.split(": ")[0] for line in (known.text or "").splitlines()] == ["gone", "updated", "unchanged"]
    _, known = case(SUPPRESSED, CPP)
    assert [line.split(": ")[0] for line in (known.text or "").splitlines()] == ["suppressed", "suppressed"]


def test_a_file_with_known_findings_alone_passes() -> None:
    [known] = case(of(COMPARED.runs[0].results[1]), CPP)
    assert known.tag == "system-out"


def test_a_tool_that_failed_is_an_error() -> None:
    root = parsed(junit.render(FAILED))
    errors = {s.get("name"): [e.get("message") for e in s.iter("error")] for s in root}
    failed = "failed: timed out after 600 s. Its findings are missing or incomplete."
    assert errors["cppcheck"] == [f"cppcheck {failed}"]
    assert errors["clang-tidy"] == ["clang-tidy failed: It did not finish. Its findings are missing or incomplete."]
    assert errors["pylint"] == [] and root.get("errors") == "2"
    said = {s.get("name"): s.findtext("system-err") or "" for s in root}
    assert f"warning: {PY}:3: syntax error." in said["pylint"]
    assert "error: No baseline: the clone is shallow." in said["haros-ci (inputs)"]
    assert "Latin-1" in said["haros-ci (inputs)"]


def test_a_file_that_a_tool_gave_up_on_is_skipped() -> None:
    note = Notification(Level.WARNING, "too large", "cppcheck", "base/src/big.cpp")
    report = replace(PLAIN, runs=(replace(CPPCHECK_RUN, notifications=(note,)),))
    [skipped] = case(report, "base/src/big.cpp")
    assert (skipped.tag, skipped.get("message")) == ("skipped", "warning: base/src/big.cpp: too large.")
    assert parsed(junit.render(report))[0].get("skipped") == "1"


@pytest.mark.parametrize(
    "note",
    [
        Notification(Level.WARNING, "half read", "cppcheck", CPP, 3),
        Notification(Level.NOTE, "'x' has no effect", "cppcheck", ".haros-ci.yaml", 3, configuration=True),
        Notification(Level.NOTE, "no compile database", "cppcheck"),
    ],
    ids=["of a file with findings", "of the configuration", "of no file"],
)
def test_other_messages_skip_nothing(note: Notification) -> None:
    root = parsed(junit.render(replace(PLAIN, runs=(replace(CPPCHECK_RUN, notifications=(note,)),))))
    assert [root[0].get(name) for name in ("tests", "failures", "errors", "skipped")] == ["1", "1", "0", "0"]
    assert "system-err" in {child.tag for child in root[0]}


def test_many_messages_are_counted() -> None:
    notes = tuple(Notification(Level.NOTE, f"m{n}", "cppcheck") for n in range(junit.MAX_NOTES + 5))
    said = parsed(junit.render(Report((Run(Tool("cppcheck"), notifications=notes),))))[0].findtext("system-err") or ""
    assert said.endswith("\nand 5 more messages") and said.count("\n") == junit.MAX_NOTES


def test_nothing_is_a_document_too() -> None:
    assert parsed(junit.render(EMPTY)).attrib == {
        "name": "haros-ci", "tests": "0", "failures": "0", "errors": "0", "time": "0",
    }  # fmt: skip
    assert not list(parsed(checkstyle.render(EMPTY)))


def test_imported_runs_have_suites_of_their_own() -> None:
    names = [s.get("name") for s in parsed(junit.render(IMPORTED))]
    assert names == ["cppcheck", "A Tool With Many Words (imported)", "cppcheck (imported)"]


@given(TEXTS, TEXTS)
def test_junit_of_hostile_texts(text: str, other: str) -> None:
    report = report_saying(text, other)
    root = parsed(junit.render(report))
    cases = list(root.iter("testcase"))
    assert len(cases) == int(root.get("tests", "")) and len(list(root.iter("error"))) == 1
    [failure] = root.iter("failure")
    assert failure.get("message") == shown_as(f"line 3: {plain(report.runs[0].results[0])}")
    assert (failure.text or "").count("\n") == 1
    assert {c.get("name") for c in cases} == {shown_as(f"src/{text}"), shown_as(text), "the tool itself"}


# -- Checkstyle


def test_checkstyle() -> None:
    root = parsed(checkstyle.render(PLAIN))
    assert (root.tag, [f.get("name") for f in root]) == ("checkstyle", [PY, CPP])
    assert [e.attrib for e in root[1]] == [
        {
            "line": "5", "column": "9", "severity": "info", "source": "haros-ci.cppcheck.variableScope",
            "message": "The scope of the variable 'x' can be reduced.",
        },
        {
            "line": "7", "column": "4", "severity": "error", "source": "haros-ci.cppcheck.nullPointer",
            "message": "Null pointer dereference: p.",
        },
    ]  # fmt: skip
    assert root[0][0].get("line") == "1" and root[0][0].get("column") is None, "a finding on the whole file"


@pytest.mark.parametrize("report", SHAPES.values(), ids=SHAPES)
def test_checkstyle_has_the_open_findings_and_no_others(report: Report) -> None:
    errors = list(parsed(checkstyle.render(report)).iter("error"))
    assert [e.get("message") for e in errors] == [shown_as(plain(r)) for r in report.shown()]


@given(TEXTS)
def test_checkstyle_of_hostile_texts(text: str) -> None:
    [file] = parsed(checkstyle.render(report_saying(text)))
    [error] = file
    assert file.get("name") == shown_as(f"src/{text}")
    assert error.get("source") == shown_as(f"haros-ci.{text}.{text}")


@pytest.mark.parametrize("render", [junit.render, checkstyle.render])
def test_a_message_of_a_megabyte_is_cut(render: object) -> None:
    text = render(of(replace(NULL_RESULT, message=LONG)))  # type: ignore[operator]
    assert parsed(text) is not None and len(text) < 20_000


@pytest.mark.parametrize("render", [junit.render, checkstyle.render])
@pytest.mark.parametrize("report", [*SHAPES.values(), ARCHITECTURE])
def test_the_order_of_runs_and_results_does_not_matter(render: object, report: Report) -> None:
    turned = replace(report, runs=tuple(replace(r, results=r.results[::-1]) for r in report.runs[::-1]))
    if len({(r.imported, r.tool.name) for r in report.runs}) == len(report.runs):
        assert render(turned) == render(report)  # type: ignore[operator]
