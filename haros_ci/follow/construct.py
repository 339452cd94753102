# SPDX-License-Identifier: Apache-2.0
"""Objects: construction with bases and members, variables."""

from __future__ import annotations

from collections.abc import Mapping

from haros_ci import syntax
from haros_ci.follow import (
    activation,
    base_initializers,
    braces,
    call_arguments,
    callbacks,
    conversions,
    converting,
    copies,
    data_classes,
    decorated_classes,
    expressions,
    guarded,
    members,
    methods,
    specialisations,
    template_arguments,
    uncertain,
)
from haros_ci.follow.frames import Frame
from haros_ci.follow.libraries import objects as library_objects
from haros_ci.follow.libraries import optionals, texts, tuples
from haros_ci.follow.walk import Walk
from haros_ci.index.index import Source
from haros_ci.index.ros_types import parameter_type
from haros_ci.index.types import MAPS, NO_TYPE, SEQUENCES, STRINGS, is_smart_pointer, pointee
from haros_ci.model.location import Location
from haros_ci.syntax import Class, Expression, Function, Type
from haros_ci.values.abstract import FALSE, LIST_LIMIT, NONE, Cell, Known, Mapped, Object, Opaque, Sequence, Value

#: So many parts of an object, of its class and of the bases, are constructed.
MOST_PARTS = 64
TOO_MANY = "an object of {} has more than {} base classes: the others are not constructed"
#: Classes of nodes that have functions to make them.
NODES = frozenset(("rclcpp::Node", "rclcpp_lifecycle::LifecycleNode"))


def declare(walk: Walk, frame: Frame, variable: syntax.Variable) -> None:
    """A local variable."""
    name, init = variable.name, variable.init
    resolved = walk.type_in(variable.type, frame)
    location = Location(frame.source.path, variable.line, variable.column)
    value_node = init.value if type(init) is syntax.Equals else None
    if value_node is not None and "&" in resolved.marks:
        cell = expressions.cell_of(walk, frame, value_node)
        if cell is None and "c" not in resolved.marks:
            uncertain.exposed(walk, frame, value_node)
        if cell is not None:
            value = converting.converted(walk, frame, cell.value, resolved, location)
            frame.declare(name, copies.referred(walk, cell, resolved) if value is cell.value else Cell(value, resolved))
            return
    declared = resolved if resolved.name != "auto" else None
    value = initial(walk, frame, resolved, init, location)
    is_call = type(value_node) is syntax.Call
    if is_call and "&" in resolved.marks and walk.references is not None and len(walk.references) == 1:
        frame.declare(name, walk.references[0])
        return
    if init is not None and resolved == syntax.AUTO and isinstance(value, (Object, Sequence, Mapped)):
        declared = copies.static_copy(walk, frame, value_node) if value_node is not None else None
    frame.declare(name, Cell(value, declared))


def initial(walk: Walk, frame: Frame, kind: Type, init: syntax.Init | None, location: Location) -> Value:
    """The first value of a variable of the resolved type *kind*."""
    if type(init) is syntax.Equals:
        is_python = frame.source.program.language == "python"
        in_braces = init.value if type(init.value) is syntax.ListLiteral and not is_python else None
        if in_braces is not None and not braces.is_list(kind) and "*" not in kind.marks:
            return create(walk, frame, kind, braces.arguments(walk, frame, kind, in_braces.items), location)
        walk.references = None
        value = expressions.evaluate(walk, frame, init.value)
        if in_braces is not None and kind.name not in ("auto", ""):
            return braces.from_list(walk, frame, kind, value)
        value = copies.taken(walk, frame, kind, init.value, value)
        if kind.name == "auto" or isinstance(value, Object):
            return converting.converted(walk, frame, value, kind, location)
        is_text = isinstance(value, Known) and issubclass(value.kind, str)
        if is_text and walk.class_of(kind.name, frame.source) is not None:
            return create(walk, frame, kind, (call_arguments.PassedArgument(value),), location)
        if isinstance(value, Sequence):
            return Sequence(value.content, kind if kind.name in SEQUENCES else value.type, value.end)
        return conversions.converted(value, kind)
    arguments = braces.arguments(walk, frame, kind, init.arguments) if init is not None else ()
    braced = init.arguments if type(init) is syntax.Braces and arguments else ()
    is_braced = bool(braced)
    if is_braced and "*" in kind.marks and (len(arguments) > 1 or type(braced[0]) is syntax.ListLiteral):
        return braces.array(walk, frame, [argument.value for argument in arguments], kind)
    if "*" in kind.marks or "&" in kind.marks:
        return arguments[0].value if arguments else NONE
    if is_braced and (kind.name in SEQUENCES or kind.name in MAPS):
        items = Sequence(Cell(tuple(Cell(argument.value) for argument in arguments)))
        return braces.from_list(walk, frame, kind, items)
    return create(walk, frame, kind, arguments, location)


def create(
    walk: Walk, frame: Frame, kind: Type, arguments: tuple[call_arguments.PassedArgument, ...], location: Location
) -> Value:
    """An instance of the resolved type *kind*, constructed from *arguments*."""
    if is_smart_pointer(kind):
        held = optionals.created(walk, frame, kind, arguments, location) if optionals.is_one(kind) else None
        return held or (arguments[0].value if arguments else NONE)
    name = kind.name
    if name in STRINGS:
        return conversions.converted(texts.constructed(arguments), kind)
    if name in SEQUENCES:
        return _vector(walk, frame, kind, arguments)
    if name in MAPS:
        return braces.map_of(walk, frame, kind, arguments)
    if name == tuples.TUPLE.name:
        return arguments[0].value if len(arguments) == 1 and len(kind.arguments) != 1 else tuples.made(arguments)
    if call_arguments.is_scalar(kind):
        if arguments:
            return conversions.converted(arguments[0].value, kind)
        return Opaque("it is not set before", location, kind)
    owner = walk.class_of(name, frame.source)
    owner = specialisations.of_class(walk, owner, kind.arguments, location) if owner is not None else None
    if owner is None:
        return library_objects.library_object(walk, frame, kind, arguments, location)
    return instance(walk, frame, owner, kind.arguments, arguments, location)


#: Objects that a vector is filled with when it is constructed.
OBJECTS = 100
#: What ``T{}`` is of a scalar type (value initialisation).
ZEROS = {"bool": FALSE, "int": Known(0), "double": Known(0.0)}


def of_template(
    walk: Walk, frame: Frame, kind: Type, arguments: tuple[call_arguments.PassedArgument, ...], location: Location
) -> Value:
    """``T{...}`` or ``T(...)`` of the type that a template parameter stands for, and elements that a list is made with."""
    if "*" in kind.marks:
        return arguments[0].value if arguments else NONE
    if not arguments and call_arguments.is_scalar(kind):
        return ZEROS.get(parameter_type(kind) or "", Opaque("its value is not known", location, kind))
    return create(walk, frame, kind, arguments, location)


def _vector(walk: Walk, frame: Frame, kind: Type, arguments: tuple[call_arguments.PassedArgument, ...]) -> Value:
    if not arguments and 0 < (number := tuples.number_of(kind, 1) or 0) <= OBJECTS:
        arguments = (call_arguments.PassedArgument(Known(number)),)
    if not arguments:
        return Sequence(Cell(()), kind)
    first = arguments[0].value
    if isinstance(first, Sequence) and first.type is None and len(arguments) == 1:  # its elements, in braces
        return braces.from_list(walk, frame, kind, first)
    if isinstance(first, Sequence):
        twin = copies.copied(walk, first, kind)
        return Sequence(twin.content, kind) if isinstance(twin, Sequence) else twin
    inner = kind.of(0) or NO_TYPE
    if inner.name in STRINGS and all(braces.is_text(argument) for argument in arguments):
        items = Sequence(Cell(tuple(Cell(argument.value) for argument in arguments)))
        return braces.from_list(walk, frame, kind, items)  # no other constructor takes texts
    if len(arguments) > 3:  # nor so many
        return braces.braced(walk, frame, kind, [argument.value for argument in arguments])
    begin = create if tuples.is_unset(kind, inner) else of_template
    fill = arguments[1].value if len(arguments) > 1 else None
    within = fill.content.value if isinstance(fill, Sequence) else ()
    most = LIST_LIMIT // max(1, len(within) if isinstance(within, tuple) else 1)
    if walk.class_of(inner.name, frame.source) is not None:
        most = min(most, OBJECTS)
    if isinstance(first, Known) and issubclass(first.kind, int) and 0 <= first.of(int) <= most:
        cells = []
        for _ in range(first.of(int)):
            value = copies.copied(walk, fill, inner) if fill is not None else None
            start = value if value is not None else begin(walk, frame, inner, (), Location(frame.source.path))
            cells.append(Cell(start, inner))
        return Sequence(Cell(tuple(cells)), kind)
    return Sequence(Cell(walk.opaque("a list of unknown length", frame)), kind)


def made_by_its_class(
    walk: Walk,
    frame: Frame,
    callee: Expression,
    kinds: tuple[syntax.Argument, ...],
    args: tuple[call_arguments.PassedArgument, ...],
    location: Location,
) -> Value | None:
    """``C::make_shared(args)`` for a class of the workspace, as RCLCPP_SMART_PTR_DEFINITIONS defines it (rclcpp/macros.hpp).

    A node's class has the one of ``rclcpp::Node``, which makes no object of it, unless it defines its own: None.
    """
    if type(callee) is not syntax.Name or not callee.name.endswith(("::make_shared", "::make_unique")):
        return None
    kind = walk.type_in(syntax.Type(callee.name.rpartition("::")[0], kinds), frame)
    owner = walk.class_of(kind.name, frame.source)
    if owner is None or any(base in NODES for base in methods.library_bases(walk, *owner)):
        return None
    return create(walk, frame, syntax.Type(kind.name, kind.arguments or kinds), args, location)


def instance(
    walk: Walk,
    frame: Frame,
    owner: tuple[Source, Class],
    targs: tuple[syntax.Argument, ...],
    arguments: tuple[call_arguments.PassedArgument, ...],
    location: Location,
) -> Value:
    """A new object of a workspace's class: bases, then members in their order, then the constructor's body."""
    source, definition = owner = decorated_classes.in_place_of(walk, owner) if owner[1].decorators else owner
    if source.program.language != "python" and len(arguments) == 1:
        twin = copies.duplicate(walk, owner, arguments[0])
        if twin is not None:
            return twin
    templates = dict(zip(definition.templates, targs, strict=False))
    this = Object(definition.name, tuple(targs), owner, location=location, templates=templates)
    if source.program.language == "python":
        python_construct(walk, frame, this, arguments, location)
        return this
    initialise(walk, frame, this, owner, templates, arguments, location)
    callbacks.framework_entries(walk, this)
    return this


def initialise(  # noqa: C901 - the steps of [class.base.init], in its order
    walk: Walk,
    frame: Frame,
    this: Object,
    owner: tuple[Source, Class],
    templates: Mapping[str, syntax.Argument],
    arguments: tuple[call_arguments.PassedArgument, ...],
    location: Location,
    parts: list[Class] | None = None,
    chosen: tuple[Source, Function] | None = None,
) -> None:
    """Construct the part of *this* that *owner* declares, by the *chosen* constructor or else by the one that fits.

    *parts* are the classes of which the object has been given its part, once for every way that leads to them.
    """
    source, definition = owner
    parts = [] if parts is None else parts
    parts.append(definition)
    if len(parts) > MOST_PARTS:
        walk.gaps.setdefault(TOO_MANY.format(this.name, MOST_PARTS), location)
        return
    if walk.index.trace is not None:
        walk.index.trace.paths.add(source.path)
    short = definition.name.rpartition("::")[2]
    found = chosen or methods.own_method(walk, source, definition, short, arguments)
    where, function = found if found is not None else (source, None)
    if function is not None:
        templates = template_arguments.defaulted(walk, where, definition.name, function, templates, arguments)
    inner = Frame(where, definition.name, function, this, templates=templates, mark=walk.state.mark())
    inits: dict[str, syntax.Initializer] = {}
    body_at = location
    if function is not None:
        activation.bind(walk, frame, inner, function, arguments)
        for init in function.inits:
            inits[init.name.rpartition("::")[2]] = init
        if function.body is not None:
            body_at = Location(where.path, function.body_line, function.body_column)
        if short in inits and not base_initializers.is_of_base(
            walk, inner, function, definition.name
        ):  # delegates to another constructor
            args = call_arguments.arguments(walk, inner, inits[short].arguments)
            other = methods.other_constructor(walk, source, definition, function, args)
            if other is not None:
                initialise(walk, inner, this, owner, templates, args, location, parts, other)
            if function.body is not None:
                activation.follow_body(walk, inner, function)
            return
    bases = walk.bases(source, definition, templates)
    passed = list(arguments) if function is None and not bases else []  # an aggregate
    for base in bases:
        base_init = inits.get(base.name.rpartition("::")[2]) or base_initializers.by_another_name(
            walk, inner, definition, base.name
        )
        args = call_arguments.arguments(walk, inner, base_init.arguments) if base_init else ()
        if function is None and base is bases[0]:  # constructors are inherited
            args = arguments
        base_owner = walk.class_of(base.name, source)
        if base_owner is not None and base_owner[1] is not definition:
            bound = dict(zip(base_owner[1].templates, base.arguments, strict=False))
            initialise(walk, inner, this, base_owner, bound, args, body_at, parts)
        elif base_owner is None:
            library_objects.construct_library(walk, inner, this, base, args, body_at)
    declared = Frame(source, definition.name, None, this, templates=templates)
    for member in definition.fields:
        if member.is_static:
            continue
        kind = walk.type_in(member.type, declared)
        cell = this.fields[member.name] = members.of_object(this, member.name, kind)
        if passed:
            cell.value = braces.fitted(walk, declared, kind, passed.pop(0).value)
        elif member.name in inits:
            own = inits[member.name]
            is_one = "&" in kind.marks and len(own.arguments) == 1
            referred = expressions.cell_of(walk, inner, own.arguments[0]) if is_one else None
            if referred is not None:
                this.fields[member.name] = referred
                continue
            start = _as_value(kind, own.arguments)
            with guarded.under(walk, where.path, own.guards):
                cell.value = initial(walk, inner, kind, start, Location(where.path, own.line, own.column))
        elif member.init is not None:
            cell.value = initial(walk, declared, kind, member.init, Location(source.path, member.line, member.column))
        elif "*" in kind.marks or "&" in kind.marks:
            cell.value = walk.opaque(members.UNSET.format(member.name), declared, member.line, pointee(kind))
        elif not call_arguments.is_scalar(kind):
            at = body_at if function is not None else Location(source.path, member.line, member.column)
            cell.value = initial(walk, declared, kind, None, at)
        else:
            cell.value = Opaque(members.UNSET.format(member.name), Location(source.path, member.line), kind)
    if function is not None and function.body is not None:
        activation.follow_body(walk, inner, function)


def _as_value(kind: Type, arguments: tuple[Expression, ...]) -> syntax.Init:
    """``m(x)`` for a scalar, pointer or reference is ``m = x``."""
    if len(arguments) == 1 and ("*" in kind.marks or "&" in kind.marks or call_arguments.is_scalar(kind)):
        return syntax.Equals(arguments[0])
    return syntax.Parentheses(arguments)


def python_construct(
    walk: Walk, frame: Frame, this: Object, arguments: tuple[call_arguments.PassedArgument, ...], location: Location
) -> None:
    """``__init__``, and the constructors of libraries' base classes."""
    assert this.definition is not None
    source, definition = this.definition
    method = methods.method_of(walk, this, "__init__")
    if method is not None:
        activation.invoke(walk, frame, method, arguments)
    else:
        data_classes.construct(walk, frame, this, arguments)
    for base in methods.library_bases(walk, source, definition) if method is None else ():
        library_objects.construct_library(walk, frame, this, syntax.Type(base), arguments, location)
    callbacks.framework_entries(walk, this)
