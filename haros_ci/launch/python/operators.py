# SPDX-License-Identifier: Apache-2.0
"""Operators on values, none of which makes anything large."""

from __future__ import annotations

import ast
import operator
from collections.abc import Callable
from typing import Any

from haros_ci.bounded_python.language import ARITHMETIC, BITS, POWER
from haros_ci.launch.python.formats import percent
from haros_ci.launch.python.heap import LARGEST
from haros_ci.launch.python.paths import joined_path
from haros_ci.launch.python.run import ScriptEvaluation
from haros_ci.launch.python.truth import contains, equal, truth
from haros_ci.launch.python.values import (
    Configurations,
    Library,
    PartialText,
    PathValue,
    Rest,
    Sub,
    Unknown,
    Value,
    holes,
    merged,
    phrase,
    text_of,
    uncertain,
    why,
)
from haros_ci.model.launch_actions import Substitution
from haros_ci.model.location import Location

BINARY: dict[type, Callable[[Any, Any], Any]] = {
    **ARITHMETIC,
    **POWER,
    **BITS,
    ast.LShift: operator.lshift,
    ast.RShift: operator.rshift,
}
ORDER: dict[type, Callable[[Any, Any], Any]] = {
    ast.Lt: operator.lt,
    ast.LtE: operator.le,
    ast.Gt: operator.gt,
    ast.GtE: operator.ge,
}
NUMBER = (bool, int, float)


def binary(run: ScriptEvaluation, op: ast.operator, one: Value, other: Value, place: Location) -> Value:
    """``one op other``; Unknown if Python would raise, or if it is large."""
    if isinstance(op, ast.Add) and stringy(one, other):
        return run.made(text_of(merged((*phrase(one), *phrase(other)))), place)
    for value in (one, other):
        if isinstance(value, Unknown):
            return Unknown(value.reason, value.location)
    if isinstance(op, ast.Div) and (isinstance(one, (PathValue, Sub)) or isinstance(other, PathValue)):
        return _path(one, other, place)
    if isinstance(op, ast.Mod) and isinstance(one, (str, PartialText)):
        return percent(run, one, other, place)
    if isinstance(op, ast.Mult) and (repeated := repeat(run, one, other, place)) is not None:
        return repeated
    if (made := _container(run, op, one, other, place)) is not None:
        return made
    if not (isinstance(one, NUMBER) and isinstance(other, NUMBER)) or type(op) not in BINARY:
        return run.unknown(why(one if not isinstance(one, NUMBER) else other), place)
    if isinstance(op, (ast.Pow, ast.LShift)) and not small_power(one, other):
        return run.unknown("the number is too large", place)
    return run.made(BINARY[type(op)](one, other), place)


def _path(one: Value, other: Value, place: Location) -> Value:
    """``one / other`` of paths, or of a substitution and what comes below it."""
    if isinstance(one, Sub):
        return Sub((Substitution("join", (phrase(one), phrase(other)), place),), "PathJoinSubstitution")
    return PathValue(joined_path([value.text if isinstance(value, PathValue) else value for value in (one, other)]))


def _container(run: ScriptEvaluation, op: ast.operator, one: Value, other: Value, place: Location) -> Value | None:
    """An operator on two lists, tuples, maps or sets; None where there is none."""
    if isinstance(op, ast.Add) and isinstance(one, (list, tuple)) and type(one) is type(other):
        if len(one) + len(other) > LARGEST:
            return run.unknown("it is too large", place)
        return run.made(operator.add(one, other), place)
    if isinstance(op, ast.BitOr) and isinstance(one, dict) and isinstance(other, dict):
        return run.made({**one, **other}, place)
    if isinstance(one, set) and isinstance(other, set) and isinstance(op, (ast.BitOr, ast.BitAnd, ast.Sub, ast.BitXor)):
        if (doubt := holes(one) or holes(other)) is not None:
            return Unknown(doubt.reason, doubt.location)
        return run.made(BINARY[type(op)](one, other), place)
    return None


def stringy(one: Value, other: Value) -> bool:
    """Whether both are texts, or one of them and the other not known."""
    kinds = (str, PartialText)
    return (isinstance(one, kinds) and isinstance(other, (*kinds, Unknown)) and not isinstance(other, Rest)) or (
        isinstance(other, kinds) and isinstance(one, Unknown) and not isinstance(one, Rest)
    )


def repeat(run: ScriptEvaluation, one: Value, other: Value, place: Location) -> Value | None:
    """A text or list, so many times; None if it is neither."""
    count, items = (one, other) if isinstance(one, int) else (other, one)
    if not isinstance(count, int) or not isinstance(items, (str, list, tuple, bytes)):
        return None
    if count > 0 and len(items) * count > LARGEST:
        return run.unknown("it is too large", place)
    return run.made(items * count, place)


def small_power(one: Any, other: Any) -> bool:
    if isinstance(one, float) or isinstance(other, float):
        return True
    return bool(0 <= other <= 4096 and one.bit_length() * other <= 4096)


def unary(run: ScriptEvaluation, op: ast.unaryop, value: Value, place: Location) -> Value:
    if isinstance(op, ast.Not):
        known = truth(run, value)
        return known if isinstance(known, Unknown) else not known
    if isinstance(value, Unknown):
        return Unknown(value.reason, value.location)
    if not isinstance(value, NUMBER):
        return run.unknown(why(value), place)
    if isinstance(op, ast.USub):
        return -value
    if isinstance(op, ast.UAdd):
        return +value
    return ~value if isinstance(value, int) else run.unknown("it raises TypeError", place)


def compare(run: ScriptEvaluation, op: ast.cmpop, one: Value, other: Value, place: Location) -> Value:
    """``one op other``: True, False or Unknown."""
    if isinstance(op, (ast.Eq, ast.NotEq)):
        return negated(equal(run, one, other), isinstance(op, ast.NotEq))
    if isinstance(op, (ast.Is, ast.IsNot)):
        return negated(identical(run, one, other), isinstance(op, ast.IsNot))
    if isinstance(op, (ast.In, ast.NotIn)):
        return negated(member(run, one, other, place), isinstance(op, ast.NotIn))
    for value in (one, other):
        if uncertain(value):
            return Unknown(why(value), getattr(value, "location", None))
    comparable = isinstance(one, NUMBER) and isinstance(other, NUMBER)
    if comparable or (isinstance(one, str) and isinstance(other, str)):
        return ORDER[type(op)](one, other)
    return run.unknown("how these compare is not followed", place)


def negated(value: bool | Unknown, turn: bool) -> bool | Unknown:
    return value if isinstance(value, Unknown) or not turn else not value


def identical(run: ScriptEvaluation, one: Value, other: Value) -> bool | Unknown:
    if one is None or other is None or isinstance(one, bool) or isinstance(other, bool):
        if isinstance(one, PartialText) or isinstance(other, PartialText):
            return False
        return equal(run, one, other) if type(one) is type(other) or uncertain(one) or uncertain(other) else False
    if uncertain(one) or uncertain(other):
        return Unknown(why(one if uncertain(one) else other), None)
    if isinstance(one, Library) and isinstance(other, Library):
        return one.dotted == other.dotted
    return one is other


def member(run: ScriptEvaluation, one: Value, other: Value, place: Location) -> bool | Unknown:
    """``one in other``."""
    if isinstance(other, Configurations):
        if not isinstance(one, str):
            return Unknown(why(one), place)
        return other.context.launch.configuration(one) is not None
    if isinstance(other, Library) and other.dotted == "os.environ":
        return (
            True
            if isinstance(one, str) and one in run.environment
            else run.unknown("the environment is not known", place)
        )
    if isinstance(other, str) and isinstance(one, str):
        return one in other
    if isinstance(other, range):
        return one in other if isinstance(one, (bool, int)) else run.unknown(why(one), place)
    if isinstance(other, (list, tuple, set, dict)):
        return contains(run, other, one)
    return run.unknown(why(other if not isinstance(other, str) else one), place)
