# SPDX-License-Identifier: Apache-2.0
"""Predicates as formulas. As in ``monitoring/predicates.py`` a predicate that asks for what a message does not have is false as a whole.

So each part is a value and the condition under which it has one; ``and``, ``or`` and ``implies`` do not look at their right side where
the left one decides.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from fractions import Fraction
from typing import Any

import z3

from haros_ci.behaviour.text import expression_text
from haros_ci.behaviour.tree import (
    Binary,
    Call,
    Event,
    Expression,
    Field,
    Item,
    Literal,
    Range,
    SetOf,
    Unary,
    Variable,
)
from haros_ci.monitoring.predicates import key_of
from haros_ci.records import dataclass
from haros_ci.verification.fields import Fields, Kind, owner_of
from haros_ci.verification.problem import Claim, NotModelled

#: The value of a part of a message by its key, and whether it is there.
Message = Callable[[str], "Value"]
TRUE, FALSE = z3.BoolVal(True), z3.BoolVal(False)
#: The greatest exponent.
MOST_POWER = 4


@dataclass(frozen=True, slots=True)
class Value:
    """A *term* (or a number of Python that is not finite), and the condition *there* under which it has a value."""

    kind: Kind
    term: Any
    there: Any = TRUE


def both(*parts: Any) -> Any:
    """The conjunction, short where a part is constant."""
    kept = [part for part in parts if not z3.is_true(part)]
    if any(z3.is_false(part) for part in kept):
        return FALSE
    return TRUE if not kept else kept[0] if len(kept) == 1 else z3.And(*kept)


def one_of(*parts: Any) -> Any:
    """The disjunction, short where a part is constant."""
    kept = [part for part in parts if not z3.is_false(part)]
    if any(z3.is_true(part) for part in kept):
        return TRUE
    return FALSE if not kept else kept[0] if len(kept) == 1 else z3.Or(*kept)


def no(part: Any) -> Any:
    """The opposite."""
    return FALSE if z3.is_true(part) else TRUE if z3.is_false(part) else z3.Not(part)


class Compiler:
    """Makes formulas of the predicates of one claim; *fields* knows all that they ask for."""

    def __init__(self, claim: Claim, fields: Fields) -> None:
        self.claim = claim
        self.fields = fields

    def holds(self, event: Event, own: Message, others: Mapping[str, Message]) -> Any:
        """Whether a message is one of *event*, given those of the aliases that it can use."""
        if event.predicate is None:
            return TRUE
        made = _Predicate(self, event, own, others).of(event.predicate)
        return both(made.there, _truth(made))


@dataclass(frozen=True, slots=True)
class _Predicate:
    compiler: Compiler
    event: Event
    own: Message
    others: Mapping[str, Message]

    def of(self, expression: Expression) -> Value:
        constant = self.constant(expression)
        if constant is not None:
            return self.literal(constant)
        match expression:
            case Literal(value=value):
                return self.literal(value)
            case Field() | Item() | Variable():
                return self.chain(expression)
            case Unary(operator="not", operand=operand):
                inner = self.of(operand)
                return Value(Kind.BOOL, no(_truth(inner)), inner.there)
            case Unary(operand=operand):
                number = _number(self.of(operand), expression)
                return Value(number.kind, -number.term, number.there)
            case Call():
                return self.call(expression)
            case Binary():
                return self.binary(expression)
            case _:
                raise NotModelled(expression_text(expression))

    def constant(self, expression: Expression) -> Any:
        if not isinstance(expression, (Field, Item, Variable)):
            return None
        return self.compiler.claim.constants(self.event, expression)

    def literal(self, value: Any) -> Value:
        if isinstance(value, bool):
            return Value(Kind.BOOL, z3.BoolVal(value))
        if isinstance(value, str):
            return Value(Kind.TEXT, z3.IntVal(self.compiler.fields.text(value)))
        if isinstance(value, float) and not math.isfinite(value):
            return Value(Kind.REAL, value)
        if isinstance(value, int) or value.is_integer():
            return Value(Kind.INT, z3.IntVal(int(value)))
        exact = Fraction(value)
        return Value(Kind.REAL, z3.Q(exact.numerator, exact.denominator))

    def chain(self, expression: Expression) -> Value:
        message = self.message(expression)
        if message is None:
            return Value(Kind.BOOL, FALSE, FALSE)
        return message(key_of(expression))

    def message(self, expression: Expression) -> Message | None:
        """The message that a chain begins at; None if it is that of an event that was not met."""
        owner = owner_of(self.compiler.claim, self.event, expression)
        if owner is None:
            raise NotModelled(expression_text(expression))
        return self.own if owner is self.event else self.others.get(owner.alias or "")

    def call(self, call: Call) -> Value:
        name, arguments = call.name, call.arguments
        if name == "len" and len(arguments) == 1 and isinstance(arguments[0], (Field, Item)):
            message = self.message(arguments[0])
            return Value(Kind.BOOL, FALSE, FALSE) if message is None else message(f"len({key_of(arguments[0])})")
        if name == "abs" and len(arguments) == 1:
            inner = _number(self.of(arguments[0]), call)
            return Value(inner.kind, z3.If(inner.term >= 0, inner.term, -inner.term), inner.there)
        if name in ("max", "min") and len(arguments) > 1:
            found = _number(self.of(arguments[0]), call)
            for argument in arguments[1:]:
                found = _extreme(found, _number(self.of(argument), call), greatest=name == "max")
            return found
        raise NotModelled(f"the function {name} in {expression_text(call)}")

    def binary(self, binary: Binary) -> Value:
        if binary.operator == "in":
            return self.membership(binary)
        left, right = self.of(binary.left), self.of(binary.right)
        if binary.operator in _SKIPPED:
            return _logic(binary.operator, left, right)
        there = both(left.there, right.there)
        if binary.operator in _COMPARED:
            term, possible = _compared(binary.operator, left, right)
            return Value(Kind.BOOL, term, both(there, possible))
        if binary.operator == "**":
            return self.power(binary, left, right)
        return _calculated(binary.operator, _number(left, binary), _number(right, binary))

    def power(self, binary: Binary, left: Value, right: Value) -> Value:
        exponent = right.term
        if not (right.kind is Kind.INT and z3.is_int_value(exponent) and 0 <= exponent.as_long() <= MOST_POWER):
            raise NotModelled(f"the power {expression_text(binary)}")
        base = _number(left, binary)
        found = Value(Kind.INT, z3.IntVal(1), base.there)
        for _ in range(exponent.as_long()):
            found = _calculated("*", found, base)
        return found

    def membership(self, binary: Binary) -> Value:
        value, compound = self.of(binary.left), binary.right
        if isinstance(compound, SetOf):
            members = [self.of(member) for member in compound.values]
            terms = [both(*_compared("=", value, member)) for member in members]
            return Value(Kind.BOOL, one_of(*terms), both(value.there, *(member.there for member in members)))
        if not isinstance(compound, Range):
            raise NotModelled(f"membership in an array: {expression_text(binary)}")
        low, high = self.of(compound.low), self.of(compound.high)
        above, first = _compared("<" if compound.open_low else "<=", low, value)
        below, second = _compared("<" if compound.open_high else "<=", value, high)
        there = both(value.there, low.there, high.there, first, one_of(no(above), second))
        return Value(Kind.BOOL, both(above, below), there)


_SKIPPED = frozenset(("and", "or", "implies", "iff"))
_COMPARED = frozenset(("=", "!=", "<", "<=", ">", ">="))


def _truth(value: Value) -> Any:
    """A value where a truth value is needed, as Python takes it."""
    if value.kind is Kind.BOOL:
        return value.term
    return value.term != 0


def _number(value: Value, whole: Expression) -> Value:
    """A value that is calculated with; a truth value is 0 or 1."""
    if value.kind is Kind.BOOL:
        return Value(Kind.INT, z3.If(value.term, z3.IntVal(1), z3.IntVal(0)), value.there)
    if value.kind is Kind.TEXT or isinstance(value.term, float):
        raise NotModelled(expression_text(whole))
    return value


def _real(value: Value) -> Any:
    return value.term if value.kind is Kind.REAL else z3.ToReal(value.term)


def _same(left: Value, right: Value) -> tuple[Kind, Any, Any]:
    """Two numbers as terms of one sort."""
    if left.kind is right.kind:
        return left.kind, left.term, right.term
    return Kind.REAL, _real(left), _real(right)


def _extreme(left: Value, right: Value, *, greatest: bool) -> Value:
    kind, one, other = _same(left, right)
    first = one >= other if greatest else one <= other
    return Value(kind, z3.If(first, one, other), both(left.there, right.there))


def _calculated(sign: str, left: Value, right: Value) -> Value:
    there = both(left.there, right.there)
    if sign == "/":
        divisor = _real(right)
        return Value(Kind.REAL, _real(left) / divisor, both(there, divisor != 0))
    kind, one, other = _same(left, right)
    return Value(kind, one + other if sign == "+" else one - other if sign == "-" else one * other, there)


def _logic(word: str, left: Value, right: Value) -> Value:
    one, other = _truth(left), _truth(right)
    match word:
        case "and":
            return Value(Kind.BOOL, both(one, other), both(left.there, one_of(no(one), right.there)))
        case "or":
            return Value(Kind.BOOL, one_of(one, other), both(left.there, one_of(one, right.there)))
        case "implies":
            return Value(Kind.BOOL, one_of(no(one), other), both(left.there, one_of(no(one), right.there)))
        case _:
            return Value(Kind.BOOL, one == other, both(left.there, right.there))


def _compared(sign: str, left: Value, right: Value) -> tuple[Any, Any]:
    """The comparison, and whether it is possible at all: texts and numbers are unequal, and have no order."""
    if Kind.TEXT in (left.kind, right.kind):
        if left.kind is right.kind and sign in ("=", "!="):
            return (left.term == right.term, TRUE) if sign == "=" else (left.term != right.term, TRUE)
        if left.kind is right.kind:
            raise NotModelled("the order of texts")
        return (FALSE, TRUE) if sign == "=" else (TRUE, TRUE) if sign == "!=" else (FALSE, FALSE)
    if isinstance(left.term, float) or isinstance(right.term, float):
        return _with_infinity(sign, left.term, right.term), TRUE
    if left.kind is right.kind is Kind.BOOL and sign in ("=", "!="):
        return (left.term == right.term, TRUE) if sign == "=" else (left.term != right.term, TRUE)
    nothing = Literal(None, "", 0)  # type: ignore[arg-type]  # neither is a text
    _, one, other = _same(_number(left, nothing), _number(right, nothing))
    return {
        "=": one == other, "!=": one != other, "<": one < other, "<=": one <= other, ">": one > other, ">=": one >= other,
    }[sign], TRUE  # fmt: skip


def _with_infinity(sign: str, left: Any, right: Any) -> Any:
    """A comparison with what is no finite number; 0 stands for all that are."""
    one, other = (side if isinstance(side, float) else 0.0 for side in (left, right))
    holds = {
        "=": one == other,
        "!=": one != other,
        "<": one < other,
        "<=": one <= other,
        ">": one > other,
        ">=": one >= other,
    }
    return z3.BoolVal(holds[sign])
