# SPDX-License-Identifier: Apache-2.0
"""Objects: construction with bases and members, variables."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from haros_ci.link import (
    activation,
    braces,
    call_arguments,
    callbacks,
    conversions,
    copies,
    expressions,
    library_objects,
    methods,
    texts,
    uncertain,
)
from haros_ci.link.index import Source
from haros_ci.link.run import Frame, Run
from haros_ci.link.types import MAPS, NO_TYPE, SEQUENCES, STRINGS, is_smart_pointer, parameter_type, pointee
from haros_ci.link.values import FALSE, LIST_LIMIT, NONE, Cell, Known, Mapped, Object, Opaque, Sequence, Value
from haros_ci.model.location import Location
from haros_ci.model.program import Class, Expression, Function, Type

#: Classes of nodes that have functions to make them.
NODES = frozenset(("rclcpp::Node", "rclcpp_lifecycle::LifecycleNode"))


def declare(run: Run, frame: Frame, name: str, kind: Type, init: Any, line: int, column: int) -> None:
    """A local variable."""
    resolved = run.type_in(kind, frame)
    location = Location(frame.source.path, line, column)
    if init is not None and init[0] == "=" and "&" in resolved[2]:
        cell = expressions.cell_of(run, frame, init[1])
        if cell is None and "c" not in resolved[2]:
            uncertain.exposed(run, frame, init[1])
        if cell is not None:
            frame.declare(name, cell)
            return
    declared = resolved if resolved[0] != "auto" else None
    value = initial(run, frame, resolved, init, location)
    is_call = init is not None and init[0] == "=" and init[1][0] == "call"
    if is_call and "&" in resolved[2] and run.references is not None and len(run.references) == 1:
        frame.declare(name, run.references[0])
        return
    if init is not None and resolved == ("auto", (), "") and isinstance(value, (Object, Sequence, Mapped)):
        declared = copies.static_copy(run, frame, init[1]) if init[0] == "=" else None
    frame.declare(name, Cell(value, declared))


def copied(run: Run, value: Value, kind: Type | None) -> Value:
    """*value* as another variable of static type *kind* holds it in C++ (see ``copies.copied``)."""
    return copies.copied(run, value, kind)


def initial(run: Run, frame: Frame, kind: Type, init: Any, location: Location) -> Value:
    """The first value of a variable of the resolved type *kind*."""
    if init is not None and init[0] == "=":
        is_python = frame.source.program.language == "python"
        if init[1][0] == "list" and not is_python and not _is_list(kind) and "*" not in kind[2]:
            return create(run, frame, kind, call_arguments.arguments(run, frame, init[1][1]), location)
        run.references = None
        value = expressions.evaluate(run, frame, init[1])
        if init[1][0] == "list" and not is_python and kind[0] not in ("auto", ""):
            return braces.from_list(run, frame, kind, value)
        value = copies.taken(run, frame, kind, init[1], value)
        if kind[0] == "auto" or isinstance(value, Object):
            return value
        if (
            isinstance(value, Known)
            and isinstance(value.value, str)
            and run.class_of(kind[0], frame.source) is not None
        ):
            return create(run, frame, kind, (call_arguments.Argument(value),), location)
        if isinstance(value, Sequence):
            return Sequence(value.content, kind if kind[0] in SEQUENCES else value.type, value.end)
        return conversions.converted(value, kind)
    arguments = call_arguments.arguments(run, frame, init[1]) if init is not None else ()
    is_braced = init is not None and init[0] == "{" and bool(arguments)
    if is_braced and "*" in kind[2] and (len(arguments) > 1 or init[1][0][0] == "list"):
        return braces.array(run, frame, [argument.value for argument in arguments], kind)
    if "*" in kind[2] or "&" in kind[2]:
        return arguments[0].value if arguments else NONE
    if is_braced and (kind[0] in SEQUENCES or kind[0] in MAPS):
        items = Sequence(Cell(tuple(Cell(argument.value) for argument in arguments)))
        return braces.from_list(run, frame, kind, items)
    return create(run, frame, kind, arguments, location)


def _is_list(kind: Type) -> bool:
    return kind[0] in SEQUENCES or kind[0] in MAPS or kind[0] in ("auto", "")


def create(
    run: Run, frame: Frame, kind: Type, arguments: tuple[call_arguments.Argument, ...], location: Location
) -> Value:
    """An instance of the resolved type *kind*, constructed from *arguments*."""
    if is_smart_pointer(kind):
        return arguments[0].value if arguments else NONE
    name = kind[0]
    if name in STRINGS:
        return conversions.converted(texts.constructed(arguments), kind)
    if name in SEQUENCES:
        return _vector(run, frame, kind, arguments)
    if name in MAPS:
        given = arguments[0].value if arguments else Mapped(Cell({}))
        if not isinstance(given, Mapped):
            return Mapped(Cell(run.opaque("a map that is built in a way that is not followed", frame)))
        return copies.copied(run, given, kind)
    if call_arguments.is_scalar(kind):
        if arguments:
            return conversions.converted(arguments[0].value, kind)
        return Opaque("it is not set before", location, kind)
    owner = run.class_of(name, frame.source)
    if owner is None:
        return library_objects.library_object(run, frame, kind, arguments, location)
    return instance(run, frame, owner, kind[1], arguments, location)


#: Objects that a vector is filled with when it is constructed.
OBJECTS = 100
#: What ``T{}`` is of a scalar type (value initialisation).
ZEROS = {"bool": FALSE, "int": Known(0), "double": Known(0.0)}


def of_template(
    run: Run, frame: Frame, kind: Type, arguments: tuple[call_arguments.Argument, ...], location: Location
) -> Value:
    """``T{...}`` or ``T(...)`` of the type that a template parameter stands for."""
    if "*" in kind[2]:
        return arguments[0].value if arguments else NONE
    if not arguments and call_arguments.is_scalar(kind):
        return ZEROS.get(parameter_type(kind) or "", Opaque("its value is not known", location, kind))
    return create(run, frame, kind, arguments, location)


def _vector(run: Run, frame: Frame, kind: Type, arguments: tuple[call_arguments.Argument, ...]) -> Value:
    if not arguments:
        return Sequence(Cell(()), kind)
    first = arguments[0].value
    if isinstance(first, Sequence):
        twin = copies.copied(run, first, kind)
        return Sequence(twin.content, kind) if isinstance(twin, Sequence) else twin
    if kind[1] and kind[1][0][0] in STRINGS and all(braces.is_text(argument) for argument in arguments):
        items = Sequence(
            Cell(tuple(Cell(argument.value) for argument in arguments))
        )  # no other constructor takes texts
        return braces.from_list(run, frame, kind, items)
    fill = arguments[1].value if len(arguments) > 1 else None
    inner = kind[1][0] if kind[1] else NO_TYPE
    within = fill.content.value if isinstance(fill, Sequence) else ()
    most = LIST_LIMIT // max(1, len(within) if isinstance(within, tuple) else 1)
    if run.class_of(inner[0], frame.source) is not None:
        most = min(most, OBJECTS)
    if isinstance(first, Known) and isinstance(first.value, int) and 0 <= first.value <= most:
        cells = []
        for _ in range(first.value):
            given = copies.copied(run, fill, inner) if fill is not None else None
            start = given if given is not None else create(run, frame, inner, (), Location(frame.source.path))
            cells.append(Cell(start, inner))
        return Sequence(Cell(tuple(cells)), kind)
    return Sequence(Cell(run.opaque("a list of unknown length", frame)), kind)


def made_by_its_class(
    run: Run,
    frame: Frame,
    callee: Expression,
    kinds: tuple[Any, ...],
    args: tuple[call_arguments.Argument, ...],
    location: Location,
) -> Value | None:
    """``C::make_shared(args)`` for a class of the workspace, as RCLCPP_SMART_PTR_DEFINITIONS defines it (rclcpp/macros.hpp).

    A node's class has the one of ``rclcpp::Node``, which makes no object of it, unless it defines its own: None.
    """
    if callee[0] != "name" or not callee[1].endswith(("::make_shared", "::make_unique")):
        return None
    kind = run.type_in((callee[1].rpartition("::")[0], kinds, ""), frame)
    owner = run.class_of(kind[0], frame.source)
    if owner is None or any(base in NODES for base in methods.library_bases(run, *owner)):
        return None
    return create(run, frame, (kind[0], kind[1] or kinds, ""), args, location)


def instance(
    run: Run,
    frame: Frame,
    owner: tuple[Source, Class],
    targs: tuple[Any, ...],
    arguments: tuple[call_arguments.Argument, ...],
    location: Location,
) -> Value:
    """A new object of a workspace's class: bases, then members in their order, then the constructor's body."""
    source, definition = owner
    if source.program.language != "python" and len(arguments) == 1:
        twin = copies.duplicate(run, owner, arguments[0])
        if twin is not None:
            return twin
    templates = dict(zip(definition.templates, targs, strict=False))
    this = Object(definition.name, tuple(targs), owner, location=location, templates=templates)
    if source.program.language == "python":
        python_construct(run, frame, this, arguments, location)
        return this
    initialise(run, frame, this, owner, templates, arguments, location)
    callbacks.framework_entries(run, this)
    return this


def initialise(
    run: Run,
    frame: Frame,
    this: Object,
    owner: tuple[Source, Class],
    templates: Mapping[str, Type],
    arguments: tuple[call_arguments.Argument, ...],
    location: Location,
    depth: int = 0,
    chosen: tuple[Source, Function] | None = None,
) -> None:
    """Construct the part of *this* that *owner* declares, by the *chosen* constructor or else by the one that fits."""
    source, definition = owner
    if run.index.trace is not None:
        run.index.trace.paths.add(source.path)
    short = definition.name.rpartition("::")[2]
    found = chosen or methods.class_method(run, source, definition, short, arguments, methods.BASES)
    where, function = found if found is not None else (source, None)
    inner = Frame(where, definition.name, function, this, templates=templates, mark=run.state.mark())
    inits: dict[str, Any] = {}
    body_at = location
    if function is not None:
        activation.bind(run, frame, inner, function, arguments)
        for name, kind, args, line, column in function.inits:
            inits[name.rpartition("::")[2]] = (kind, args, line, column)
        if function.body is not None:
            body_at = Location(where.path, function.body_line, function.body_column)
        if short in inits and not _is_of_base(
            run, inner, function, definition.name
        ):  # delegates to another constructor
            args = call_arguments.arguments(run, inner, inits[short][1])
            if depth < methods.BASES:
                initialise(run, inner, this, owner, templates, args, location, depth + 1)
            if function.body is not None:
                activation.follow_body(run, inner, function)
            return
    if depth > methods.BASES:
        return
    bases = run.bases(source, definition, templates)
    given = list(arguments) if function is None and not bases else []  # an aggregate
    for base in bases:
        base_init = inits.get(base[0].rpartition("::")[2]) or _by_another_name(run, inner, definition, base[0])
        args = call_arguments.arguments(run, inner, base_init[1]) if base_init else ()
        if function is None and base is bases[0]:  # constructors are inherited
            args = arguments
        base_owner = run.class_of(base[0], source)
        if base_owner is not None and base_owner[1] is not definition:
            bound = dict(zip(base_owner[1].templates, base[1], strict=False))
            initialise(run, inner, this, base_owner, bound, args, body_at, depth + 1)
        elif base_owner is None:
            library_objects.construct_library(run, inner, this, base, args, body_at)
    declared = Frame(source, definition.name, None, this, templates=templates)
    for member in definition.fields:
        if member.is_static:
            continue
        kind = run.type_in(member.type, declared)
        cell = this.fields[member.name] = Cell(NONE, kind)
        if given:
            cell.value = braces.fitted(run, declared, kind, given.pop(0).value)
        elif member.name in inits:
            _, args, line, column = inits[member.name]
            referred = expressions.cell_of(run, inner, args[0]) if "&" in kind[2] and len(args) == 1 else None
            if referred is not None:
                this.fields[member.name] = referred
                continue
            start = ("(", args)
            cell.value = initial(run, inner, kind, _as_value(kind, start), Location(where.path, line, column))
        elif member.init is not None:
            cell.value = initial(run, declared, kind, member.init, Location(source.path, member.line, member.column))
        elif "*" in kind[2] or "&" in kind[2]:
            cell.value = run.opaque(f"the member {member.name} is not set before", declared, member.line, pointee(kind))
        elif not call_arguments.is_scalar(kind):
            at = body_at if function is not None else Location(source.path, member.line, member.column)
            cell.value = initial(run, declared, kind, None, at)
        else:
            cell.value = Opaque(f"the member {member.name} is not set before", Location(source.path, member.line), kind)
    if function is not None and function.body is not None:
        activation.follow_body(run, inner, function)


def _by_another_name(run: Run, inner: Frame, definition: Class, base: str) -> Any:
    """The initialiser of a *base* under an alias or macro: ``Base(name)`` where ``using Base = rclcpp::Node``."""
    members = {member.name for member in definition.fields}
    for name, kind, args, line, column in inner.function.inits if inner.function is not None else ():
        if name not in members and run.type_in(kind if kind[0] else (name, (), ""), inner)[0] == base:
            return kind, args, line, column
    return None


def _is_of_base(run: Run, inner: Frame, function: Function, name: str) -> bool:
    """Whether what a constructor initialises under the last part of its own class's *name* is a base of that name."""
    last = name.rpartition("::")[2]
    written = next(init for init in function.inits if init[0].rpartition("::")[2] == last)
    qualified = written[0] if "::" in written[0] else written[1][0]
    head = qualified.rpartition("::")[0].partition("<")[0]
    if head.rpartition("::")[2] == last:  # C::C, C<T>::C
        qualified = head
    return "::" in qualified and run.type_in((qualified, (), ""), inner)[0] != name


def _as_value(kind: Type, start: Any) -> Any:
    """``m(x)`` for a scalar, pointer or reference is ``m = x``."""
    if len(start[1]) == 1 and ("*" in kind[2] or "&" in kind[2] or call_arguments.is_scalar(kind)):
        return ("=", start[1][0])
    return start


def python_construct(
    run: Run, frame: Frame, this: Object, arguments: tuple[call_arguments.Argument, ...], location: Location
) -> None:
    """``__init__``, and the constructors of libraries' base classes."""
    source, definition = this.definition
    method = methods.method_of(run, this, "__init__")
    if method is not None:
        activation.invoke(run, frame, method, arguments)
    for base in methods.library_bases(run, source, definition):
        if method is None:
            library_objects.construct_library(run, frame, this, (base, (), ""), arguments, location)
    callbacks.framework_entries(run, this)
