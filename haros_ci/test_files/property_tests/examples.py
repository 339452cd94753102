# SPDX-License-Identifier: Apache-2.0
"""Examples: a plan is carried out, the monitors of a property and of its assumptions watch, and a failure is confirmed before it counts."""

from __future__ import annotations

import json
import threading
import time
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

from haros_ci.test_files.property_tests.messages import stamped
from haros_ci.test_files.property_tests.plans import Step

SECOND = 1_000_000_000
#: Seconds after which nothing is waited for any more, whatever a monitor says.
LONGEST = 60.0
#: Seconds without a message after which the next example may begin, and how long that is waited for.
QUIET, LONGEST_QUIET = 0.02, 0.25

HELD, VIOLATED, DIED, DISCARDED = "held", "violated", "died", "discarded"


class Claim(NamedTuple):
    """A property with the class of its monitor. *text* has the names of the running system; *hold* is how long, in seconds, an example goes on
    after its last message."""

    title: str
    text: str
    monitor: Callable[[], Any]
    hold: float = 0.1
    where: str = ""
    configuration: str = ""


class Entry(NamedTuple):
    """A message of an example: its time in nanoseconds from the begin, and whether the test has *sent* it."""

    time: int
    topic: str
    message: Any
    sent: bool


class Outcome(NamedTuple):
    """What an example has shown: ``held``, ``violated``, ``died`` (a process ended), or ``discarded`` (an assumption does not hold)."""

    status: str
    reason: str
    trace: Sequence[Entry]
    length: int
    exercised: bool

    @property
    def fails(self) -> bool:
        return self.status in (VIOLATED, DIED)


class Example:
    """One plan, carried out once. Messages of the system come by ``take`` from other threads."""

    def __init__(self, claim: Claim, assumptions: Sequence[Claim], ended: Callable[[], list[str]]) -> None:
        self.monitor = claim.monitor()
        self.hold = claim.hold
        self.assumed = [(assumption, assumption.monitor()) for assumption in assumptions]
        self.ended = ended
        self.changed = threading.Condition()
        self.entries: list[Entry] = []
        self.broken = ""
        self.over = False
        self.began = self.clock()
        self.length = 0
        for monitor in (self.monitor, *(monitor for _, monitor in self.assumed)):
            monitor.start(0)

    #: Nanoseconds of a clock that only goes on.
    clock = staticmethod(time.monotonic_ns)

    def rest(self, seconds: float) -> None:
        """Wait for so long, or until a message comes."""
        self.changed.wait(seconds)

    def now(self) -> int:
        """Nanoseconds since the begin."""
        return self.clock() - self.began

    def take(self, topic: str, message: Any, sent: bool = False) -> None:
        """A message that the system has published, or that the test is about to."""
        with self.changed:
            if self.over:
                return
            at = self.now()
            self.entries.append(Entry(at, topic, message, sent))
            number = len(self.entries)
            for title, monitor in (
                ("", self.monitor),
                *((assumption.title, monitor) for assumption, monitor in self.assumed),
            ):
                if topic in monitor.roles:
                    monitor.on_message(topic, message, at, number)
                if title and monitor.violation is not None and not self.broken:
                    self.broken = title
            self.changed.notify_all()

    @property
    def decided(self) -> bool:
        return bool(self.monitor.violation is not None or self.broken)

    def run(self, plan: Sequence[Step], send: Callable[[str, Any], None]) -> Outcome:
        """Carry out *plan* and say what it has shown."""
        for step in plan:
            if step.settled:
                self._settle()
            if not self._pass(step.after):
                break
            if step.topic is not None:
                message = stamped(step.message, time.time_ns())
                self.take(step.topic, message, sent=True)
                send(step.topic, message)
        self._settle()
        self._pass(self.hold)
        return self._finish()

    def _settle(self) -> None:
        """Wait until the monitor waits for nothing any more."""
        until = self.now() + int(LONGEST * SECOND)
        with self.changed:
            while not self.decided and self.now() < until:
                deadline = self.monitor.deadline()
                if deadline is None:
                    return
                self._wait(deadline - self.now())

    def _pass(self, seconds: float) -> bool:
        """Let so much time pass; False as soon as the example is decided."""
        until = self.now() + int(seconds * SECOND)
        with self.changed:
            while not self.decided and self.now() < until:
                deadline = self.monitor.deadline()
                self._wait(min(until, until if deadline is None else deadline) - self.now())
            return not self.decided

    def _wait(self, nanoseconds: int) -> None:
        """Wait for messages, or for this long; then tell the monitor what time it is."""
        if nanoseconds > 0:
            self.rest(nanoseconds / SECOND)
        self.monitor.on_timer(self.now())

    def _finish(self) -> Outcome:
        dead = self.ended()
        with self.changed:
            self.over = True
            self.length = self.now()
            verdict, reason = self.monitor.finish(self.length, {entry.topic for entry in self.entries})
            status = HELD
            if self.broken:
                status, reason = DISCARDED, self.broken
            elif self.monitor.violation is not None:
                status = VIOLATED
            elif dead:
                status, reason = DIED, "; ".join(dead)
            return Outcome(status, reason, self.entries, self.length, verdict in ("held", "violated"))


#: Topics of the lines that say when an example began and ended; nothing is ever sent on them.
BEGIN, END = "/property_tests/begin", "/property_tests/end"


def lines(outcome: Outcome) -> str:
    """A trace as ``haros-ci monitor --jsonl`` reads it: times in seconds from the begin of the example."""
    entries = [Entry(0, BEGIN, {}, False), *outcome.trace, Entry(outcome.length, END, {}, False)]
    return "".join(f"{_line(entry)}\n" for entry in entries)


def _line(entry: Entry) -> str:
    seconds, rest = divmod(entry.time, SECOND)
    message = json.dumps(entry.message, sort_keys=True)
    return f'{{"topic": {json.dumps(entry.topic)}, "time": {seconds}.{rest:09d}, "msg": {message}}}'


def shown(outcome: Outcome, most: int = 40) -> str:
    """A trace to read: what was sent, and what came."""
    made = [
        f"  {entry.time / SECOND:+8.3f} s  {'sent    ' if entry.sent else 'received'}  {entry.topic}  {_short(entry.message)}"
        for entry in outcome.trace[:most]
    ]
    more = len(outcome.trace) - most
    return "\n".join([*made, *([f"  and {more} more"] if more > 0 else [])])


def _short(message: Any) -> str:
    text = json.dumps(message, sort_keys=True)
    return text if len(text) <= 200 else f"{text[:199]}…"


def quiet(last: Callable[[], float]) -> None:
    """Wait until for a moment no message has come; *last* is when the last one did."""
    until = time.monotonic() + LONGEST_QUIET
    while time.monotonic() < until:
        rest = last() + QUIET - time.monotonic()
        if rest <= 0:
            return
        time.sleep(rest)
