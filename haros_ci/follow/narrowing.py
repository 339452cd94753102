# SPDX-License-Identifier: Apache-2.0
"""What a test of equality tells of the variable in it, or of a getter's result, for what stands under it: ``if (side == "left")``."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from haros_ci import syntax
from haros_ci.follow import calls, conversions, expressions
from haros_ci.follow.frames import Frame
from haros_ci.follow.walk import Walk
from haros_ci.syntax import Expression
from haros_ci.values.abstract import Cell, Choice, Known, Opaque, Text, Value

#: How the name of a function begins that only tells something.
GETTERS = ("get", "Get")
_LITERALS = (syntax.String, syntax.Number)


@contextmanager
def narrowed(walk: Walk, frame: Frame, test: Expression) -> Iterator[None]:
    """Inside, variables have the values that *test* says they have, as long as nothing else is assigned to them."""
    held: list[tuple[Cell, Value, Value]] = []
    names: list[str] = []
    for variable, literal in _equalities(test):
        known = expressions.evaluate(walk, frame, literal)
        if not isinstance(known, Known) or not issubclass(known.kind, (str, int)):
            continue
        getter = _getter(variable)
        if getter and getter not in frame.beliefs:
            frame.beliefs[getter] = known
            names.append(getter)
        cell = expressions.cell_of(walk, frame, variable) if _is_plain(variable) else None
        if cell is None or not isinstance(cell.value, (Opaque, Choice, Text)):
            continue
        value = conversions.converted(known, cell.type)
        if isinstance(value, Known):
            held.append((cell, cell.value, value))
            walk.state.write(cell, value)
    try:
        yield
    finally:
        for cell, before, value in reversed(held):
            if cell.value is value:
                walk.state.write(cell, before)
        for name in names:
            del frame.beliefs[name]


def called(walk: Walk, frame: Frame, expression: syntax.Call) -> Value:
    """The value of a call: where it is a getter's of which nothing is known, what the test around it says."""
    value = calls.call(walk, frame, expression)
    if isinstance(value, Opaque):
        return frame.beliefs.get(_getter(expression), value)
    return value


def _equalities(test: Expression) -> Iterator[tuple[Expression, Expression]]:
    """What *test* compares with a literal, and the literal, of all that has to hold for it."""
    if type(test) is not syntax.Operation:
        return
    if test.operator == "&&":
        for operand in test.operands:
            yield from _equalities(operand)
    elif test.operator == "==" and len(test.operands) == 2:
        one, other = test.operands
        if isinstance(other, _LITERALS):
            yield one, other
        elif isinstance(one, _LITERALS):
            yield other, one


def _getter(expression: Expression) -> str:
    """The name of a function without arguments that only tells something; "" if *expression* is no call of one."""
    if type(expression) is not syntax.Call or expression.arguments:
        return ""
    callee = expression.callee
    owner = callee.object if type(callee) is syntax.Member else None
    last = callee.name if isinstance(callee, (syntax.Name, syntax.Member)) else ""
    if not last.rpartition("::")[2].startswith(GETTERS) or not (owner is None or _is_plain(owner)):
        return ""
    return repr(callee)


def _is_plain(expression: Expression) -> bool:
    """Whether it is a name, or a member of one: nothing is called for it."""
    while type(expression) is syntax.Member or type(expression) is syntax.Dereference:
        expression = expression.object if type(expression) is syntax.Member else expression.value
    return isinstance(expression, (syntax.Name, syntax.This))
