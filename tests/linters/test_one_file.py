# SPDX-License-Identifier: Apache-2.0
"""What pylint says of one file for one cause is one finding."""

from __future__ import annotations

import pytest

from haros_ci.linters.one_file import one_file
from haros_ci.model.location import Location
from haros_ci.results.result import Result
from haros_ci.results.rule import Level

CODE = "def first():\n" + "    a\n" * 20 + "def second():\n" + "    a\n" * 20
CALL = "No value for argument 'a' in function call"
MADE = "No value for argument 'a' in constructor call"


def said(rule: str, line: int, message: str = "m", path: str = "a.py", level: Level = Level.ERROR) -> Result:
    return Result("pylint", rule, level, message, Location(path, line, 1))


def name(line: int, word: str, level: Level = Level.ERROR) -> Result:
    return said("undefined-variable", line, f"Undefined variable '{word}'.", level=level)


def left(results: list[Result]) -> list[tuple[int | None, int]]:
    return [(result.location.line, len(result.related)) for result in one_file(results, lambda path: CODE)]


@pytest.mark.parametrize(
    ("results", "expected"),
    [
        ([name(5, "a"), said("not-in-loop", 9)], [(9, 1)]),
        ([said("no-value-for-parameter", 3, CALL), name(5, "a"), said("return-outside-function", 9)], [(9, 2)]),
        ([said("no-value-for-parameter", 3, MADE), said("no-value-for-parameter", 9, MADE)], [(3, 1)]),
        ([said("unexpected-keyword-arg", 9, MADE), said("no-value-for-parameter", 3, MADE)], [(3, 1)]),
        ([said("no-value-for-parameter", line, CALL) for line in (3, 7, 30)], [(3, 2)]),
        (
            [
                said("no-value-for-parameter", 3, CALL),
                said("too-many-function-args", 7),
                said("unexpected-keyword-arg", 30),
            ],
            [(3, 2)],
        ),
        ([name(3, "a"), name(5, "b")], [(3, 1)]),
        ([name(3, "a"), name(7, "b"), name(11, "c")], [(3, 2)]),
    ],
)
def test_one_cause(results: list[Result], expected: list[tuple[int, int]]) -> None:
    assert left(results) == expected


@pytest.mark.parametrize(
    "results",
    [
        [],
        [name(5, "a")],
        [said("not-in-loop", 9)],
        [said("not-in-loop", 9), said("not-in-loop", 12)],
        [said("not-in-loop", 9), said("unused-import", 1)],
        [said("not-in-loop", 9), said("undefined-variable", 3, path="b.py")],
        [said("invalid-character-esc", 9), name(3, "a")],
        [said("no-value-for-parameter", 3, CALL), said("no-value-for-parameter", 9, CALL)],
        [said("no-value-for-parameter", 3, MADE), said("no-value-for-parameter", 9, CALL)],
        [said("no-value-for-parameter", 3, MADE), said("no-value-for-parameter", 9, MADE, path="b.py")],
        [name(3, "a"), name(9, "b")],
        [name(20, "a"), name(23, "b")],
        [name(3, "a"), name(5, "b", Level.WARNING)],
        [name(50, "a"), name(51, "b")],
        [Result("ruff", "F821", Level.ERROR, "Undefined name `a`", Location("a.py", line, 1)) for line in (3, 4)],
    ],
)
def test_several_causes(results: list[Result]) -> None:
    assert one_file(results, lambda path: CODE) == tuple(results)


def test_the_other_names_are_in_the_message() -> None:
    (one,) = one_file([name(3, "a"), name(5, "b")], lambda path: CODE)
    assert one.message == "Undefined variable 'a'; 1 more name is not defined in this file: 'b'"


def test_what_was_put_together_before_stays_whole() -> None:
    (names,) = one_file([name(3, "a"), name(5, "b")], lambda path: CODE)
    (one,) = one_file([names, said("not-in-loop", 9)], lambda path: CODE)
    assert [part.location.line for part in one.parts] == [9, 3, 5]
    assert [place.location.line for place in one.related] == [3, 5]


def test_a_finding_names_so_many_places_at_most() -> None:
    found = one_file([said("no-value-for-parameter", line, CALL) for line in range(1, 60)], lambda path: CODE)
    assert sum(1 + len(result.related) for result in found) == 59
    assert len(found[0].related) == 40
