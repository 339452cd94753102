# SPDX-License-Identifier: Apache-2.0
"""What follows of predicates: never true, always true, one of another. Each answer True is certain; False is also "not known"."""

from __future__ import annotations

from haros_ci.behaviour.clauses import Clauses, Reader, TooMany, is_decided, is_possible, joined
from haros_ci.behaviour.tree import Expression, Item, parts

#: Alternatives of two predicates together that are looked at to compare them.
MOST_JOINED = 64


class Predicate:
    """The predicate of an event, None for none, with what reads it; its clauses are made once."""

    __slots__ = ("_made", "expression", "reader")

    def __init__(self, expression: Expression | None, reader: Reader) -> None:
        self.expression = expression
        self.reader = reader
        self._made: dict[bool, Clauses | None] = {}

    def clauses(self, positive: bool = True) -> Clauses:
        """Those of the predicate, or of its opposite; TooMany if there are too many."""
        if positive not in self._made:
            try:
                self._made[positive] = self.reader.clauses(self.expression, positive)
            except TooMany:
                self._made[positive] = None
        found = self._made[positive]
        if found is None:
            raise TooMany
        return found


def is_never(predicate: Predicate) -> bool:
    """Whether no message matches."""
    try:
        return not any(map(is_possible, predicate.clauses()))
    except TooMany:
        return False


def is_always(predicate: Predicate) -> bool:
    """Whether every message matches: its opposite never holds. An array may be shorter than an index asks, so then nothing is certain."""
    if any(isinstance(part, Item) for part in parts(predicate.expression)):
        return False
    try:
        return not any(map(is_possible, predicate.clauses(False)))
    except TooMany:
        return False


def implies(one: Predicate, other: Predicate) -> bool:
    """Whether all messages that match *one* match *other*."""
    if other.expression is None:
        return True
    if _items(other) - _items(one):  # an array of the one may be too short for the other
        return False
    try:
        return not any(map(is_possible, _both(one.clauses(), other.clauses(False))))
    except TooMany:
        return False


def overlap(one: Predicate, other: Predicate) -> bool:
    """Whether some message matches both, for certain."""
    try:
        return any(is_decided(item) and is_possible(item) for item in _both(one.clauses(), other.clauses()))
    except TooMany:
        return False


def _both(one: Clauses, other: Clauses) -> Clauses:
    if len(one) * len(other) > MOST_JOINED:
        raise TooMany
    return joined(one, other)


def _items(predicate: Predicate) -> set[str]:
    return {predicate.reader.term(part) for part in parts(predicate.expression) if isinstance(part, Item)}
