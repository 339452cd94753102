# SPDX-License-Identifier: Apache-2.0
"""Several properties against one recording."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import Any

from haros_ci.monitoring.clock import Clock, Stamped, Timed, stamp_of
from haros_ci.monitoring.monitor import Monitor
from haros_ci.monitoring.verdict import Outcome, Verdict


class Watch:
    """Gives each message to the monitors that it concerns.

    With *by_header* the times are those of header stamps, else those at which messages were recorded.
    """

    def __init__(self, monitors: Iterable[Monitor], *, by_header: bool = False) -> None:
        self.monitors = tuple(monitors)
        self.ears: dict[str, list[Monitor]] = {}
        for monitor in self.monitors:
            for topic in monitor.topics:
                self.ears.setdefault(topic, []).append(monitor)
        self.clock = Clock()
        self.stamped = Stamped() if by_header else None
        self.began: int | None = None
        #: How many messages came on each topic of the properties.
        self.counts: dict[str, int] = dict.fromkeys(self.ears, 0)

    @property
    def topics(self) -> frozenset[str]:
        """The topics whose messages are needed."""
        return frozenset(self.ears)

    def begin(self, time: int) -> None:
        """The recording begins: *time* is that of its first message, by the clock that counts."""
        self.began = self.clock.at(time, 0)
        for monitor in self.monitors:
            monitor.start(self.began)

    def take(self, topic: str, message: Any, time: int, number: int) -> None:
        """The *number*-th message of the recording, of one of ``topics``, recorded at *time* (nanoseconds)."""
        self.counts[topic] += 1
        if self.stamped is None:
            self._give(topic, message, time, number)
            return
        stamp = stamp_of(message)
        if stamp is None:
            self.leave(topic, f"message {number}, on {topic}, has no header stamp; --clock log does without")
            return
        for timed in self.stamped.put(Timed(number, topic, time, message), stamp):
            self._give(timed.topic, timed.message, timed.time, timed.number)

    def leave(self, topic: str, reason: str) -> None:
        """A message of one of ``topics`` is there and cannot be had."""
        for monitor in self.ears[topic]:
            monitor.leave(reason)

    def miss(self, topic: str, reason: str, time: int, number: int) -> None:
        """The same, recorded at *time*: where it does not matter what a message holds, it is enough that it came."""
        self.counts[topic] += 1
        if self.stamped is not None:
            self.leave(topic, reason)
            return
        at = self._at(time, number)
        for monitor in self.ears[topic]:
            if monitor.is_blind(topic):
                monitor.take(topic, None, at, number)
            else:
                monitor.leave(reason)

    def _give(self, topic: str, message: Any, time: int, number: int) -> None:
        at = self._at(time, number)
        for monitor in self.ears[topic]:
            monitor.take(topic, message, at, number)

    def _at(self, time: int, number: int) -> int:
        """The time of a message by the clock that counts."""
        if self.began is None:
            self.begin(time)
        return self.clock.at(time, number)

    def finish(self, time: int | None, recorded: frozenset[str] | None = None) -> tuple[Outcome, ...]:
        """The outcomes, in the order of the monitors. *time* is that of the last message of the recording (None: not known); *recorded* are its topics."""
        for timed in self.stamped.rest() if self.stamped is not None else ():
            self._give(timed.topic, timed.message, timed.time, timed.number)
        if self.began is None:
            self.begin(time or 0)
        end = self.clock.last or 0
        if time is not None and self.stamped is None:
            end = self.clock.at(time, 0) if time + self.clock.moved >= end else end
        return tuple(self._outcome(monitor, end, recorded) for monitor in self.monitors)

    def _outcome(self, monitor: Monitor, end: int, recorded: frozenset[str] | None) -> Outcome:
        outcome = monitor.finish(end)
        behaviour = {monitor.name(event) for event in monitor.property.pattern.behaviour}
        if recorded is None or behaviour & recorded:
            return outcome
        reason = f"the recording does not have {', '.join(sorted(behaviour))}"
        if outcome.verdict is Verdict.HELD:
            return replace(outcome, verdict=Verdict.NEVER_EXERCISED, reason=reason)
        is_missed = outcome.verdict is Verdict.VIOLATED  # by what nobody published, or nobody recorded
        return replace(outcome, reason=f"{outcome.reason}; {reason}") if is_missed else outcome
