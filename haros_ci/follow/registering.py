# SPDX-License-Identifier: Apache-2.0
"""Python: decorators of the workspace that note functions (``@register("name")``): they are called as the module is loaded.

A function that a decorator gives to an object of a library that is not known may be called by it.
What decorators put around functions is ``around``'s.
"""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci import syntax
from haros_ci.follow import call_arguments, calls, commands, expressions, lookup, uncalled
from haros_ci.follow.frames import Frame
from haros_ci.follow.walk import Walk
from haros_ci.index.index import Source
from haros_ci.model.location import Location
from haros_ci.syntax import Class, Function
from haros_ci.values.abstract import Callable, ClassValue, Object, Opaque

#: What is said of a decorator that makes something around a function.
AROUND = "what the decorator {} puts around {} is not followed"
#: Decorated functions of a module that are looked at.
MOST = 200


def note(walk: Walk, frame: Frame, source: Source) -> None:
    """Call the decorators of the functions and classes of a module, whose body has been followed, that put them into lists and maps."""
    every: list[Function | Class] = [*source.program.functions, *source.program.classes]
    decorated = [one for one in every if one.decorators and _is_outer(one)]
    for function in sorted(decorated, key=lambda one: (one.line, one.column))[:MOST]:
        if isinstance(function, Function):
            given(walk, frame, Callable(source, function))
        for decorator in reversed(function.decorators):
            callee = decorator.callee if isinstance(decorator, syntax.Call) else decorator
            if not isinstance(callee, syntax.Name):
                continue
            if isinstance(function, Class) and makes(walk, callee.name):
                walk.gaps.setdefault(AROUND.format(callee.name, "classes"), Location(source.path, function.line))
            if not _notes(walk, callee.name):
                continue
            value = expressions.evaluate(walk, frame, decorator)
            if isinstance(value, Callable):
                noted = Callable(source, function) if isinstance(function, Function) else ClassValue(source, function)
                where = Location(source.path, function.line)
                calls.apply(walk, frame, value, (call_arguments.PassedArgument(noted),), (), where, decorator)


def given(walk: Walk, frame: Frame, function: Callable) -> None:
    """A function is given to objects of libraries that are not known by its decorators (``@app.route("/x")``): they may call it."""
    for decorator in function.function.decorators:
        callee = decorator.callee if isinstance(decorator, syntax.Call) else decorator
        if not isinstance(callee, syntax.Member) or not _is_held(walk, frame, callee.object):
            continue
        value = expressions.evaluate(walk, frame, callee.object)
        is_library = isinstance(value, Opaque) or (isinstance(value, Object) and value.definition is None)
        if is_library and commands.command(walk, function) is None:
            name = syntax.dotted(callee) or callee.name
            uncalled.offer(
                walk, function, f"the decorator {name} is not known, which is given the function and may call it"
            )


def _is_held(walk: Walk, frame: Frame, receiver: syntax.Expression) -> bool:
    """Whether a name or a chain of members begins with a variable, and not with a module."""
    while isinstance(receiver, syntax.Member):
        receiver = receiver.object
    return isinstance(receiver, syntax.This) or (
        isinstance(receiver, syntax.Name) and lookup.named_cell(walk, frame, receiver.name) is not None
    )


def _is_outer(one: Function | Class) -> bool:
    """Whether a function or class stands in no other."""
    return "." not in one.name and (isinstance(one, Class) or (not one.owner and one.kind == "function"))


def _notes(walk: Walk, name: str) -> bool:
    """Whether a function of that name, or one inside of it, puts something into a list or map."""
    key = ("notes", name)
    if key not in walk.found:
        walk.found[key] = any(
            walk.relevance.collects(part.body, source) for source, part in _parts(walk, name) if part.body is not None
        )
    return bool(walk.found[key])


def makes(walk: Walk, name: str) -> bool:
    """Whether a function of that name, or one inside of it, may make something beside what it calls of the function that it is given."""
    key = ("makes around", name)
    if key not in walk.found:
        walk.found[key] = any(walk.relevance.makes(part, source) for source, part in _parts(walk, name))
    return bool(walk.found[key])


def _parts(walk: Walk, name: str) -> Iterator[tuple[Source, Function]]:
    """The Python functions of a name, each with those inside of it."""
    for source, function in walk.index.functions.get(name, ()):
        if source.separator == ".":
            yield source, function
            inside = (one for one in source.program.functions if one.name.startswith(f"{name}."))
            yield from ((source, one) for one in inside)
