# SPDX-License-Identifier: Apache-2.0
"""What a manifest lacks, as lines to write below the line at which the finding stands; and notes that say the same."""

from __future__ import annotations

from dataclasses import replace

import pytest

from haros_ci.model.location import Location
from haros_ci.report import text
from haros_ci.report.entries import MOST, lines_to_add
from haros_ci.results.result import Related, Result
from haros_ci.results.rule import Level

PLACE = Location("a/package.xml", 2)
MANIFEST = "<package>\n  <depend>rclcpp</depend>\n</package>\n"


def lacking(
    message: str, rule: str = "undeclared-import", tool: str = "haros-ci", path: str = "a/package.xml"
) -> Result:
    return Result(tool, rule, Level.ERROR, message, replace(PLACE, path=path))


@pytest.mark.parametrize(
    ("message", "expected"),
    [
        ("a needs b; add <depend>b</depend>.", ("<depend>b</depend>",)),
        ("x; remove it from find_package(), or add <depend>b</depend>.", ("<depend>b</depend>",)),
        ("x; add <exec_depend>b</exec_depend> and <exec_depend>c</exec_depend>; and 1 more like it", ("<exec_depend>b</exec_depend>", "<exec_depend>c</exec_depend>")),
        ("x; add <depend>b</depend>, <depend>c</depend> and <depend>d</depend> (or e)", ("<depend>b</depend>", "<depend>c</depend>", "<depend>d</depend>")),
        ("x; add <a>b</a>, which brings c, too", ("<a>b</a>",)),
        ("x; add b to package.xml", ()),
        ("x; write <depend>b</depend>", ()),
        ("x; add <a>b</c>", ()),
    ],
)  # fmt: skip
def test_the_tags_of_an_advice(message: str, expected: tuple[str, ...]) -> None:
    assert lines_to_add([lacking(message)]) == expected


ADVICE = "x; add <depend>b</depend>"


def test_copies_in_the_same_file_count_and_each_once() -> None:
    other, far = lacking(ADVICE.replace("b", "c")), lacking(ADVICE.replace("b", "d"), path="b/package.xml")
    one = replace(lacking(ADVICE), copies=(other, far))
    assert lines_to_add([one, lacking(ADVICE)]) == ("<depend>b</depend>", "<depend>c</depend>")


def test_many_are_cut() -> None:
    tags = ", ".join(f"<depend>n{number}</depend>" for number in range(MOST + 9))
    assert len(lines_to_add([lacking(f"x; add {tags}")])) == MOST


@pytest.mark.parametrize(
    "result",
    [
        lacking(ADVICE, rule="misspelt-dependency"),
        lacking(ADVICE, tool="catkin_lint"),
        lacking(ADVICE, path="a/CMakeLists.txt"),
        lacking(ADVICE, path="a/my_package.xml"),
    ],
)
def test_other_findings_add_nothing(result: Result) -> None:
    assert lines_to_add([result]) == ()


def shown(result: Result) -> str:
    return text.findings([result], color=False, width=90, why=False, source=lambda path: MANIFEST)


def test_below_the_line_and_as_far_in() -> None:
    assert "     2 |   <depend>rclcpp</depend>\n     + |   <depend>b</depend>\n" in shown(lacking(ADVICE))
    assert "     + |" not in shown(lacking(ADVICE, rule="invalid-manifest"))


def test_under_the_finding_that_asks_for_them() -> None:
    note = (Related(Location("a.py", 1), "needs b"),)
    one, other = replace(lacking(ADVICE), related=note), lacking("y; add <exec_depend>c</exec_depend>")
    last = replace(lacking("z; add <depend>b</depend> and <depend>d</depend>"), related=note)
    lines = text.findings(
        [one, other, last], color=False, width=90, why=False, source=lambda path: MANIFEST
    ).splitlines()
    assert [
        line.partition(": error: ")[2][:1] or line.strip() for line in lines if " |" in line or "error" in line
    ] == [
        "x",
        "2 |   <depend>rclcpp</depend>",
        "+ |   <depend>b</depend>",
        "y",
        "+ |   <exec_depend>c</exec_depend>",
        "z",
        "+ |   <depend>d</depend>",  # b stands above
    ]


def at(path: str, line: int | None) -> Related:
    return Related(Location(path, line), "needs b: import b")


@pytest.mark.parametrize(
    ("related", "expected"),
    [
        ((at("a.py", 1),), ["a.py:1: note: needs b: import b"]),
        ((at("a.py", 1), at("a.py", 1)), ["a.py:1: note: needs b: import b"]),
        ((at("a.py", 1), at("a.py", 7)), ["a.py:1: note: needs b: import b; and in line 7"]),
        ((at("a.py", 1), at("a.py", 10), at("a.py", 9)), ["a.py:1: note: needs b: import b; and in lines 9, 10"]),
        ((at("a.py", 1), at("b.py", 7)), ["a.py:1: note: needs b: import b; and at 1 more place"]),
        ((at("a.py", 1), at("b.py", 7), at("b.py", 8)), ["a.py:1: note: needs b: import b; and at 2 more places"]),
        (
            (at("a.py", 1), Related(Location("a.py", 2), "needs c"), at("a.py", 3)),
            ["a.py:1: note: needs b: import b", "a.py:2: note: needs c", "a.py:3: note: needs b: import b"],
        ),
    ],
)
def test_notes_that_say_the_same(related: tuple[Related, ...], expected: list[str]) -> None:
    said = shown(replace(lacking("x"), related=related)).splitlines()
    assert [line.strip() for line in said if ": note: " in line] == expected


@pytest.mark.parametrize(
    ("lines", "count"),
    [((2, 2), 0), ((2,), 0), ((2, 3), 2), ((1,), 1)],
)
def test_a_flow_at_the_own_line_is_not_repeated(lines: tuple[int, ...], count: int) -> None:
    flow = tuple(Related(replace(PLACE, line=line), "it is set") for line in lines)
    assert shown(replace(lacking("x"), flow=flow)).count(": step ") == count
