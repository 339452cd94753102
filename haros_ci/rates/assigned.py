# SPDX-License-Identifier: Apache-2.0
"""All that a number in a program may be: the values that a variable or member is given anywhere, and the calls that read a parameter into it."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci import syntax
from haros_ci.code import classes, kinds
from haros_ci.code.body import Call
from haros_ci.code.callbacks import given_function
from haros_ci.code.calls import called
from haros_ci.code.codebase import Codebase, Routine
from haros_ci.rates.publishers import related
from haros_ci.records import dataclass
from haros_ci.syntax import Expression
from haros_ci.syntax.walk import everything

#: Calls that write a parameter's value into their second argument (rclcpp/node.hpp, ros/node_handle.h).
READS_INTO = frozenset("get_parameter get_parameter_or getParam getParamCached param".split())
#: Functions of libraries that take numbers by value: what they are given stays as it is.
BY_VALUE = frozenset(
    "min max clamp abs fabs floor ceil round lround sqrt pow isnan isfinite to_string duration milliseconds microseconds nanoseconds "
    "seconds Duration Rate WallRate from_seconds fromSec toSec ParameterValue Parameter declare_parameter create_wall_timer "
    "createTimer createWallTimer create_timer create_rate sleep sleep_for float int str format print make_unique make_shared "
    "bind thread jthread static_cast loginfo logwarn logerr logdebug info warn error debug".split()
)
#: Beginnings of the names of macros that only write a log.
LOGS = ("RCLCPP_", "ROS_", "NODELET_", "RCUTILS_")


@dataclass(frozen=True, slots=True, eq=False)
class Given:
    """A *value* that something is given in *routine*; *is_read*: the value is a call that reads a parameter into it."""

    routine: Routine
    value: Expression
    is_read: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Assigned:
    """All that is *given*; *reason* says why there may be more, "" if that is all."""

    given: tuple[Given, ...] = ()
    reason: str = ""


def of_local(code: Codebase, where: Routine, name: str) -> Assigned:
    """What the local variable *name* of *where* is given, in the functions in it, too."""
    found: list[Given] = []
    for local in code.body(where).variables.get(name, ()):
        if local.value is not None:
            found.append(Given(where, local.value))
        elif local.init is not None and local.parts:
            return Assigned(reason=f"{name} is not made of one number")
    inside = (one for one in code.routines(where.path) if _is_within(one, where))
    return _gathered(code, tuple(inside), name, None, found)


def of_member(code: Codebase, owner: classes.Owner, name: str, is_python: bool) -> Assigned:
    """What a member of a class is given, whatever object of the class it is."""
    key = ("assigned", id(owner[1]), name)
    if key not in code.kept:
        found: list[Given] = []
        member = classes.field_of(code, owner, name)
        routines = [
            one
            for path in sorted(code.mentioning(name))
            if path.endswith(".py") is is_python
            for one in code.routines(path)
            if not one.is_test
        ]
        first = tuple(syntax.started(member[1].init)) if member is not None else ()
        near = [one for one in routines if classes.owner_of(code, one) is not None]
        if first and near:
            found.append(Given(near[0], first[0]))
        code.kept[key] = _gathered(code, tuple(routines), name, owner, found)
    known: Assigned = code.kept[key]
    return known


def _is_within(routine: Routine, outer: Routine) -> bool:
    around: Routine | None = routine
    while around is not None and around is not outer:
        around = around.outer
    return around is outer


def _gathered(
    code: Codebase, routines: tuple[Routine, ...], name: str, owner: classes.Owner | None, found: list[Given]
) -> Assigned:
    for routine in routines:
        why = _in_routine(code, routine, name, owner, found)
        if why:
            return Assigned(reason=why)
    return Assigned(tuple(found))


def _in_routine(code: Codebase, routine: Routine, name: str, owner: classes.Owner | None, found: list[Given]) -> str:
    """Add what *routine* gives it to *found*; why it may be given something else there, "" if it is not."""
    parts = (*routine.function.inits, *(routine.function.body or ()))
    body = code.body(routine)
    for target, operator, value, _ in body.sets:
        if not _means(code, routine, target, name, owner):
            continue
        if operator != "=":
            return f"{routine.title} computes {name} from itself"
        found.append(Given(routine, value))
    for call in body.calls:
        for position, argument in enumerate(call.args):
            value = argument.value if isinstance(argument, syntax.Keyword) else argument
            if not _means(code, routine, value, name, owner):
                continue
            if position == 1 and call.name in READS_INTO:
                found.append(Given(routine, call.whole, True))
            elif not (routine.is_python or _is_by_value(code, routine, call, position)):
                return f"{routine.title} gives {name} to others"
    for node in everything(parts):
        if isinstance(node, syntax.Address) and _means(code, routine, node.value, name, owner):
            return f"{routine.title} takes the address of {name}"
    return ""


def _is_by_value(code: Codebase, routine: Routine, call: Call, position: int) -> bool:
    """Whether a call cannot change the argument at *position*."""
    if call.name in BY_VALUE or call.name.startswith(LOGS):
        return True
    every = called(code, routine, call.whole)
    for target in every:
        parameters = target.function.parameters
        kind = parameters[position].type if position < len(parameters) else None
        if kind is None or ("&" in kind.marks and "c" not in kind.marks) or "*" in kind.marks:
            return False
    return bool(every)


def _means(code: Codebase, routine: Routine, node: Expression, name: str, owner: classes.Owner | None) -> bool:
    """Whether *node* is, or may be, the variable or member *name*."""
    if isinstance(node, syntax.Name):
        if node.name.rpartition("::")[2] != name:
            return False
        if owner is None:
            return True
        return not (routine.is_python or kinds.is_local(code, routine, name)) and _is_of(code, routine, owner)
    if not isinstance(node, syntax.Member) or node.name != name or owner is None:
        return False
    if isinstance(node.object, syntax.This):
        return _is_of(code, routine, owner)
    own = kinds.class_of(code, routine, node.object)
    return own is None or related(code, own, owner)


def _is_of(code: Codebase, routine: Routine, owner: classes.Owner) -> bool:
    own = classes.owner_of(code, routine)
    return own is None or related(code, own, owner)


def callers(calls: tuple[tuple[Routine, Call], ...], position: int, name: str) -> Iterator[Given]:
    """What *calls* give the parameter *name* at *position* of the function that they call."""
    for where, call in calls:
        words = [value.value for value in call.args if isinstance(value, syntax.Keyword) and value.name == name]
        plain = [value for value in call.args if not isinstance(value, syntax.Keyword)]
        if words or position < len(plain):
            yield Given(where, words[0] if words else plain[position])


def bound(code: Codebase, threads: tuple[tuple[Routine, Call], ...], target: Routine, position: int) -> Iterator[Given]:
    """What the calls that begin *threads* with the function *target* give its parameter at *position*, through a bind or directly."""
    shift = 1 if target.function.owner and not target.is_python else 0
    for where, call in threads:
        for node in everything(call.whole):
            if not isinstance(node, syntax.Call) or not node.arguments:
                continue
            if target in given_function(code, where, node.arguments[0]) and len(node.arguments) > position + 1 + shift:
                yield Given(where, node.arguments[position + 1 + shift])
                break
