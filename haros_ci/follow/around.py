# SPDX-License-Identifier: Apache-2.0
"""Python: what decorators of the workspace put around functions (docs.python.org/3/reference/compound_stmts.html, function definitions).

``@guard`` over ``def f`` makes ``f`` what ``guard(f)`` gives: where that is a function of the workspace, it is called in place of ``f``.
"""

from __future__ import annotations

from haros_ci import syntax
from haros_ci.follow import call_arguments, calls, expressions, overloads, python_names, registering
from haros_ci.follow.frames import Frame
from haros_ci.follow.made import go_back, keep
from haros_ci.follow.walk import Walk
from haros_ci.model.location import Location
from haros_ci.syntax import Expression, Function
from haros_ci.values.abstract import Callable, Cell, Known, Value


def called(
    walk: Walk, frame: Frame, function: Callable, args: tuple[call_arguments.PassedArgument, ...]
) -> Value | None:
    """What a call of a decorated function gives; None where nothing of the workspace is known to be around it."""
    definition = overloads.original(walk, function.function)
    if function.source.separator != "." or not any(_of_workspace(walk, item) for item in definition.decorators):
        return None
    key = (function.source.path, f"@{definition.name}:{definition.line}")
    cell = walk.globals.get(key)
    if cell is None:
        cell = walk.globals[key] = Cell(Known(None))
        mark, kept = walk.state.mark(), keep(walk)
        wrapped = _wrapped(walk, function, definition)
        if wrapped is None:  # what it was given to is not followed either
            walk.state.undo(mark)
            go_back(walk, kept)
            _named(walk, function, definition)
        cell.value = wrapped or Known(None)
    wrapper = cell.value
    if not isinstance(wrapper, Callable) or wrapper.function in walk.active:
        return None
    given = (call_arguments.PassedArgument(function.this), *args) if function.this is not None else args
    return calls.apply(
        walk, frame, wrapper, given, (), Location(function.source.path, definition.line), syntax.Name("")
    )


def _of_workspace(walk: Walk, decorator: Expression) -> bool:
    """Whether a decorator is called like a Python function of the workspace."""
    callee = decorator.callee if type(decorator) is syntax.Call else decorator
    name = syntax.name_of(callee)
    return (
        bool(name)
        and name not in overloads.TRANSPARENT
        and any(s.separator == "." for s, _ in walk.index.functions.get(name, ()))
    )


def _wrapped(walk: Walk, function: Callable, definition: Function) -> Value | None:
    """What its decorators make of a function, the last of them first; None where one is not known."""
    module = python_names.module_frame(walk, function.source)
    value: Value = Callable(function.source, _bare(walk, definition), None, (), function.frame)
    for decorator in reversed(definition.decorators):
        if type(decorator) is syntax.Name and decorator.name in overloads.TRANSPARENT:
            continue
        found = expressions.evaluate(walk, module, decorator)
        if not isinstance(found, Callable):
            return None
        where = Location(function.source.path, definition.line)
        value = calls.apply(walk, module, found, (call_arguments.PassedArgument(value),), (), where, decorator)
        if not isinstance(value, Callable):
            return None
    return value


def _named(walk: Walk, function: Callable, definition: Function) -> None:
    """The decorators that may make something around a function are named."""
    for decorator in definition.decorators:
        name = syntax.name_of(decorator.callee if type(decorator) is syntax.Call else decorator)
        if registering.makes(walk, name):
            where = Location(function.source.path, definition.line)
            walk.gaps.setdefault(registering.AROUND.format(name, "functions"), where)


def _bare(walk: Walk, function: Function) -> Function:
    """The function without its decorators."""
    key = ("bare", id(function))
    if key not in walk.found:
        walk.found[key] = (syntax.replace(function, decorators=()), function)
    found: Function = walk.found[key][0]
    return found
