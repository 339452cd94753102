# SPDX-License-Identifier: Apache-2.0
"""Members: the data of objects, methods, what modules and classes contain."""

from __future__ import annotations

from dataclasses import replace

from haros_ci import syntax
from haros_ci.follow import (
    activation,
    bases,
    call_arguments,
    dereferenced,
    enums,
    expressions,
    initialised,
    linear,
    methods,
    properties,
    python_names,
)
from haros_ci.follow.frames import Frame
from haros_ci.follow.libraries import argparse, python_modules, python_paths
from haros_ci.follow.libraries import python as library_python
from haros_ci.follow.ros import ros2_parameters
from haros_ci.follow.walk import Walk
from haros_ci.index.index import Source
from haros_ci.index.types import pointee
from haros_ci.syntax import Class, Type
from haros_ci.values import iterators
from haros_ci.values.abstract import (
    NONE,
    Callable,
    Cell,
    Choice,
    ClassValue,
    Known,
    Library,
    Module,
    Object,
    Opaque,
    Pointer,
    Value,
    join,
)

#: Why a member is not known, by its name.
UNSET = "the member {} is not set before"


def member(walk: Walk, value: Value, name: str, frame: Frame) -> Cell | None:
    """The cell of a data member; made where the class declares it (or Python may), None where there is none."""
    if isinstance(value, Pointer):
        value = value.cell.value
    elif (
        isinstance(value, Object) and value.name == iterators.ITERATOR and (of := iterators.pointed(value)) is not None
    ):
        value = of.value
    if not isinstance(value, Object):
        return _of_module_or_class(walk, value, name)
    if "::" in name:
        return _of_base(walk, value, name, frame)
    cell = value.fields.get(name)
    if value.definition is None:
        _read_as(walk, value, name)
    elif cell is None:
        source, definition = value.definition
        if source.program.language == "python":
            cell = static_cell(walk, source, definition, name)
            if cell is not None:
                return cell
        found = methods.field_of(walk, source, definition, name, value.templates)
        if found is not None:
            where, declared, kind = found
            if declared.is_static:
                one = definition.name
                if source.separator == "::":
                    one = bases.declaring(walk, source, definition, name)
                return initialised.global_cell(walk, where, f"{one}{where.separator}{name}", declared.init, kind)
            cell = value.fields[name] = Cell(walk.opaque(UNSET.format(name), frame, None, kind), kind)
        elif (held := dereferenced.led(walk, frame, value)) is not None:
            return member(walk, held, name, frame)
    return cell


def of_object(this: Object, name: str, kind: Type) -> Cell:
    """The cell of a member that is initialised: the one that a reference to it has already, if an earlier member is one."""
    known = this.fields.get(name)
    is_referred = known is not None and isinstance(known.value, Opaque) and known.value.reason == UNSET.format(name)
    return known if known is not None and is_referred and known.type == kind else Cell(NONE, kind)


def _read_as(walk: Walk, value: Object, name: str) -> None:
    if name in ros2_parameters.READ_AS and "of" in value.fields:
        ros2_parameters.read_as(walk, value.fields["of"].value, name)


def _of_base(walk: Walk, value: Object, name: str, frame: Frame) -> Cell | None:
    """The cell of ``Base::x``: the data member of that name that the class of an object, or a base of it, declares."""
    head, _, last = name.rpartition("::")
    if value.definition is None or value.definition[0].separator != "::":
        return None
    source, definition = value.definition
    meant = walk.type_in(syntax.Type(head), frame).name
    every = bases.classes(walk, source, definition)
    owners = [item for item in every if item[1].name in (meant, head)]
    owners = owners or [item for item in every if item[1].name.endswith(f"::{head}")]  # the injected class name
    found = methods.field_of(walk, *owners[0], last, {}) if len(owners) == 1 else None
    if found is None or found[1].is_static:
        return None
    seen = methods.field_of(walk, source, definition, last, {})
    if seen is not None and seen[1] is found[1]:
        return member(walk, value, last, frame)
    key = f"{owners[0][1].name}::{last}"  # the class has another one of that name, and methods of the base mean this
    if key not in value.fields:
        value.fields[key] = Cell(walk.opaque(f"{name} is hidden by a member of its derived class", frame), found[2])
    return value.fields[key]


def _of_module_or_class(walk: Walk, value: Value, name: str) -> Cell | None:
    """The cell of a variable of a module, or of a class's own attribute."""
    if isinstance(value, Module):
        return python_names.module_frame(walk, value.source).scopes[0].get(name)
    return static_cell(walk, value.source, value.definition, name) if isinstance(value, ClassValue) else None


def own_cell(walk: Walk, value: Value, name: str, frame: Frame) -> Cell | None:
    """The cell of a data member that is assigned to: in Python the object gets one of its own where its class has one."""
    this = value.cell.value if isinstance(value, Pointer) else value
    if isinstance(this, Object) and argparse.UNREAD in this.fields and name not in this.fields:
        this.fields[name] = Cell(this.fields[argparse.UNREAD].value)  # what no word and no default has set is set here
    if isinstance(this, Object) and this.definition is not None and name not in this.fields:
        source, definition = this.definition
        of_its_class = static_cell(walk, source, definition, name)
        if of_its_class is not None:
            own = this.fields[name] = Cell(of_its_class.value, of_its_class.type)
            own.born = this.born  # a loop that changes it does not make it anew in each turn
    return member(walk, value, name, frame)


def static_cell(walk: Walk, source: Source, definition: Class, name: str) -> Cell | None:
    """The cell of a class's own attribute, declared or assigned to, or that of its bases."""
    own = _own_static(walk, source, definition, name)
    if own is not None or (source.separator == "." and any(field.name == name for field in definition.fields)):
        return own
    every = (
        linear.of_workspace(linear.order(walk, source, definition))
        if source.separator == "."
        else bases.classes(walk, source, definition)
    )
    cells = (_own_static(walk, where, known, name) for where, known in every)
    return next((cell for cell in cells if cell is not None), None)


def _own_static(walk: Walk, source: Source, definition: Class, name: str) -> Cell | None:
    """The cell of an attribute that a class itself declares or is assigned."""
    whole = f"{definition.name}{source.separator}{name}"
    set_later = walk.globals.get((source.path, whole))
    if set_later is not None:
        return set_later
    declared = next((field for field in definition.fields if field.name == name and field.is_static), None)
    if declared is None:
        return None
    kind = walk.type_in(declared.type, Frame(source, definition.name))
    return initialised.global_cell(walk, source, whole, declared.init, kind)


def attribute(walk: Walk, value: Value, name: str, frame: Frame) -> Value:  # noqa: C901 - one branch for each kind of value
    """``value.name`` where it is no data member: a method, a module's content, a library's member."""
    if isinstance(value, Pointer):
        value = value.cell.value
    if isinstance(value, Module):
        inner = python_names.module_frame(walk, value.source)
        if name in inner.scopes[0]:
            return inner.scopes[0][name].value
        deeper = walk.index.modules.get(f"{value.source.module}.{name}")
        if deeper:
            return python_modules.bound(walk, f"{value.source.module}.{name}") or Module(deeper[0])
        placed = python_modules.placed(walk, value.source, f".{name}") if not value.source.module else None
        if placed is not None and not placed[1] and value.source.path.endswith("__init__.py"):
            return Module(placed[0])
        if python_names.is_generated(walk, value.source, name):
            return Library(f"{value.source.module}.{name}")
        return python_names.meant(walk, inner, name)
    if isinstance(value, Library):
        if value.name == "sys" and name == "argv":
            return library_python.argv(walk, frame)
        if frame.source.program.language == "python":
            return python_modules.of_library(f"{value.name}.{name}")
        return Library(f"{value.name}::{name}")
    if isinstance(value, Object):
        cell = member(walk, value, name, frame)
        if cell is not None:
            return cell.value
        method = methods.method_of(walk, value, name)
        if method is not None:
            return activation.invoke(walk, frame, method, ()) if properties.is_property(method.function) else method
        if frame.source.separator == ".":
            held = of_class(walk, value, name, frame) or given(walk, value, name, frame)
            if held is not None:
                return held
            if argparse.UNREAD in value.fields:
                return value.fields[argparse.UNREAD].value
        return Library(f"{value.name}{frame.source.separator}{name}", value)
    if isinstance(value, ClassValue):
        found = methods.field_of(walk, value.source, value.definition, name, {})
        if found is not None:
            separator = value.source.separator
            return initialised.global_cell(
                walk, found[0], f"{value.definition.name}{separator}{name}", found[1].init, found[2]
            ).value
        unbound = methods.class_method(walk, value.source, value.definition, name)
        if unbound is not None:
            return properties.of_class(value, *unbound)
        if value.source.separator == ".":
            inside = class_inside(walk, value.source, value.definition, name)
            if inside is not None:
                return inside
            if name == "__name__":
                return Known(value.definition.name.rpartition(".")[2])
        return Library(f"{value.definition.name}.{name}")
    if isinstance(value, Choice) and frame.source.separator == ".":
        value = iterators.not_none(value)
        if not isinstance(value, Choice):
            return attribute(walk, value, name, frame)
    if isinstance(value, Choice):
        result: Value | None = None
        for option in value.options:
            found_ = attribute(walk, option, name, frame)
            result = found_ if result is None else join(result, found_)
        return result if result is not None else NONE
    of_path = python_paths.attribute(walk, frame, value, name) if frame.source.separator == "." else None
    if of_path is not None:
        return of_path
    if isinstance(value, Opaque):
        kind = value.type
        if kind is not None and kind.name:
            owner = walk.class_of(pointee(kind).name, frame.source)
            if owner is not None:
                declared = methods.field_of(walk, owner[0], owner[1], name, {})
                if declared is not None:
                    return Opaque(value.reason, value.location, declared[2])
                unbound = methods.class_method(walk, owner[0], owner[1], name)
                if unbound is not None:
                    return Callable(*unbound)
            return Library(f"{pointee(kind).name}{frame.source.separator}{name}", value)
        return Opaque(value.reason, value.location)
    return Library(name, value)


def of_class(walk: Walk, value: Object, name: str, frame: Frame) -> Value | None:
    """What a Python object's class has under *name* that is no method: an attribute, a class in it, ``__class__``.

    A function is a method there, be it a lambda or a method by another name.
    """
    if value.definition is None:
        return None
    if name == "__class__":
        return ClassValue(*value.definition)
    source, definition = value.definition
    cell = static_cell(walk, source, definition, name)
    if cell is None:
        return class_inside(walk, source, definition, name)
    held = cell.value
    if isinstance(held, Callable) and held.this is None:
        if not held.function.owner:
            return replace(held, bound=(value, *held.bound))
        if not held.function.is_static:
            return replace(held, this=value)
    return held


def given(walk: Walk, value: Object, name: str, frame: Frame) -> Value | None:
    """What ``__getattr__`` of a Python object's class gives for a name that the object does not have, if all of its bases are here."""
    if value.definition is None or name.startswith("__"):
        return None
    method = methods.method_of(walk, value, "__getattr__")
    if method is None or methods.library_bases(walk, *value.definition):
        return None
    return activation.invoke(walk, frame, method, (call_arguments.PassedArgument(Known(name)),))


def class_inside(walk: Walk, source: Source, definition: Class, name: str) -> ClassValue | None:
    """The Python class *name* that is defined inside of a class or one of its bases."""
    for where, known in linear.of_workspace(linear.order(walk, source, definition)):
        every = walk.index.classes.get(f"{known.name}.{name}", ())
        found = [item for item in every if item[0].path == where.path]
        if found:
            return ClassValue(*found[-1]) if len(found) == 1 else None
    return None


def field(walk: Walk, frame: Frame, expression: syntax.Member) -> Value:
    return located(walk, frame, expression)[1]


def located(walk: Walk, frame: Frame, expression: syntax.Member) -> tuple[Cell | None, Value]:
    """The cell of ``object.name`` where it is a data member, and its value; the object is evaluated once."""
    if expression.name in enums.FIELDS and frame.source.separator == ".":
        result = enums.field(walk, frame, expression)
        if result is not None:
            return None, result
    value = expressions.evaluate(walk, frame, expression.object)
    cell = member(walk, value, expression.name, frame)
    if cell is not None:
        return cell, cell.value
    return None, attribute(walk, value, expression.name, frame)
