# SPDX-License-Identifier: Apache-2.0
"""Content of messages: what of a routine's values comes from the message that its callback is given."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from haros_ci import syntax
from haros_ci.code.body import Call, last_part
from haros_ci.code.calls import called
from haros_ci.code.codebase import Codebase, Routine
from haros_ci.regex import regex
from haros_ci.syntax import Expression

#: Functions whose result cannot carry a command.
CLEANING = frozenset(
    "int float bool len quote abs round ord hash min max id isinstance stoi stod stof stol size empty length count find "
    "strlen atoi atof index startswith endswith isdigit compare get_clock sum".split()
)
#: Operators whose result is no text.
TESTS = frozenset("== != < > <= >= && || ! and or not in is".split())
#: The fields of ``"…".format()`` and of ``"…" % …``, each with its type of presentation, and those types that no text has.
_BRACES = regex(r"\{[^{}:]{0,80}(?::[^{}]{0,40}?([A-Za-z%])?)?\}")
_PERCENT = regex(r"%(?:\(\w{1,60}\))?[-+#0 ]{0,5}[\d*]{0,5}(?:\.[\d*]{0,5})?([A-Za-z%])")
_NUMERIC = frozenset("bcdeEfFgGiouxXn%")

Marks = Mapping[str, frozenset[tuple[str, ...]]]


def carried(expression: Expression, marks: Marks) -> frozenset[tuple[str, ...]]:  # noqa: C901 - one branch for each kind of expression
    """The members of the message that an expression's value carries; *marks* are the variables that carry some."""
    if isinstance(expression, syntax.Name):
        return marks.get(expression.name, frozenset())
    if isinstance(expression, syntax.Member):
        return frozenset((*path, expression.name) for path in carried(expression.object, marks))
    if isinstance(expression, (syntax.Dereference, syntax.Address, syntax.Star)):
        return carried(expression.value, marks)
    if isinstance(expression, (syntax.Keyword, syntax.Cast)):
        return carried(expression.value, marks)
    if isinstance(expression, syntax.Subscript):
        return carried(expression.object, marks)
    if isinstance(expression, syntax.Operation):
        if expression.operator in TESTS or (
            expression.operator == "%" and _is_numeric(expression.operands[0], _PERCENT)
        ):
            return frozenset()
        return _any(expression.operands, marks)
    if isinstance(expression, syntax.ListLiteral):
        return _any(expression.items, marks)
    if isinstance(expression, syntax.Format):
        return _any(expression.parts, marks)
    if isinstance(expression, syntax.Conditional):
        return _any((expression.then, expression.other), marks)
    if isinstance(expression, syntax.Call):
        name = last_part(expression.callee)
        if name in CLEANING:
            return frozenset()
        receiver: frozenset[tuple[str, ...]] = frozenset()
        if isinstance(expression.callee, syntax.Member):
            receiver = carried(expression.callee.object, marks)
            if name == "format" and _is_numeric(expression.callee.object, _BRACES):
                return frozenset()
            if name in ("get", "lookup", "at") and not receiver:  # what is looked up is not what it is looked up by
                return frozenset()
        return receiver | _any(expression.arguments, marks)
    return frozenset()


def _is_numeric(text: Expression, holes: re.Pattern[str]) -> bool:
    """Whether *text* is a format, all *holes* of which take a number alone."""
    found = list(holes.finditer(text.value)) if isinstance(text, syntax.String) else []
    return bool(found) and all(match[1] in _NUMERIC for match in found)


def _any(every: tuple[Expression, ...], marks: Marks) -> frozenset[tuple[str, ...]]:
    found: frozenset[tuple[str, ...]] = frozenset()
    for literal in every:
        found |= carried(literal, marks)
    return found


def marks_in(code: Codebase, routine: Routine, start: Marks) -> dict[str, frozenset[tuple[str, ...]]]:
    """The local variables that carry message content, given those parameters that do."""
    marks = dict(start)
    body = code.body(routine)
    for _ in range(3):
        before = dict(marks)
        for name, every in body.variables.items():
            for variable in every:
                if variable.init is not None:
                    marks[name] = marks.get(name, frozenset()) | _any(variable.parts, marks)
        for target, operator, value, _ in body.sets:
            if isinstance(target, syntax.Name) and operator in ("=", "+="):
                marks[target.name] = marks.get(target.name, frozenset()) | carried(value, marks)
        if marks == before:
            break
    return {name: paths for name, paths in marks.items() if paths}


def followed(
    code: Codebase, routine: Routine, start: Marks, depth: int = 1
) -> Iterator[tuple[Routine, Call, Marks, tuple[tuple[Routine, Call], ...]]]:
    """The calls in a routine, and so many calls deep, each with the variables that carry content there and the way to it."""
    marks = marks_in(code, routine, start)
    if not marks:
        return
    for call in code.body(routine).calls:
        yield routine, call, marks, ()
        if depth <= 0:
            continue
        for target in called(code, routine, call.whole):
            tainted: dict[str, frozenset[tuple[str, ...]]] = {}
            plain = [argument for argument in call.args if not isinstance(argument, syntax.Keyword)]
            for parameter, literal in zip(target.function.parameters, plain, strict=False):
                tainted[parameter.name] = carried(literal, marks)
            for argument in call.args:
                if isinstance(argument, syntax.Keyword):
                    tainted[argument.name] = carried(argument.value, marks)
            if any(tainted.values()):
                for where, inner, its, way in followed(code, target, tainted, depth - 1):
                    yield where, inner, its, ((routine, call), *way)
