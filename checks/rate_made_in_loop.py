# SPDX-License-Identifier: Apache-2.0
"""Rates that are made in the loop that they are to slow down, behind its work."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Decidability, Finding, Level, Location, Project, syntax
from haros_ci.api.code import Routine, dotted
from haros_ci.api.syntax import everything

RATES = frozenset(("ros::Rate", "ros::WallRate", "rclcpp::Rate", "rclcpp::WallRate"))


def check(project: Project) -> Iterator[Finding]:
    code = project.code
    for path in sorted(code.mentioning("Rate") & code.mentioning("sleep") & code.mentioning("publish")):
        for routine in code.routines(path):
            if routine.is_test:
                continue
            for loop, _ in code.body(routine).loops:
                for statement, sleep in _slept(loop.body):
                    if _made(project, routine, loop.body, statement, sleep) and _publishes_before(loop.body, statement):
                        yield _finding(routine, sleep)


def _slept(block: syntax.Block) -> Iterator[tuple[syntax.Statement, syntax.Call]]:
    """The statements ``x.sleep()`` of a loop's body, those of loops in it left out."""
    for statement in block:
        if isinstance(statement, syntax.Do) and isinstance(statement.value, syntax.Call):
            callee = statement.value.callee
            if isinstance(callee, syntax.Member) and callee.name == "sleep" and not statement.value.arguments:
                yield statement, statement.value


def _made(
    project: Project, routine: Routine, block: syntax.Block, statement: syntax.Statement, sleep: syntax.Call
) -> bool:
    """Whether the rate is made in the statement itself, or in the one before it."""
    assert isinstance(sleep.callee, syntax.Member)
    rate = sleep.callee.object
    if isinstance(rate, syntax.Name):
        before = block[block.index(statement) - 1] if block.index(statement) else None
        if isinstance(before, syntax.Variable):
            return before.name == rate.name and before.type.name in RATES
        value = before.value if isinstance(before, syntax.Do) else None
        rate = value.value if isinstance(value, syntax.Assignment) and value.target == rate else rate
    if not isinstance(rate, syntax.Call):
        return False
    if routine.is_python:
        return dotted(project.code, routine, rate.callee) == "rospy.Rate"
    return syntax.name_of(rate.callee) in RATES


def _publishes_before(block: syntax.Block, end: syntax.Statement) -> bool:
    """Whether the turn publishes before the rate is made."""
    for statement in block:
        if statement is end:
            return False
        if any(
            isinstance(node, syntax.Call) and syntax.name_of(node.callee) == "publish" for node in everything(statement)
        ):
            return True
    return False


def _finding(routine: Routine, sleep: syntax.Call) -> Finding:
    return Finding(
        at=Location(routine.path, sleep.line, sleep.column),
        message=(
            f"the rate of the loop in {routine.title} is made in every turn, behind its work: it sleeps a whole period each "
            "time, and the loop is slower than the rate by the time of its work; make the rate before the loop"
        ),
        about=(routine.title, "rate in loop"),
    )


CHECK = Check(
    id="rate-made-in-loop",
    summary="Rate that is made in every turn of its loop, and does not keep it.",
    level=Level.NOTE,
    decidability=Decidability.EXACT,
    tags=("code",),
    profiles=("strict",),
    project=check,
)
