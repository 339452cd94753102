# SPDX-License-Identifier: Apache-2.0
"""One property against messages in order: the exact meaning that docs/hpl.md states, message by message.

Times are whole nanoseconds that do not decrease. A window of *d* is from 0 up to, and without, d; deadlines are looked at when the next message
of a topic of the property comes, and at the end, which makes no difference to the verdict.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from types import MappingProxyType
from typing import Any

from haros_ci.behaviour.text import time_text
from haros_ci.behaviour.tree import Event, Expression, Property
from haros_ci.monitoring.pool import MOST_KEPT, Record
from haros_ci.monitoring.predicates import Constants, Faults, Known, Slots, Test, chains, test_of
from haros_ci.monitoring.verdict import Outcome, Verdict, Witness
from haros_ci.records import dataclass

SECOND = 1_000_000_000
_ROLES = ("activator", "terminator", "trigger", "behaviour")
ACTIVATOR, TERMINATOR, TRIGGER, BEHAVIOUR = _ROLES
_NOTHING: Known = {}


def no_constants(event: Event, expression: Expression) -> Any:
    """For messages of which no definition is known."""
    return None


@dataclass(slots=True)
class Part:
    """An event in its role: whether a message is one, and what others ask of it (None: nothing)."""

    event: Event
    role: str
    test: Test | None
    slots: Slots | None
    shown: Slots

    def matches(self, message: Any, known: Known) -> bool:
        """Whether *message*, of the event's topic, is one."""
        return self.test is None or self.test(message, known)


@dataclass(slots=True)
class Roles:
    """The parts that a topic has in a property."""

    activator: Part | None = None
    terminator: Part | None = None
    trigger: Part | None = None
    behaviour: Part | None = None


class Monitor:
    """A property and what is known of it so far. *names* are what its topics are called in the recording, where that differs; *limit* is how many
    messages are kept at most. The monitor must be given all messages on ``topics``."""

    def __init__(
        self,
        property: Property,
        names: Mapping[str, str] = MappingProxyType({}),
        constants: Constants = no_constants,
        limit: int = MOST_KEPT,
    ) -> None:
        self.property = property
        self.names = names
        self.constants = constants
        self.faults = Faults()
        self.roles: dict[str, Roles] = {}
        bound = property.pattern.bound
        self.window: int | None = None if bound is None else round(bound.seconds * SECOND)
        self.failed: Outcome | None = None
        #: Why nothing can be said, "" if something can.
        self.unusable = ""
        #: Nothing that follows can change the verdict.
        self.done = False
        self.opened: Record | None = None
        self.known: Known = _NOTHING
        self.scopes = self.triggers = self.behaviours = self.heard = 0
        self.last = 0
        for role, events in zip(_ROLES, self.events):
            for event in events:
                roles = self.roles.setdefault(self.name(event), Roles())
                if getattr(roles, role) is not None:
                    self.leave(f"two of its events are messages on {self.name(event)}")
                setattr(roles, role, self.part(event, role))

    @property
    def events(self) -> tuple[tuple[Event, ...], ...]:
        """The events by their roles: activator, terminator, trigger, behaviour."""
        scope, pattern = self.property.scope, self.property.pattern
        return scope.activator, scope.terminator, pattern.trigger, pattern.behaviour

    @property
    def topics(self) -> tuple[str, ...]:
        return tuple(self.roles)

    def name(self, event: Event) -> str:
        """What the topic of *event* is called in the recording."""
        return self.names.get(event.topic, event.topic)

    def is_blind(self, topic: str) -> bool:
        """Whether the property asks for nothing that messages on one of ``topics`` hold."""
        roles = self.roles[topic]
        parts = (roles.activator, roles.terminator, roles.trigger, roles.behaviour)
        return all(part is None or (part.test is None and part.slots is None) for part in parts)

    def leave(self, reason: str) -> None:
        """A message on one of ``topics`` is there and cannot be had: from here on nothing is known."""
        if not self.done:
            self.unusable = reason
            self.done = True

    def part(self, event: Event, role: str) -> Part:
        """What is asked of a message in this role."""
        asked, own = self.asked_of(event)
        test = test_of(event, self.constants, self.faults, of_slots=self.is_kept_in_slots(role))
        slots = Slots(event, asked, self.constants) if asked else None
        return Part(event, role, test, slots, Slots(event, [*own, *asked], self.constants))

    def asked_of(self, event: Event) -> tuple[list[Expression], list[Expression]]:
        """What other events ask of a message of *event*, and what its own predicate asks of it."""
        others = [other_event for other_event in self.property.events if other_event is not event]
        asked = [chain for other in others for chain in chains(other.predicate, event.alias)] if event.alias else []
        own = [*chains(event.predicate, None), *(chains(event.predicate, event.alias) if event.alias else ())]
        return asked, own

    def is_kept_in_slots(self, role: str) -> bool:
        """Whether predicates of this role are asked later, of what was kept."""
        return False

    def start(self, time: int) -> None:
        """The recording begins."""
        self.last = time
        if not self.property.scope.activator:
            self.open(Record("", None, time, 0), _NOTHING)

    def take(self, topic: str, message: Any, time: int, number: int) -> None:
        """A message of one of ``topics``, the *number*-th of the recording."""
        if self.done:
            return
        self.last = time
        roles = self.roles[topic]
        if self.opened is None:
            part = roles.activator
            if part is not None and part.matches(message, _NOTHING):
                slots = None if part.slots is None else part.slots.of(message)
                known = _NOTHING if slots is None or part.event.alias is None else {part.event.alias: slots}
                self.open(Record(topic, part.shown.of(message), time, number), known)
            return
        self.expire(time)
        if self.done:
            return
        end = roles.terminator
        if end is not None and end.matches(message, self.known):
            self.close(Record(topic, message, time, number))
        elif roles.behaviour is not None or roles.trigger is not None:
            self.step(roles, topic, message, time, number)

    def open(self, record: Record, known: Known) -> None:
        """The scope begins; of its activator *record* has what is shown."""
        self.opened, self.known = record, known
        self.scopes += 1

    def close(self, record: Record) -> None:
        """The scope ends with the terminator *record*."""
        self.ended(record)
        self.opened, self.known = None, _NOTHING
        if not self.property.scope.activator:
            self.done = True

    def expire(self, time: int) -> None:
        """Time passes up to *time*."""

    def ended(self, record: Record) -> None:
        """What the terminator *record* means for the pattern."""

    def step(self, roles: Roles, topic: str, message: Any, time: int, number: int) -> None:
        """A message in the open scope that is not its terminator."""
        raise NotImplementedError

    def fail(self, reason: str, time: int, *records: tuple[str, Record]) -> None:
        """The property is violated at *time* by these records in their roles."""
        opened = self.opened
        found = [*records]
        if opened is not None and opened.number:
            found.insert(0, (ACTIVATOR, opened))
        witnesses = tuple(self.witness(role, record) for role, record in found)
        self.failed = Outcome(Verdict.VIOLATED, reason, time / SECOND, witnesses)
        self.done = True

    def witness(self, role: str, record: Record) -> Witness:
        """A record as it is shown."""
        values = record.slots if record.slots is not None else record.message
        if role != ACTIVATOR and record.message is not None:
            part = getattr(self.roles[record.topic], role)
            values = part.shown.of(record.message)
        return Witness(role, record.topic, record.number, record.time / SECOND, shown(values))

    def finish(self, time: int) -> Outcome:
        """The recording ends at *time*."""
        if self.opened is not None and not self.done:
            self.expire(time)
        found = self.failed
        if self.unusable:
            found = Outcome(Verdict.UNDECIDED, self.unusable)
        if found is None:
            reason = self.unused() if self.open_end() is None else None
            if (open_end := self.open_end()) is not None:
                found = Outcome(Verdict.UNDECIDED, open_end)
            elif reason is not None:
                found = Outcome(Verdict.NEVER_EXERCISED, reason)
            else:
                found = Outcome(Verdict.HELD, "")
        return replace(
            found,
            scopes=self.scopes,
            triggers=self.triggers,
            behaviours=self.behaviours,
            faults=self.faults.count,
            faulty_topic=self.faults.first,
        )

    def open_end(self) -> str | None:
        """Why the verdict is open at the end, None if it is not."""
        return None

    def unused(self) -> str | None:
        """Why the recording has nothing to hold the property against, None if it has."""
        return None if self.scopes else "its scope never opened"

    def in_window(self, since: int, time: int) -> bool:
        """Whether *time* is in the window that begins at *since*."""
        return self.window is None or time - since < self.window

    @property
    def promised(self) -> str:
        """The topics of the behaviour in words."""
        return words(map(self.name, self.property.pattern.behaviour))

    @property
    def within(self) -> str:
        """The bound in words, "" without one."""
        bound = self.property.pattern.bound
        return "" if bound is None else f" within {time_text(bound.seconds)}"


def words(events: Iterable[str]) -> str:
    """Topics in a sentence."""
    return " or ".join(events)


#: Characters of a value that is shown, and values of one message.
LONGEST, MOST_SHOWN = 60, 8


def shown(values: Mapping[str, Any] | None) -> dict[str, Any]:
    """Values as they are shown: numbers and short texts as they are, of the rest what it is."""
    found: dict[str, Any] = {}
    for key, value in (values or {}).items():
        if key and len(found) < MOST_SHOWN:
            if isinstance(value, (bool, int, float)):
                found[key] = value
            elif isinstance(value, str):
                found[key] = value if len(value) <= LONGEST else f"{value[: LONGEST - 1]}…"
    return found
