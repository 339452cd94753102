# SPDX-License-Identifier: Apache-2.0
"""Two properties of one owner: whether one says all that the other does, whether they exclude each other (docs/hpl.md, "Exact meaning").

Each answer True is certain. Messages that match are compared by topic, and by what follows of the predicates.
"""

from __future__ import annotations

import math
from collections.abc import Callable

from haros_ci.behaviour.deciding import Predicate, implies
from haros_ci.behaviour.meaning import free_variables
from haros_ci.behaviour.text import events_text, scope_text
from haros_ci.behaviour.tree import Event, Pattern, PatternKind, Property, ScopeKind
from haros_ci.records import dataclass

Read = Callable[[Event], Predicate]


@dataclass(frozen=True, slots=True)
class Compared:
    """A property, and how the predicates of its events are read."""

    stated: Property
    read: Read

    @property
    def pattern(self) -> Pattern:
        return self.stated.pattern

    @property
    def bound(self) -> float:
        """Seconds; without one there is no end."""
        bound = self.stated.pattern.bound
        return math.inf if bound is None else bound.seconds

    @property
    def is_plain(self) -> bool:
        """Whether no event says anything of another message."""
        return not any(next(free_variables(event), None) for event in self.stated.events)


def follows(one: Compared, other: Compared) -> bool:
    """Whether *one* holds whenever *other* does."""
    first, second = one.pattern.kind, other.pattern.kind
    if not _may_compare(one, other) or not _covers(other, one):
        return False
    if second is PatternKind.NO:
        return _follows_from_absence(one, other)
    if first is not second:
        return False
    if first is PatternKind.SOME:
        return _behaviour_in(other, one) and other.bound <= one.bound
    if first is PatternKind.CAUSES:
        return _triggers_in(one, other) and _behaviour_in(other, one) and other.bound <= one.bound
    if first is PatternKind.FORBIDS:
        return _triggers_in(one, other) and _behaviour_in(one, other) and one.bound <= other.bound
    return _behaviour_in(one, other) and _triggers_in(other, one) and other.bound <= one.bound  # requires


def _follows_from_absence(one: Compared, other: Compared) -> bool:
    """Whether *one* holds where what *other* forbids never comes."""
    kind = one.pattern.kind
    if kind is PatternKind.NO:
        return one.bound <= other.bound and _behaviour_in(one, other)
    is_kept = kind in (PatternKind.FORBIDS, PatternKind.REQUIRES)
    return is_kept and other.bound == math.inf and _behaviour_in(one, other)


def excluded(one: Compared, other: Compared) -> str | None:
    """Why *one*, which asks for an event, cannot hold together with *other*, which forbids it; None if it can, or that is not known."""
    asks, forbids = one.pattern.kind, other.pattern.kind
    if not _may_compare(one, other) or not _covers(other, one) or not _behaviour_in(one, other):
        return None
    asked = events_text(one.pattern.behaviour)
    if asks is PatternKind.SOME and forbids is PatternKind.NO and one.bound <= other.bound:
        opens = one.stated.scope.activator
        when = f" once {events_text(opens)} has come" if opens else ""
        return f"one asks for {asked}{when}, the other forbids it"
    is_forbidden = forbids is PatternKind.NO and other.bound == math.inf
    if forbids is PatternKind.FORBIDS:
        is_forbidden = _triggers_in(one, other) and one.bound <= other.bound
    if asks is not PatternKind.CAUSES or not is_forbidden:
        return None
    return f"as soon as {events_text(one.pattern.trigger)} comes, one asks for {asked}, which the other forbids"


def _may_compare(one: Compared, other: Compared) -> bool:
    """Whether aliases mean the same in both: none says anything of another message, or all but the bound and the behaviour is the same text."""
    if one.is_plain and other.is_plain:
        return True
    first, second = one.stated, other.stated
    same_scope = scope_text(first.scope) == scope_text(second.scope)
    return (
        same_scope
        and first.pattern.kind is second.pattern.kind
        and events_text(first.pattern.trigger) == events_text(second.pattern.trigger)
        and events_text(first.pattern.behaviour) == events_text(second.pattern.behaviour)
    )


def _covers(wide: Compared, narrow: Compared) -> bool:
    """Whether *wide* counts wherever *narrow* does: the same scope, or always, for what a wider scope only makes stronger."""
    if scope_text(wide.stated.scope) == scope_text(narrow.stated.scope):
        return True
    kind = wide.pattern.kind
    is_wide = wide.stated.scope.kind is ScopeKind.GLOBALLY
    return is_wide and (kind is PatternKind.FORBIDS or (kind is PatternKind.NO and wide.bound == math.inf))


def _behaviour_in(narrow: Compared, wide: Compared) -> bool:
    return _within(narrow.pattern.behaviour, narrow.read, wide.pattern.behaviour, wide.read)


def _triggers_in(narrow: Compared, wide: Compared) -> bool:
    return _within(narrow.pattern.trigger, narrow.read, wide.pattern.trigger, wide.read)


def _within(events: tuple[Event, ...], read: Read, others: tuple[Event, ...], read_other: Read) -> bool:
    """Whether every message that is one of *events* is one of *others*."""
    return all(
        any(event.topic == other.topic and implies(read(event), read_other(other)) for other in others)
        for event in events
    )
