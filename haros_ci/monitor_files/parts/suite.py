# SPDX-License-Identifier: Apache-2.0
"""All properties of a file, and what is said of them."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Mapping
from typing import Any

from haros_ci.monitor_files.parts.monitors import SECOND, VIOLATED, Property

#: A step back of the clock that is smaller is noise between senders, any other a clock that was set back: no time counts as passed.
GREATEST_NOISE = SECOND


class Clock:
    """Makes times that do not decrease: after a great step back later times are moved."""

    def __init__(self) -> None:
        self.last: int | None = None
        self.moved = self.noise = self.jumps = 0

    def at(self, time: int) -> int:
        """The time that counts, in nanoseconds."""
        time += self.moved
        last = self.last
        if last is not None and time < last:
            if last - time >= GREATEST_NOISE:
                self.jumps += 1
                self.moved += last - time
            else:
                self.noise += 1
            return last
        self.last = time
        return time


class Monitors:
    """Gives each message to the properties that it concerns. Times are nanoseconds of one clock, from ``start`` on.

    ``on_message`` and ``on_timer`` return the properties that are violated since the last call; ``on_timer`` is to be called at ``deadline()``.
    """

    def __init__(self, classes: Iterable[type[Property]]) -> None:
        self.properties = [kind() for kind in classes]
        self.ears: dict[str, list[Property]] = {}
        for one in self.properties:
            for topic in one.roles:
                self.ears.setdefault(topic, []).append(one)
        #: How many messages came on each topic.
        self.counts = dict.fromkeys(sorted(self.ears), 0)
        self.clock = Clock()
        self.began: int | None = None
        #: The number of the last message, and the last time.
        self.number = 0
        self.last = 0
        self.told: set[int] = set()

    def start(self, time: int) -> None:
        """The monitor begins."""
        if self.began is None:
            self.last = time
            self.began = self.clock.at(time)
            for one in self.properties:
                one.start(self.began)

    def on_message(self, topic: str, message: Any, time: int) -> list[Property]:
        """A message; those on other topics are numbered and passed over."""
        self.start(time)
        self.last = time
        self.number += 1
        at = self.clock.at(time)
        if topic not in self.ears:
            return []
        self.counts[topic] += 1
        for one in self.ears[topic]:
            one.on_message(topic, message, at, self.number)
        return self.news()

    def on_unreadable(self, topic: str, reason: str, time: int) -> list[Property]:
        """A message of which nothing can be had: it came, which is enough where nothing is asked of it."""
        for one in self.ears.get(topic, ()):
            if not one.is_blind(topic):
                one.leave(reason)
        return self.on_message(topic, None, time)

    def on_timer(self, time: int) -> list[Property]:
        """No message up to *time*."""
        self.start(time)
        self.last = time
        at = self.clock.at(time)
        for one in self.properties:
            one.on_timer(at)
        return self.news()

    def deadline(self) -> int | None:
        """When time alone can violate a property, None if only a message can."""
        due = [time for one in self.properties for time in (one.deadline(),) if time is not None]
        return min(due) - self.clock.moved if due else None

    def news(self) -> list[Property]:
        """The properties that are violated, once each."""
        found = [one for one in self.properties if one.violation is not None and id(one) not in self.told]
        self.told.update(map(id, found))
        return found

    @property
    def has_violation(self) -> bool:
        return any(one.violation is not None for one in self.properties)

    def finish(self, time: int | None = None) -> list[dict[str, Any]]:
        """The verdicts at the end, *time* or the last time, as the report has them."""
        self.start(self.last if time is None else time)
        at = self.clock.at(self.last if time is None else time)
        came = {topic for topic, count in self.counts.items() if count}
        return [described(one, *one.finish(at, came)) for one in self.properties]


def described(one: Property, verdict: str, reason: str) -> dict[str, Any]:
    """What is known of a property, as ``haros-ci monitor --output json`` writes it."""
    path, line, column = one.place or (None, None, None)
    found = one.violation or {}
    note = (
        f"{one.faults} times a message had not what a predicate asks for, first on {one.faulty_topic}; it is false then"
    )
    return {
        "id": one.title,
        "text": one.text,
        "owner": one.owner,
        "node": one.node or None,
        "axiom": one.is_axiom,
        "path": path,
        "line": line,
        "column": column,
        "verdict": verdict,
        "reason": reason or None,
        "time": found["time"] / SECOND if found and verdict == VIOLATED else None,
        "witnesses": found.get("witnesses", []) if verdict == VIOLATED else [],
        "scopes": one.scopes,
        "triggers": one.triggers,
        "behaviours": one.behaviours,
        "faults": one.faults,
        "warning": note if one.faults else None,
    }


def as_json(value: Any, indent: int | None = None) -> str:
    """JSON, in which infinite numbers are texts."""
    return json.dumps(finite(value), indent=indent)


def finite(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {str(key): finite(entry) for key, entry in value.items()}
    if isinstance(value, (list, tuple)):
        return [finite(entry) for entry in value]
    return str(value) if isinstance(value, float) and not math.isfinite(value) else value
