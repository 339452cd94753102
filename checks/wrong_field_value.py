# SPDX-License-Identifier: Apache-2.0
"""Python code that gives a field of a message a value of another type than the field has."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Location, Project, syntax
from haros_ci.api.code import Codebase, Routine, attribute_values, calls_of, owner_of, weighed
from haros_ci.api.interfaces import WrongValue, unnamed_values, wrong_values

#: What is published as it is.
_PUBLISHED: dict[type[syntax.Node], str] = {
    syntax.String: "a str",
    syntax.Format: "a str",
    syntax.Number: "a number",
    syntax.Boolean: "a bool",
}
_KINDS = {"int": "an int", "float": "a float", "bool": "a bool", "str": "a str", "none": "None", "list": "a list"}


def check(project: Project) -> Iterator[Finding]:
    yield from weighed(project, _found(project))


def _found(project: Project) -> Iterator[Finding]:
    for wrong_value in wrong_values(project):
        yield Finding(
            at=wrong_value.location,
            message=f"{wrong_value.written.rstrip('=')}{')' if '(' in wrong_value.written else ''} is {wrong_value.type}, but is given {_value(wrong_value)}: "
            f"{_effect(wrong_value)}{_instead(wrong_value)}",
            about=(wrong_value.routine.title, wrong_value.written),
            apart=(wrong_value.routine.title, wrong_value.written),
            level=Level.WARNING if wrong_value.ros == 1 or _is_converted(wrong_value) else None,
        )
    for unnamed in unnamed_values(project):
        some = ", ".join(f"{field}=..." for field in unnamed.fields[: min(unnamed.count, 3)])
        yield Finding(
            at=unnamed.location,
            message=f"{unnamed.maker}() is given {'a value' if unnamed.count == 1 else f'{unnamed.count} values'} without a name: classes of "
            f"messages take fields by name alone in ROS 2, and the line raises TypeError; write {unnamed.maker}({some})",
            about=(unnamed.routine.title, f"{unnamed.maker}("),
            apart=(unnamed.routine.title, f"{unnamed.maker}("),
        )
    yield from _published(project.code)


def _value(wrong_value: WrongValue) -> str:
    if wrong_value.kind == "Time":
        return "the Time of rclpy"
    if _is_converted(wrong_value):
        return "a list that has an int in it"
    return (
        f"{wrong_value.value}, {_KINDS[wrong_value.kind]}"
        if wrong_value.value and wrong_value.kind != "none"
        else _KINDS[wrong_value.kind]
    )


def _is_converted(wrong_value: WrongValue) -> bool:
    """Whether the value is a list with whole numbers for floats: without its assertions, the setter makes floats of them (rosidl_generator_py, _msg.py.em)."""
    return wrong_value.kind == "list" and wrong_value.type.startswith("float") and "[" in wrong_value.type


def _effect(wrong_value: WrongValue) -> str:
    if wrong_value.ros == 1:
        return "publishing the message fails"
    if _is_converted(wrong_value):
        return "the line raises AssertionError up to Iron (since Jazzy with ROS_PYTHON_CHECK_FIELDS=1 alone)"
    return "the line raises AssertionError, and without these checks (off by default since Jazzy) a wrong value is sent"


def _instead(wrong_value: WrongValue) -> str:
    if wrong_value.kind == "Time":
        return "; append .to_msg()"
    if wrong_value.type in ("float32", "float64") and wrong_value.kind == "int":
        return f"; write {wrong_value.value}.0" if wrong_value.value else "; put float() around it"
    if wrong_value.kind == "list":
        return "; write floats (0.0 for 0)" if wrong_value.type.startswith("float") else ""
    if wrong_value.type == "bool" and wrong_value.value in ("0", "1"):
        return f"; write {wrong_value.value == '1'}"
    if wrong_value.type == "string" and wrong_value.kind in ("int", "float", "bool"):
        return "; put str() around it"
    return ""


def _published(code: Codebase) -> Iterator[Finding]:
    """Texts and numbers that are published as they are: rclpy takes objects of the message's class alone."""
    for routine, call in calls_of(code, "publish"):
        if not routine.is_python or len(call.args) != 1 or call.receiver is None or code.ros_of(routine.source) != 2:
            continue
        value = call.args[0]
        kind = _PUBLISHED.get(type(value))
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
            apart=(routine.title, _written(value)[:50]),
        )


def _written(value: syntax.Expression) -> str:
    """What tells *value* from others that are published in the same function."""
    if isinstance(value, syntax.Format):
        return "".join(part.value for part in value.parts if isinstance(part, syntax.String))
    return str(value.value) if isinstance(value, (syntax.String, syntax.Number, syntax.Boolean)) else ""


def _is_publisher(code: Codebase, routine: Routine, receiver: syntax.Expression) -> bool:
    """Whether all that the attribute of self is given are publishers of rclpy."""
    if not isinstance(receiver, syntax.Member) or not isinstance(receiver.object, syntax.This):
        return False
    owner = owner_of(code, routine)
    values = attribute_values(code, owner, receiver.name) if owner is not None else ()
    made = [_method(value) for _, value in values]
    return bool(made) and set(made) <= {"create_publisher", "create_lifecycle_publisher"}


def _method(value: syntax.Expression) -> str:
    """The method of which *value* is a call."""
    return value.callee.name if isinstance(value, syntax.Call) and isinstance(value.callee, syntax.Member) else ""


CHECK = Check(
    id="wrong-field-value",
    summary="Value of another type than the message field.",
    level=Level.ERROR,
    tags=("interfaces", "python"),
    project=check,
)
