# SPDX-License-Identifier: Apache-2.0
"""The parts of messages that properties ask for: one variable for each, of the type that the interface has.

Whole numbers have the range of their type, floating point numbers are real ones (no NaN, no infinity, nothing is rounded). Of texts only
those that properties name are distinguished from each other, and from all others.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from enum import Enum
from typing import Any

from haros_ci.behaviour.messages import FLOATS, INTEGERS, TEXTS, Missing
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
    Unary,
    Variable,
    children,
    parts,
)
from haros_ci.interfaces.definitions import FieldType
from haros_ci.monitoring.predicates import key_of
from haros_ci.records import dataclass
from haros_ci.verification.problem import Claim, NotModelled, events_of

#: Fields of all messages together, and parts of one predicate.
MOST_FIELDS, MOST_PARTS = 200, 2_000
#: The longest array of a message.
LONGEST_ARRAY = 10_000
_LOGIC = frozenset(("and", "or", "implies", "iff"))


class Kind(Enum):
    """What a variable holds."""

    BOOL = "bool"
    INT = "int"
    REAL = "real"
    TEXT = "text"


@dataclass(frozen=True, slots=True)
class Slot:
    """A part of a message on *topic*: *path* are names of fields and numbers of items. An *is_length* is that of the array there."""

    topic: str
    key: str
    path: tuple[str | int, ...]
    kind: Kind
    low: int | None = None
    high: int | None = None
    is_length: bool = False
    is_typed: bool = True


@dataclass(frozen=True, slots=True)
class Asked:
    """A chain of fields: of the message of which event, and the arrays that it goes through."""

    slot: Slot
    arrays: tuple[Slot, ...]


class Fields:
    """All slots of the claims, and the texts that they name."""

    def __init__(self) -> None:
        self.slots: dict[tuple[str, str], Slot] = {}
        self.texts: dict[str, int] = {"": 0}

    def add(self, claims: Iterable[Claim]) -> None:
        """Take in what *claims*, whose predicates have no quantifiers left, ask for; NotModelled for what messages cannot have here."""
        for claim in claims:
            for event, _ in events_of(claim):
                self._event(claim, event)

    def _event(self, claim: Claim, event: Event) -> None:
        if event.predicate is None:
            return
        uses = dict(_uses(event.predicate))
        for part in parts(event.predicate):
            if isinstance(part, Literal) and isinstance(part.value, str):
                self.text(part.value)
        for array in _measured(event.predicate):
            owner = owner_of(claim, event, array)
            if owner is not None:
                self._put(_length(claim.name(owner), array, claim.typed(event, array)))
        for chain in chains_of(event.predicate):
            if claim.constants(event, chain) is not None:
                continue
            owner = owner_of(claim, event, chain)
            if owner is not None:
                self._chain(claim, event, chain, claim.name(owner), uses.get(id(chain), Kind.REAL))

    def text(self, value: str) -> int:
        """The number that stands for a text."""
        return self.texts.setdefault(value, len(self.texts))

    def _chain(self, claim: Claim, event: Event, chain: Expression, topic: str, use: Kind) -> None:
        expression: Expression | None = chain
        while isinstance(expression, (Field, Item)):
            base = expression.base
            if isinstance(expression, Item) and base is not None:
                self._put(_length(topic, base, claim.typed(event, base)))
            expression = base
        self._put(_slot(topic, chain, claim.typed(event, chain), use))

    def _put(self, slot: Slot) -> Slot:
        known = self.slots.get((slot.topic, slot.key))
        if known is None or (slot.is_typed and not known.is_typed):
            self.slots[slot.topic, slot.key] = slot
        if len(self.slots) > MOST_FIELDS:
            raise NotModelled(f"more than {MOST_FIELDS} fields")
        return self.slots[slot.topic, slot.key]

    def of(self, topic: str) -> Iterator[Slot]:
        """The slots of messages on *topic*."""
        return (slot for (owner, _), slot in self.slots.items() if owner == topic)


def chains_of(expression: Expression) -> Iterator[Expression]:
    """The chains of fields in *expression*, and the arrays whose length is asked; NotModelled for an index that is no literal."""
    if isinstance(expression, (Field, Item, Variable)):
        path_of(expression)
        yield expression
        return
    for child in children(expression):
        if not (isinstance(expression, Call) and expression.name == "len"):
            yield from chains_of(child)


def _measured(expression: Expression) -> Iterator[Expression]:
    """The chains of fields whose length is asked."""
    for part in parts(expression):
        if isinstance(part, Call) and part.name == "len" and len(part.arguments) == 1:
            (argument,) = part.arguments
            if not isinstance(argument, (Field, Item)):
                raise NotModelled(f"the function len in {expression_text(part)}")
            path_of(argument)
            yield argument


def path_of(chain: Expression | None) -> tuple[str | int, ...]:
    """Names and indices from the message on."""
    found: list[str | int] = []
    while chain is not None and not isinstance(chain, Variable):
        match chain:
            case Field(base=base, name=name):
                found.append(name)
            case Item(base=base, index=Literal(value=bool() | float() | str())) | Item(base=base, index=Unary()):
                raise NotModelled(f"the index of {expression_text(chain)}")
            case Item(base=base, index=Literal(value=int(index))):
                if index >= LONGEST_ARRAY:
                    raise NotModelled(f"an array of more than {LONGEST_ARRAY:,} items")
                found.append(index)
            case Item():
                raise NotModelled(f"an index that depends on a message: {expression_text(chain)}")
            case _:
                raise NotModelled(expression_text(chain))
        chain = base
    return tuple(reversed(found))


def owner_of(claim: Claim, event: Event, chain: Expression) -> Event | None:
    """The event whose message a chain begins at; None for an alias that no event has."""
    expression: Expression | None = chain
    while isinstance(expression, (Field, Item)):
        expression = expression.base
    if expression is None or (isinstance(expression, Variable) and expression.name == event.alias):
        return event
    assert isinstance(expression, Variable)
    name = expression.name
    return next((other for other, _ in events_of(claim) if other.alias == name), None)


def _length(topic: str, array: Expression, typed: Any) -> Slot:
    low, high, known = 0, LONGEST_ARRAY, isinstance(typed, FieldType) and bool(typed.form)
    if isinstance(typed, FieldType) and not typed.form:
        raise NotModelled(f"the length of a text: {expression_text(array)}")
    if known and typed.form in ("array", "bounded"):
        high = min(typed.size, LONGEST_ARRAY)
        low = high if typed.form == "array" else 0
    return Slot(topic, f"len({key_of(array)})", path_of(array), Kind.INT, low, high, True, known)


def _slot(topic: str, chain: Expression, typed: Any, use: Kind) -> Slot:
    made = Slot(topic, key_of(chain), path_of(chain), use, is_typed=False)
    if not made.path:
        raise NotModelled(f"a whole message as a value: {expression_text(chain)}")
    if isinstance(typed, Missing):
        raise NotModelled(f"{expression_text(chain)}, which {typed.message.name} does not have")
    if not isinstance(typed, FieldType):
        if typed is not None:
            raise NotModelled(f"a whole message as a value: {expression_text(chain)}")
        if str(made.path[-1]).isupper():
            raise NotModelled(f"{expression_text(chain)}, a constant of a message whose definition is not known")
        return made
    if typed.form:
        raise NotModelled(f"a whole array as a value: {expression_text(chain)}")
    if typed.base in INTEGERS:
        low, high = INTEGERS[typed.base]
        return replace(made, kind=Kind.INT, low=low, high=high, is_typed=True)
    kinds = {"bool": Kind.BOOL, **dict.fromkeys(FLOATS, Kind.REAL), **dict.fromkeys(TEXTS, Kind.TEXT)}
    return made if typed.base not in kinds else replace(made, kind=kinds[typed.base], is_typed=True)


def _uses(predicate: Expression) -> Iterator[tuple[int, Kind]]:
    """What fields without a known type must be, by how they are used: compared with texts or truth values, or used as one."""
    yield from _truths(predicate)
    for part in parts(predicate):
        if not isinstance(part, Binary) or part.operator in _LOGIC:
            continue
        for one, other in ((part.left, part.right), (part.right, part.left)):
            kinds = {type(item.value) for item in parts(other) if isinstance(item, Literal)}
            if str in kinds:
                yield id(one), Kind.TEXT
            elif bool in kinds and part.operator in ("=", "!="):
                yield id(one), Kind.BOOL


def _truths(expression: Expression) -> Iterator[tuple[int, Kind]]:
    """The chains that stand where a truth value is needed."""
    match expression:
        case Field() | Item():
            yield id(expression), Kind.BOOL
        case Unary(operator="not", operand=operand):
            yield from _truths(operand)
        case Binary(operator=word, left=left, right=right) if word in _LOGIC:
            yield from _truths(left)
            yield from _truths(right)
        case Quantifier(condition=condition):
            yield from _truths(condition)
        case _:
            return
