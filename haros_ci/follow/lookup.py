# SPDX-License-Identifier: Apache-2.0
"""What a name means: a variable, a function, a class, a macro, a module, or something of a library."""

from __future__ import annotations

from haros_ci import syntax
from haros_ci.follow import (
    bases,
    conversions,
    initialised,
    members,
    methods,
    object_macros,
    python_names,
    specialisations,
)
from haros_ci.follow.frames import Frame, looked_up_from
from haros_ci.follow.libraries import cpp as library_cpp
from haros_ci.follow.libraries import numbers as library_numbers
from haros_ci.follow.libraries import optionals
from haros_ci.follow.ros import qos
from haros_ci.follow.walk import Walk
from haros_ci.index.common_messages import NAMES
from haros_ci.index.index import EITHER, Source
from haros_ci.syntax import Type
from haros_ci.values.abstract import (
    NONE,
    Callable,
    Cell,
    ClassValue,
    Known,
    Library,
    Object,
    Value,
)


def named_cell(walk: Walk, frame: Frame, name: str) -> Cell | None:
    cell = frame.find(name)
    if cell is not None:
        return cell
    if frame.source.program.language == "python":
        if frame.function is None and frame.scope:  # the body of a class
            around = walk.class_of(frame.scope, frame.source)
            own = around is not None and any(field.name == name for field in around[1].fields)
            if own and around is not None:
                return members.static_cell(walk, *around, name)
        module = python_names.module_frame(walk, frame.source)
        return module.scopes[0].get(name)
    this = frame.this
    if this is None and frame.outer is not None:
        this = frame.outer.this
    if this is not None:
        cell = members.member(walk, this, name, frame) or library_cpp.protected(walk, this, name)
        if cell is not None:
            return cell
    found = _found_variable(walk, frame, name)
    if found is None and "::" in name:  # a static member of what a template parameter or an alias stands for
        head, _, last = name.rpartition("::")
        meant = walk.type_in(syntax.Type(head), frame).name
        found = _found_variable(walk, frame, f"{meant}::{last}") if meant not in ("", head) else None
    return initialised.global_cell(walk, *found) if found is not None else None


def _found_variable(walk: Walk, frame: Frame, name: str) -> tuple[Source, str, syntax.Init | None, Type] | None:
    if (key := ("variable", name, frame.scope, frame.source.path)) not in walk.found:
        walk.found[key] = _variable(walk, frame, name)
    found: tuple[Source, str, syntax.Init | None, Type] | None = walk.found[key]
    return found


def _variable(walk: Walk, frame: Frame, name: str) -> tuple[Source, str, syntax.Init | None, Type] | None:
    """The namespace-scope variable or static member that *name* means: its file, qualified name, initialiser, type."""
    for candidate in walk.index.scopes(name, frame.scope, frame.source):
        found = walk.index.near(walk.index.variables, candidate, frame.source, walk.files)
        if found:
            where, variable = found[0]
            if any(other.init != variable.init for _, other in found):
                return frame.source, variable.name, syntax.Equals(syntax.Unknown(EITHER)), variable.type
            return where, variable.name, variable.init, variable.type
        head, colons, last = candidate.rpartition("::")
        if colons:
            owner = walk.class_of(head, frame.source)
            if owner is not None:
                static = methods.field_of(walk, owner[0], owner[1], last, {})
                if static is not None and static[1].is_static:
                    if specialisations.are_several(walk, frame, head):
                        return frame.source, candidate, syntax.Equals(syntax.Unknown(EITHER)), static[2]
                    one = f"{bases.declaring(walk, *owner, last)}::{last}"
                    there = _variable(walk, frame, one) if one != candidate else None
                    return there or (static[0], one, static[1].init, static[2])
    meant = walk.type_in(syntax.Type(name), frame).name if "::" not in name else name
    return _variable(walk, frame, meant) if meant != name and meant in walk.index.variables else None


def name(walk: Walk, frame: Frame, expression: syntax.Name) -> Value:
    cell = named_cell(walk, frame, expression.name)
    return cell.value if cell is not None else no_variable(walk, frame, expression.name)


def no_variable(walk: Walk, frame: Frame, name: str) -> Value:
    """What a name that is no variable means: a function, class, module, macro, or a library's name."""
    if frame.source.program.language == "python":
        return python_names.meant(walk, frame, name)
    key = (
        "name",
        name,
        looked_up_from(walk.index.inner, frame),
        frame.source.path,
        walk.numbered(frame.templates) if frame.templates else 0,
    )
    if key not in walk.found:
        walk.found[key] = _global_name(walk, frame, name)
    value: Value | object_macros.ObjectMacro = walk.found[key]
    if isinstance(value, object_macros.ObjectMacro):
        return object_macros.expanded(walk, frame, value, name)
    if isinstance(value, Library) and walk.context.process is not None:
        profile = qos.preset(value.name)
        if profile is not None:
            return profile
    return _as_method(walk, frame, name, value) if frame.this is not None else value


def _as_method(walk: Walk, frame: Frame, name: str, value: Value) -> Value:
    """What *name* means in a method, where *value* is what it means outside: a method of a base or of the object's own class, or *value* for the object."""
    this = frame.this
    assert this is not None
    if "::" not in name:
        inherited = _inherited(walk, frame, this, name, value)
        value = inherited if inherited is not None else value
    if not isinstance(value, Callable):
        return value
    if "::" not in name and _is_virtual(walk, frame, value):
        method = methods.method_of(walk, this, name)
        if method is not None:
            return method
    if value.function.owner and not value.function.is_static:
        return Callable(value.source, value.function, this, templates=frame.templates)
    return value


def _inherited(walk: Walk, frame: Frame, this: Object, name: str, value: Value) -> Callable | None:
    """The method *name* of a base class, which is meant before what the enclosing namespaces have of that name."""
    if isinstance(value, Callable) and value.function.owner and value.function.owner == frame.scope:
        return None
    key = ("inherited", name, frame.scope, frame.source.path, this.name)
    if key not in walk.found:
        owner = walk.class_of(frame.scope, frame.source) or this.definition
        found = methods.class_method(walk, owner[0], owner[1], name) if owner is not None else None
        walk.found[key] = found if found is not None and found[1].kind == "function" else None
    method = walk.found[key]
    return Callable(*method) if method is not None else None


def _is_virtual(walk: Walk, frame: Frame, value: Callable) -> bool:
    """Whether the call of a method goes to the object's own class: not inside a constructor, where it is not yet of it."""
    if frame.function is None or frame.function.kind in ("constructor", "destructor"):
        return False
    return any(function.is_virtual for _, function in walk.index.functions.get(value.function.name, ()))


def _global_name(walk: Walk, frame: Frame, name: str) -> Value | object_macros.ObjectMacro:
    """What a name that is no variable means in C++: a function, macro, class, or a library's name."""
    index = walk.index
    for candidate in index.scopes(name, frame.scope, frame.source):
        functions = index.near(index.functions, candidate, frame.source, walk.files)
        if functions:
            hidden = specialisations.hides(walk, frame, name, functions)
            return hidden or Callable(*methods.with_body(walk, functions))
    macro = object_macros.meant(walk, frame, name)
    if macro is not None:
        return macro
    resolved = walk.type_in(syntax.Type(name), frame)
    found = walk.class_of(resolved.name, frame.source)
    if found is not None:
        return ClassValue(*found)
    if (
        resolved.name != name and resolved.name not in walk.rows
    ):  # what a using-declaration or an alias of a namespace stands for
        if functions := index.near(index.functions, resolved.name, frame.source, walk.files):
            return Callable(*methods.with_body(walk, functions))
    if "::" in name:
        method = _of_its_base(walk, frame, name)
        if method is None:
            method = methods.tail_method(walk, resolved.name if "::" in resolved.name else name, frame.source)
        if method is not None:
            return Callable(*method)
    if resolved.name in optionals.EMPTY:
        return NONE
    if resolved.name.endswith("string::npos"):
        return Known(conversions.NPOS)
    constant = NAMES.get(resolved.name, library_numbers.CONSTANTS.get(name))
    return Known(constant) if constant is not None else Library(resolved.name)


def _of_its_base(walk: Walk, frame: Frame, name: str) -> tuple[Source, syntax.Function] | None:
    """``C::m`` where a base of the class defines the method."""
    head, _, last = name.rpartition("::")
    owner = walk.class_of(walk.type_in(syntax.Type(head), frame).name, frame.source)
    return methods.class_method(walk, *owner, last) if owner is not None else None
