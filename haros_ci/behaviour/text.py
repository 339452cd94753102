# SPDX-License-Identifier: Apache-2.0
"""The canonical text of a property: the same for texts that differ in white space, comments, parentheses without effect and units of time only."""

from __future__ import annotations

from haros_ci.behaviour.tree import (
    Binary,
    Call,
    Event,
    Expression,
    Field,
    Item,
    Literal,
    Pattern,
    PatternKind,
    Property,
    Quantifier,
    Range,
    Scope,
    ScopeKind,
    SetOf,
    Unary,
    Variable,
)

#: How strongly operators bind; those of one rank group from the left.
RANKS = {
    "implies": 1, "iff": 1, "or": 2, "and": 3,
    "=": 5, "!=": 5, "<": 5, "<=": 5, ">": 5, ">=": 5, "in": 5,
    "+": 6, "-": 6, "*": 7, "/": 7, "**": 8,
}  # fmt: skip
_LOGIC, _COMPARISON, _PREFIX, _ATOM = 4, 5, 9, 10


def canonical(property: Property) -> str:
    """The canonical text; it is the same property again, without metadata."""
    return f"{scope_text(property.scope)}: {pattern_text(property.pattern)}"


def scope_text(scope: Scope) -> str:
    match scope.kind:
        case ScopeKind.GLOBALLY:
            return "globally"
        case ScopeKind.AFTER:
            return f"after {events_text(scope.activator)}"
        case ScopeKind.UNTIL:
            return f"until {events_text(scope.terminator)}"
        case _:
            return f"after {events_text(scope.activator)} until {events_text(scope.terminator)}"


def pattern_text(pattern: Pattern) -> str:
    behaviour, trigger = events_text(pattern.behaviour), events_text(pattern.trigger)
    match pattern.kind:
        case PatternKind.SOME | PatternKind.NO:
            text = f"{pattern.kind.value} {behaviour}"
        case PatternKind.REQUIRES:
            text = f"{behaviour} requires {trigger}"
        case _:
            text = f"{trigger} {pattern.kind.value} {behaviour}"
    return text if pattern.bound is None else f"{text} within {time_text(pattern.bound.seconds)}"


def time_text(seconds: float) -> str:
    """A time in the unit that people would write: ``200 ms``, ``1.5 s``."""
    if seconds and seconds < 1:
        return f"{_digits(float(f'{seconds * 1000:.12g}'))} ms"
    return f"{_digits(seconds)} s"


def _digits(number: float) -> str:
    return f"{number:.0f}" if number == int(number) and number < 1e15 else repr(number)


def events_text(events: tuple[Event, ...]) -> str:
    texts = [event_text(event) for event in events]
    return texts[0] if len(texts) == 1 else f"({' or '.join(texts)})"


def event_text(event: Event) -> str:
    alias = "" if event.alias is None else f" as {event.alias}"
    return f"{event.topic}{alias}" + ("" if event.predicate is None else f" {{{expression_text(event.predicate)}}}")


def expression_text(expression: Expression) -> str:
    """The text of an expression, with the parentheses that it needs."""
    match expression:
        case Literal(written=written):
            return written
        case SetOf(values=values):
            return f"{{{_list(values)}}}"
        case Range():
            return _range_text(expression)
        case Variable(name=name):
            return f"@{name}"
        case Field(base=base, name=name):
            return name if base is None else f"{expression_text(base)}.{name}"
        case Item(base=base, index=index):
            return f"{expression_text(base)}[{_at_least(index, 6)}]"
        case Call(name=name, arguments=arguments):
            return f"{name}({_list(arguments)})"
        case Unary(operator=operator, operand=operand):
            return f"not {_at_least(operand, _LOGIC)}" if operator == "not" else f"-{_at_least(operand, _PREFIX)}"
        case Binary():
            return _binary_text(expression)
        case Quantifier(word=word, variable=variable, domain=domain, condition=condition):
            return f"{word} {variable} in {expression_text(domain)}: {_at_least(condition, _LOGIC)}"


def _range_text(range: Range) -> str:
    opening, closing = "![" if range.open_low else "[", "]!" if range.open_high else "]"
    return f"{opening}{_at_least(range.low, 6)} to {_at_least(range.high, 6)}{closing}"


def _binary_text(binary: Binary) -> str:
    rank = RANKS[binary.operator]
    first = rank + 1 if rank == _COMPARISON else rank
    return f"{_at_least(binary.left, first)} {binary.operator} {_at_least(binary.right, rank + 1)}"


def rank_of(expression: Expression) -> int:
    match expression:
        case Binary(operator=operator):
            return RANKS[operator]
        case Unary(operator="not") | Quantifier():
            return _LOGIC
        case Unary():
            return _PREFIX
        case _:
            return _ATOM


def _at_least(expression: Expression, rank: int) -> str:
    text = expression_text(expression)
    return text if rank_of(expression) >= rank else f"({text})"


def _list(values: tuple[Expression, ...]) -> str:
    return ", ".join(_at_least(value, 6) for value in values)
