# SPDX-License-Identifier: Apache-2.0
"""What the language itself asks of a property that can be read: aliases that are bound, kinds of values that fit (hpl-specs 1.4).

The rules are those of ``ast/properties.py:sanity_check``, ``ast/events.py:HplEventDisjunction`` and of the types in ``ast/expressions.py`` and
``ast/predicates.py``.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from enum import Enum

from haros_ci.behaviour import kinds
from haros_ci.behaviour.text import expression_text
from haros_ci.behaviour.tree import (
    Binary,
    Call,
    Event,
    Expression,
    Field,
    Item,
    Literal,
    PatternKind,
    Place,
    Property,
    Quantifier,
    Range,
    SetOf,
    Unary,
    Variable,
    children,
    parts,
)
from haros_ci.records import dataclass


class Slip(Enum):
    """What kind of mistake it is."""

    KIND = "kind of value"
    UNBOUND = "unbound"
    TWICE = "bound twice"
    VARIABLE = "variable"
    EVENTS = "events"


@dataclass(frozen=True, slots=True)
class Mistake:
    """Something that HPL does not allow, *at* its place."""

    slip: Slip
    at: Place
    message: str


def mistakes(property: Property) -> tuple[Mistake, ...]:
    """All that is wrong with *property* whatever the system is."""
    found: list[Mistake] = []
    for event, known in bindings(property):
        found += _of_aliases(event, known)
        if event.predicate is not None:
            found += _Kinds(event).mistakes()
    for events in _groups(property):
        found += _of_disjunction(events)
    return tuple(found)


def mistyped(event: Event, known: Callable[[Expression], int | None]) -> tuple[Mistake, ...]:
    """What does not fit together in the predicate of *event* once the kinds of fields are *known* (None: not known)."""
    return () if event.predicate is None else tuple(_Kinds(event, known).mistakes())


def bindings(property: Property) -> Iterator[tuple[Event, Mapping[str, Event]]]:
    """Each event with the aliases of other events that it can use."""
    scope, pattern = property.scope, property.pattern
    opened = {event.alias: event for event in scope.activator if event.alias is not None}
    for event in scope.activator:
        yield event, {}
    first, second = pattern.trigger, pattern.behaviour
    if pattern.kind is PatternKind.REQUIRES:
        first, second = second, first
    for event in first:
        yield event, opened
    known = {**opened, **{event.alias: event for event in first if event.alias is not None}}
    for event in second:
        yield event, known
    for event in scope.terminator:
        yield event, opened


def free_variables(event: Event) -> Iterator[Variable]:
    """What the predicate of *event* says of other messages: variables that are neither its own alias nor a quantifier's."""
    if event.predicate is not None:
        own = frozenset((event.alias,)) if event.alias is not None else frozenset()
        yield from _free(event.predicate, own)


def unused_aliases(property: Property) -> Iterator[Event]:
    """The events with an alias that no other event uses."""
    used = {
        id(known[variable.name])
        for event, known in bindings(property)
        for variable in free_variables(event)
        if variable.name in known
    }
    yield from (event for event in property.events if event.alias is not None and id(event) not in used)


def _free(expression: Expression, bound: frozenset[str]) -> Iterator[Variable]:
    if isinstance(expression, Variable):
        if expression.name not in bound:
            yield expression
        return
    if isinstance(expression, Quantifier):
        yield from _free(expression.domain, bound)
        yield from _free(expression.condition, bound | {expression.variable})
        return
    for child in children(expression):
        yield from _free(child, bound)


def _groups(property: Property) -> tuple[tuple[Event, ...], ...]:
    scope, pattern = property.scope, property.pattern
    return scope.activator, scope.terminator, pattern.trigger, pattern.behaviour


def _of_aliases(event: Event, known: Mapping[str, Event]) -> Iterator[Mistake]:
    for variable in free_variables(event):
        if variable.name not in known:
            yield Mistake(Slip.UNBOUND, variable.at, f"@{variable.name}: {_missing(variable.name, known)}")
    if event.alias is not None and event.alias in known and event.alias_at is not None:
        yield Mistake(
            Slip.TWICE, event.alias_at, f"the alias {event.alias} is given twice; give this event another one"
        )


def _missing(name: str, known: Mapping[str, Event]) -> str:
    there = ", ".join(f"@{item}" for item in sorted(known))
    return f"no event before this one has the alias {name}; " + (
        f"there is {there}" if there else f"write 'as {name}' behind its topic"
    )


def _of_disjunction(events: tuple[Event, ...]) -> Iterator[Mistake]:
    seen: set[str] = set()
    for event in events:
        if event.topic in seen:
            message = (
                f"the topic {event.topic} stands twice in one disjunction; write one event with 'or' in its predicate"
            )
            yield Mistake(Slip.EVENTS, event.topic_at, message)
        seen.add(event.topic)


class _Kinds:
    """Narrows the kinds of all parts of one predicate, from the leaves up."""

    def __init__(self, event: Event, known: Callable[[Expression], int | None] = lambda expression: None) -> None:
        self.known = known
        self.alias = event.alias
        self.root = event.predicate
        self.of: dict[int, int] = {}
        self.found: list[Mistake] = []

    def mistakes(self) -> list[Mistake]:
        assert self.root is not None
        self.visit(self.root)
        self.cast(self.root, kinds.BOOL)
        if not self.found:
            self.agree()
        return self.found

    def cast(self, expression: Expression, expected: int) -> None:
        """Narrow to *expected*, which is a mistake if nothing is left."""
        narrowed = self.of[id(expression)] & expected
        if not narrowed:
            is_ = kinds.in_words(self.of[id(expression)])
            self.say(
                expression.at, f"{expression_text(expression)} is {is_}, where {kinds.in_words(expected)} is needed"
            )
        self.of[id(expression)] = narrowed or expected

    def say(self, at: Place, message: str, slip: Slip = Slip.KIND) -> None:
        self.found.append(Mistake(slip, at, message))

    def visit(self, expression: Expression) -> None:
        for child in children(expression):
            self.visit(child)
        self.of[id(expression)] = self.kind(expression)

    def kind(self, expression: Expression) -> int:
        match expression:
            case Literal(value=value):
                return kinds.BOOL if isinstance(value, bool) else kinds.TEXT if isinstance(value, str) else kinds.NUMBER
            case Variable(name=name):
                return self.known_or(expression, kinds.MESSAGE if name == self.alias else kinds.ITEM)
            case SetOf(values=values):
                return self.all_cast(values, kinds.PRIMITIVE, kinds.SET)
            case Range(low=low, high=high):
                return self.all_cast((low, high), kinds.NUMBER, kinds.RANGE)
            case Field(base=base):
                return self.all_cast(
                    () if base is None else (base,), kinds.MESSAGE, self.known_or(expression, kinds.FIELD)
                )
            case Item(base=base, index=index):
                self.cast(base, kinds.ARRAY)
                return self.all_cast((index,), kinds.NUMBER, self.known_or(expression, kinds.FIELD))
            case Unary(operator=operator, operand=operand):
                return self.all_cast((operand,), kinds.UNARY[operator], kinds.UNARY[operator])
            case Call():
                return self.call(expression)
            case Binary():
                return self.binary(expression)
            case Quantifier():
                return self.quantifier(expression)

    def known_or(self, expression: Expression, usual: int) -> int:
        known = self.known(expression)
        return usual if known is None else known

    def all_cast(self, expressions: tuple[Expression, ...], expected: int, result: int) -> int:
        for expression in expressions:
            self.cast(expression, expected)
        return result

    def call(self, call: Call) -> int:
        given = [self.argument(argument) for argument in call.arguments]
        if not kinds.takes(call.name, given):
            words = ", ".join(map(kinds.in_words, given))
            self.say(call.at, f"{call.name} takes {kinds.signature(call.name)}, not ({words})")
        return kinds.RESULTS.get(call.name, kinds.NUMBER)

    def argument(self, expression: Expression) -> int:
        """The kinds that an argument can have: of a field any, whatever its type (a text has a length, too)."""
        if isinstance(expression, (Field, Item)):
            return kinds.FIELD
        return self.of[id(expression)]

    def binary(self, binary: Binary) -> int:
        first, second, result = kinds.OPERATORS[binary.operator]
        left, right = binary.left, binary.right
        before = len(self.found)
        self.cast(left, first)
        self.cast(right, second)
        if first & second and len(self.found) == before:
            self.cast(left, self.of[id(right)])
            if len(self.found) == before:
                self.cast(right, self.of[id(left)])
        return result

    def quantifier(self, quantifier: Quantifier) -> int:
        self.cast(quantifier.domain, kinds.COMPOUND)
        self.cast(quantifier.condition, kinds.BOOL)
        name, at = quantifier.variable, quantifier.variable_at
        if any(isinstance(part, Variable) and part.name == name for part in parts(quantifier.domain)):
            self.say(at, f"the members that {name} stands for depend on @{name} itself", Slip.VARIABLE)
        members = kinds.PRIMITIVE
        if isinstance(quantifier.domain, SetOf):
            members = 0
            for value in quantifier.domain.values:
                members |= self.of[id(value)]
        elif isinstance(quantifier.domain, Range):
            members = kinds.NUMBER
        used = False
        for part in parts(quantifier.condition):
            if isinstance(part, Quantifier) and part.variable == name:
                self.say(
                    part.variable_at, f"the variable {name} is bound twice; give this one another name", Slip.VARIABLE
                )
            elif isinstance(part, Variable) and part.name == name:
                used = True
                if not self.of[id(part)] & members:
                    needed = kinds.in_words(self.of[id(part)])
                    self.say(part.at, f"@{name} is {kinds.in_words(members)}, where {needed} is needed")
        if not used:
            self.say(at, f"the variable {name} is never used; write @{name} in the condition", Slip.VARIABLE)
        return kinds.BOOL

    def agree(self) -> None:
        """All that is said of one field, or of one variable, must fit together."""
        assert self.root is not None
        kept: dict[str, int] = {}
        for part in parts(self.root):
            if isinstance(part, (Field, Item, Variable)):
                key = expression_text(part)
                own = f"@{self.alias}." if self.alias is not None else ""
                key = key.removeprefix(own) if own else key
                before = kept.get(key, kinds.ANY)
                if not before & self.of[id(part)]:
                    is_, was = kinds.in_words(self.of[id(part)]), kinds.in_words(before)
                    self.say(part.at, f"{key} is used as {is_} here, and as {was} elsewhere in the predicate")
                    return
                kept[key] = before & self.of[id(part)]
