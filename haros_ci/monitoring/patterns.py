# SPDX-License-Identifier: Apache-2.0
"""The five patterns as monitors."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

from haros_ci.behaviour.tree import PatternKind, Property
from haros_ci.monitoring.monitor import (
    BEHAVIOUR,
    SECOND,
    TERMINATOR,
    TRIGGER,
    Monitor,
    Part,
    Roles,
    no_constants,
    words,
)
from haros_ci.monitoring.pool import MOST_KEPT, Pool, Record
from haros_ci.monitoring.predicates import Constants, Known, chains

_SO_MANY = "more messages would have to be kept than the limit allows"


class Absence(Monitor):
    """``no``: nothing of the behaviour while the scope is open, and in the window."""

    def step(self, roles: Roles, topic: str, message: Any, time: int, number: int) -> None:
        assert self.opened is not None and roles.behaviour is not None
        if not self.in_window(self.opened.time, time):
            return
        self.heard += 1
        if roles.behaviour.matches(message, self.known):
            self.behaviours += 1
            self.fail(f"{topic} came{self.within}", time, (BEHAVIOUR, Record(topic, message, time, number)))

    def open_end(self) -> str | None:
        if self.heard and self.faults.count >= self.heard:
            return "no message has what its predicate asks for"
        return None

    def unused(self) -> str | None:
        if not self.scopes or self.heard or any(event.predicate is None for event in self.property.pattern.behaviour):
            return super().unused()
        return "no message of its topics came while its scope was open"


class Existence(Monitor):
    """``some``: the behaviour in each opening, before it closes, in the window."""

    found = False

    def open(self, record: Record, known: Known) -> None:
        super().open(record, known)
        self.found = False

    def expire(self, time: int) -> None:
        assert self.opened is not None
        if not self.found and not self.in_window(self.opened.time, time):
            assert self.window is not None
            self.fail(f"{self.promised} did not come{self.within}", self.opened.time + self.window)

    def ended(self, record: Record) -> None:
        if not self.found:
            self.fail(f"{self.promised} did not come before the scope closed", record.time, (TERMINATOR, record))

    def step(self, roles: Roles, topic: str, message: Any, time: int, number: int) -> None:
        assert roles.behaviour is not None
        if self.found or not roles.behaviour.matches(message, self.known):
            return
        self.behaviours += 1
        self.found = True
        self.done = not (self.property.scope.activator and self.property.scope.terminator)

    def open_end(self) -> str | None:
        return f"{self.promised} had not come when the recording ended" if self.opened and not self.found else None


class _Remembering(Monitor):
    """A pattern that keeps records of its first event, as far as its second one asks for them."""

    keeps_first = False

    def __init__(
        self, property: Property, names: Mapping[str, str], constants: Constants = no_constants, limit: int = MOST_KEPT
    ) -> None:
        super().__init__(property, names, constants, limit)
        self.pool = Pool(self.keeps_first, limit)
        #: Whether the behaviour asks for values of the trigger, so that one trigger is not as good as another.
        self.asks = any(
            part.slots is not None and part.event.alias in self.asked()
            for roles in self.roles.values()
            if (part := roles.trigger) is not None
        )

    def asked(self) -> set[str | None]:
        """The aliases of triggers that behaviour asks for."""
        return {
            event.alias
            for event in self.property.pattern.trigger
            if event.alias is not None
            for other in self.property.pattern.behaviour
            if any(True for _ in chains(other.predicate, event.alias))
        }

    def open(self, record: Record, known: Known) -> None:
        super().open(record, known)
        self.pool.clear()

    def triggered(self, part: Part, topic: str, message: Any, time: int, number: int) -> None:
        """Keep a trigger."""
        self.triggers += 1
        if not self.asks:
            self.pool.add(Record(topic, message, time, number))
        else:
            slots = {} if part.slots is None else part.slots.of(message)
            self.pool.add(Record(topic, None, time, number, slots))

    def knowing(self, record: Record) -> Known:
        """What is known where behaviour is held against the trigger *record*."""
        part = self.roles[record.topic].trigger
        assert part is not None
        if not self.asks or part.event.alias is None:
            return self.known
        return {**self.known, part.event.alias: record.slots}

    def unused(self) -> str | None:
        if super().unused() is None and not self.triggers:
            return "its trigger never came while its scope was open"
        return super().unused()


class Response(_Remembering):
    """``causes``: each trigger is answered in its opening, in its window; an answer can be a trigger, too."""

    keeps_first = True

    def expire(self, time: int) -> None:
        if self.window is not None and self.pool and not self.in_window(self.pool.first.time, time):
            first = self.pool.first
            self.fail(f"{self.promised} did not come{self.within}", first.time + self.window, (TRIGGER, first))

    def ended(self, record: Record) -> None:
        if self.pool:
            reason = f"{self.promised} did not come before the scope closed"
            self.fail(reason, record.time, (TRIGGER, self.pool.first), (TERMINATOR, record))

    def step(self, roles: Roles, topic: str, message: Any, time: int, number: int) -> None:
        if roles.behaviour is not None and self.pool:
            self.answer(roles.behaviour, message)
        part = roles.trigger
        if part is not None and part.matches(message, self.known):
            self.triggered(part, topic, message, time, number)

    def answer(self, part: Part, message: Any) -> None:
        """Take the triggers out that *message* answers."""
        if self.asks:
            answered = [record for record in self.pool if part.matches(message, self.knowing(record))]
        else:
            answered = list(self.pool) if part.matches(message, self.known) else []
        self.behaviours += bool(answered)
        for record in answered:
            self.pool.remove(record)

    def open_end(self) -> str | None:
        if self.pool.overflowed:
            return _SO_MANY
        if self.opened is not None and self.pool:
            return f"{self.promised} had not come when the recording ended, {self._waited()} after its trigger"
        return None

    def _waited(self) -> str:
        return f"{(self.last - self.pool.first.time) / SECOND:.3f} s"

    def finish(self, time: int) -> Any:
        self.last = max(self.last, time)
        return super().finish(time)


class Prevention(_Remembering):
    """``forbids``: no behaviour in the window after a trigger of the same opening."""

    def step(self, roles: Roles, topic: str, message: Any, time: int, number: int) -> None:
        if self.window is not None:
            self.pool.drop_until(time - self.window)
        if roles.behaviour is not None and self.pool:
            for record in self.pool:
                if roles.behaviour.matches(message, self.knowing(record)):
                    self.behaviours += 1
                    reason = (
                        f"{topic} came{self.within} of {record.topic}"
                        if self.within
                        else f"{topic} came after {record.topic}"
                    )
                    self.fail(reason, time, (TRIGGER, record), (BEHAVIOUR, Record(topic, message, time, number)))
                    return
        part = roles.trigger
        if part is not None and part.matches(message, self.known):
            self.triggered(part, topic, message, time, number)

    def open_end(self) -> str | None:
        return _SO_MANY if self.pool.overflowed else None


class Requirement(Monitor):
    """``requires``: each behaviour has an earlier trigger in its opening, in the window. Triggers can ask for values of the behaviour."""

    def __init__(
        self, property: Property, names: Mapping[str, str], constants: Constants = no_constants, limit: int = MOST_KEPT
    ) -> None:
        aliases = {event.alias for event in property.pattern.behaviour if event.alias is not None}
        #: Whether triggers ask for values of the behaviour, so that they are held against each one anew.
        self.asks = any(
            any(True for _ in chains(event.predicate, alias)) for event in property.pattern.trigger for alias in aliases
        )
        super().__init__(property, names, constants, limit)
        self.pool = Pool(False, limit)

    def is_kept_in_slots(self, role: str) -> bool:
        return role == TRIGGER and self.asks

    def open(self, record: Record, known: Known) -> None:
        super().open(record, known)
        self.pool.clear()

    def step(self, roles: Roles, topic: str, message: Any, time: int, number: int) -> None:
        if self.window is not None:
            self.pool.drop_until(time - self.window)
        part = roles.behaviour
        if part is not None and part.matches(message, self.known):
            self.behaviours += 1
            if not self.is_founded(part, message) and not self.pool.overflowed:
                before = words(map(self.name, self.property.pattern.trigger))
                behaviour = Record(topic, message, time, number)
                self.fail(f"{topic} came without {before} before{self.within}", time, (BEHAVIOUR, behaviour))
                return
        part = roles.trigger
        if part is None:
            return
        if self.asks:
            self.triggers += 1
            self.pool.add(Record(topic, None, time, number, part.shown.of(message)))
        elif part.matches(message, self.known):
            self.triggers += 1
            self.pool.add(Record(topic, None, time, number))

    def is_founded(self, behaviour: Part, message: Any) -> bool:
        """Whether a trigger that is kept allows *message*."""
        if not self.asks:
            return bool(self.pool)
        known = self.known
        if behaviour.event.alias is not None and behaviour.slots is not None:
            known = {**known, behaviour.event.alias: behaviour.slots.of(message)}
        for record in reversed(self.pool.records.values()):
            part = self.roles[record.topic].trigger
            assert part is not None
            if part.matches(record.slots, known):
                return True
        return False

    def open_end(self) -> str | None:
        return _SO_MANY if self.pool.overflowed else None

    def unused(self) -> str | None:
        if super().unused() is None and not self.behaviours:
            return "its behaviour never came while its scope was open"
        return super().unused()


_MONITORS: Mapping[PatternKind, type[Monitor]] = {
    PatternKind.NO: Absence,
    PatternKind.SOME: Existence,
    PatternKind.CAUSES: Response,
    PatternKind.FORBIDS: Prevention,
    PatternKind.REQUIRES: Requirement,
}


def monitor_of(
    property: Property,
    names: Mapping[str, str] = MappingProxyType({}),
    constants: Constants = no_constants,
    limit: int = MOST_KEPT,
) -> Monitor:
    """The monitor of *property*, which the language allows (``Monitor`` says what the others are)."""
    return _MONITORS[property.pattern.kind](property, names, constants, limit)
