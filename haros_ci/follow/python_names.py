# SPDX-License-Identifier: Apache-2.0
"""What a name of Python means that is no variable: a function, a class, a module, or something of a library."""

from __future__ import annotations

import builtins
import sys
from collections.abc import Sequence

from haros_ci.follow import members, overloads
from haros_ci.follow.frames import NEXT, Frame
from haros_ci.follow.libraries import own_files, python_modules
from haros_ci.follow.walk import Walk
from haros_ci.index.index import Source
from haros_ci.values.abstract import Callable, ClassValue, Known, Library, Module, Value, join, tick


def meant(walk: Walk, frame: Frame, name: str) -> Value:
    """What a name means that is no variable of a function: of the file itself, of what it imports, or of the library."""
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
    if python_modules.is_generated_elsewhere(walk, target):
        return python_modules.of_library(target)
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
