# SPDX-License-Identifier: Apache-2.0
"""What follows of predicates: never true, always true, one of another. Each answer True is certain; False is also "not known"."""

from __future__ import annotations

from dataclasses import dataclass

from haros_ci.behaviour.clauses import Clauses, Reader, TooMany, is_decided, is_possible, joined
from haros_ci.behaviour.tree import Expression, Item, parts


@dataclass(frozen=True, slots=True)
class Predicate:
    """The predicate of an event, None for none, with what reads it."""

    expression: Expression | None
    reader: Reader

    def clauses(self, positive: bool = True) -> Clauses:
        return self.reader.clauses(self.expression, positive)


def is_never(predicate: Predicate) -> bool:
    """Whether no message matches."""
    try:
        return not any(map(is_possible, predicate.clauses()))
    except TooMany:
        return False


def is_always(predicate: Predicate) -> bool:
    """Whether every message matches: its opposite never holds. An array may be shorter than an index asks, so then nothing is certain."""
    if any(isinstance(each, Item) for each in parts(predicate.expression)):
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
        return not any(map(is_possible, joined(one.clauses(), other.clauses(False))))
    except TooMany:
        return False


def overlap(one: Predicate, other: Predicate) -> bool:
    """Whether some message matches both, for certain."""
    try:
        return any(is_decided(each) and is_possible(each) for each in joined(one.clauses(), other.clauses()))
    except TooMany:
        return False


def _items(predicate: Predicate) -> set[str]:
    return {predicate.reader.term(each) for each in parts(predicate.expression) if isinstance(each, Item)}
