# SPDX-License-Identifier: Apache-2.0
"""Quantifiers written out: over sets, ranges and arrays of a fixed length, as far as these are short."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from functools import partial, reduce

from haros_ci.behaviour.messages import Typed
from haros_ci.behaviour.text import expression_text
from haros_ci.behaviour.tree import (
    Binary,
    Call,
    Event,
    Expression,
    Field,
    Item,
    Literal,
    Place,
    Property,
    Quantifier,
    Range,
    SetOf,
    Unary,
    Variable,
    parts,
)
from haros_ci.interfaces.definitions import FieldType
from haros_ci.verification.fields import MOST_PARTS
from haros_ci.verification.problem import Claim, NotModelled

#: Members that a quantifier goes through.
MOST_MEMBERS = 16
_NOWHERE = Place(1, 1, 0, 0)


def lowered(claim: Claim) -> Claim:
    """*claim* without quantifiers; NotModelled where that is not possible."""
    before = claim.stated

    def events(found: tuple[Event, ...]) -> tuple[Event, ...]:
        return tuple(_event(event, partial(claim.typed, event)) for event in found)

    scope = replace(before.scope, activator=events(before.scope.activator), terminator=events(before.scope.terminator))
    pattern = replace(
        before.pattern, behaviour=events(before.pattern.behaviour), trigger=events(before.pattern.trigger)
    )
    after = Property(before.at, scope, pattern, before.metadata)
    known = {id(new): old for new, old in zip(after.events, before.events)}
    return replace(
        claim,
        stated=after,
        typed=lambda event, part: claim.typed(known[id(event)], part),
        constants=lambda event, part: claim.constants(known[id(event)], part),
    )


def _event(event: Event, typed: Callable[[Expression], Typed]) -> Event:
    if event.predicate is None:
        return event
    found = _without(event.predicate, typed, 0)
    if sum(1 for _ in parts(found)) > MOST_PARTS:
        raise NotModelled(f"a predicate of more than {MOST_PARTS:,} parts")
    return replace(event, predicate=found)


def _without(expression: Expression, typed: Callable[[Expression], Typed], depth: int) -> Expression:
    if not any(isinstance(part, Quantifier) for part in parts(expression)):
        return expression
    match expression:
        case Quantifier():
            return _written_out(expression, typed, depth)
        case Unary(operand=operand):
            return replace(expression, operand=_without(operand, typed, depth))
        case Binary(left=left, right=right):
            return replace(expression, left=_without(left, typed, depth), right=_without(right, typed, depth))
        case _:
            raise NotModelled(f"a quantifier as a value: {expression_text(expression)}")


def _written_out(quantifier: Quantifier, typed: Callable[[Expression], Typed], depth: int) -> Expression:
    if depth >= 3:
        raise NotModelled("quantifiers within each other")
    members = _members(quantifier, typed)
    one_by_one = [
        _without(substituted(quantifier.condition, quantifier.variable, member), typed, depth + 1) for member in members
    ]
    is_all = quantifier.word == "forall"
    if not one_by_one:
        return Literal(quantifier.at, str(is_all), is_all)
    return reduce(
        lambda left, right: Binary(quantifier.at, "and" if is_all else "or", left, right),
        one_by_one,
    )


def _members(quantifier: Quantifier, typed: Callable[[Expression], Typed]) -> list[Expression]:
    domain = quantifier.domain
    found: list[Expression] | None = None
    if isinstance(domain, SetOf):
        found = list(domain.values)
    elif isinstance(domain, Range):
        found = _whole_numbers(domain)
    else:
        known = typed(domain)
        if isinstance(known, FieldType) and known.form == "array":
            found = [_number(value) for value in range(min(known.size, MOST_MEMBERS + 1))]
    if found is None or len(found) > MOST_MEMBERS:
        raise NotModelled(f"a quantifier over {expression_text(domain)}")
    return found


def _whole_numbers(domain: Range) -> list[Expression] | None:
    """Those of a range between literals, or one more than are looked at; None for other ranges."""
    if not isinstance(domain.low, Literal) or not isinstance(domain.high, Literal):
        return None
    low, high = domain.low.value, domain.high.value
    if isinstance(low, str) or isinstance(high, str) or not abs(low) + abs(high) < 1e9:
        return None
    first, last = math.ceil(low), math.floor(high)
    first += domain.open_low and first == low
    last -= domain.open_high and last == high
    return [_number(value) for value in range(first, min(last + 1, first + MOST_MEMBERS + 1))]


def _number(value: int) -> Literal:
    return Literal(_NOWHERE, str(value), value)


def substituted(expression: Expression, name: str, value: Expression) -> Expression:
    """*expression* with *value* for the variable *name*."""

    def inner(part: Expression) -> Expression:
        return substituted(part, name, value)

    match expression:
        case Variable(name=own) if own == name:
            return value
        case SetOf(values=values):
            return replace(expression, values=tuple(map(inner, values)))
        case Call(arguments=arguments):
            return replace(expression, arguments=tuple(map(inner, arguments)))
        case Range(low=low, high=high):
            return replace(expression, low=inner(low), high=inner(high))
        case Field(base=base) if base is not None:
            return replace(expression, base=inner(base))
        case Item(base=base, index=index):
            return replace(expression, base=inner(base), index=_constant(inner(index)))
        case Unary(operand=operand):
            return replace(expression, operand=inner(operand))
        case Binary(left=left, right=right):
            return replace(expression, left=inner(left), right=inner(right))
        case Quantifier(domain=domain, condition=condition):
            return replace(expression, domain=inner(domain), condition=inner(condition))
        case _:
            return expression


def _constant(index: Expression) -> Expression:
    """``2 + 1`` as 3, so that an item's number is known."""
    match index:
        case Binary(operator=("+" | "-") as sign, left=left, right=right):
            one, other = _constant(left), _constant(right)
            if isinstance(one, Literal) and isinstance(other, Literal):
                first, second = one.value, other.value
                if type(first) is int and type(second) is int:
                    value = first + second if sign == "+" else first - second
                    return _number(value) if value >= 0 else index
        case _:
            pass
    return index
