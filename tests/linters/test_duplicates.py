# SPDX-License-Identifier: Apache-2.0
"""The same defect found by two tools is reported once, naming both; everything else stays."""

from __future__ import annotations

from itertools import permutations

import pytest

from haros_ci.linters.duplicates import drop_unfounded, merge_same_defects
from haros_ci.model.location import Location
from haros_ci.results.result import Result
from haros_ci.results.rule import Level


def result(
    name: str, line: int | None = 3, *, path: str = "a", column: int | None = None, message: str = "m", scope: str = ""
) -> Result:
    tool, _, rule = name.partition(":")
    return Result(tool, rule, Level.WARNING, message, Location(path, line, column), scope=scope)


@pytest.mark.parametrize(
    ("given", "kept", "also"),
    [
        (
            ["cpplint:runtime/explicit", "cppcheck:noExplicitConstructor"],
            "cpplint:runtime/explicit",
            ["cppcheck:noExplicitConstructor"],
        ),
        (["pylint:expression-not-assigned", "ruff:B018"], "pylint:expression-not-assigned", ["ruff:B018"]),
        (["pylint:pointless-statement", "ruff:B018"], "pylint:pointless-statement", ["ruff:B018"]),
        (["ruff:F401", "pylint:unused-import"], "pylint:unused-import", ["ruff:F401"]),
        (["ruff:F507", "pylint:too-many-format-args"], "pylint:too-many-format-args", ["ruff:F507"]),
        (["ruff:F523", "pylint:too-many-format-args"], "pylint:too-many-format-args", ["ruff:F523"]),
        (["flake8:F507", "pylint:too-many-format-args"], "pylint:too-many-format-args", ["flake8:F507"]),
        (
            ["ruff:F503", "ruff:F507", "pylint:too-few-format-args"],
            "pylint:too-few-format-args",
            ["ruff:F503", "ruff:F507"],
        ),
        (["ruff:F509", "pylint:bad-format-character"], "pylint:bad-format-character", ["ruff:F509"]),
        (["ruff:F505", "pylint:missing-format-string-key"], "pylint:missing-format-string-key", ["ruff:F505"]),
        (["ruff:F841", "pylint:unused-variable"], "pylint:unused-variable", ["ruff:F841"]),
        (
            ["pylint:too-many-arguments", "metrics:max-function-parameters-6", "ruff:PLR0913"],
            "metrics:max-function-parameters-6",
            ["pylint:too-many-arguments", "ruff:PLR0913"],
        ),
        (
            ["metrics:max-function-length-40", "metrics:max-eloc-70"],
            "metrics:max-eloc-70",
            ["metrics:max-function-length-40"],
        ),
        (
            ["cppcheck:noOperatorEq", "cppcheck:noCopyConstructor"],
            "cppcheck:noCopyConstructor",
            ["cppcheck:noOperatorEq"],
        ),
    ],
)
def test_merged(given: list[str], kept: str, also: list[str]) -> None:
    for order in permutations(result(name, message=name) for name in given):
        (left,) = merge_same_defects(order)
        assert (left.full_id, left.message, list(left.also)) == (kept, kept, also)


@pytest.mark.parametrize(
    "given",
    [
        [],
        [result("pylint:unused-import")],
        [result("pylint:unused-import"), result("ruff:F401", 4)],
        [result("pylint:unused-import"), result("ruff:F401", path="b")],
        [result("pylint:unused-import"), result("ruff:F841")],
        [result("pylint:unused-import"), result("pylint:unused-import", message="other")],
        [result("cppcheck:uninitMemberVar", message="a"), result("cppcheck:uninitMemberVar", message="b")],
        [result("metrics:max-cyclomatic-complexity-15"), result("metrics:max-eloc-70")],
        [result("metrics:max-function-parameters-6"), result("metrics:max-eloc-70")],
        [result("elsewhere:F401"), result("pylint:unused-import")],
        [result("cpplint:runtime/explicit", None), result("cppcheck:noExplicitConstructor", 3)],
    ],
)
def test_quiet(given: list[Result]) -> None:
    assert merge_same_defects(given) == tuple(given)


def test_several_on_one_line_are_paired_in_order() -> None:
    given = [
        result("ruff:F401", column=15, message="b"),
        result("ruff:F401", column=12, message="a"),
        result("pylint:unused-import", column=1, message="Unused a"),
        result("pylint:unused-import", column=1, message="Unused b"),
        result("ruff:F401", column=18, message="c"),
    ]
    left = merge_same_defects(given)
    assert [(r.full_id, r.message, r.also) for r in left] == [
        ("pylint:unused-import", "Unused a", ("ruff:F401",)),
        ("pylint:unused-import", "Unused b", ("ruff:F401",)),
        ("ruff:F401", "c", ()),
    ]


def test_the_worst_level_stays() -> None:
    note = Result("cpplint", "runtime/explicit", Level.NOTE, "m", Location("a", 1))
    error = Result("cppcheck", "noExplicitConstructor", Level.ERROR, "m", Location("a", 1))
    assert [r.level for r in merge_same_defects([note, error])] == [Level.ERROR]


def test_order_and_other_results_stay() -> None:
    given = [result("z:z"), result("pylint:unused-import"), result("a:a"), result("ruff:F401"), result("m:m", 1)]
    assert [r.full_id for r in merge_same_defects(given)] == ["z:z", "pylint:unused-import", "a:a", "m:m"]
    once = merge_same_defects(given)
    assert merge_same_defects(once) == once


@pytest.mark.parametrize(
    ("line", "scope", "count"),
    [(10, "ns::A::spin", 1), (10, "spin", 1), (60, "ns::A::spin", 2), (10, "ns::A::spun", 2)],
)
def test_cpplint_names_long_functions_at_their_end(line: int, scope: str, count: int) -> None:
    message = "Small and focused functions are preferred: A::spin() has 602 non-comment lines."
    given = [
        result("cpplint:readability/fn_size", 50, message=message),
        result("metrics:max-eloc-70", line, scope=scope),
    ]
    assert len(merge_same_defects(given)) == count


@pytest.mark.parametrize(
    ("text", "kept"),
    [
        ("from std_msgs.msg import *\n", False),
        ("#!/usr/bin/env python\n\nfrom  a.b  import  *\n", False),
        ("if a:\n    from a import (*)\n", False),
        ("from a import b\n", True),
        ("x = 'from a import *'\n", True),
        ("# from a import *\n", True),
        ("from a import b as c\nd = b * c\n", True),
        ("", True),
    ],
)
def test_names_behind_a_wildcard_import(text: str, kept: bool) -> None:
    given = (result("pylint:undefined-variable"), result("pylint:unused-import"), result("ruff:F821"))
    assert drop_unfounded(given, {"a": text}.__getitem__) == (given if kept else given[1:])


def test_defaults_of_one_function_are_one() -> None:
    head, other = result("pylint:dangerous-default-value", 3), result("pylint:dangerous-default-value", 20)
    defaults = [result("ruff:B006", line) for line in (3, 3, 5, 22, 90)]
    merged = merge_same_defects([head, *defaults, other])
    assert [(r.full_id, r.location.line) for r in merged] == [
        ("pylint:dangerous-default-value", 3),
        ("ruff:B006", 90),
        ("pylint:dangerous-default-value", 20),
    ]


def test_a_key_that_stands_twice_is_one_finding() -> None:
    """pylint gives the place of the dict, ruff that of the key."""
    twice = Result(
        "pylint", "duplicate-key", Level.WARNING, "Duplicate key 'x' in dictionary", Location("a", 1, 5, 5, 2)
    )
    again = result("ruff:F601", 4, message='Dictionary key literal `"x"` repeated')
    for order in ([twice, again], [again, twice]):
        (left,) = merge_same_defects(order)
        assert (left.full_id, left.also) == ("pylint:duplicate-key", ("ruff:F601",))
    for other in (
        result("ruff:F601", 4, message='Dictionary key literal `"y"` repeated'),
        result("ruff:F601", 7, message='Dictionary key literal `"x"` repeated'),
        result("ruff:F601", 4, path="b", message='Dictionary key literal `"x"` repeated'),
    ):
        assert len(merge_same_defects([twice, other])) == 2
