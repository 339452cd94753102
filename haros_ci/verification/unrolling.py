# SPDX-License-Identifier: Apache-2.0
"""A run of so many events as variables: who publishes or receives what at each step, when, and with which values.

Times are real numbers, in milliseconds, that do not decrease. Steps without an event stand at the end alone: all is silent from there on. With a
loop, all steps have an event, and those from one of them on repeat for ever. A subscriber sees a message as it is published, or, in an asynchronous
network, at a step of its own: each channel from a publisher to a subscriber keeps the order and delivers once.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from fractions import Fraction
from itertools import combinations
from typing import Any

import z3

from haros_ci.records import dataclass
from haros_ci.verification.fields import Fields, Kind, Slot
from haros_ci.verification.predicates import FALSE, TRUE, Value, both, no, one_of
from haros_ci.verification.problem import MILLISECOND, NotModelled, Problem

#: Kinds of events of one run.
MOST_OPTIONS = 150


@dataclass(frozen=True, slots=True)
class Option:
    """*node* publishes on *topic*, or receives what *sender* has published there."""

    node: str
    topic: str
    sender: str = ""


def milliseconds(time: int) -> Any:
    """Nanoseconds as a number of milliseconds."""
    exact = Fraction(time, MILLISECOND)
    return z3.Q(exact.numerator, exact.denominator)


def options_of(problem: Problem, topics: Iterable[str], heard: Iterable[tuple[str, str]]) -> tuple[Option, ...]:
    """All that can happen on *topics*; *heard* are nodes and topics of which it matters when they receive."""
    found = [Option(node, topic) for topic in sorted(topics) for node in problem.publishers(topic)]
    if problem.network.is_async:
        found += [
            Option(node, topic, sender) for node, topic in sorted(set(heard)) for sender in problem.publishers(topic)
        ]
    if len(found) > MOST_OPTIONS:
        raise NotModelled(f"more than {MOST_OPTIONS} kinds of events")
    return tuple(found)


class Unrolling:
    """Runs of *length* events. ``constraints`` say what a run is. With *is_prefix* it goes on: messages can be on their way at its end."""

    def __init__(
        self,
        problem: Problem,
        options: tuple[Option, ...],
        fields: Fields,
        length: int,
        *,
        is_looped: bool = False,
        is_exact: bool = False,
        is_prefix: bool = False,
    ) -> None:
        self.problem, self.options, self.fields, self.length = problem, options, fields, length
        self.is_looped, self.is_prefix = is_looped, is_prefix
        steps = range(length)
        self.steps = steps
        self.happens = {(i, o): z3.Bool(f"event {i} {n}") for i in steps for n, o in enumerate(options)}
        self.idle = [z3.Bool(f"idle {i}") for i in steps]
        self.time = [z3.Real(f"time {i}") for i in range(length + is_looped)]
        self.constraints: list[Any] = []
        self._values: dict[tuple[int, str, str], Value] = {}
        self._publishing: dict[tuple[int, str], Any] = {}
        self.matches: dict[tuple[Option, int, int], Any] = {}
        self._events(is_exact)
        self._times()
        #: Whether the loop begins at a step.
        self.loops = [z3.Bool(f"loop {i}") for i in steps] if is_looped else []
        if is_looped:
            self._loop()
        if problem.network.is_async:
            for option in options:
                if option.sender:
                    self._channel(option)
        self._ranges()

    def say(self, *parts: Any) -> None:
        self.constraints.extend(part for part in parts if not z3.is_true(part))

    def _events(self, is_exact: bool) -> None:
        for i in self.steps:
            every = [self.idle[i], *(self.happens[i, option] for option in self.options)]
            self.say(z3.Or(*every), *(z3.Or(z3.Not(a), z3.Not(b)) for a, b in combinations(every, 2)))
            if i:
                self.say(z3.Implies(self.idle[i - 1], self.idle[i]))
        if self.length and (self.is_looped or is_exact):
            self.say(z3.Not(self.idle[-1]))

    def _times(self) -> None:
        if self.time:
            self.say(self.time[0] >= 0, *(a <= b for a, b in zip(self.time, self.time[1:])))

    def _loop(self) -> None:
        self.period = z3.Real("period")
        self.say(self.period > 0, z3.Or(*self.loops))
        self.say(*(z3.Or(z3.Not(a), z3.Not(b)) for a, b in combinations(self.loops, 2)))
        for i, begins in enumerate(self.loops):
            self.say(z3.Implies(begins, self.period == self.time[self.length] - self.time[i]))

    def repeats(self, step: int) -> Any:
        """Whether *step* is in the loop."""
        return one_of(*self.loops[: step + 1])

    def value(self, step: int, topic: str, key: str) -> Value:
        """A part of the message on *topic* at *step*; an item is there if its array is long enough."""
        if (step, topic, key) not in self._values:
            slot = self.fields.slots[topic, key]
            term = _variable(slot, f"{topic} {key} {step}")
            self._values[step, topic, key] = Value(slot.kind, term, self._there(step, slot))
        return self._values[step, topic, key]

    def _there(self, step: int, slot: Slot) -> Any:
        found = []
        for number, part in enumerate(slot.path):
            if isinstance(part, int):
                length = next(
                    other
                    for other in self.fields.of(slot.topic)
                    if other.is_length and other.path == slot.path[:number]
                )
                if length.low is None or length.low <= part:
                    found.append(self.value(step, slot.topic, length.key).term > part)
        return both(*found)

    def _ranges(self) -> None:
        """The values that the types allow, of what can happen."""
        for topic in sorted({option.topic for option in self.options}):
            for slot in self.fields.of(topic):
                for i in self.steps:
                    term = self.value(i, topic, slot.key).term
                    self.say(*(part for part in _range(slot, term)))

    def published(self, step: int, topic: str, node: str | None = None) -> Any:
        """Whether *node*, or anybody, publishes on *topic* at *step*."""
        if node is not None:
            return self.happens.get((step, Option(node, topic)), FALSE)
        if (step, topic) not in self._publishing:
            found = (self.happens[step, o] for o in self.options if o.topic == topic and not o.sender)
            self._publishing[step, topic] = one_of(*found)
        return self._publishing[step, topic]

    def received(self, step: int, topic: str, node: str) -> Any:
        """Whether *node* sees a message on *topic* at *step*."""
        if not self.problem.network.is_async:
            return self.published(step, topic)
        return one_of(
            *(self.happens[step, o] for o in self.options if o.topic == topic and o.node == node and o.sender)
        )

    def _channel(self, option: Option) -> None:
        """Messages arrive once, in order, in time, as they were sent; nothing is on its way at the end, nor where a loop begins."""
        network = self.problem.network
        sent = [self.happens[i, Option(option.sender, option.topic)] for i in self.steps]
        got = [self.happens[i, option] for i in self.steps]
        kept = self._kept(option, sent)
        so_far, arrived = _counts(kept), _counts(got)
        keys = [slot.key for slot in self.fields.of(option.topic)]
        for i in self.steps:
            sources = []
            for j in range(i):
                match = z3.And(kept[j], got[i], _equal(so_far[j], arrived[i]))
                self.matches[option, j, i] = match
                sources.append(match)
                late = self.time[i] - self.time[j]
                held = [late >= milliseconds(network.low)] if network.low else []
                held += [late <= milliseconds(network.high)] if network.high is not None else []
                held += [self.value(i, option.topic, k).term == self.value(j, option.topic, k).term for k in keys]
                if held:
                    self.say(z3.Implies(match, z3.And(*held)))
            self.say(z3.Implies(got[i], one_of(*sources)))
        if not self.is_prefix:
            self.say(_equal(so_far[self.length], arrived[self.length]))
        for i, begins in enumerate(self.loops):
            self.say(z3.Implies(begins, _equal(so_far[i], arrived[i])))

    def _kept(self, option: Option, sent: list[Any]) -> list[Any]:
        """Which messages of a channel are not lost: as many as the queue holds must come behind one that is."""
        network = self.problem.network
        member = self.problem.member(option.node)
        size = member.subscribes.get(option.topic) if member is not None else None
        if not network.loses or not size or size >= self.length:
            return sent
        kept = []
        for i in self.steps:
            lost = z3.Bool(f"lost {i} {option.node} {option.topic} {option.sender}")
            behind = [
                both(sent[j], self.time[j] - self.time[i] <= milliseconds(network.high)) if network.high is not None else sent[j]
                for j in range(i + 1, self.length)
            ]  # fmt: skip
            self.say(z3.Implies(lost, z3.AtLeast(*behind, size) if len(behind) >= size else FALSE))
            kept.append(z3.And(sent[i], z3.Not(lost)))
        return kept


def _variable(slot: Slot, name: str) -> Any:
    match slot.kind:
        case Kind.BOOL:
            return z3.Bool(name)
        case Kind.REAL:
            return z3.Real(name)
        case _:
            return z3.Int(name)


def _range(slot: Slot, term: Any) -> Iterator[Any]:
    if slot.kind is Kind.TEXT:
        yield term >= 0
    if slot.low is not None and slot.low == slot.high:
        yield term == slot.low
        return
    if slot.low is not None:
        yield term >= slot.low
    if slot.high is not None:
        yield term <= slot.high


def _counts(events: list[Any]) -> list[list[Any]]:
    """Before each step, and at the end: whether there were at least 1, 2, … of *events*."""
    found: list[list[Any]] = [[]]
    for event in events:
        last = found[-1]
        at_least = [one_of(last[0], event)] if last else [event]
        at_least += [one_of(last[k], both(last[k - 1], event)) for k in range(1, len(last))]
        if last:
            at_least.append(both(last[-1], event))
        found.append(at_least)
    return found


def _equal(one: list[Any], other: list[Any]) -> Any:
    """Whether two counts are the same."""
    parts = []
    for k in range(max(len(one), len(other))):
        first = one[k] if k < len(one) else FALSE
        second = other[k] if k < len(other) else FALSE
        parts.append(no(second) if z3.is_false(first) else no(first) if z3.is_false(second) else first == second)
    return both(*parts) if parts else TRUE
