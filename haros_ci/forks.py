# SPDX-License-Identifier: Apache-2.0
"""Work that needs much memory in common, shared out to forked processes: what they find comes back pickled.

Where a process cannot be forked safely (other systems than Linux, other threads), and for what a process did not bring
back, the work is done here.
"""

from __future__ import annotations

import os
import pickle
import signal
import sys
import threading
import time
from collections.abc import Callable, Hashable, Iterator, Sequence
from contextlib import contextmanager, suppress
from functools import partial
from typing import Any, BinaryIO, TypeVar

from haros_ci.interruption import held, listen_anew, release

T = TypeVar("T")
#: A place in the queue as bytes: so few are read from a pipe at once or not at all (pipe(7)).
WIDTH = 4
#: Seconds that a process gets to put in order what it has begun.
PATIENCE = 5.0
#: Groups that fit into a pipe that nobody reads from yet.
LONGEST = 60_000 // WIDTH


def shared(
    jobs: Sequence[Callable[[], T]], groups: Sequence[Hashable], processes: int, here: Hashable = None
) -> list[T]:
    """What each of *jobs* returns, in their order, found by up to *processes* processes.

    Jobs of the same of the *groups* (as many as jobs) are done by one process, in their order. The groups are begun in
    the order of their first jobs. What the jobs return must be picklable; what they change is lost, but for those of the group *here*, which
    this process does, and first.
    """
    together: dict[Hashable, list[int]] = {}
    for number, group in enumerate(groups):
        together.setdefault(group, []).append(number)
    batches = list(together.values())
    found: dict[int, T] = {}
    count = min(processes, len(batches))
    if count > 1 and len(batches) <= LONGEST and _can_fork():
        found = _forked(jobs, batches, count, together.get(here, []))
    return [found[number] if number in found else job() for number, job in enumerate(jobs)]


@contextmanager
def meanwhile(job: Callable[[], T]) -> Iterator[Callable[[], T | None]]:
    """While the block goes on, another process does *job*; what is given waits for it, and returns what it has found.

    None, at once, where there is no such process, and if it did not come to its end. One that is still there when the block ends, ends with it, and puts in
    order what it has begun, as it does when a signal ends the run.
    """
    life = os.pipe()
    child: tuple[int, BinaryIO] | None = None

    def found() -> T | None:
        nonlocal child
        if child is None:
            return None
        (number, pipe), child = child, None
        result: T | None = _result_of(number, pipe)
        return result

    try:
        with suppress(OSError), held():
            child = _child(job, life, listen_anew) if _can_fork() else None
        yield found
    finally:
        if child is not None:
            _ask_to_end(child[0])
            _end([child])
        for end in life:
            os.close(end)


def _can_fork() -> bool:
    return sys.platform == "linux" and threading.active_count() == 1


def _ask_to_end(child: int) -> None:
    """Send it a signal, and wait for a while; whether it has ended is not said, and it is not collected."""
    deadline = time.monotonic() + PATIENCE
    with suppress(ProcessLookupError, ChildProcessError):
        os.kill(child, signal.SIGTERM)
        while time.monotonic() < deadline:
            if os.waitid(os.P_PID, child, os.WEXITED | os.WNOHANG | os.WNOWAIT) is not None:
                return
            time.sleep(0.005)


def _end(children: list[tuple[int, BinaryIO]]) -> None:
    """Kill all that are left, and wait for them."""
    for child, _ in children:
        with suppress(ProcessLookupError):
            os.kill(child, signal.SIGKILL)
    for child, pipe in children:
        pipe.close()
        with suppress(ChildProcessError):
            os.waitpid(child, 0)


def _forked(jobs: Sequence[Callable[[], T]], batches: list[list[int]], count: int, own: list[int]) -> dict[int, T]:
    queue, tail = os.pipe()
    queued = [number for number, batch in enumerate(batches) if batch is not own]
    os.write(tail, b"".join(number.to_bytes(WIDTH, "big") for number in queued))
    os.close(tail)
    life = os.pipe()
    children: list[tuple[int, BinaryIO]] = []
    try:
        for _ in range(count - 1):
            with suppress(OSError), held():  # no more processes: those that are there do the work
                children.append(_child(partial(_all_done, jobs, batches, queue), life))
        found = {number: jobs[number]() for number in own}
        found.update(_done(jobs, batches, queue))
        brought = [_result_of(child, pipe) for child, pipe in children]
    except BaseException:
        _end(children)
        raise
    finally:
        for other_number in (queue, *life):
            os.close(other_number)
    for more in brought:
        found.update(more or {})
    return found


def _child(work: Callable[[], Any], life: tuple[int, int], begin: Callable[[], None] = release) -> tuple[int, BinaryIO]:
    """A process that does *work*; its number, and where what it finds can be read. *begin* says what signals do in it."""
    reading, writing = os.pipe()
    try:
        child = os.fork()
    except OSError:
        os.close(reading)
        os.close(writing)
        raise
    if child:
        os.close(writing)
        return child, open(reading, "rb")
    code = 1
    try:
        begin()
        os.close(life[1])
        threading.Thread(target=_die_with_parent, args=(life[0],), daemon=True).start()
        os.close(reading)
        data = pickle.dumps(work(), pickle.HIGHEST_PROTOCOL)
        with open(writing, "wb") as stream:
            stream.write(data)
        code = 0
    finally:
        os._exit(code)  # nothing of the parent's is flushed, closed or raised here


def _die_with_parent(life: int) -> None:
    """Nobody writes into this pipe, and the parent alone holds its other end: it is at its end when the parent is gone, killed or not."""
    with suppress(OSError):
        os.read(life, 1)
    os._exit(1)


def _done(jobs: Sequence[Callable[[], T]], batches: list[list[int]], queue: int) -> Iterator[tuple[int, T]]:
    while place := os.read(queue, WIDTH):
        for number in batches[int.from_bytes(place, "big")]:
            yield number, jobs[number]()


def _all_done(jobs: Sequence[Callable[[], T]], batches: list[list[int]], queue: int) -> dict[int, T]:
    return dict(_done(jobs, batches, queue))


def _result_of(child: int, pipe: BinaryIO) -> Any:
    """What a process has found; None if it did not come to its end, or if what it found cannot be carried over."""
    with pipe:
        data = pipe.read()
    _, status = os.waitpid(child, 0)
    if status != 0:
        return None
    try:
        return pickle.loads(data)
    except Exception:
        return None  # it is found anew in this process
