# SPDX-License-Identifier: Apache-2.0
"""One property against messages in order. Times are whole nanoseconds that do not decrease; a window of d is from 0 up to, and without, d."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any

from haros_ci.monitor_files.parts.values import FAULTS, MISSING

SECOND = 1_000_000_000
ACTIVATOR, TERMINATOR, TRIGGER, BEHAVIOUR = "activator", "terminator", "trigger", "behaviour"
HELD, VIOLATED, NEVER_EXERCISED, UNDECIDED = "held", "violated", "never exercised", "undecided"
#: Messages that one property keeps, and items of arrays and characters of texts that they have altogether.
MOST_KEPT, MOST_KEPT_ITEMS = 10_000, 4_000_000
#: Values of one message that are shown, and characters of one.
MOST_SHOWN, LONGEST_SHOWN = 8, 60
SO_MANY = "more messages would have to be kept than the limit allows"


class Record:
    """A message at its place: its *number* from 1, and *values* of it, None where nobody asks for them."""

    def __init__(
        self, topic: str, time: int, number: int, message: Any = None, values: Mapping[str, Any] | None = None
    ) -> None:
        self.topic, self.time, self.number, self.message, self.values = topic, time, number, message, values
        self.weight = sum(len(value) for value in (values or {}).values() if hasattr(value, "__len__"))


class Event:
    """A message on *topic* for which *test* holds (None: for all), in its *role*.

    *keeps* are the values of it that other events ask for by its *alias* (None: none), *shows* those that are shown.
    """

    def __init__(
        self,
        role: str,
        topic: str,
        test: Callable[[Any, Mapping[str, Any]], Any] | None = None,
        alias: str = "",
        keeps: Mapping[str, Callable[[Any], Any]] | None = None,
        shows: Mapping[str, Callable[[Any], Any]] | None = None,
    ) -> None:
        self.role, self.topic, self.test, self.alias = role, topic, test, alias
        self.keeps, self.shows = keeps, shows or {}


def values_of(getters: Mapping[str, Callable[[Any], Any]], message: Any) -> dict[str, Any]:
    """The values that *message* has for them."""
    found: dict[str, Any] = {}
    for key, getter in getters.items():
        try:
            found[key] = getter(message)
        except FAULTS:
            found[key] = MISSING
    return found


def shown(values: Mapping[str, Any]) -> dict[str, Any]:
    """Values as they are shown: numbers and short texts."""
    found: dict[str, Any] = {}
    for key, value in values.items():
        if key and len(found) < MOST_SHOWN:
            if isinstance(value, (bool, int, float)):
                found[key] = value
            elif isinstance(value, str):
                found[key] = value if len(value) <= LONGEST_SHOWN else value[: LONGEST_SHOWN - 1] + "\u2026"
    return found


class Pool:
    """Records in order of time. Of two with the same values the first (*keeps_first*) or the last stays; *overflowed* if one was left out."""

    def __init__(self, keeps_first: bool) -> None:
        self.keeps_first = keeps_first
        self.overflowed = False
        self.records: dict[Any, Record] = {}
        self.weight = 0

    def __len__(self) -> int:
        return len(self.records)

    def __iter__(self) -> Iterator[Record]:
        return iter(self.records.values())

    @property
    def first(self) -> Record:
        """The oldest; there must be one."""
        return next(iter(self.records.values()))

    def add(self, record: Record) -> None:
        """Take *record*, which is not older than those that are there."""
        key = self.key(record)
        if key in self.records:
            if self.keeps_first:
                return
            self.forget(key)
        while self.records and (len(self.records) >= MOST_KEPT or self.weight + record.weight > MOST_KEPT_ITEMS):
            self.overflowed = True
            if self.keeps_first:
                return
            self.forget(next(iter(self.records)))
        self.records[key] = record
        self.weight += record.weight

    def forget(self, key: Any) -> None:
        self.weight -= self.records.pop(key).weight

    def key(self, record: Record) -> Any:
        if record.values is None:
            return None
        key = (record.topic, *record.values.values())
        try:
            hash(key)
        except TypeError:
            return record.number
        return key

    def remove(self, record: Record) -> None:
        """Take *record* out, which is there."""
        self.forget(self.key(record))

    def drop_until(self, time: int) -> None:
        """Forget what is of *time*, or older."""
        while self.records and self.first.time <= time:
            self.forget(next(iter(self.records)))

    def clear(self) -> None:
        """Forget all."""
        self.records.clear()
        self.weight = 0


class Property:
    """A property and what is known of it so far. Subclasses are the patterns; theirs, at the end of this file's core, the properties."""

    #: The id, else the text; the text; what it is about; the instance of the node that it is about.
    title = text = owner = node = ""
    #: Whether it is taken for granted (an assumption), and where it stands.
    is_axiom = False
    place: tuple[str, int, int] | tuple[()] = ()
    #: The time bound in nanoseconds, and in words.
    window: int | None = None
    within = ""
    #: The topics of behaviour and trigger in words.
    promised = expected = ""
    #: Whether one of behaviour and trigger asks for values of the other.
    asks = False
    #: Why nothing can be said, "" if something can.
    unusable = ""

    def __init__(self) -> None:
        self.roles: dict[str, dict[str, Event]] = {}
        for event in self.events():
            self.roles.setdefault(event.topic, {})[event.role] = event
        every = [event for roles in self.roles.values() for event in roles.values()]
        self.is_reopened = any(event.role == ACTIVATOR for event in every)
        self.is_closed = any(event.role == TERMINATOR for event in every)
        self.behaviour = {event.topic for event in every if event.role == BEHAVIOUR}
        #: Nothing that follows can change the verdict.
        self.done = bool(self.unusable)
        self.violation: dict[str, Any] | None = None
        self.opened: Record | None = None
        self.known: Mapping[str, Any] = {}
        self.last = 0
        self.scopes = self.triggers = self.behaviours = self.heard = 0
        #: How often a predicate asked a message for what it does not have, and of which topic first.
        self.faults, self.faulty_topic = 0, ""

    def events(self) -> Sequence[Event]:
        """The events of the property."""
        raise NotImplementedError

    def matches(self, event: Event, message: Any, known: Mapping[str, Any]) -> bool:
        """Whether *message*, of the event's topic, is one."""
        if event.test is None:
            return True
        try:
            return bool(event.test(message, known))
        except FAULTS:
            self.faults += 1
            self.faulty_topic = self.faulty_topic or event.topic
            return False

    def is_blind(self, topic: str) -> bool:
        """Whether the property asks for nothing that messages on *topic* hold."""
        return all(event.test is None and event.keeps is None for event in self.roles[topic].values())

    def leave(self, reason: str) -> None:
        """A message is there and cannot be had: from here on nothing is known."""
        if not self.done:
            self.unusable, self.done = reason, True

    def start(self, time: int) -> None:
        """The monitor begins."""
        self.last = time
        if not self.is_reopened:
            self.open(Record("", time, 0), {})

    def on_message(self, topic: str, message: Any, time: int, number: int) -> None:
        """A message on a topic of the property, the *number*-th of all."""
        if self.done:
            return
        self.last = time
        roles = self.roles[topic]
        if self.opened is None:
            event = roles.get(ACTIVATOR)
            if event is not None and self.matches(event, message, {}):
                known = {} if event.keeps is None else {event.alias: values_of(event.keeps, message)}
                self.open(Record(topic, time, number, None, values_of(event.shows, message)), known)
            return
        self.expire(time)
        if self.done:
            return
        end = roles.get(TERMINATOR)
        if end is not None and self.matches(end, message, self.known):
            self.close(Record(topic, time, number, message))
        elif BEHAVIOUR in roles or TRIGGER in roles:
            self.step(roles, topic, message, time, number)

    def on_timer(self, time: int) -> None:
        """No message up to *time*."""
        if self.opened is not None and not self.done:
            self.expire(time)

    def deadline(self) -> int | None:
        """When ``on_timer`` has something to say, None if only a message can."""
        return None

    def open(self, record: Record, known: Mapping[str, Any]) -> None:
        """The scope begins."""
        self.opened, self.known = record, known
        self.scopes += 1

    def close(self, record: Record) -> None:
        """The scope ends with the terminator *record*."""
        self.ended(record)
        self.opened, self.known = None, {}
        if not self.is_reopened:
            self.done = True

    def expire(self, time: int) -> None:
        """Time passes up to *time*."""

    def ended(self, record: Record) -> None:
        """What the terminator *record* means for the pattern."""

    def step(self, roles: Mapping[str, Event], topic: str, message: Any, time: int, number: int) -> None:
        """A message in the open scope that is not its terminator."""
        raise NotImplementedError

    def in_window(self, since: int, time: int) -> bool:
        """Whether *time* is in the window that begins at *since*."""
        return self.window is None or time - since < self.window

    def fail(self, reason: str, time: int, *records: tuple[str, Record]) -> None:
        """The property is violated at *time* by these records in their roles."""
        if self.opened is not None and self.opened.number:
            records = ((ACTIVATOR, self.opened), *records)
        self.violation = {"reason": reason, "time": time, "witnesses": [self.witness(*entry) for entry in records]}
        self.done = True

    def witness(self, role: str, record: Record) -> dict[str, Any]:
        """A record as it is shown."""
        values = record.values or {}
        if role != ACTIVATOR and record.message is not None:
            values = values_of(self.roles[record.topic][role].shows, record.message)
        time = record.time / SECOND
        return {"role": role, "topic": record.topic, "number": record.number, "time": time, "values": shown(values)}

    def finish(self, time: int, came: Iterable[str]) -> tuple[str, str]:
        """The verdict and its reason at the end; on the topics *came* there were messages."""
        self.on_timer(time)
        self.last = max(self.last, time)
        missing = "" if self.behaviour.intersection(came) else f"no message came on {', '.join(sorted(self.behaviour))}"
        if self.unusable:
            return UNDECIDED, self.unusable
        if self.violation is not None:
            return VIOLATED, "; ".join(filter(None, (self.violation["reason"], missing)))
        reason = self.open_end()
        if reason:
            return UNDECIDED, reason
        reason = self.unused() or missing
        return (NEVER_EXERCISED, reason) if reason else (HELD, "")

    def open_end(self) -> str:
        """Why the verdict is open at the end, "" if it is not."""
        return ""

    def unused(self) -> str:
        """Why there was nothing to hold the property against, "" if there was."""
        return "" if self.scopes else "its scope never opened"
