# SPDX-License-Identifier: Apache-2.0
"""What a name means: a variable, a function, a class, a macro, a module, or something of a library."""

from __future__ import annotations

import builtins
import sys
from collections.abc import Sequence

from haros_ci import syntax
from haros_ci.follow import (
    bases,
    conversions,
    initialised,
    members,
    methods,
    object_macros,
    overloads,
    specialisations,
)
from haros_ci.follow.frames import NEXT, Frame, looked_up_from
from haros_ci.follow.libraries import cpp as library_cpp
from haros_ci.follow.libraries import numbers as library_numbers
from haros_ci.follow.libraries import optionals, own_files, python_modules
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
    Module,
    Object,
    Value,
    join,
    tick,
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
        module = module_frame(walk, frame.source)
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
        return python_name(walk, frame, name)
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


def python_name(walk: Walk, frame: Frame, name: str) -> Value:
    if name in ("True", "False", "None"):
        return Known({"True": True, "False": False, "None": None}[name])
    found = walk.index.near(walk.index.classes, name, frame.source, walk.files)
    if found and found[0][0].path == frame.source.path:
        is_instead = found[0][1].column > 1 and any(alias.name == name for alias in frame.source.program.aliases)
        value = _imported_name(walk, frame, name) if is_instead else None
        if isinstance(value, ClassValue) or (isinstance(value, Library) and value.name in walk.rows):
            return value  # the class is there where that cannot be imported
        return overloads.either([ClassValue(*item) for item in overloads.last(found)])
    functions = [f for f in walk.index.functions.get(name, ()) if f[0].path == frame.source.path]
    if frame.function is None and frame.scope:  # the body of a class
        own = walk.index.functions.get(f"{frame.scope}.{name}", ())
        functions = [f for f in own if f[0].path == frame.source.path] or functions
    if functions:
        return overloads.either([Callable(*item) for item in overloads.last(functions)])
    place = (frame.source.path, name, len(walk.modules))
    if walk.is_called_back and place in walk.outside_names:
        return walk.outside_names[place]
    value = _from_elsewhere(walk, frame, name)
    if isinstance(value, Library) and value.this is None and walk.is_called_back and len(walk.modules) == place[2]:
        walk.outside_names[place] = value  # Python has it from where the file is loaded
    return value


def _from_elsewhere(walk: Walk, frame: Frame, name: str) -> Value:
    """What a name of Python means that the file itself does not define."""
    key = ("tried", name)
    is_first = key not in walk.found
    tried: dict[str, int] = walk.found.setdefault(key, {})
    if tried.get(frame.source.path, -1) < len(walk.modules):  # else modules import each other, or one by several ways
        tried[frame.source.path] = sys.maxsize
        try:
            value = _imported_name(walk, frame, name)
        finally:
            tried[frame.source.path] = len(walk.modules)  # with others loaded since it may have the name
            if is_first:
                del walk.found[key]
        if value is not None:
            del tried[frame.source.path]
            return value
    if name == "__file__":
        return own_files.own_file(walk, frame)
    if name == "__name__":
        is_run = walk.is_program and frame.source.path in walk.files
        module = "__main__" if is_run else frame.source.module
        return Known(module) if module else walk.opaque("the name of the module is not known", frame)
    if not hasattr(builtins, name):
        return Library(python_modules.starred(walk, frame.source, name) or name)
    return Library(name)


def _imported_name(walk: Walk, frame: Frame, name: str) -> Value | None:
    """What the file's imports of *name* mean: either of several, and of several modules with all their names the last."""
    targets = dict.fromkeys(alias.type.name for alias in frame.source.program.aliases if alias.name == name)
    value: Value | None = None
    for target in targets:
        other = imported(walk, frame, target)
        value = other if value is None else join(value, other)
    if value is not None:
        return value
    for alias in reversed(frame.source.program.aliases):
        if alias.name == "*":
            module = alias.type.name.removesuffix(".*")
            target, is_outside = f"{module}.{name}", python_modules.is_outside(walk, frame.source, module)
            value = python_modules.of_library(target) if is_outside else imported(walk, frame, target)
            is_named = isinstance(value, Library) and value.name in (
                name,
                python_modules.absolute(frame.source, target),
            )
            if not is_named:
                return value  # what a module of the workspace has from a library is called as it is there
    return None


def imported(walk: Walk, frame: Frame, target: str) -> Value:
    """What a dotted Python name means: a module, class, function or variable of the workspace, or a library's name."""
    placed = python_modules.placed(walk, frame.source, target)
    if placed is not None:
        return _inside(walk, frame, *placed)
    target = python_modules.absolute(frame.source, target)
    head, rest = target, list[str]()
    while head:
        modules = walk.index.modules.get(head)
        if modules:
            source = min(modules, key=lambda s: (s.package != frame.source.package, s.path))
            if rest and is_generated(walk, source, rest[-1]):
                return Library(target)
            bound = python_modules.bound(walk, head) if not rest else None
            return bound or _inside(walk, frame, source, rest[::-1])
        head, dot, last = head.rpartition(".")
        if not dot:
            break
        rest.append(last)
    beside = python_modules.beside(walk, frame.source, target)
    return imported(walk, frame, beside) if beside is not None else python_modules.of_library(target)


def _inside(walk: Walk, frame: Frame, source: Source, rest: Sequence[str]) -> Value:
    """A module, or what the names *rest* mean in it, one inside of the other."""
    value: Value = Module(source)
    for part in rest:
        value = members.attribute(walk, value, part, frame)
    if rest and value is not walk.own.get(("first", source.path, rest[0]), value):
        return walk.opaque("it is imported by value, and a function of its module assigns to it", frame)
    return value


def is_generated(walk: Walk, source: Source, name: str) -> bool:
    """Whether *name* of a package's own Python module is the module that its interfaces are generated into.

    Both are installed into one Python package (wiki.ros.org/genpy, wiki.ros.org/dynamic_reconfigure).
    """
    if name not in ("msg", "srv", "cfg") or "." in source.module or not source.path.endswith("__init__.py"):
        return False
    if f"{source.module}.{name}" in walk.index.modules:
        return False
    return name not in module_frame(walk, source).scopes[0]


def module_frame(walk: Walk, source: Source) -> Frame:
    """A Python module's own scope; its body is followed once, when the module is first used."""
    frame = walk.modules.get(source.path)
    if frame is None:
        from haros_ci.follow import registering, statements

        mark, begun = walk.state.mark(), tick()
        frame = walk.modules[source.path] = Frame(source, "")
        if walk.index.trace is not None:
            walk.index.trace.paths.add(source.path)
        body = next((f for f in source.program.functions if f.kind == "module"), None)
        if body is not None and body.body:
            for statement in body.body:
                walk.step()
                if statements.STATEMENTS[type(statement)](walk, frame, statement) != NEXT:
                    break
        registering.note(walk, frame, source)
        walk.state.settle(mark, begun)  # the next branch finds the module loaded
        for name in python_modules.rebound(source):
            if name in frame.scopes[0]:
                walk.own["first", source.path, name] = frame.scopes[0][name].value
    return frame
