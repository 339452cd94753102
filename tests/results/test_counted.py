# SPDX-License-Identifier: Apache-2.0
"""Metrics are counted where nothing is known of what has changed, and warn where a change crosses a limit."""

from __future__ import annotations

from dataclasses import replace

import pytest

from haros_ci.model.location import Location
from haros_ci.results.counted import REASON, count_metrics, counted, is_counted, is_set_aside, raise_exceeded
from haros_ci.results.known import ComparedFiles, known_from_results
from haros_ci.results.result import BaselineState, Result, Run, Suppression, Tool
from haros_ci.results.rule import Level
from haros_ci.results.upkeep import update

LONG = Result("metrics", "max-cyclomatic-complexity-15", Level.NOTE, "m", Location("a.py", 1))
OTHER = replace(LONG, rule="mi-below-20")
LINT = Result("pylint", "unused-import", Level.WARNING, "m", Location("a.py", 1))
COMMENT = Suppression("inSource", "on purpose")


def runs(*results: Result) -> tuple[Run, ...]:
    return tuple(Run(Tool(name), results=tuple(r for r in results if r.tool == name)) for name in ("metrics", "pylint"))


def results(found: tuple[Run, ...]) -> list[Result]:
    return [result for run in found for result in run.results]


def test_metrics_that_nobody_asked_for_are_set_aside_and_counted() -> None:
    found = results(count_metrics(runs(LONG, LONG, OTHER, LINT), lambda *rule: rule[1] == "mi-below-20"))
    assert [is_counted(r) for r in found] == [True, True, False, False]
    assert counted(found) == (
        "Metrics beyond their limits: max-cyclomatic-complexity-15 (2); --profile strict lists them."
    )


def test_several_rules_are_counted_in_one_line() -> None:
    found = results(count_metrics(runs(OTHER, OTHER, LONG), lambda *rule: False))
    assert "mi-below-20 (2), max-cyclomatic-complexity-15 (1)" in counted(found)


@pytest.mark.parametrize("found", [[], [LINT], [LONG], [replace(LONG, suppressions=(COMMENT,))]])
def test_nothing_is_counted(found: list[Result]) -> None:
    assert counted(found) == ""


def test_a_suppressed_metric_stays_suppressed() -> None:
    (only,) = results(count_metrics(runs(replace(LONG, suppressions=(COMMENT,))), lambda *rule: False))
    assert only.suppressions == (COMMENT,) and is_set_aside(only) and not is_counted(only)


def test_a_baseline_remembers_what_was_counted_but_not_what_was_set_aside() -> None:
    (one,) = results(count_metrics(runs(LONG), lambda *rule: False))
    assert [known.rule for known in known_from_results([one])] == [LONG.rule]
    assert known_from_results([replace(LONG, suppressions=(COMMENT,))]) == ()
    assert known_from_results([replace(one, suppressions=(*one.suppressions, COMMENT))]) == ()


def test_a_baseline_that_is_brought_up_to_date_keeps_what_is_counted() -> None:
    (one,) = results(count_metrics(runs(LONG), lambda *rule: False))
    before = known_from_results([one])
    sides = ComparedFiles(head=lambda path: "def f():\n", language=lambda path: "python", exists=lambda path: True)
    assert [known.rule for known in update(before, [one], sides)] == [LONG.rule]
    assert update(before, [replace(one, suppressions=(*one.suppressions, COMMENT))], sides) == ()


@pytest.mark.parametrize(
    ("result", "weighs", "level"),
    [
        (replace(LONG, state=BaselineState.NEW), True, Level.WARNING),
        (replace(LONG, state=BaselineState.NEW), False, Level.NOTE),
        (replace(LONG, state=BaselineState.UNCHANGED), True, Level.NOTE),
        (replace(LONG, state=BaselineState.UPDATED), True, Level.NOTE),
        (replace(LONG, state=BaselineState.ABSENT), True, Level.NOTE),
        (replace(LONG, state=BaselineState.NEW, level=Level.ERROR), True, Level.ERROR),  # as the settings say
        (replace(LINT, state=BaselineState.NEW, level=Level.NOTE), True, Level.NOTE),
    ],
)
def test_a_change_that_crosses_a_limit_warns(result: Result, weighs: bool, level: Level) -> None:
    (only,) = results(raise_exceeded(runs(result), lambda _: weighs))
    assert only.level is level


def test_the_reason_is_a_sentence() -> None:
    assert REASON[0].isupper() and REASON.endswith(".")
