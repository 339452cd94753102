# SPDX-License-Identifier: Apache-2.0
"""Python code that gives a field of a message a value of another type than the field has."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Location, Project
from haros_ci.api.code import Codebase, Routine, attribute_values, calls_of, owner_of
from haros_ci.api.interfaces import WrongValue, wrong_values

_KINDS = {"int": "an int", "float": "a float", "bool": "a bool", "str": "a str", "none": "None", "list": "a list"}


def check(project: Project) -> Iterator[Finding]:
    for each in wrong_values(project):
        yield Finding(
            at=each.location,
            message=f"{each.written.rstrip('=')}{')' if '(' in each.written else ''} is {each.type}, but is given {_value(each)}: "
            f"{_effect(each.ros)}{_instead(each)}",
            about=(each.routine.title, each.written),
            apart=(each.routine.title, each.written),
            level=Level.WARNING if each.ros == 1 else None,
        )
    yield from _published(project.code)


def _value(each: WrongValue) -> str:
    if each.kind == "Time":
        return "the Time of rclpy"
    return f"{each.value}, {_KINDS[each.kind]}" if each.value and each.kind != "none" else _KINDS[each.kind]


def _effect(ros: int) -> str:
    if ros == 1:
        return "publishing the message fails"
    return "the line raises AssertionError, and without these checks (off by default since Jazzy) a wrong value is sent"


def _instead(each: WrongValue) -> str:
    if each.kind == "Time":
        return "; append .to_msg()"
    if each.type in ("float32", "float64") and each.kind == "int":
        return f"; write {each.value}.0" if each.value else "; put float() around it"
    if each.kind == "list":
        return "; write floats" if each.type.startswith("float") else ""
    if each.type == "bool" and each.value in ("0", "1"):
        return f"; write {each.value == '1'}"
    if each.type == "string" and each.kind in ("int", "float", "bool"):
        return "; put str() around it"
    return ""


def _published(code: Codebase) -> Iterator[Finding]:
    """Texts and numbers that are published as they are: rclpy takes objects of the message's class alone."""
    for routine, call in calls_of(code, "publish"):
        if not routine.is_python or len(call.args) != 1 or call.receiver is None or code.ros_of(routine.source) != 2:
            continue
        kind = {"str": "a str", "format": "a str", "num": "a number", "bool": "a bool"}.get(str(call.args[0][0]))
        if (
            kind is None
            or any(place.kind == "try" for place in call.around)
            or not _is_publisher(code, routine, call.receiver)
        ):
            continue
        yield Finding(
            at=Location(routine.path, call.line, call.column),
            message=f"publish() is given {kind}: rclpy raises TypeError, for it takes an object of the message's class; make one and "
            "set its field",
            about=(routine.title, "publish"),
            apart=(routine.title, str(call.args[0][1])[:50]),
        )


def _is_publisher(code: Codebase, routine: Routine, receiver: tuple[object, ...]) -> bool:
    """Whether all that the attribute of self is given are publishers of rclpy."""
    owner = owner_of(code, routine) if receiver[0] == "field" and receiver[1][0] == "this" else None  # type: ignore[index]
    values = attribute_values(code, owner, str(receiver[2])) if owner is not None else ()
    made = [value[1][2] if value[0] == "call" and value[1][0] == "field" else "" for _, value in values]
    return bool(made) and set(made) <= {"create_publisher", "create_lifecycle_publisher"}


CHECK = Check(
    id="wrong-field-value",
    summary="Value of another type than the message field.",
    level=Level.ERROR,
    tags=("interfaces", "python"),
    project=check,
)
