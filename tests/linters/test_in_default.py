# SPDX-License-Identifier: Apache-2.0
"""What the default profile leaves out of what linters say, by where it is."""

from __future__ import annotations

from dataclasses import replace

import pytest

from haros_ci.linters import catalogue
from haros_ci.linters.in_default import IN_TESTS, is_idle, is_of_linter, is_test
from haros_ci.model.location import Location
from haros_ci.results.result import Related, Result
from haros_ci.results.rule import Level


def result(name: str, path: str = "src/a.cpp", message: str = "said") -> Result:
    tool, _, rule = name.partition(":")
    return Result(tool, rule, Level.WARNING, message, Location(path, 3))


OBJECT = "Instance of '{}' object is destroyed immediately."
INDEX = "Array 'parts[3]' accessed at index -1, which is out of bounds."
SCANNED = "{}() without field width limits can crash with huge input data."
IDLE = [
    (result("cppcheck:duplicateExpression", "demo/test/a.cpp"), 2),
    (result("cppcheck:ignoredReturnValue", "tests/unit/a.cpp"), 2),
    (result("cppcheck:selfAssignment", "src/a_test.cpp"), None),
    (result("cppcheck:incorrectLogicOperator", "test/test_gait.cpp"), 2),
    (result("pylint:unreachable", "demo/test_walk.py"), 2),
    (result("cppcheck:unusedVariable", "test/a.cpp"), 2),
    (result("cppcheck:unusedVariable", "src/a_test.cc"), 1),
    (result("pylint:no-self-argument", "demo/conftest.py"), 2),
    (result("pylint:no-self-argument", "demo_tests/mock.py"), 2),
    (result("pylint:deprecated-module", "setup.py"), 1),
    (result("pylint:deprecated-method", "src/a.py"), 1),
    (result("cppcheck:unusedScopedObject", message=OBJECT.format("Driver")), 2),
    (result("cppcheck:negativeIndex", message=INDEX), 2),
    (result("cppcheck:invalidscanf", message=SCANNED.format("scanf")), 1),
]
STANDS = [
    (result("cppcheck:invalidscanf", message=SCANNED.format("fscanf")), 1),
    (result("cppcheck:invalidscanf", message=SCANNED.format("sscanf")), 2),
    (result("cppcheck:duplicateExpression"), 2),
    (result("cppcheck:incorrectLogicOperator"), 2),
    (result("cppcheck:duplicateExpression", "src/contest.cpp"), 2),
    (result("cppcheck:duplicateExpression", "src/attest/a.cpp"), 2),
    (result("cppcheck:duplicateExpression", "src/latest.cpp"), 2),
    (result("cppcheck:unusedVariable", "src/contest.cpp"), 2),
    (result("cppcheck:unusedVariable", "src/a.cpp"), 1),
    (result("cppcheck:uninitvar", "test/a.cpp"), 2),
    (result("pylint:no-value-for-parameter", "test/test_a.py"), 2),
    (result("pylint:unexpected-keyword-arg", "test/test_a.py"), 2),
    (result("pylint:syntax-error", "test/test_a.py"), 2),
    (result("pylint:undefined-variable", "test/test_a.py"), 2),
    (result("ruff:F811", "test/test_a.py"), 2),
    (result("pylint:deprecated-module", "setup.py"), 2),
    (result("pylint:deprecated-module", "setup.py"), None),
    (result("cppcheck:unusedScopedObject", message=OBJECT.format("std::lock_guard<std::mutex>")), 2),
    (result("cppcheck:unusedScopedObject", message=OBJECT.format("std::runtime_error")), 2),
    (result("cppcheck:negativeIndex", message=f"Either the condition 'a<1' is redundant or the array {INDEX}"), 2),
]


@pytest.mark.parametrize(("said", "ros"), IDLE)
def test_left_out(said: Result, ros: int | None) -> None:
    assert is_idle(said, ros)


@pytest.mark.parametrize(("said", "ros"), STANDS)
def test_stands(said: Result, ros: int | None) -> None:
    assert not is_idle(said, ros)


@pytest.mark.parametrize(
    "path", ["test/a.py", "a/tests/b/c.cpp", "a/a_unittest.cc", "a/b_spec.cpp", "unit_tests/a.cpp"]
)
def test_paths_of_tests(path: str) -> None:
    assert is_test(path)


@pytest.mark.parametrize(
    "path", ["a.py", "testing.py", "src/latest/a.cpp", "src/test.cpp", "protest/a.py", "spec/a.cpp"]
)
def test_other_paths(path: str) -> None:
    assert not is_test(path)


def test_the_rules_are_known() -> None:
    for name in IN_TESTS:
        tool, _, rule = name.partition(":")
        assert rule in catalogue.rules_of(tool) or tool == "ruff", name


def test_what_linters_say() -> None:
    assert is_of_linter(result("cppcheck:nullPointer"))
    assert not any(map(is_of_linter, map(result, ("haros-ci:missing-source", "metrics:mi-below-20", "clazy:level0"))))


@pytest.mark.parametrize(
    ("path", "expected"),
    [
        ("src/motor_spec.cpp", False),
        ("demo/test_rig.py", False),
        ("src/other_test.cpp", True),
        ("test/motor_spec.cpp", True),
        ("demo_tests/rig.py", True),
    ],
)
def test_what_a_build_makes_a_program_of_is_no_test(path: str, expected: bool) -> None:
    assert is_idle(result("cppcheck:nullPointer", path), 2, lambda one: "other" not in one) is expected
    assert is_idle(result("cppcheck:nullPointer", path), 2) is True
    assert is_idle(result("cppcheck:uninitvar", path), 2, lambda one: True) is False


@pytest.mark.parametrize("rule", ["nullPointer", "nullPointerArithmetic", "ctunullpointer"])
def test_an_allocation_that_fails(rule: str) -> None:
    """cppcheck names it nullPointerOutOfMemory, which no profile but ``all`` has, and forgets it over an assignment."""
    places = [
        Related(Location("src/a.cpp", 2), text) for text in ("Assignment 'a=b+1'", "Assuming allocation function fails")
    ]
    assert is_idle(replace(result(f"cppcheck:{rule}"), related=tuple(places)), 2)
    assert not is_idle(replace(result(f"cppcheck:{rule}"), related=tuple(places[:1])), 2)
    assert not is_idle(replace(result("cppcheck:uninitvar"), related=tuple(places)), 2)
