# SPDX-License-Identifier: Apache-2.0
"""Calls: into the workspace's functions they are followed, into libraries the API rows and models say what they do."""

from __future__ import annotations

from functools import partial

from haros_ci import syntax
from haros_ci.follow import (
    activation,
    alternatives,
    associated,
    beside,
    call_arguments,
    commands,
    construct,
    dereferenced,
    dynamic,
    expressions,
    follow,
    handles,
    library_calls,
    linear,
    managers,
    members,
    methods,
    opaque_receivers,
    packs,
    partials,
    qt,
    specialisations,
    static_methods,
    static_types,
    twins,
)
from haros_ci.follow.frames import Frame
from haros_ci.follow.libraries import given_away, library
from haros_ci.follow.libraries import objects as library_objects
from haros_ci.follow.ros import api_rows, forwarding, given_nodes, outside_nodes, ros2_parameters
from haros_ci.follow.walk import Walk
from haros_ci.index.types import is_smart_pointer
from haros_ci.model.location import Location
from haros_ci.syntax import Expression
from haros_ci.values import iterators
from haros_ci.values.abstract import (
    NONE,
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

#: What an expression of a pack is for each of its elements.
FOLD = syntax.Name("[fold]")


def call(walk: Walk, frame: Frame, expression: syntax.Call) -> Value:
    """The value of a call, with all that it makes, stores and registers on the way."""
    callee, written, targs = expression.callee, expression.arguments, expression.templates
    location = Location(frame.source.path, expression.line, expression.column)
    receiver: Value | None = None
    receiver_cell: Cell | None = None
    name = ""
    twins.called(walk, callee)
    if callee == FOLD:
        return packs.folded(walk, frame, written[0])
    if type(callee) is syntax.Member:
        name = callee.name
        receiver_cell, receiver = expressions.located(walk, frame, callee.object)
        args = call_arguments.arguments(walk, frame, written)
        if receiver_cell is not None and _is_of_pointer(walk, frame, callee, receiver_cell):
            return library.pointer_method(walk, frame, receiver_cell, name, args, location)
        if isinstance(receiver, Pointer):
            receiver_cell, receiver = receiver.cell, receiver.cell.value
        elif isinstance(receiver, Object) and receiver.name == iterators.ITERATOR:
            of = iterators.pointed(receiver)
            receiver_cell, receiver = (of, of.value) if of is not None else (receiver_cell, receiver)
        if isinstance(receiver, Object) and receiver.name == ros2_parameters.PARAMETER:
            kinds = tuple(walk.type_in(targ, frame) if type(targ) is syntax.Type else targ for targ in targs)
            ros2_parameters.read_as(walk, receiver, name, kinds)
        if isinstance(receiver, Choice) and frame.source.separator == "::":
            receiver = iterators.not_null(receiver)
        elif isinstance(receiver, Choice):
            receiver = iterators.not_none(receiver)
        if isinstance(receiver, Choice):
            ways = [
                partial(method_call, walk, frame, option, cell, name, args, targs, location)
                for option in receiver.options
                for cell in [receiver_cell if isinstance(option, (Known, Text)) else None]
            ]
            settle = (
                partial(alternatives.certain, receiver.options) if alternatives.are(walk, receiver.options) else None
            )
            return walk.either_way(ways, "it is called on one of several objects", settle)
        return method_call(walk, frame, receiver, receiver_cell, name, args, targs, location)
    callee, targs = static_types.member_called(walk, frame, callee, targs)
    of_class, targs = static_methods.of_class(targs)
    function = static_methods.bound(walk, frame, callee, expressions.evaluate(walk, frame, callee), of_class)
    if isinstance(function, Library) and function.name in qt.MACROS:
        return qt.signature(walk, frame, function.name, written)
    if isinstance(function, Pointer):
        function = function.cell.value
    args = call_arguments.arguments(walk, frame, written)
    function = associated.meant(walk, frame, callee, function, args)
    return apply(walk, frame, function, args, targs, location, callee)


def _is_of_pointer(walk: Walk, frame: Frame, callee: syntax.Member, cell: Cell) -> bool:
    """Whether a method is one of the smart pointer in *cell*: ``p.reset()``, and ``it->reset()`` of an iterator over pointers; ``p->reset()`` is the object's."""
    is_one = is_smart_pointer(cell.type) and callee.name in library.pointer_methods(cell.type)
    if not is_one or type(callee.object) is not syntax.Dereference:
        return is_one
    of = callee.object.value
    return isinstance(of, (syntax.Name, syntax.Member)) and expressions.cell_of(walk, frame, of) is not cell


def method_call(  # noqa: C901 - one branch for each kind of receiver, in the order in which they are asked
    walk: Walk,
    frame: Frame,
    receiver: Value,
    cell: Cell | None,
    name: str,
    args: tuple[call_arguments.PassedArgument, ...],
    targs: tuple[syntax.Argument, ...],
    location: Location,
) -> Value:
    """``receiver.name(args)``."""
    if isinstance(receiver, Library) and receiver.name == "super":
        return super_call(walk, frame, name, args, location)
    if isinstance(receiver, Object) and receiver.name.endswith("Executor"):
        if name.startswith(outside_nodes.HANDED):
            outside_nodes.spun(walk, args, location)
        if name.startswith("spin"):
            follow.interlude(walk, frame)
    elif beside.come_while_waiting(walk, name):
        follow.meanwhile(walk, frame)
    if name in managers.METHODS and frame.source.separator == ".":
        return managers.called(walk, frame, receiver, name)
    modelled = library.method(walk, frame, receiver, cell, name, args, location, targs)
    if modelled is not None:
        return modelled
    if isinstance(receiver, Object):
        method = dynamic.as_declared(walk, receiver, cell, name, args) or methods.method_of(walk, receiver, name, args)
        if method is not None:
            specialised = specialisations.specialised(walk, frame, method, targs) if targs else None
            if specialisations.is_missing(specialised):
                return library_calls.of_no_specialisation(walk, frame, method, args, location)
            method = specialised or method
            with forwarding.through(walk, method.function, args, location):
                return activation.invoke(walk, frame, method, args, targs)
        field = receiver.fields.get(name)
        is_method = receiver.definition is None and any(
            f"{owner}{frame.source.separator}{name}" in walk.rows for owner in library_objects.owners(walk, receiver)
        )
        if field is not None and not is_method:
            return apply(walk, frame, field.value, args, targs, location, syntax.Name(name))
        if "::" in name and receiver.definition is not None:
            return _of_base(walk, frame, receiver, name, args, targs, location)
        if frame.source.separator == ".":
            of_class = members.of_class(walk, receiver, name, frame) or members.given(walk, receiver, name, frame)
            if of_class is not None:
                return apply(walk, frame, of_class, args, targs, location, syntax.Name(name))
        if (led := dereferenced.led(walk, frame, receiver)) is not None:
            return method_call(walk, frame, led, None, name, args, targs, location)
        if (found := library_calls.library_method(walk, frame, receiver, name, args, targs, location)) is not None:
            return found
        of_node = outside_nodes.method(walk, frame, receiver, name, args, targs, location)
        if of_node is None:
            given_away.started(walk, name, receiver)
        if of_node is not None:
            return of_node
        given_nodes.to_function(walk, f"{receiver.name}{frame.source.separator}{name}", args, location)
        return library.unknown_call(walk, frame, f"{receiver.name}::{name}", args)
    if isinstance(receiver, Opaque):
        return opaque_receivers.method_call(walk, frame, receiver, cell, name, args, targs, location)
    of = "" if not isinstance(receiver, Library) or receiver.this else handles.by_method(frame, name, args, targs)
    if isinstance(receiver, Library) and of:
        space = walk.opaque(f"what {receiver.name} is is not known", frame, location.line)
        found = api_rows.call(walk, frame, f"{of}::{name}", Object(of, namespace=space), args, targs, location)
        if found is not None:
            return found
    of_member = opaque_receivers.of_member(walk, frame, receiver, name, args, targs, location)
    if of_member is not None:
        return of_member
    of_object = library_calls.of_object(walk, frame, receiver, name, args, targs, location)
    if of_object is not None:
        return of_object
    function = members.attribute(walk, receiver, name, frame)
    return apply(walk, frame, function, args, targs, location, syntax.Name(name))


def _of_base(
    walk: Walk,
    frame: Frame,
    this: Object,
    name: str,
    args: tuple[call_arguments.PassedArgument, ...],
    targs: tuple[syntax.Argument, ...],
    location: Location,
) -> Value:
    """``this->Base::method(args)``: the method of that base class, whatever the object's own is."""
    head, _, last = name.rpartition("::")
    meant = walk.type_in(syntax.Type(head), frame)
    owner = walk.class_of(meant.name, frame.source)
    found = methods.class_method(walk, *owner, last, args) if owner is not None else None
    if found is not None:
        return activation.invoke(walk, frame, Callable(*found, this, templates=this.templates), args, targs)
    inherited = library_calls.inherited_call(walk, frame, this, name, args, targs, location)
    return inherited if inherited is not None else library.unknown_call(walk, frame, f"{this.name}::{name}", args)


def super_call(
    walk: Walk, frame: Frame, name: str, args: tuple[call_arguments.PassedArgument, ...], location: Location
) -> Value:
    """Python's ``super().name(...)``: the method of the next class up, of the workspace or of a library."""
    this = expressions.here(frame)
    function = frame.function
    owner = walk.class_of(function.owner, frame.source) if function is not None and function.owner else None
    if this is None or owner is None:
        return library.unknown_call(walk, frame, f"super().{name}", args)
    entries = linear.above(walk, this.definition, owner[1]) if this.definition is not None else None
    for entry in entries if entries is not None else linear.order(walk, *owner)[1:]:
        if isinstance(entry, str):
            if name == "__init__":
                named = methods.as_node(walk, entry, *owner)
                library_objects.construct_library(walk, frame, this, syntax.Type(named), args, location)
                if named in walk.rows:  # which calls nobody else's
                    return NONE
            continue
        method = methods.own_method(walk, *entry, name)
        if method is not None:
            return activation.invoke(walk, frame, Callable(*method, this), args)
    found = library_calls.library_method(walk, frame, this, name, args, (), location)
    return found if found is not None else library.unknown_call(walk, frame, f"super().{name}", args)


def apply(  # noqa: C901 - one branch for each kind of what is called
    walk: Walk,
    frame: Frame,
    function: Value,
    args: tuple[call_arguments.PassedArgument, ...],
    targs: tuple[syntax.Argument, ...],
    location: Location,
    callee: Expression,
) -> Value:
    """Call *function*, whatever kind of value it is."""
    if function.__class__ in commands.KINDS and frame.source.separator == ".":
        started = commands.run(walk, frame, function, args)
        if started is not None:
            return started
    if isinstance(function, Callable):
        specialised = specialisations.specialised(walk, frame, function, targs)
        if specialisations.is_missing(specialised):
            return library_calls.of_no_specialisation(walk, frame, function, args, location)
        function = specialised or function
        if function.function.body is None and function.function.kind != "constructor":
            source, definition = methods.with_body(walk, [(function.source, function.function)])
            if definition.body is None:
                found = api_rows.call(walk, frame, definition.name, function.this, args, targs, location)
                if found is not None:
                    return found
            function = Callable(source, definition, function.this, function.bound, function.frame, function.templates)
        if _takes_self(function, args):
            this = args[0].value
            assert isinstance(this, Object)
            function = Callable(function.source, function.function, this, function.bound, None, this.templates)
            args = args[1:]
        if specialised is None:
            function = activation.choose(walk, frame, function, args)
        with forwarding.through(walk, function.function, args, location):
            return activation.invoke(walk, frame, function, args, targs)
    if isinstance(function, ClassValue):
        given = tuple(walk.type_in(t, frame) if type(t) is syntax.Type else t for t in targs)
        owner = specialisations.of_class(walk, (function.source, function.definition), given, location)
        if owner is None:
            return walk.opaque(specialisations.OF_CLASS.format(function.definition.name), frame)
        return construct.instance(walk, frame, owner, tuple(t for t in given if type(t) is syntax.Type), args, location)
    if isinstance(function, Library):
        return library_calls.library_call(walk, frame, function, args, targs, location, callee)
    if isinstance(function, Object) and function.name == partials.PARTIAL:
        function, args = partials.called(function, args)
        return apply(walk, frame, function, args, targs, location, callee)
    if isinstance(function, Object):
        method = methods.method_of(walk, function, "operator()" if frame.source.separator == "::" else "__call__")
        if method is not None:
            return activation.invoke(walk, frame, method, args, targs)
    if isinstance(function, Choice):
        meant = iterators.not_none(function)
        if not isinstance(meant, Choice):
            return apply(walk, frame, meant, args, targs, location, callee)
        ways = [partial(apply, walk, frame, option, args, targs, location, callee) for option in function.options]
        return walk.either_way(ways, "one of several functions is called")
    if isinstance(function, Opaque):
        dynamic.function(walk, function, syntax.dotted(callee), location)
    return library.unknown_call(walk, frame, syntax.dotted(callee) or "a function", args)


def _takes_self(function: Callable, args: tuple[call_arguments.PassedArgument, ...]) -> bool:
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


def new(walk: Walk, frame: Frame, expression: syntax.New) -> Value:
    """``new T(...)``: the object itself stands for its address."""
    resolved = walk.type_in(expression.type, frame)
    args = call_arguments.arguments(walk, frame, expression.arguments)
    location = Location(frame.source.path, expression.line, expression.column)
    return given_away.constructed(walk, construct.create(walk, frame, resolved.bare(), args, location))
