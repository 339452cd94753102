# SPDX-License-Identifier: Apache-2.0
"""The five patterns."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from haros_ci.monitor_files.parts.monitors import (
    BEHAVIOUR,
    SECOND,
    SO_MANY,
    TERMINATOR,
    TRIGGER,
    Event,
    Pool,
    Property,
    Record,
    values_of,
)


class No(Property):
    """``no``: nothing of the behaviour while the scope is open, and in the window."""

    def step(self, roles: Mapping[str, Event], topic: str, message: Any, time: int, number: int) -> None:
        assert self.opened is not None
        if not self.in_window(self.opened.time, time):
            return
        self.heard += 1
        if self.matches(roles[BEHAVIOUR], message, self.known):
            self.behaviours += 1
            self.fail(f"{topic} came{self.within}", time, (BEHAVIOUR, Record(topic, time, number, message)))

    def open_end(self) -> str:
        is_deaf = bool(self.heard) and self.faults >= self.heard
        return "no message has what its predicate asks for" if is_deaf else ""

    def unused(self) -> str:
        events = [roles[BEHAVIOUR] for roles in self.roles.values() if BEHAVIOUR in roles]
        if not self.scopes or self.heard or any(event.test is None for event in events):
            return super().unused()
        return "no message of its topics came while its scope was open"


class Some(Property):
    """``some``: the behaviour in each opening, before it closes, in the window."""

    found = False

    def open(self, record: Record, known: Mapping[str, Any]) -> None:
        super().open(record, known)
        self.found = False

    def deadline(self) -> int | None:
        if self.done or self.opened is None or self.found or self.window is None:
            return None
        return self.opened.time + self.window

    def expire(self, time: int) -> None:
        assert self.opened is not None
        if not self.found and not self.in_window(self.opened.time, time):
            assert self.window is not None
            self.fail(f"{self.promised} did not come{self.within}", self.opened.time + self.window)

    def ended(self, record: Record) -> None:
        if not self.found:
            self.fail(f"{self.promised} did not come before the scope closed", record.time, (TERMINATOR, record))

    def step(self, roles: Mapping[str, Event], topic: str, message: Any, time: int, number: int) -> None:
        if self.found or not self.matches(roles[BEHAVIOUR], message, self.known):
            return
        self.behaviours += 1
        self.found = True
        self.done = not (self.is_reopened and self.is_closed)

    def open_end(self) -> str:
        is_open = self.opened is not None and not self.found
        return f"{self.promised} had not come when the recording ended" if is_open else ""


class Remembering(Property):
    """A pattern that keeps its triggers, as far as its behaviour asks for them."""

    def __init__(self) -> None:
        super().__init__()
        self.pool = Pool(isinstance(self, Causes))

    def open(self, record: Record, known: Mapping[str, Any]) -> None:
        super().open(record, known)
        self.pool.clear()

    def triggered(self, event: Event, topic: str, message: Any, time: int, number: int) -> None:
        """Keep a trigger."""
        self.triggers += 1
        if self.asks:
            self.pool.add(Record(topic, time, number, None, values_of(event.keeps or {}, message)))
        else:
            self.pool.add(Record(topic, time, number, message))

    def knowing(self, record: Record) -> Mapping[str, Any]:
        """What is known where behaviour is held against the trigger *record*."""
        event = self.roles[record.topic][TRIGGER]
        if not self.asks or not event.alias:
            return self.known
        return {**self.known, event.alias: record.values or {}}

    def open_end(self) -> str:
        return SO_MANY if self.pool.overflowed else ""

    def unused(self) -> str:
        return super().unused() or ("" if self.triggers else "its trigger never came while its scope was open")


class Causes(Remembering):
    """``causes``: each trigger is answered in its opening, in its window; an answer can be a trigger, too."""

    def deadline(self) -> int | None:
        if self.done or self.opened is None or not self.pool or self.window is None:
            return None
        return self.pool.first.time + self.window

    def expire(self, time: int) -> None:
        if self.window is not None and self.pool and not self.in_window(self.pool.first.time, time):
            first = self.pool.first
            self.fail(f"{self.promised} did not come{self.within}", first.time + self.window, (TRIGGER, first))

    def ended(self, record: Record) -> None:
        if self.pool:
            reason = f"{self.promised} did not come before the scope closed"
            self.fail(reason, record.time, (TRIGGER, self.pool.first), (TERMINATOR, record))

    def step(self, roles: Mapping[str, Event], topic: str, message: Any, time: int, number: int) -> None:
        if BEHAVIOUR in roles and self.pool:
            self.answer(roles[BEHAVIOUR], message)
        event = roles.get(TRIGGER)
        if event is not None and self.matches(event, message, self.known):
            self.triggered(event, topic, message, time, number)

    def answer(self, event: Event, message: Any) -> None:
        """Take the triggers out that *message* answers."""
        if self.asks:
            answered = [record for record in self.pool if self.matches(event, message, self.knowing(record))]
        else:
            answered = list(self.pool) if self.matches(event, message, self.known) else []
        self.behaviours += bool(answered)
        for record in answered:
            self.pool.remove(record)

    def open_end(self) -> str:
        if not self.pool.overflowed and self.opened is not None and self.pool:
            waited = (self.last - self.pool.first.time) / SECOND
            return f"{self.promised} had not come when the recording ended, {waited:.3f} s after its trigger"
        return super().open_end()


class Forbids(Remembering):
    """``forbids``: no behaviour in the window after a trigger of the same opening."""

    def step(self, roles: Mapping[str, Event], topic: str, message: Any, time: int, number: int) -> None:
        if self.window is not None:
            self.pool.drop_until(time - self.window)
        if BEHAVIOUR in roles:
            for record in self.pool:
                if self.matches(roles[BEHAVIOUR], message, self.knowing(record)):
                    self.behaviours += 1
                    of = " of" if self.within else " after"
                    behaviour = Record(topic, time, number, message)
                    reason = f"{topic} came{self.within}{of} {record.topic}"
                    self.fail(reason, time, (TRIGGER, record), (BEHAVIOUR, behaviour))
                    return
        event = roles.get(TRIGGER)
        if event is not None and self.matches(event, message, self.known):
            self.triggered(event, topic, message, time, number)


class Requires(Property):
    """``requires``: each behaviour has an earlier trigger in its opening, in the window.

    Where triggers ask for values of the behaviour they are held against each one anew, with the values that were kept of them.
    """

    def __init__(self) -> None:
        super().__init__()
        self.pool = Pool(False)

    def open(self, record: Record, known: Mapping[str, Any]) -> None:
        super().open(record, known)
        self.pool.clear()

    def step(self, roles: Mapping[str, Event], topic: str, message: Any, time: int, number: int) -> None:
        if self.window is not None:
            self.pool.drop_until(time - self.window)
        event = roles.get(BEHAVIOUR)
        if event is not None and self.matches(event, message, self.known):
            self.behaviours += 1
            if not self.is_founded(event, message) and not self.pool.overflowed:
                behaviour = Record(topic, time, number, message)
                reason = f"{topic} came without {self.expected} before{self.within}"
                self.fail(reason, time, (BEHAVIOUR, behaviour))
                return
        event = roles.get(TRIGGER)
        if event is None:
            return
        if self.asks:
            self.triggers += 1
            self.pool.add(Record(topic, time, number, None, values_of(event.shows, message)))
        elif self.matches(event, message, self.known):
            self.triggers += 1
            self.pool.add(Record(topic, time, number, message))

    def is_founded(self, event: Event, message: Any) -> bool:
        """Whether a trigger that is kept allows *message*."""
        if not self.asks:
            return bool(self.pool)
        known = self.known
        if event.keeps is not None:
            known = {**known, event.alias: values_of(event.keeps, message)}
        for record in reversed(list(self.pool)):
            if self.matches(self.roles[record.topic][TRIGGER], record.values, known):
                return True
        return False

    def open_end(self) -> str:
        return SO_MANY if self.pool.overflowed else ""

    def unused(self) -> str:
        return super().unused() or ("" if self.behaviours else "its behaviour never came while its scope was open")
