# SPDX-License-Identifier: Apache-2.0
"""The parts of an HPL text, each with its place (hpl-specs 1.4, ``grammars/*.lark``)."""

from __future__ import annotations

from collections.abc import Iterator
from enum import Enum
from typing import Union

from haros_ci.records import dataclass


@dataclass(frozen=True, slots=True)
class Place:
    """Where a part stands in its text: *line* and *column* of its first character, both from 1, and the offsets of it and of its end."""

    line: int
    column: int
    offset: int
    end: int


class ScopeKind(Enum):
    """When a property counts."""

    GLOBALLY = "globally"
    AFTER = "after"
    UNTIL = "until"
    AFTER_UNTIL = "after-until"


class PatternKind(Enum):
    """What a property says of events."""

    SOME = "some"
    NO = "no"
    CAUSES = "causes"
    FORBIDS = "forbids"
    REQUIRES = "requires"


@dataclass(frozen=True, slots=True)
class Literal:
    """A number, a text, ``True``, ``False`` or a constant (``PI``), as it is *written*; a text's *value* has no quotes."""

    at: Place
    written: str
    value: bool | int | float | str


@dataclass(frozen=True, slots=True)
class SetOf:
    """``{a, b}``."""

    at: Place
    values: tuple[Expression, ...]


@dataclass(frozen=True, slots=True)
class Range:
    """``[low to high]``; *open_low* for ``![``, *open_high* for ``]!``: that end is not in it."""

    at: Place
    low: Expression
    high: Expression
    open_low: bool = False
    open_high: bool = False


@dataclass(frozen=True, slots=True)
class Variable:
    """``@name``: the message of an event with that alias, or the variable of a quantifier."""

    at: Place
    name: str


@dataclass(frozen=True, slots=True)
class Field:
    """A field or constant of *base*; None is the message of the event itself. *name_at* is where the name stands."""

    at: Place
    base: Expression | None
    name: str
    name_at: Place


@dataclass(frozen=True, slots=True)
class Item:
    """``base[index]``."""

    at: Place
    base: Expression
    index: Expression


@dataclass(frozen=True, slots=True)
class Call:
    """A function of the language."""

    at: Place
    name: str
    arguments: tuple[Expression, ...]


@dataclass(frozen=True, slots=True)
class Unary:
    """``-`` or ``not``."""

    at: Place
    operator: str
    operand: Expression


@dataclass(frozen=True, slots=True)
class Binary:
    """Arithmetic, a comparison, ``in``, or a logical operator, by its sign or word."""

    at: Place
    operator: str
    left: Expression
    right: Expression


@dataclass(frozen=True, slots=True)
class Quantifier:
    """``forall`` or ``exists`` (*word*) over the members of *domain*."""

    at: Place
    word: str
    variable: str
    variable_at: Place
    domain: Expression
    condition: Expression


Expression = Union[Literal, SetOf, Range, Variable, Field, Item, Call, Unary, Binary, Quantifier]


@dataclass(frozen=True, slots=True)
class Event:
    """A message on a topic for which *predicate* holds; None holds for all."""

    at: Place
    topic: str
    topic_at: Place
    alias: str | None = None
    alias_at: Place | None = None
    predicate: Expression | None = None


@dataclass(frozen=True, slots=True)
class Scope:
    """From when to when a property counts; each end is one event, or one of several."""

    at: Place
    kind: ScopeKind
    activator: tuple[Event, ...] = ()
    terminator: tuple[Event, ...] = ()


@dataclass(frozen=True, slots=True)
class Bound:
    """``within …``: *seconds*, as *written*."""

    at: Place
    written: str
    seconds: float


@dataclass(frozen=True, slots=True)
class Pattern:
    """*behaviour* is what is promised or forbidden; *trigger* what it depends on (for ``requires`` what must have come before), () if it has none."""

    at: Place
    kind: PatternKind
    behaviour: tuple[Event, ...]
    trigger: tuple[Event, ...] = ()
    bound: Bound | None = None


@dataclass(frozen=True, slots=True)
class Metadata:
    """``# key: value`` before a property; a text's *value* has no quotes."""

    at: Place
    key: str
    value: str
    value_at: Place


@dataclass(frozen=True, slots=True)
class Property:
    """One property; its place does not include its metadata."""

    at: Place
    scope: Scope
    pattern: Pattern
    metadata: tuple[Metadata, ...] = ()

    def metadata_of(self, key: str) -> Metadata | None:
        """The metadata of this *key*."""
        return next((entry for entry in self.metadata if entry.key == key), None)

    @property
    def events(self) -> tuple[Event, ...]:
        """All its events in the order in which they stand."""
        behaviour, trigger = self.pattern.behaviour, self.pattern.trigger
        inner = (*behaviour, *trigger) if self.pattern.kind is PatternKind.REQUIRES else (*trigger, *behaviour)
        return (*self.scope.activator, *self.scope.terminator, *inner)


def children(expression: Expression) -> tuple[Expression, ...]:
    """The expressions right below *expression*."""
    match expression:
        case SetOf(values=values):
            return values
        case Call(arguments=arguments):
            return arguments
        case Range(low=low, high=high):
            return low, high
        case Field(base=base):
            return () if base is None else (base,)
        case Item(base=base, index=index):
            return base, index
        case Unary(operand=operand):
            return (operand,)
        case Binary(left=left, right=right):
            return left, right
        case Quantifier(domain=domain, condition=condition):
            return domain, condition
        case _:
            return ()


def parts(expression: Expression | None) -> Iterator[Expression]:
    """*expression* and everything in it, from left to right."""
    stack = [] if expression is None else [expression]
    while stack:
        item = stack.pop()
        yield item
        stack.extend(reversed(children(item)))
