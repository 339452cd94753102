# SPDX-License-Identifier: Apache-2.0
"""Objects and their classes: construction with bases and members, look-up of members and methods, variables."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from haros_ci.link import (
    activation,
    call_arguments,
    callbacks,
    conversions,
    expressions,
    library_objects,
    lookup,
    members,
    texts,
)
from haros_ci.link.index import Source
from haros_ci.link.run import Frame, Run
from haros_ci.link.types import MAPS, NO_TYPE, SEQUENCES, STRINGS, is_smart_pointer, pointee, resolve_type
from haros_ci.link.values import NONE, Callable, Cell, Known, Mapped, Object, Opaque, Sequence, Value
from haros_ci.model.location import Location
from haros_ci.model.program import Class, Field, Function, Type

#: Deeper hierarchies are cut off (and cycles with them).
BASES = 12

Member = tuple[Source, Field, Type]
Found = tuple[Source, Function]


def field_of(
    run: Run, source: Source, definition: Class, name: str, templates: Mapping[str, Type], depth: int = 0
) -> Member | None:
    """The data member *name* of a class or its bases: where it is declared, and its resolved type."""
    for declared in definition.fields:
        if declared.name == name:
            kind = resolve_type(run.index, declared.type, definition.name, source, run.files, templates)
            return source, declared, kind
    if depth < BASES:
        for base in run.bases(source, definition, templates):
            owner = run.class_of(base[0], source)
            if owner is not None and owner[1] is not definition:
                bound = dict(zip(owner[1].templates, base[1], strict=False))
                found = field_of(run, owner[0], owner[1], name, bound, depth + 1)
                if found is not None:
                    return found
    return None


def class_method(
    run: Run, source: Source, definition: Class, name: str, count: int | None = None, depth: int = 0
) -> Found | None:
    """The method *name* of a class or its bases; *count* arguments choose between overloads."""
    separator = source.separator
    candidates = run.index.near(run.index.functions, f"{definition.name}{separator}{name}", source, run.files)
    if separator == "::":
        if not any(function.body is not None for _, function in candidates):
            tail = f"{definition.name.rpartition('::')[2]}::{name}"
            loose = [
                item
                for item in run.index.by_tail.get(tail, ())
                if item[1].body is not None and definition.name.endswith(item[1].owner) and item[1].owner
            ]
            candidates = [*run.index.near({tail: loose}, tail, source, run.files), *candidates]
    else:
        candidates = [item for item in candidates if item[0].path == source.path]
    if candidates:
        return overload(candidates, count)
    if depth < BASES:
        for base in run.bases(source, definition, {}):
            owner = python_class(run, base, source) if separator == "." else run.class_of(base[0], source)
            if owner is not None and owner[1] is not definition:
                found = class_method(run, owner[0], owner[1], name, count, depth + 1)
                if found is not None:
                    return found
    return None


def python_class(run: Run, base: Type, source: Source) -> tuple[Source, Class] | None:
    from haros_ci.link.values import ClassValue

    value: Value = expressions.evaluate(run, lookup.module_frame(run, source), ("name", base[0].split(".")[0]))
    for part in base[0].split(".")[1:]:
        value = members.attribute(run, value, part, Frame(source, ""))
    return (value.source, value.definition) if isinstance(value, ClassValue) else None


def library_bases(run: Run, source: Source, definition: Class, depth: int = 0) -> list[str]:
    """The names of all base classes that are not of the workspace."""
    found: list[str] = []
    if depth < BASES:
        for base in run.bases(source, definition, {}):
            if source.program.language == "python":
                owner = python_class(run, base, source)
                name = base[0]
                if owner is None:
                    value = expressions.evaluate(run, Frame(source, ""), ("name", name.split(".")[0]))
                    name = ".".join((getattr(value, "name", name.split(".")[0]), *name.split(".")[1:]))
            else:
                owner, name = run.class_of(base[0], source), base[0]
            if owner is None:
                found.append(name)
            elif owner[1] is not definition:
                found += library_bases(run, owner[0], owner[1], depth + 1)
    return found


def method_of(run: Run, this: Object, name: str, count: int | None = None) -> Callable | None:
    """The method *name* of an object, bound to it."""
    if this.definition is None:
        return None
    source, definition = this.definition
    found = class_method(run, source, definition, name, count)
    if found is None:
        return None
    return Callable(found[0], found[1], this, templates=this.templates)


def overload(candidates: list[Found], count: int | None) -> Found:
    """The definition that takes *count* arguments, bodies first."""
    ranked = sorted(
        candidates,
        key=lambda item: (count is not None and not _takes(item[1], count), item[1].body is None),
    )
    best = ranked[0]
    if best[1].body is None:
        for item in ranked:
            if item[1].body is not None and len(item[1].parameters) == len(best[1].parameters):
                return item
    return best


def _takes(function: Function, count: int) -> bool:
    required = sum(1 for p in function.parameters if p.default is None and not p.name.startswith("*"))
    open_end = any(p.name.startswith("*") for p in function.parameters)
    return required <= count and (open_end or count <= len(function.parameters))


def with_body(run: Run, candidates: list[Found]) -> Found:
    """The first that has a body, looked for under the same name elsewhere if need be."""
    for item in candidates:
        if item[1].body is not None:
            return item
    source, function = candidates[0]
    for item in run.index.functions.get(function.name, ()):
        if item[1].body is not None and len(item[1].parameters) == len(function.parameters):
            return item
    return candidates[0]


def tail_method(run: Run, name: str, source: Source) -> Found | None:
    """``C::m`` where the class is known under a using-directive only."""
    tail = "::".join(name.split("::")[-2:])
    found = run.index.near(run.index.by_tail, tail, source, run.files)
    return overload(found, None) if found else None


def declare(run: Run, frame: Frame, name: str, kind: Type, init: Any, line: int, column: int) -> None:
    """A local variable."""
    resolved = run.type_in(kind, frame)
    location = Location(frame.source.path, line, column)
    if init is not None and init[0] == "=" and "&" in resolved[2]:
        cell = expressions.cell_of(run, frame, init[1])
        if cell is not None:
            frame.declare(name, cell)
            return
    declared = resolved if resolved[0] != "auto" else None
    frame.declare(name, Cell(initial(run, frame, resolved, init, location), declared))


def initial(run: Run, frame: Frame, kind: Type, init: Any, location: Location) -> Value:
    """The first value of a variable of the resolved type *kind*."""
    if init is not None and init[0] == "=":
        value = expressions.evaluate(run, frame, init[1])
        if init[1][0] == "list" and not _is_list(kind):
            return create(run, frame, kind, call_arguments.arguments(run, frame, init[1][1]), location)
        if kind[0] == "auto" or isinstance(value, Object):
            return value
        if (
            isinstance(value, Known)
            and isinstance(value.value, str)
            and run.class_of(kind[0], frame.source) is not None
        ):
            return create(run, frame, kind, (call_arguments.Argument(value),), location)
        if isinstance(value, Sequence):
            copied = Sequence(Cell(value.content.value), kind if _is_list(kind) else value.type)
            return copied if init[1][0] in ("name", "field") else Sequence(value.content, copied.type)
        return conversions.converted(value, kind)
    arguments = call_arguments.arguments(run, frame, init[1]) if init is not None else ()
    if "*" in kind[2] or "&" in kind[2]:
        return arguments[0].value if arguments else NONE
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
        return Mapped(Cell({}))
    if call_arguments.is_scalar(kind):
        if arguments:
            return conversions.converted(arguments[0].value, kind)
        return Opaque("it is not set before", location, kind)
    owner = run.class_of(name, frame.source)
    if owner is None:
        return library_objects.library_object(run, frame, kind, arguments, location)
    return instance(run, frame, owner, kind[1], arguments, location)


def _vector(run: Run, frame: Frame, kind: Type, arguments: tuple[call_arguments.Argument, ...]) -> Value:
    if not arguments:
        return Sequence(Cell(()), kind)
    first = arguments[0].value
    if isinstance(first, Sequence):
        return Sequence(Cell(first.content.value), kind)
    if isinstance(first, Known) and isinstance(first.value, int) and 0 <= first.value <= 1000:
        fill = arguments[1].value if len(arguments) > 1 else None
        inner = kind[1][0] if kind[1] else NO_TYPE
        cells = []
        for _ in range(first.value):
            start = fill if fill is not None else create(run, frame, inner, (), Location(frame.source.path))
            cells.append(Cell(start, inner))
        return Sequence(Cell(tuple(cells)), kind)
    return Sequence(Cell(run.opaque("a list of unknown length", frame)), kind)


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
) -> None:
    """Construct the part of *this* that *owner* declares."""
    source, definition = owner
    short = definition.name.rpartition("::")[2]
    found = class_method(run, source, definition, short, len(arguments), BASES)
    where, function = found if found is not None else (source, None)
    inner = Frame(where, definition.name, function, this, templates=templates, mark=run.state.mark())
    inits: dict[str, Any] = {}
    body_at = location
    if function is not None:
        activation.bind(run, frame, inner, function, arguments, ())
        for name, kind, args, line, column in function.inits:
            inits[name.rpartition("::")[2]] = (kind, args, line, column)
        if function.body is not None:
            body_at = Location(where.path, function.body_line, function.body_column)
        if short in inits:  # delegates to another constructor
            args = call_arguments.arguments(run, inner, inits[short][1])
            if depth < BASES:
                initialise(run, inner, this, owner, templates, args, location, depth + 1)
            if function.body is not None:
                activation.follow_body(run, inner, function)
            return
    if depth > BASES:
        return
    for base in run.bases(source, definition, templates):
        base_init = inits.get(base[0].rpartition("::")[2])
        args = call_arguments.arguments(run, inner, base_init[1]) if base_init else ()
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
        if member.name in inits:
            _, args, line, column = inits[member.name]
            start = ("(", args)
            cell.value = initial(run, inner, kind, _as_value(kind, start), Location(where.path, line, column))
        elif member.init is not None:
            cell.value = initial(run, declared, kind, member.init, Location(source.path, member.line, member.column))
        elif "*" in kind[2] or "&" in kind[2]:
            cell.value = run.opaque(f"the member {member.name} is not set before", declared, member.line, pointee(kind))
        elif _has_default(run, kind, source):
            at = body_at if function is not None else Location(source.path, member.line, member.column)
            cell.value = initial(run, declared, kind, None, at)
        else:
            cell.value = Opaque(f"the member {member.name} is not set before", Location(source.path, member.line), kind)
    if function is not None and function.body is not None:
        activation.follow_body(run, inner, function)


def _as_value(kind: Type, start: Any) -> Any:
    """``m(x)`` for a scalar, pointer or reference is ``m = x``."""
    if len(start[1]) == 1 and ("*" in kind[2] or "&" in kind[2] or call_arguments.is_scalar(kind)):
        return ("=", start[1][0])
    return start


def _has_default(run: Run, kind: Type, source: Source) -> bool:
    return not call_arguments.is_scalar(kind)


def python_construct(
    run: Run, frame: Frame, this: Object, arguments: tuple[call_arguments.Argument, ...], location: Location
) -> None:
    """``__init__``, and the constructors of libraries' base classes."""
    source, definition = this.definition
    method = method_of(run, this, "__init__")
    if method is not None:
        activation.invoke(run, frame, method, arguments, None)
    for base in library_bases(run, source, definition):
        if method is None:
            library_objects.construct_library(run, frame, this, (base, (), ""), arguments, location)
    callbacks.framework_entries(run, this)
