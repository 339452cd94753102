# SPDX-License-Identifier: Apache-2.0
"""Implicit conversions of C++ between classes: ``Talker t = nh;``, arguments and what is returned ([class.conv]).

A constructor with one parameter of the object's class makes the other one, or a conversion function of the object does (``operator std::string()``).
"""

from __future__ import annotations

from haros_ci.follow import activation, call_arguments, construct, conversions
from haros_ci.follow.frames import Frame
from haros_ci.follow.walk import Walk
from haros_ci.index.types import STRINGS, is_smart_pointer
from haros_ci.model.location import Location
from haros_ci.syntax import Function, Type
from haros_ci.values.abstract import Callable, Object, Value

OPERATOR = "operator "


def converted(walk: Walk, frame: Frame, value: Value, kind: Type, location: Location) -> Value:
    """*value* where a variable of the resolved type *kind* begins with it: an object of another class is converted, all else stays."""
    if not isinstance(value, Object) or frame.source.separator != "::" or kind.name in ("", "auto", value.name):
        return value
    is_changed = "&" in kind.marks and not kind.marks.rstrip("&").endswith("c")
    if "*" in kind.marks or is_changed or is_smart_pointer(kind):
        return value
    if walk.class_of(kind.name, frame.source) is not None:
        if any(_takes(walk, frame, function, value) for _, function in _constructors(walk, kind.name)):
            return construct.create(walk, frame, kind.bare(), (call_arguments.PassedArgument(value),), location)
    elif kind.name not in STRINGS and not call_arguments.is_scalar(kind) and value.definition is None:
        return value
    function = _function(walk, value, kind)
    return activation.invoke(walk, frame, function, ()) if function is not None else value


def _constructors(walk: Walk, name: str) -> list[tuple[object, Function]]:
    return list(walk.index.functions.get(f"{name}::{name.rpartition('::')[2]}", ()))


def _takes(walk: Walk, frame: Frame, function: Function, value: Object) -> bool:
    """Whether a constructor can be called with *value* alone, whose class its parameter has."""
    parameters = function.parameters
    if not parameters or any(parameter.default is None for parameter in parameters[1:]):
        return False
    kind = walk.type_in(parameters[0].type, Frame(frame.source, function.owner, function))
    return (conversions.smart(kind) or kind).name == value.name


def _function(walk: Walk, value: Object, kind: Type) -> Callable | None:
    """The conversion function of an object's class that gives *kind*."""
    if value.definition is None:
        return None
    source, definition = value.definition
    head = f"{definition.name}::{OPERATOR}"
    for function in source.program.functions:
        if function.name.startswith(head) and function.body is not None:
            given = walk.type_in(Type(function.name[len(head) :]), Frame(source, definition.name, function))
            if given.name == kind.name or (given.name in STRINGS and kind.name in STRINGS):
                return Callable(source, function, value, templates=value.templates)
    return None
