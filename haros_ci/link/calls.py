# SPDX-License-Identifier: Apache-2.0
"""Calls: into the workspace's functions they are followed, into libraries the API rows and models say what they do."""

from __future__ import annotations

from functools import partial
from typing import Any

from haros_ci.link import (
    activation,
    api_rows,
    call_arguments,
    construct,
    expressions,
    follow,
    library,
    library_objects,
    members,
    methods,
)
from haros_ci.link.run import Frame, Run
from haros_ci.link.types import MAPS, SEQUENCES, STRINGS, is_smart_pointer, is_type, pointee
from haros_ci.link.values import (
    Callable,
    Cell,
    Choice,
    ClassValue,
    Known,
    Library,
    Object,
    Opaque,
    Pointer,
    Text,
    Value,
)
from haros_ci.model.location import Location
from haros_ci.model.program import Expression


def call(run: Run, frame: Frame, expression: Expression) -> Value:
    """The value of a call, with all that it makes, stores and registers on the way."""
    _, callee, written, targs, line, column = expression
    location = Location(frame.source.path, line, column)
    receiver: Value | None = None
    receiver_cell: Cell | None = None
    name = ""
    if callee[0] == "field":
        name = callee[2]
        receiver_cell = expressions.cell_of(run, frame, callee[1]) if callee[1][0] in call_arguments.LVALUES else None
        if receiver_cell is not None:
            receiver = receiver_cell.value
        else:
            receiver = expressions.evaluate(run, frame, callee[1])
        smart = receiver_cell is not None and is_smart_pointer(receiver_cell.type)
        args = call_arguments.arguments(run, frame, written)
        if smart and receiver_cell is not None and name in library.POINTER_METHODS:
            return library.pointer_method(run, receiver_cell, name, args)
        if isinstance(receiver, Pointer):
            receiver_cell, receiver = receiver.cell, receiver.cell.value
        if isinstance(receiver, Choice):
            ways = [
                partial(method_call, run, frame, option, cell, name, args, targs, location)
                for option in receiver.options
                for cell in [receiver_cell if isinstance(option, (Known, Text)) else None]
            ]
            return run.either_way(ways, "it is called on one of several objects")
        return method_call(run, frame, receiver, receiver_cell, name, args, targs, location)
    function = expressions.evaluate(run, frame, callee)
    if isinstance(function, Pointer):
        function = function.cell.value
    return apply(run, frame, function, call_arguments.arguments(run, frame, written), targs, location, callee)


def method_call(
    run: Run,
    frame: Frame,
    receiver: Value,
    cell: Cell | None,
    name: str,
    args: tuple[call_arguments.Argument, ...],
    targs: Any,
    location: Location,
) -> Value:
    """``receiver.name(args)``."""
    if isinstance(receiver, Library) and receiver.name == "super":
        return super_call(run, frame, name, args, location)
    modelled = library.method(run, frame, receiver, cell, name, args, location)
    if modelled is not None:
        return modelled
    if isinstance(receiver, Object):
        method = methods.method_of(run, receiver, name, args)
        if method is not None:
            return activation.invoke(run, frame, method, args, location, targs)
        field = receiver.fields.get(name)
        if field is not None:
            return apply(run, frame, field.value, args, targs, location, ("name", name))
        for owner in library_objects.owners(run, receiver):
            found = api_rows.call(run, frame, f"{owner}{frame.source.separator}{name}", receiver, args, targs, location)
            if found is not None:
                return found
        return library.unknown_call(run, frame, f"{receiver.name}::{name}", args)
    if isinstance(receiver, Opaque):
        kind = receiver.type or (cell.type if cell is not None else None)
        if kind is not None and kind[0]:
            kind = pointee(kind)
            owner_class = run.class_of(kind[0], frame.source)
            if owner_class is not None:
                summary = library_objects.summary_object(run, owner_class, kind, receiver)
                if methods.method_of(run, summary, name, args) is not None:
                    return method_call(run, frame, summary, None, name, args, targs, location)
            else:
                stand_in = Object(kind[0], kind[1], namespace=receiver if kind[0] in api_rows.HANDLES else None)
                for owner in library_objects.owners(run, stand_in):
                    found = api_rows.call(
                        run, frame, f"{owner}{frame.source.separator}{name}", stand_in, args, targs, location
                    )
                    if found is not None:
                        return found
        elif name in api_rows.UNMISTAKABLE and frame.source.program.language != "python":
            stand_in = Object("ros::NodeHandle", namespace=receiver)
            found = api_rows.call(run, frame, f"ros::NodeHandle::{name}", stand_in, args, targs, location)
            if found is not None:
                return found
        return library.unknown_call(run, frame, name, args, receiver)
    function = members.attribute(run, receiver, name, frame)
    return apply(run, frame, function, args, targs, location, ("name", name))


def super_call(
    run: Run, frame: Frame, name: str, args: tuple[call_arguments.Argument, ...], location: Location
) -> Value:
    """Python's ``super().name(...)``: the method of the next class up, of the workspace or of a library."""
    this = expressions.here(frame)
    function = frame.function
    owner = run.class_of(function.owner, frame.source) if function is not None and function.owner else None
    if this is None or owner is None:
        return library.unknown_call(run, frame, f"super().{name}", args)
    for base in owner[1].bases:
        found = methods.python_class(run, base, owner[0])
        if found is None:
            if name == "__init__":
                for library_base in methods.library_bases(run, *owner):
                    library_objects.construct_library(run, frame, this, (library_base, (), ""), args, location)
            continue
        method = methods.class_method(run, *found, name)
        if method is not None:
            return activation.invoke(run, frame, Callable(*method, this), args, location)
    return library.unknown_call(run, frame, f"super().{name}", args)


def apply(
    run: Run,
    frame: Frame,
    function: Value,
    args: tuple[call_arguments.Argument, ...],
    targs: Any,
    location: Location,
    callee: Any,
) -> Value:
    """Call *function*, whatever kind of value it is."""
    if isinstance(function, Callable):
        if function.function.body is None and function.function.kind != "constructor":
            source, definition = methods.with_body(run, [(function.source, function.function)])
            if definition.body is None:
                found = api_rows.call(run, frame, definition.name, function.this, args, targs, location)
                if found is not None:
                    return found
            function = Callable(source, definition, function.this, function.bound, function.frame, function.templates)
        if _takes_self(function, args):
            this = args[0].value
            assert isinstance(this, Object)
            function = Callable(function.source, function.function, this, function.bound, None, this.templates)
            args = args[1:]
        return activation.invoke(run, frame, activation.choose(run, frame, function, args), args, location, targs)
    if isinstance(function, ClassValue):
        owner = (function.source, function.definition)
        resolved = tuple(run.type_in(t, frame) for t in targs if isinstance(t, (tuple, list)) and len(t) == 3)
        return construct.instance(run, frame, owner, resolved, args, location)
    if isinstance(function, Library):
        return library_call(run, frame, function, args, targs, location, callee)
    if isinstance(function, Object):
        method = methods.method_of(run, function, "operator()" if frame.source.separator == "::" else "__call__")
        if method is not None:
            return activation.invoke(run, frame, method, args, location, targs)
    if isinstance(function, Choice):
        ways = [partial(apply, run, frame, option, args, targs, location, callee) for option in function.options]
        return run.either_way(ways, "one of several functions is called")
    return library.unknown_call(run, frame, members.dotted(callee) or "a function", args)


def _takes_self(function: Callable, args: tuple[call_arguments.Argument, ...]) -> bool:
    """Whether this is ``Base.method(self, ...)`` of Python."""
    definition = function.function
    return (
        function.source.program.language == "python"
        and function.this is None
        and bool(definition.owner)
        and not definition.is_static
        and bool(args)
        and isinstance(args[0].value, Object)
    )


#: Functions in which callbacks are called.
SPINNING = frozenset(
    "ros::spin ros::spinOnce ros::waitForShutdown rospy.spin rospy.sleep rospy.wait_for_message rospy.wait_for_service".split()
)


def library_call(
    run: Run,
    frame: Frame,
    function: Library,
    args: tuple[call_arguments.Argument, ...],
    targs: Any,
    location: Location,
    callee: Any,
) -> Value:
    """A function, method or constructor of a library."""
    name = function.name
    if name in SPINNING:
        follow.interlude(run, frame)
    if function.this is None and frame.this is not None and callee[0] == "name" and "::" not in callee[1]:
        for owner in library_objects.owners(run, frame.this):  # an inherited method without ``this->``
            found = api_rows.call(run, frame, f"{owner}::{callee[1]}", frame.this, args, targs, location)
            if found is not None:
                return found
    modelled = library.function(run, frame, name, args, targs, location)
    if modelled is not None:
        return modelled
    kinds = tuple(run.type_in(t, frame) if is_type(t) else t for t in targs)
    found = api_rows.call(run, frame, name, function.this, args, targs, location, kinds)
    if found is not None:
        return found
    if name in STRINGS or name in SEQUENCES or name in MAPS:
        return construct.create(run, frame, (name, kinds, ""), args, location)
    modelled = library.instance(run, frame, (name, kinds, ""), args)
    if modelled is not None:
        return modelled
    if callee[0] == "name" and "::" not in name and frame.source.separator == "::":
        resolved = run.type_in((callee[1], tuple(targs), ""), frame)
        if resolved[0] != name or is_smart_pointer(resolved) or resolved[0] in STRINGS:
            return construct.create(run, frame, resolved, args, location)
    return library.unknown_call(run, frame, name, args)


def new(run: Run, frame: Frame, expression: Expression) -> Value:
    """``new T(...)``: the object itself stands for its address."""
    _, kind, written, line, column = expression
    resolved = run.type_in(kind, frame)
    return construct.create(
        run,
        frame,
        (resolved[0], resolved[1], ""),
        call_arguments.arguments(run, frame, written),
        Location(frame.source.path, line, column),
    )
