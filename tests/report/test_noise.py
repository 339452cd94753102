# SPDX-License-Identifier: Apache-2.0
"""``-q`` leaves findings alone, ``-v`` stands for reasons, counts and times; without them nothing is otherwise."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import pytest
from report_samples import EMPTY, PLAIN

from haros_ci.cli import haros_ci
from haros_ci.commands.output import Extras, rendered
from haros_ci.commands.timings import with_timings
from haros_ci.results.result import Report


def text(report: Report, **flags: Any) -> str:
    return rendered(report, "text", Extras(lambda path: "", {"why": False, **flags}, to_file=True), {})


def test_quiet_has_the_findings_and_no_summary() -> None:
    quiet, usual = text(PLAIN, quiet=True), text(PLAIN)
    assert usual.startswith(quiet.rstrip("\n")) and len(quiet) < len(usual)
    assert "Looked at" in usual and "Looked at" not in quiet and "findings: " not in quiet


def test_quiet_says_nothing_where_there_is_nothing() -> None:
    assert text(EMPTY, quiet=True).strip() == ""


@pytest.mark.parametrize("flags", [{}, {"quiet": False}, {"quiet": None}])
def test_otherwise_the_summary_is_there(flags: Mapping[str, Any]) -> None:
    assert text(PLAIN, **flags) == text(PLAIN)


@pytest.mark.parametrize(
    ("flags", "expected"),
    [
        ({"verbose": True}, (True, True)),
        ({"verbose": True, "why": False, "statistics": False}, (True, True)),
        ({"verbose": False, "why": True}, (True, None)),
        ({"statistics": True}, (None, True)),
        ({}, (None, None)),
    ],
)
def test_verbose_stands_for_several(flags: Mapping[str, Any], expected: tuple[bool | None, bool | None]) -> None:
    seen: list[Mapping[str, Any]] = []

    def command(given: Mapping[str, Any]) -> int:
        seen.append(given)
        return 0

    assert with_timings(command)(flags) == 0
    assert (seen[0].get("why"), seen[0].get("statistics")) == expected


@pytest.mark.parametrize("name", ["check", "merge", "metrics"])
def test_commands_with_both(name: str) -> None:
    options = {option for parameter in haros_ci.commands[name].params for option in parameter.opts}
    assert {"-q", "--quiet", "-v", "--verbose"} <= options


@pytest.mark.parametrize("name", ["model", "diff", "report"])
def test_commands_that_can_say_more(name: str) -> None:
    options = {option for parameter in haros_ci.commands[name].params for option in parameter.opts}
    assert {"-v", "--verbose"} <= options
