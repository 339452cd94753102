# SPDX-License-Identifier: Apache-2.0
"""The text for people: what it shows, what it counts, and that no foreign text drives the terminal."""

from __future__ import annotations

import re
from dataclasses import replace

import pytest
from report_samples import (
    ARCHITECTURE,
    COMPARED,
    CPP,
    CPPCHECK_RUN,
    EMPTY,
    FAILED,
    HOSTILE,
    MISMATCH_RESULT,
    NULL_RESULT,
    PLAIN,
    SCOPE_RESULT,
    SHAPES,
    SOURCES,
    SUPPRESSED,
    hostile,
)

from haros_ci.model.location import Location
from haros_ci.report import markdown, text
from haros_ci.results.result import Baseline, Notification, Related, Report, Result
from haros_ci.results.rule import Level

EDITOR = re.compile(r"(?m)^(\S+?)(?::(\d+))?(?::(\d+))?: (error|warning|note): (.+) \[(\S+?)(?:, \S+)*\]$")


def shown(report: Report, *, why: bool = False, color: bool = False, width: int = 90) -> str:
    return text.render(report, color=color, width=width, why=why, source=lambda path: SOURCES.get(path, ""))


def test_the_whole() -> None:
    assert shown(PLAIN) == (
        "base/scripts/teleop.py: note: Missing module docstring. [pylint:missing-module-docstring]\n"
        "base/scripts/teleop.py:7:23: error: Undefined variable 'undefined'. [pylint:undefined-variable, ruff:F821]\n"
        "     7 |     print('größe 漢字', undefined)\n"
        "       |                         ^~~~~~~~~\n"
        "\n"
        "base/src/odometry.cpp:5:9: note: The scope of the variable 'x' can be reduced. [cppcheck:variableScope]\n"
        "     5 |     double x = 0.0;\n"
        "       |            ^\n"
        "base/src/odometry.cpp:7:4: error: Null pointer dereference: p. [cppcheck:nullPointer]\n"
        "     7 |   *p = 1;\n"
        "       |    ^\n"
        "      base/src/odometry.cpp:6:12: note: Assignment 'p=0', assigned value is 0\n"
        "\n"
        "4 findings: 2 errors, 2 notes\n"
        "  2 findings at or above 'warning' fail this run.\n"
        "  Looked at 1 package, 3 files, 1,500 lines with cppcheck 2.22, pylint 4.1.0.\n"
        "  Not seen: base/gen is generated when building.\n"
        "  What a rule means: haros-ci explain pylint:undefined-variable\n"
    )


def test_the_flow_of_a_finding() -> None:
    assert (
        "base/scripts/teleop.py:6:1: error: /teleop subscribes to /odom as Pose, but /base publishes Odometry."
        " [haros-ci:topic-type-mismatch]\n"
        "     6 | def main():\n"
        "       | ^\n"
        "      base/src/odometry.cpp:5:2: note: /base publishes Odometry\n"
        "      base/launch/base.launch:3: step 1: starts /base\n"
        "      base/launch/base.launch:4: step 2: remaps odom to /odom\n"
        "      base/scripts/teleop.py:6:1: step 3: subscribes to odom\n"
    ) in shown(ARCHITECTURE)
    assert "step" not in shown(PLAIN)


def test_a_long_flow_keeps_its_end() -> None:
    flow = tuple(Related(Location("all.launch", n), f"at {n}") for n in range(1, 41))
    said = shown(Report((replace(CPPCHECK_RUN, results=(replace(MISMATCH_RESULT, flow=flow),)),)))
    assert re.findall(r"step (\d+): at \1\n", said) == [*map(str, range(1, 12)), "40"]
    assert "at 11\n      and 28 more steps, then\n      all.launch:40: step 40: at 40\n" in said


def test_editors_find_each_finding() -> None:
    found = EDITOR.findall(shown(PLAIN))
    assert [(path, line, column, rule) for path, line, column, _, _, rule in found] == [
        ("base/scripts/teleop.py", "", "", "pylint:missing-module-docstring"),
        ("base/scripts/teleop.py", "7", "23", "pylint:undefined-variable"),
        (CPP, "5", "9", "cppcheck:variableScope"),
        (CPP, "7", "4", "cppcheck:nullPointer"),
    ]


def test_only_open_findings_are_shown_and_the_rest_is_counted() -> None:
    said = shown(COMPARED)
    assert len(EDITOR.findall(said)) == 3 and "variableScope" not in said
    assert COMPARED.baseline is not None
    assert (
        f"3 new findings: 2 errors, 1 note\n  Compared with {COMPARED.baseline.source}.\n  known: 1 unchanged, 1 updated; gone: 1\n"
        in said
    )
    assert "suppressed: 2\n" in shown(SUPPRESSED) and len(EDITOR.findall(shown(SUPPRESSED))) == 1


@pytest.mark.parametrize(
    ("copies", "expected"),
    [
        ((), ""),
        ((SCOPE_RESULT,), "1 finding: 1 error\n  It stands for 1 more of the same cause: SARIF and JSON list all 2.\n"),
        ((SCOPE_RESULT,) * 3, "1 finding: 1 error\n  It stands for 3 more of the same cause: SARIF and JSON list all 4.\n"),
    ],
)  # fmt: skip
def test_what_findings_stand_for_is_counted(copies: tuple[Result, ...], expected: str) -> None:
    report = replace(PLAIN, runs=(replace(CPPCHECK_RUN, results=(replace(NULL_RESULT, copies=copies),)),))
    assert expected in shown(report) and ("SARIF and JSON list all" in shown(report)) == bool(copies)
    assert ("SARIF and JSON list all" in markdown.render(report)) == bool(copies)


def test_several_findings_stand_for_others() -> None:
    one = replace(NULL_RESULT, copies=(SCOPE_RESULT,) * 1100)
    report = replace(PLAIN, runs=(replace(CPPCHECK_RUN, results=(one, SCOPE_RESULT)),))
    assert "  They stand for 1,100 more of the same causes: SARIF and JSON list all 1,102.\n" in shown(report)


def test_why() -> None:
    said = shown(COMPARED, why=True)
    assert "      why: no finding of this rule stood in this function\n" in said
    assert (
        f"{CPP}:5:9: unchanged: The scope of the variable 'x' can be reduced. [cppcheck:variableScope] same line"
        in said
    )
    assert f"{CPP}:3: absent: " in said and f"{CPP}:4: updated: " in said
    assert "suppressed: The scope of the variable 'x' can be reduced. [cppcheck:variableScope] Read by" in shown(
        SUPPRESSED, why=True
    )
    assert "why:" not in shown(COMPARED)


def test_trouble_is_loud_and_last() -> None:
    said = shown(FAILED)
    assert "4 findings: 2 errors, 2 notes; 2 tools failed; no baseline\n" in said
    assert said.endswith(
        "No baseline: the clone is shallow. Every finding counts as new.\n"
        "clang-tidy failed: it did not finish. Its findings are missing or incomplete.\n"
        "cppcheck failed: timed out after 600 s. Its findings are missing or incomplete.\n"
    )
    assert "error: cppcheck: timed out after 600 s\n" in said
    assert "warning: pylint: base/scripts/teleop.py:3: syntax error\n" in said
    assert "  Not analysed in full: pylint on 1 file.\n" in said
    missing = Notification(Level.ERROR, "mypy is not installed", "mypy")
    assert "error: mypy is not installed\n" in shown(replace(PLAIN, notifications=(missing,)))
    assert "note: .haros-ci.yaml:3: 'cpplint' has no effect.\n" in said


def test_nothing_found_but_a_tool_failed_is_not_green() -> None:
    run = replace(CPPCHECK_RUN, results=(), successful=False)
    said = shown(replace(PLAIN, runs=(run,)))
    assert "No findings; 1 tool failed\n" in said
    assert text.COLORS[Level.ERROR] + "No findings" in shown(replace(PLAIN, runs=(run,)), color=True)


@pytest.mark.parametrize("report", [EMPTY, PLAIN, COMPARED], ids=["empty", "plain", "compared"])
def test_no_trouble_is_said_where_there_is_none(report: Report) -> None:
    said = shown(report)
    assert not any(word in said for word in ("No baseline", "failed", "Not analysed", "baseline create"))


def test_much_trouble_is_counted() -> None:
    notes = tuple(Notification(Level.WARNING, "syntax error", "pylint", f"f{n}.py") for n in range(25))
    said = shown(replace(PLAIN, notifications=notes))
    assert said.count("syntax error") == text.MAX_TROUBLE and "and 15 more of pylint" in said
    assert "Not analysed in full: pylint on 25 files." in said


def test_many_findings_call_for_a_baseline() -> None:
    many = tuple(replace(SCOPE_RESULT, location=Location(CPP, n)) for n in range(1, 60))
    report = replace(PLAIN, runs=(replace(CPPCHECK_RUN, results=many),))
    assert "haros-ci baseline create" in shown(report)
    assert "haros-ci baseline create" not in shown(replace(report, baseline=Baseline("file", "x")))


def test_findings_of_one_line_share_its_frame() -> None:
    other = replace(SCOPE_RESULT, rule="other", location=Location(CPP, 7, 8))
    said = shown(replace(PLAIN, runs=(replace(CPPCHECK_RUN, results=(NULL_RESULT, other)),)))
    assert said.count("     7 |   *p = 1;\n       |    ^   ^\n") == 1


@pytest.mark.parametrize(
    ("line", "columns", "width", "code", "marks"),
    [
        ("int x;", [(5, 6)], 40, "int x;", "    ^"),
        ("int x;", [(5, 7)], 40, "int x;", "    ^~"),
        ("int x;", [], 40, "int x;", ""),
        ("\t\tx;", [(3, 4)], 40, "        x;", "        ^"),
        ("漢字 = x", [(6, 7)], 40, "漢字 = x", "       ^"),
        ("e\u0301 = x", [(6, 7)], 40, "e\u0301 = x", "    ^"),
        ("a\x1b[2Jb", [(6, 7)], 40, "a�[2Jb", "     ^"),
        ("int x", [(6, 7)], 40, "int x", "     ^"),
        ("", [(1, 2)], 40, "", "^"),
        ("0123456789" * 10, [(3, 4)], 20, "01234567890123456...", "  ^"),
        ("0123456789" * 10, [(51, 53)], 20, "...01234567890123...", "             ^~"),
        ("0123456789" * 10, [(101, 102)], 20, "...0123456789", "             ^"),
    ],
)
def test_frames(line: str, columns: list[tuple[int, int]], width: int, code: str, marks: str) -> None:
    assert text.frame(line, columns, width) == (code, marks)


@pytest.mark.parametrize("width", [20, 33, 80])
@pytest.mark.parametrize("column", [1, 2, 50, 499, 500])
@pytest.mark.parametrize("line", ["x" * 500, "\t" * 500, "漢" * 500, "a\t漢" * 167])
def test_frames_keep_their_width_and_their_mark(line: str, column: int, width: int) -> None:
    code, marks = text.frame(line, [(column, column + 1)], width)
    assert sum(2 if c == "漢" else 1 for c in code) <= width and len(marks) <= width and "^" in marks


def test_results_bring_their_own_line() -> None:
    said = text.render(PLAIN, color=False, width=90, why=False)
    assert "     7 |   *p = 1;\n       |    ^\n" in said and "double x" not in said


def test_summary_line() -> None:
    assert text.summary_line(COMPARED) == "3 new findings: 2 errors, 1 note; known: 1 unchanged, 1 updated; gone: 1"
    assert text.summary_line(FAILED) == "4 findings: 2 errors, 2 notes; 2 tools failed; no baseline"
    assert text.summary_line(EMPTY) == "No findings"


def test_color_only_when_asked() -> None:
    assert "\x1b" not in shown(FAILED, why=True)
    colored = shown(FAILED, color=True)
    assert re.sub(r"\x1b\[[0-9;]*m", "", colored) == shown(FAILED)


@pytest.mark.parametrize("why", [False, True])
@pytest.mark.parametrize("hostile_text", HOSTILE)
def test_hostile_texts(hostile_text: str, why: bool) -> None:
    said = text.render(hostile(hostile_text), color=False, width=80, why=why, source=lambda path: f"\n\n{hostile_text}")
    assert said.replace("\n", "").isprintable()
    assert not any(line.startswith("::") for line in said.splitlines())


@pytest.mark.parametrize("report", SHAPES.values(), ids=SHAPES)
def test_order_of_input_does_not_matter(report: Report) -> None:
    turned = replace(report, runs=tuple(replace(r, results=r.results[::-1]) for r in report.runs[::-1]))
    assert shown(turned, why=True) == shown(report, why=True)


def test_files_given_up_on_are_named_with_their_reasons() -> None:
    """The first five of a tool, then how many; not again what is a message of its own above."""
    quiet = tuple(
        Notification(Level.NOTE, f"reason {number}.", "architecture", f"launch/{number}.launch", line)
        for number in range(7)
        for line in (3, 9)
    )
    loud = Notification(Level.WARNING, "pylint could not analyse this file: it is odd", "pylint", "a.py")
    said = shown(replace(PLAIN, notifications=(*quiet, loud)))
    assert "  Not analysed in full: architecture on 7 files, pylint on 1 file.\n" in said
    lines = said.splitlines()
    first = lines.index("  Not analysed in full: architecture on 7 files, pylint on 1 file.") + 1
    assert lines[first : first + 6] == [
        *(f"    launch/{number}.launch:3: reason {number}; and 1 more reason" for number in range(5)),
        "    and 2 more files of architecture",
    ]
    assert said.count("it is odd") == 1


def test_one_reason_at_many_files_is_one_line() -> None:
    reasons = (
        "package 'camera' is not in the workspace",
        "package 'camera' is not in the workspace",
        "it is odd",
        *map(str, range(6)),
    )
    notes = tuple(
        Notification(Level.NOTE, reason, "architecture", f"launch/{number}.launch", 3)
        for number, reason in enumerate(reasons)
    )
    lines = shown(replace(PLAIN, notifications=notes)).splitlines()
    first = lines.index("  Not analysed in full: architecture on 9 files.") + 1
    assert lines[first : first + 2] == [
        "    launch/0.launch:3 and 1 more file: package 'camera' is not in the workspace",
        "    launch/2.launch:3: it is odd",
    ]
    assert lines[first + 5] == "    and 3 more files of architecture"
