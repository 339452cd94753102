# SPDX-License-Identifier: Apache-2.0
"""Work that needs much memory in common, shared out to forked processes: what they find comes back pickled.

Where a process cannot be forked safely (other systems than Linux, other threads), and for what a process did not bring
back, the work is done here.
"""

from __future__ import annotations

import os
import pickle
import sys
import threading
from collections.abc import Callable, Hashable, Iterator, Sequence
from contextlib import suppress
from typing import Any, TypeVar

T = TypeVar("T")
#: A place in the queue as bytes: so few are read from a pipe at once or not at all (pipe(7)).
WIDTH = 4
#: Groups that fit into a pipe that nobody reads from yet.
LONGEST = 60_000 // WIDTH


def shared(jobs: Sequence[Callable[[], T]], groups: Sequence[Hashable], processes: int) -> list[T]:
    """What each of *jobs* returns, in their order, found by up to *processes* processes.

    Jobs of the same of the *groups* (as many as jobs) are done by one process, in their order. The groups are begun in
    the order of their first jobs. What the jobs return must be picklable; what they change is lost.
    """
    together: dict[Hashable, list[int]] = {}
    for number, group in enumerate(groups):
        together.setdefault(group, []).append(number)
    batches = list(together.values())
    found: dict[int, T] = {}
    count = min(processes, len(batches))
    if count > 1 and len(batches) <= LONGEST and sys.platform == "linux" and threading.active_count() == 1:
        found = _forked(jobs, batches, count)
    return [found[number] if number in found else job() for number, job in enumerate(jobs)]


def _forked(jobs: Sequence[Callable[[], T]], batches: list[list[int]], count: int) -> dict[int, T]:
    queue, tail = os.pipe()
    os.write(tail, b"".join(number.to_bytes(WIDTH, "big") for number in range(len(batches))))
    os.close(tail)
    children: list[tuple[int, int]] = []
    try:
        for _ in range(count - 1):
            with suppress(OSError):  # no more processes: those that are there do the work
                children.append(_child(jobs, batches, queue))
        found = dict(_done(jobs, batches, queue))
    finally:
        os.close(queue)
        brought = [_brought(child, pipe) for child, pipe in children]
    for each in brought:
        found.update(each)
    return found


def _child(jobs: Sequence[Callable[[], Any]], batches: list[list[int]], queue: int) -> tuple[int, int]:
    """A process that works through the queue; its number, and where what it finds can be read."""
    reading, writing = os.pipe()
    try:
        child = os.fork()
    except OSError:
        os.close(reading)
        os.close(writing)
        raise
    if child:
        os.close(writing)
        return child, reading
    code = 1
    try:
        os.close(reading)
        data = pickle.dumps(dict(_done(jobs, batches, queue)), pickle.HIGHEST_PROTOCOL)
        with open(writing, "wb") as stream:
            stream.write(data)
        code = 0
    finally:
        os._exit(code)  # nothing of the parent's is flushed, closed or raised here


def _done(jobs: Sequence[Callable[[], T]], batches: list[list[int]], queue: int) -> Iterator[tuple[int, T]]:
    while place := os.read(queue, WIDTH):
        for number in batches[int.from_bytes(place, "big")]:
            yield number, jobs[number]()


def _brought(child: int, pipe: int) -> dict[int, Any]:
    """What a process has found; nothing if it did not come to its end."""
    with open(pipe, "rb") as stream:
        data = stream.read()
    _, status = os.waitpid(child, 0)
    if status != 0:
        return {}
    found: dict[int, Any] = pickle.loads(data)
    return found
