# SPDX-License-Identifier: Apache-2.0
"""The same of one thing in several launch files is one finding for who reads; what differs in anything else stays apart."""

from __future__ import annotations

from dataclasses import replace

import pytest

from haros_ci.model.location import Location
from haros_ci.results.across import across, uses
from haros_ci.results.copied import together
from haros_ci.results.result import BaselineState, Report, Result, Run, Suppression, Tool
from haros_ci.results.rule import Level

FACT = "/odom is given the parameter imu_topic, but demo/odom does not declare it: the value has no effect"


def given(path: str, line: int = 3, rest: str = "correct the name, or remove it; in demo/{}") -> Result:
    message = f"{FACT}; {rest.format(path)}."
    place = Location(path, line)
    return Result("haros-ci", "parameter-not-declared", Level.WARNING, message, place, subject=("/odom", "imu_topic"))


A, B, C, D = (given(f"{name}.launch", line) for line, name in enumerate("abcd", 3))


@pytest.mark.parametrize(
    ("results", "end"),
    [
        ((A, B), "; and the same in 1 other file (b.launch)"),
        ((A, B, C, D), "; and the same in 3 other files (b.launch, c.launch, …)"),
        ((A, given("b.launch", 9, "correct the name, or remove it; seen with sim:=1")), " (b.launch)"),
    ],
)
def test_one_cause_in_several_files(results: tuple[Result, ...], end: str) -> None:
    (one,) = across(results)
    assert one.location == A.location and one.message.startswith(FACT) and one.message.endswith(end)
    assert [copy.location for copy in one.copies] == [result.location for result in results[1:]]
    assert [place.location for place in one.related] == [result.location for result in results[1:]]


def test_keywords_of_a_former_version() -> None:
    old = "node_name= was removed from launch_ros after ROS 2 Foxy: launch stops here; write name="
    results = [
        Result("haros-ci", "deprecated-launch-keyword", Level.WARNING, f"{old}{more}.", Location(path, 4), subject=("node_name=",))
        for path, more in (("a.launch.py", "; so have 2 more calls of this file"), ("b.launch.py", ""))
    ]  # fmt: skip
    (one,) = across(results)
    assert one.message.endswith("of this file; and the same in 1 other file (b.launch.py)")


def test_a_remapping_that_several_launch_files_have() -> None:
    fact = "/manager has no topic or service /cmd: the remapping of cmd to /cmd_vel has no effect; correct the name, or remove the remapping; in demo/launch"
    results = [
        Result("haros-ci", "ineffective-remap", Level.WARNING, f"{fact}/{path}.", Location(path, 35), subject=("/manager", "/cmd"))
        for path in ("a.launch.py", "b.launch.py")
    ]  # fmt: skip
    assert len(across(results)) == 1
    assert len(across([results[0], replace(results[1], subject=("/manager", "/other"))])) == 2


def test_the_report_of_people_has_them_once() -> None:
    run = Run(Tool("haros-ci"), results=(A, B, replace(C, subject=("/odom", "rate"))))
    (joined,) = together(Report(runs=(run,)), lambda path: "", lambda path: "demo").runs
    assert [len(one.copies) for one in joined.results] == [1, 0]


@pytest.mark.parametrize(
    "other",
    [
        pytest.param(given("a.launch", 20), id="one file: other places of it are not this module's"),
        pytest.param(replace(B, subject=("/odom", "rate")), id="of another parameter"),
        pytest.param(replace(B, subject=()), id="of nothing that is named"),
        pytest.param(replace(B, level=Level.NOTE), id="of another level"),
        pytest.param(replace(B, rule="duplicate-node-name"), id="each of these is mended by itself"),
        pytest.param(replace(B, tool="pylint"), id="of another tool"),
        pytest.param(replace(B, state=BaselineState.NEW), id="new, and the first is not compared"),
        pytest.param(replace(B, suppressions=(Suppression("inSource", ""),)), id="silenced"),
        pytest.param(replace(B, copies=(C,)), id="stands for others already"),
        pytest.param(given("b.launch", 4, "did you mean imu?"), id="with other advice"),
        pytest.param(
            given("b.launch", 4, "correct the name, or remove it; likewise for rate"), id="of more parameters"
        ),
        pytest.param(replace(B, message=B.message.replace("demo/odom", "demo/other")), id="of another program"),
    ],
)
def test_what_stays_apart(other: Result) -> None:
    assert across((A, other)) == (A, other)


def unknown(path: str, line: int, name: str = "pi_robot") -> Result:
    message = f"package '{name}' does not exist; did you mean '{name}s'?"
    return Result("haros-ci", "unknown-package", Level.ERROR, message, Location(path, line), subject=(name,))


def test_one_name_that_is_not_there_in_several_files() -> None:
    found = (unknown("a.launch", 2), unknown("a.launch", 9), unknown("b.launch", 3), unknown("c.launch", 3))
    (one,) = uses(found)
    assert one.message.endswith("; and the same in 2 other files (b.launch, c.launch)")
    assert [copy.location for copy in one.copies] == [found[index].location for index in (2, 3, 1)]
    (shown,) = together(Report(runs=(Run(Tool("haros-ci"), results=found),)), lambda path: "", lambda path: "demo").runs
    assert [len(result.copies) for result in shown.results] == [3]


@pytest.mark.parametrize(
    "found",
    [
        (unknown("a.launch", 2), unknown("a.launch", 9)),
        (unknown("a.launch", 2), unknown("b.launch", 2, "other")),
        (unknown("a.launch", 2), replace(unknown("b.launch", 2), level=Level.NOTE)),
        (unknown("a.launch", 2), replace(unknown("b.launch", 2), state=BaselineState.NEW)),
        (unknown("a.launch", 2), replace(unknown("b.launch", 2), suppressions=(Suppression("inSource", ""),))),
        (unknown("a.launch", 2), replace(unknown("b.launch", 2), message="package 'pi_robot' does not exist.")),
        (A, B),
    ],
)
def test_names_that_are_not_one(found: tuple[Result, ...]) -> None:
    assert uses(found) == found
