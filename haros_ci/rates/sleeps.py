# SPDX-License-Identifier: Apache-2.0
"""What slows a loop down: the rate whose ``sleep()`` is in every turn, a sleep of a known time, and loops of a known number of turns."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci import syntax
from haros_ci.code import kinds
from haros_ci.code.codebase import Codebase, Routine
from haros_ci.syntax import Block, Expression, Statement
from haros_ci.syntax.walk import everything

#: Seconds in what ``std::chrono`` counts, by the last part of its name or literal (cppreference.com, std::chrono::duration).
CHRONO = {
    "hours": 3600.0, "h": 3600.0, "minutes": 60.0, "min": 60.0, "seconds": 1.0, "s": 1.0, "milliseconds": 1e-3, "ms": 1e-3,
    "microseconds": 1e-6, "us": 1e-6, "nanoseconds": 1e-9, "ns": 1e-9,
}  # fmt: skip
#: Functions that sleep at least as long as their argument says: in std::chrono, in seconds, in microseconds.
OF_CHRONO = frozenset(("std::this_thread::sleep_for", "this_thread::sleep_for", "rclcpp::sleep_for"))
OF_SECONDS = frozenset(("sleep", "::sleep", "time.sleep", "rospy.sleep", "rospy.rostime.sleep"))
OF_MICROSECONDS = frozenset(("usleep", "::usleep"))
#: Classes whose ``sleep()`` takes that many seconds, or one part of a second in that many.
DURATIONS = frozenset(("ros::Duration", "ros::WallDuration"))
RATES = frozenset(("ros::Rate", "ros::WallRate", "rclcpp::Rate", "rclcpp::WallRate", "rospy.Rate"))
#: Turns that a loop of constants may have, to be counted.
MOST = 1_000


def every_turn(block: Block) -> Iterator[syntax.Call]:
    """The calls ``...sleep...(...)`` that run in every turn of a loop with this body that comes to its end."""
    for statement in block:
        if isinstance(statement, (syntax.Nested, syntax.Try)):
            yield from every_turn(statement.body)
        value: Expression | None = None
        if isinstance(statement, syntax.Do):
            value = statement.value
        elif isinstance(statement, syntax.If):
            value = statement.test
        while isinstance(value, syntax.Operation) and len(value.operands) == 1:
            value = value.operands[0]
        if isinstance(value, syntax.Call) and "sleep" in syntax.name_of(value.callee).rpartition("::")[2]:
            yield value


def rate_slept(calls: tuple[syntax.Call, ...]) -> Expression | None:
    """What ``sleep()`` of a rate is called on; None if there is no one such call."""
    found = [
        call.callee.object
        for call in calls
        if isinstance(call.callee, syntax.Member) and call.callee.name == "sleep" and not call.arguments
        if not isinstance(call.callee.object, syntax.Call)
    ]
    return found[0] if len(found) == 1 else None


def seconds(code: Codebase, routine: Routine, call: syntax.Call) -> float | None:
    """How long a call sleeps at the least; None where that is not written out, or nothing."""
    callee = call.callee
    if isinstance(callee, syntax.Member) and isinstance(callee.object, syntax.Call) and not call.arguments:
        made = callee.object
        name, number = _name(code, routine, made.callee), _number(made.arguments)
        if not number or callee.name != "sleep":
            return None
        return 1.0 / number if name in RATES else number if name in DURATIONS else None
    name = _name(code, routine, callee)
    if name in OF_CHRONO and len(call.arguments) == 1:
        return _chrono(call.arguments[0])
    number = _number(call.arguments)
    if number is None:
        return None
    found = number if name in OF_SECONDS else number * 1e-6 if name in OF_MICROSECONDS else 0.0
    return found or None


def hertz(code: Codebase, routine: Routine, rate: Expression) -> float:
    """The turns a second of a local rate object that is made of a number that is written out; 0.0 for others."""
    if not isinstance(rate, syntax.Name):
        return 0.0
    if routine.is_python:
        values = [value for target, _, value, _ in code.body(routine).sets if target == rate]
        made = values[0] if len(values) == 1 else None
        if not isinstance(made, syntax.Call):
            return 0.0
        is_rate = _name(code, routine, made.callee) in RATES or syntax.name_of(made.callee) == "create_rate"
        return (_number(made.arguments) or 0.0) if is_rate else 0.0
    found = code.body(routine).variables.get(rate.name, ())
    if len(found) != 1 or found[0].type.name not in RATES:
        return 0.0
    number = _number(found[0].parts)
    period = _chrono(found[0].parts[0]) if len(found[0].parts) == 1 else None
    return number or (1.0 / period if period else 0.0)


def _name(code: Codebase, routine: Routine, callee: Expression) -> str:
    if routine.is_python:
        return kinds.dotted(code, routine, callee)
    return callee.name if isinstance(callee, syntax.Name) else ""


def _number(arguments: tuple[Expression, ...]) -> float | None:
    only = arguments[0] if len(arguments) == 1 else None
    if not isinstance(only, syntax.Number) or isinstance(only.value, bool) or not 0 < only.value < 1e9:
        return None
    return float(only.value)


def _chrono(value: Expression) -> float | None:
    if not isinstance(value, syntax.Call) or not isinstance(value.callee, syntax.Name):
        return None
    unit = value.callee.name.removeprefix('operator""').rpartition("::")[2]
    number = _number(value.arguments)
    return None if number is None or unit not in CHRONO else number * CHRONO[unit]


def turns_of(code: Codebase, routine: Routine, loop: Statement) -> int | None:
    """How many turns a loop has that counts to a constant or goes through items that are written out; None for others."""
    found: int | None = None
    if isinstance(loop, syntax.Each):
        if isinstance(loop.iterable, syntax.ListLiteral):
            is_plain = not any(isinstance(item, syntax.Star) for item in loop.iterable.items)
            found = len(loop.iterable.items) if is_plain else None
        elif isinstance(loop.iterable, syntax.Call) and syntax.name_of(loop.iterable.callee) == "range":
            number = _number(loop.iterable.arguments) if not kinds.is_local(code, routine, "range") else None
            found = int(number) if number else None
    elif isinstance(loop, syntax.Loop) and loop.keyword == "for":
        found = _counted(loop)
    return found if found is not None and found <= MOST else None


def _counted(loop: syntax.Loop) -> int | None:
    """The turns of ``for (int i = 0; i < 3; ++i)`` where nothing in the body sets the counter."""
    start = loop.before[0] if len(loop.before) == 1 else None
    test, step = loop.test, loop.body[-1] if loop.body else None
    if not isinstance(start, syntax.Variable) or not isinstance(test, syntax.Operation):
        return None
    if test.operator not in ("<", "<=") or len(test.operands) != 2 or test.operands[0] != syntax.Name(start.name):
        return None
    first, last = next(iter(syntax.started(start.init)), None), test.operands[1]
    if not isinstance(first, syntax.Number) or not isinstance(last, syntax.Number):
        return None
    if not isinstance(step, syntax.Step) or _is_set(loop.body[:-1], start.name):
        return None
    if step.value != syntax.Assignment("+=", syntax.Name(start.name), syntax.Number(1)):
        return None
    return max(0, int(last.value - first.value) + (test.operator == "<="))


def _is_set(block: Block, name: str) -> bool:
    """Whether a block assigns to a variable, or takes its address."""
    for node in everything(block):
        target = node.target if isinstance(node, syntax.Assignment) else None
        value = node.value if isinstance(node, (syntax.Assignment, syntax.Address)) else None
        if name in (getattr(target, "name", ""), getattr(value, "name", "")):
            return True
    return False
