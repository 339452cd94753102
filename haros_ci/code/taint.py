# SPDX-License-Identifier: Apache-2.0
"""Content of messages: what of a routine's values comes from the message that its callback is given."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from haros_ci.code.body import Call, last_part
from haros_ci.code.calls import called
from haros_ci.code.codebase import Codebase, Routine
from haros_ci.model.program import Expression

#: Functions whose result cannot carry a command.
CLEANING = frozenset(
    "int float bool len quote abs round ord hash min max id isinstance stoi stod stof stol size empty length count find "
    "strlen atoi atof index startswith endswith isdigit compare get_clock sum".split()
)
#: Operators whose result is no text.
TESTS = frozenset("== != < > <= >= && || ! and or not in is".split())


Marks = Mapping[str, frozenset[tuple[str, ...]]]


def carried(expression: Expression, marks: Marks) -> frozenset[tuple[str, ...]]:
    """The members of the message that an expression's value carries; *marks* are the variables that carry some."""
    tag = expression[0]
    if tag == "name":
        return marks.get(expression[1], frozenset())
    if tag == "field":
        return frozenset((*path, expression[2]) for path in carried(expression[1], marks))
    if tag in ("*", "&", "star"):
        return carried(expression[1], marks)
    if tag in ("kw", "cast"):
        return carried(expression[2], marks)
    if tag == "index":
        return carried(expression[1], marks)
    if tag == "op":
        return frozenset() if expression[1] in TESTS else _any(expression[2], marks)
    if tag in ("list", "format"):
        return _any(expression[1], marks)
    if tag == "if":
        return _any(expression[2:4], marks)
    if tag == "call":
        name = last_part(expression[1])
        if name in CLEANING:
            return frozenset()
        receiver: frozenset[tuple[str, ...]] = frozenset()
        if expression[1][0] == "field":
            receiver = carried(expression[1][1], marks)
            if name in ("get", "lookup", "at") and not receiver:  # what is looked up is not what it is looked up by
                return frozenset()
        return receiver | _any(expression[2], marks)
    return frozenset()


def _any(every: Any, marks: Marks) -> frozenset[tuple[str, ...]]:
    found: frozenset[tuple[str, ...]] = frozenset()
    for each in every:
        found |= carried(each, marks)
    return found


def marks_in(code: Codebase, routine: Routine, start: Marks) -> dict[str, frozenset[tuple[str, ...]]]:
    """The local variables that carry message content, given those parameters that do."""
    marks = dict(start)
    body = code.body(routine)
    for _ in range(3):
        before = dict(marks)
        for name, every in body.variables.items():
            for each in every:
                if each.init is not None:
                    inner = (each.init[1],) if each.init[0] in ("=", "each") else each.init[1]
                    marks[name] = marks.get(name, frozenset()) | _any(inner, marks)
        for target, operator, value, _ in body.sets:
            if target[0] == "name" and operator in ("=", "+="):
                marks[target[1]] = marks.get(target[1], frozenset()) | carried(value, marks)
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
            given: dict[str, frozenset[tuple[str, ...]]] = {}
            plain = [each for each in call.args if each[0] != "kw"]
            for parameter, each in zip(target.function.parameters, plain, strict=False):
                given[parameter.name] = carried(each, marks)
            for each in call.args:
                if each[0] == "kw":
                    given[each[1]] = carried(each[2], marks)
            if any(given.values()):
                for where, inner, its, way in followed(code, target, given, depth - 1):
                    yield where, inner, its, ((routine, call), *way)
