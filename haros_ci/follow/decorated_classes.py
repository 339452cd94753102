# SPDX-License-Identifier: Apache-2.0
"""Python: what decorators of the workspace make of a class (docs.python.org/3/reference/compound_stmts.html, class definitions).

``@swap`` over ``class C`` makes ``C`` what ``swap(C)`` gives: another class of the workspace is made in its place.
"""

from __future__ import annotations

from haros_ci import syntax
from haros_ci.follow import call_arguments, calls, expressions, overloads, python_names
from haros_ci.follow.made import go_back, keep
from haros_ci.follow.walk import Walk
from haros_ci.index.index import Source
from haros_ci.model.location import Location
from haros_ci.syntax import Class, Expression
from haros_ci.values.abstract import Callable, Cell, ClassValue, Known

NOT_KNOWN = "what the decorator {} makes of the class {} is not known: it may be another class"


def in_place_of(walk: Walk, owner: tuple[Source, Class]) -> tuple[Source, Class]:
    """The class that is made where the name of *owner* is called: *owner*, too, where its decorators give something that is not known."""
    source, definition = owner
    decorators = [item for item in definition.decorators if _of_workspace(walk, item)]
    if source.separator != "." or not decorators:
        return owner
    key = (source.path, f"@{definition.name}:{definition.line}")
    cell = walk.globals.get(key)
    if cell is None:
        cell = walk.globals[key] = Cell(Known(None))
        mark, kept = walk.state.mark(), keep(walk)
        made = _made(walk, owner, decorators)
        if made is None:
            walk.state.undo(mark)
            go_back(walk, kept)
            names = " and ".join(dict.fromkeys(_name(item) for item in decorators))
            walk.gaps.setdefault(NOT_KNOWN.format(names, definition.name), Location(source.path, definition.line))
        cell.value = made or ClassValue(*owner)
    found = cell.value
    return (found.source, found.definition) if isinstance(found, ClassValue) else owner


def _made(walk: Walk, owner: tuple[Source, Class], decorators: list[Expression]) -> ClassValue | None:
    module, where = python_names.module_frame(walk, owner[0]), Location(owner[0].path, owner[1].line)
    made = ClassValue(*owner)
    for decorator in reversed(decorators):
        function = expressions.evaluate(walk, module, decorator)
        if not isinstance(function, Callable):
            return None
        value = calls.apply(walk, module, function, (call_arguments.PassedArgument(made),), (), where, decorator)
        if not isinstance(value, ClassValue):
            return None
        made = value
    return made


def _of_workspace(walk: Walk, decorator: Expression) -> bool:
    """Whether a decorator is called like a Python function, class or variable of the workspace."""
    name, index = _name(decorator), walk.index
    if not name or name in overloads.TRANSPARENT:
        return False
    return any(
        source.separator == "."
        for table in (index.functions, index.classes, index.variables)
        for source, _ in table.get(name, ())
    )


def _name(decorator: Expression) -> str:
    return syntax.name_of(decorator.callee if type(decorator) is syntax.Call else decorator)
