# SPDX-License-Identifier: Apache-2.0
"""Loops that publish in every turn and never wait for anything."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import takewhile

from haros_ci.api import Check, Decidability, Finding, Level, Location, Project, regex, syntax
from haros_ci.api.code import Codebase, Routine, called, dotted, is_dead, type_name
from haros_ci.api.syntax import everything

#: Conditions that hold as long as ROS runs.
RUNNING = frozenset(
    (
        "ros::ok()",
        "rclcpp::ok()",
        "rclpy.ok()",
        "notrospy.is_shutdown()",
        "!ros::isShuttingDown()",
        "true",
        "True",
        "1",
        "nh.ok()",
        "n.ok()",
    )
)
#: Calls of roscpp, rclcpp, rospy, rclpy and of the languages that come back at once, by the last part of the name.
AT_ONCE = frozenset(
    (
        "publish", "spinOnce", "spin_some", "ok", "is_shutdown", "now", "toSec", "to_msg", "get_clock",
        "get_logger", "getNumSubscribers", "get_subscription_count", "get_num_connections", "loginfo", "logdebug",
        "logwarn", "info", "debug", "warn", "warning", "c_str", "str", "to_string", "format", "size", "len",
        "range", "float", "int", "sin", "cos", "push_back", "append", "isShuttingDown", "seconds", "move",
    )
)  # fmt: skip
_LOGS = regex(r"(?:ROS|RCLCPP)_(?:DEBUG|INFO|WARN|ERROR)\w{0,40}")
#: What makes a message: ``std_msgs::msg::String()``, ``Twist()``.
_MESSAGES = regex(r"\w{1,80}(?:::msg)?(?:::|\.)(?:msg\.)?[A-Z]\w{0,80}")
_YIELD = regex(r"^[^#'\"]*\byield\b")
#: Lines of a loop that are looked at.
_LONGEST = 200
#: Classes of publishers, and the calls that make them in Python.
PUBLISHERS = frozenset(("ros::Publisher", "rclcpp::Publisher"))


def check(project: Project) -> Iterator[Finding]:
    code = project.code
    for path in sorted(code.mentioning("publish") & code.mentioning("while")):
        for routine in code.routines(path):
            if routine.is_test or code.body(routine).is_partial:
                continue
            for loop, _ in code.body(routine).loops:
                if loop.keyword != "while" or not _is_unlimited(code, routine, loop):
                    continue
                if not (_stops(project.text(path), loop) if routine.is_python else is_dead(code, routine)):
                    yield _finding(routine, loop)


def _stops(text: str, loop: syntax.Loop) -> bool:
    """Whether a turn stops at a ``yield``: who goes through the generator, or sends to it, says when it goes on (docs.python.org/3/reference/expressions.html)."""
    lines = text.split("\n")[loop.line - 1 :]
    inside = [line for line in lines[1:_LONGEST] if line.strip()]
    begin = len(lines[0]) - len(lines[0].lstrip())
    body = takewhile(lambda line: len(line) - len(line.lstrip()) > begin, inside)
    return any(_YIELD.search(line) for line in body)


def _is_unlimited(code: Codebase, routine: Routine, loop: syntax.Loop) -> bool:
    if re.sub(r"\s", "", loop.text) not in RUNNING or not any(
        _publishes(code, routine, one) for one in _every_turn(loop.body)
    ):
        return False
    for node in everything(loop.body):
        if isinstance(
            node, (syntax.Break, syntax.Return, syntax.Throw, syntax.Unknown, syntax.Loop, syntax.Preprocessor)
        ):
            return False
        if isinstance(node, syntax.Call) and not _is_at_once(code, routine, node):
            return False
    return True


def _every_turn(block: syntax.Block) -> Iterator[syntax.Call]:
    """The calls that stand alone in every turn."""
    for statement in block:
        if isinstance(statement, (syntax.Nested, syntax.Try)):
            yield from _every_turn(statement.body)
        elif isinstance(statement, syntax.Do) and isinstance(statement.value, syntax.Call):
            yield statement.value


def _publishes(code: Codebase, routine: Routine, call: syntax.Call) -> bool:
    callee = call.callee
    if not isinstance(callee, syntax.Member) or callee.name != "publish" or len(call.arguments) != 1:
        return False
    kind = type_name(code, routine, callee.object)
    return (
        any(kind.startswith(name) for name in PUBLISHERS)
        if not routine.is_python
        else _is_made(code, routine, callee.object)
    )


def _is_made(code: Codebase, routine: Routine, publisher: syntax.Expression) -> bool:
    """Whether a publisher in Python is made by rospy or rclpy in the same function or module."""
    around: Routine | None = routine
    while around is not None:
        values = [value for target, _, value, _ in code.body(around).sets if target == publisher]
        if values:
            made = values[0].callee if len(values) == 1 and isinstance(values[0], syntax.Call) else None
            return made is not None and (
                dotted(code, around, made) == "rospy.Publisher"
                or syntax.name_of(made).rpartition(".")[2] == "create_publisher"
            )
        around = around.outer
    modules = [other for other in code.routines(routine.path) if other.function.kind == "module"]
    return bool(modules) and routine is not modules[0] and _is_made(code, modules[0], publisher)


def _is_at_once(code: Codebase, routine: Routine, call: syntax.Call) -> bool:
    name = syntax.name_of(call.callee)
    if called(code, routine, call):
        return False  # what a function of the workspace waits for is not looked at
    last = re.split(r"::|\.", name)[-1]
    return last in AT_ONCE or _LOGS.fullmatch(name) is not None or _is_message(code, routine, call.callee)


def _is_message(code: Codebase, routine: Routine, callee: syntax.Expression) -> bool:
    name = dotted(code, routine, callee) if routine.is_python else syntax.name_of(callee)
    return "_msgs" in name and _MESSAGES.search(name) is not None


def _finding(routine: Routine, loop: syntax.Loop) -> Finding:
    rate = "a rospy.Rate or rclpy timer" if routine.is_python else "a ros::Rate, an rclcpp::Rate or a timer"
    return Finding(
        at=Location(routine.path, loop.line, loop.column),
        message=(
            f"the loop in {routine.title} publishes in every turn and waits for nothing: it takes a whole processor, and "
            f"queues overflow at once; give it {rate}"
        ),
        about=(routine.title, "loop without limit"),
    )


CHECK = Check(
    id="publish-without-limit",
    summary="Loop that publishes as fast as the processor can.",
    level=Level.WARNING,
    decidability=Decidability.EXACT,
    tags=("code", "topics"),
    project=check,
)
