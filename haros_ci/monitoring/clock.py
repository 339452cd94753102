# SPDX-License-Identifier: Apache-2.0
"""Times that only go on, of times that jump back; and messages in the order of their header stamps."""

from __future__ import annotations

import heapq
from collections.abc import Iterator
from typing import Any

from haros_ci.records import dataclass

SECOND = 1_000_000_000
#: A step back that is smaller is noise between senders: the message counts as one of the time before. Any other is one of a clock that was
#: set back: the time between the two messages is not known and counts as none, and the times behind are moved.
GREATEST_NOISE = SECOND
#: Messages wait for others with earlier stamps as far as these are less than this apart, and so many of them.
LONGEST_WAIT, MOST_WAITING = SECOND, 2_000


class Clock:
    """Makes times that do not decrease. *noise* and *jumps* count the small and the great steps back, *first_jump* is the message of the first one."""

    def __init__(self) -> None:
        self.last: int | None = None
        self.moved = 0
        self.noise = 0
        self.jumps = 0
        self.first_jump = 0

    def at(self, time: int, number: int) -> int:
        """The time of the *number*-th message, in nanoseconds."""
        time += self.moved
        last = self.last
        if last is not None and time < last:
            if last - time >= GREATEST_NOISE:
                self.jumps += 1
                self.first_jump = self.first_jump or number
                self.moved += last - time
            else:
                self.noise += 1
            return last
        self.last = time
        return time


@dataclass(slots=True)
class Timed:
    """A message of a recording: its *number* from 1, its log *time* in nanoseconds, and the message itself."""

    number: int
    topic: str
    time: int
    message: Any


class Stamped:
    """Messages in the order of their header stamps, as far as they come within the wait."""

    def __init__(self) -> None:
        self.waiting: list[tuple[int, int, Timed]] = []

    def put(self, timed: Timed, stamp: int) -> Iterator[Timed]:
        """Take a message; what no longer waits is given back, with its stamp as its time."""
        timed.time = stamp
        heapq.heappush(self.waiting, (stamp, timed.number, timed))
        while len(self.waiting) > MOST_WAITING or stamp - self.waiting[0][0] >= LONGEST_WAIT:
            yield heapq.heappop(self.waiting)[2]

    def rest(self) -> Iterator[Timed]:
        """Those that still wait."""
        while self.waiting:
            yield heapq.heappop(self.waiting)[2]


def stamp_of(message: Any) -> int | None:
    """The header stamp of a message in nanoseconds (``sec`` and ``nanosec``, in ROS 1 also ``secs`` and ``nsecs``); None without one, or if it is zero."""
    header = _part(message, "header")
    stamp = _part(header, "stamp")
    for seconds, rest in (("sec", "nanosec"), ("secs", "nsecs")):
        first, second = _part(stamp, seconds), _part(stamp, rest)
        if _is_count(first) and _is_count(second):
            return (first * SECOND + second) or None
    return None


def _part(message: Any, name: str) -> Any:
    return message.get(name) if isinstance(message, dict) else getattr(message, name, None)


def _is_count(value: Any) -> bool:
    return isinstance(value, int) and 0 <= value < 1 << 40
