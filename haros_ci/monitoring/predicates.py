# SPDX-License-Identifier: Apache-2.0
"""Predicates as closures: no text of a workspace is ever executed, and a part that cannot be had makes the predicate false.

A closure takes the message of its event and the *known* values: those of other events by their alias, and of quantifiers' variables. Of
another event's message only what the property asks of it is known, its *slots*, so that large messages are not kept.
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any

from haros_ci.behaviour.text import expression_text
from haros_ci.behaviour.tree import (
    Binary,
    Call,
    Event,
    Expression,
    Field,
    Item,
    Literal,
    Quantifier,
    Range,
    SetOf,
    Unary,
    Variable,
    children,
)
from haros_ci.monitoring.values import FAULTS, FUNCTIONS, Interval, field, is_in, item, members, number, power, tamed

Known = Mapping[str, Any]
Closure = Callable[[Any, Known], Any]
#: The value of a constant of a message, by the expression that names it; None for what is none, or not known.
Constants = Callable[[Event, Expression], Any]
Test = Callable[[Any, Known], bool]

_CALCULATED: dict[str, Callable[[Any, Any], Any]] = {
    "+": lambda a, b: tamed(number(a) + number(b)),
    "-": lambda a, b: tamed(number(a) - number(b)),
    "*": lambda a, b: tamed(number(a) * number(b)),
    "/": lambda a, b: number(a) / number(b),
    "**": lambda a, b: power(number(a), number(b)),
    "=": operator.eq,
    "!=": operator.ne,
    "<": operator.lt,
    "<=": operator.le,
    ">": operator.gt,
    ">=": operator.ge,
    "in": is_in,
}


class Missing:
    """A slot whose value the message does not have."""

    __slots__ = ()


_MISSING = Missing()


class Faults:
    """How many predicates could not be decided, for want of a value, and of which topic the first was."""

    __slots__ = ("count", "first")

    def __init__(self) -> None:
        self.count = 0
        self.first = ""


class Slots:
    """What is kept of the message of an event: the values of *expressions*, by their text without the alias."""

    def __init__(self, event: Event, expressions: Iterable[Expression], constants: Constants) -> None:
        compiled = _Compiler(event, constants)
        self.closures = {key_of(expression): compiled.of(expression) for expression in expressions}

    def of(self, message: Any) -> dict[str, Any]:
        """The values that *message* has for them."""
        found: dict[str, Any] = {}
        for key, closure in self.closures.items():
            try:
                found[key] = closure(message, {})
            except FAULTS:
                found[key] = _MISSING
        return found


def key_of(expression: Expression) -> str:
    """The text of a chain without its alias; "" is the message itself."""
    text = expression_text(expression)
    return text.partition(".")[2] if text.startswith("@") else text


def chains(expression: Expression | None, name: str | None) -> Iterator[Expression]:
    """What *expression* asks of the message called *name* (None: of its own): the longest chains of fields and fixed items."""
    if expression is None:
        return
    if isinstance(expression, (Field, Item, Variable)) and (root := rooted(expression)) is not None:
        if root == (name,):
            yield expression
        return
    for child in children(expression):
        yield from chains(child, name)


def rooted(expression: Expression | None) -> tuple[str | None] | None:
    """Whose message a chain of fields and fixed items begins at, None if it is no such chain."""
    while True:
        match expression:
            case None:
                return (None,)
            case Variable(name=name):
                return (name,)
            case Field(base=base):
                expression = base
            case Item(base=base, index=Literal()):
                expression = base
            case _:
                return None


def test_of(event: Event, constants: Constants, faults: Faults, *, of_slots: bool = False) -> Test | None:
    """Whether a message is one of *event*; None if every one is. With *of_slots* it takes the slots of a message."""
    if event.predicate is None:
        return None
    closure = _Compiler(event, constants, of_slots).of(event.predicate)
    topic = event.topic

    def test(message: Any, known: Known) -> bool:
        try:
            return bool(closure(message, known))
        except FAULTS:
            faults.count += 1
            faults.first = faults.first or topic
            return False

    return test


class _Compiler:
    """Makes closures of the expressions of one event."""

    def __init__(self, event: Event, constants: Constants, of_slots: bool = False) -> None:
        self.event = event
        self.constants = constants
        self.of_slots = of_slots
        self.variables: tuple[str, ...] = ()

    def of(self, expression: Expression) -> Closure:
        match expression:
            case Literal(value=value):
                return lambda message, known: value
            case Field() | Item() | Variable():
                return self.chain(expression)
            case SetOf(values=values):
                parts = [self.of(value) for value in values]
                return lambda message, known: [part(message, known) for part in parts]
            case Range():
                return self.range(expression)
            case Call(name=name, arguments=arguments):
                return self.call(FUNCTIONS[name], [self.of(argument) for argument in arguments])
            case Unary(operator="not", operand=operand):
                inner = self.of(operand)
                return lambda message, known: not inner(message, known)
            case Unary(operand=operand):
                negated = self.of(operand)
                return lambda message, known: -number(negated(message, known))
            case Quantifier():
                return self.quantifier(expression)
            case Binary():
                return self.binary(expression)

    def chain(self, expression: Field | Item | Variable) -> Closure:
        constant = self.constants(self.event, expression)
        if constant is not None:
            return lambda message, known: constant
        root = rooted(expression)
        name = root[0] if root is not None else None
        if root is not None and name not in self.variables:
            if name is not None and name != self.event.alias:
                return _slot_of(name, key_of(expression))
            if self.of_slots:
                return _own_slot(key_of(expression))
        match expression:
            case Variable(name=variable) if variable == self.event.alias and variable not in self.variables:
                return lambda message, known: message
            case Variable(name=variable):
                return lambda message, known: known[variable]
            case Field(base=None, name=own):
                return lambda message, known: field(message, own)
            case Field(base=base, name=part):
                assert base is not None
                inner = self.of(base)
                return lambda message, known: field(inner(message, known), part)
            case Item(base=base, index=index):
                array, at = self.of(base), self.of(index)
                return lambda message, known: item(array(message, known), at(message, known))

    def range(self, expression: Range) -> Closure:
        low, high = self.of(expression.low), self.of(expression.high)
        opened, closed = expression.open_low, expression.open_high
        if isinstance(expression.low, Literal) and isinstance(expression.high, Literal):
            fixed = Interval(low(None, {}), high(None, {}), opened, closed)
            return lambda message, known: fixed
        return lambda message, known: Interval(low(message, known), high(message, known), opened, closed)

    def call(self, function: Callable[..., Any], arguments: list[Closure]) -> Closure:
        return lambda message, known: tamed(function(*(argument(message, known) for argument in arguments)))

    def quantifier(self, quantifier: Quantifier) -> Closure:
        domain = self.of(quantifier.domain)
        is_array = not isinstance(quantifier.domain, (SetOf, Range))
        self.variables = (*self.variables, quantifier.variable)
        condition = self.of(quantifier.condition)
        self.variables = self.variables[:-1]
        decide = all if quantifier.word == "forall" else any
        name = quantifier.variable

        def holds(message: Any, known: Known) -> bool:
            found = members(domain(message, known))
            inner = dict(known)

            def entry() -> Iterator[Any]:
                for value in range(len(found)) if is_array else found:
                    inner[name] = value
                    yield condition(message, inner)

            return decide(entry())

        return holds

    def binary(self, binary: Binary) -> Closure:
        left, right = self.of(binary.left), self.of(binary.right)
        match binary.operator:
            case "and":
                return lambda message, known: left(message, known) and right(message, known)
            case "or":
                return lambda message, known: left(message, known) or right(message, known)
            case "implies":
                return lambda message, known: not left(message, known) or right(message, known)
            case "iff":
                return lambda message, known: bool(left(message, known)) == bool(right(message, known))
            case sign:
                calculated = _CALCULATED[sign]
                if isinstance(binary.right, Literal):
                    value = binary.right.value
                    return lambda message, known: calculated(left(message, known), value)
                return lambda message, known: calculated(left(message, known), right(message, known))


def _slot_of(name: str, key: str) -> Closure:
    def slot(message: Any, known: Known) -> Any:
        return _there(known[name][key])

    return slot


def _own_slot(key: str) -> Closure:
    return lambda message, known: _there(message[key])


def _there(value: Any) -> Any:
    if value is _MISSING:
        raise LookupError("no such value")
    return value
