# SPDX-License-Identifier: Apache-2.0
"""The search in a process of its own, which is ended where the solver keeps neither its time nor its memory: no text of a workspace makes it endless.

The child says of which claim it asks next, and for how long at most; the claim at which it had to be ended is undetermined, and another child goes
on with the rest. The solver is loaded in the child alone.
"""

from __future__ import annotations

import os
import pickle
import resource
import select
import signal
import threading
import time
from collections.abc import Iterator
from contextlib import suppress
from importlib.util import find_spec
from typing import Any

from haros_ci.errors import UserError
from haros_ci.interruption import held, release
from haros_ci.verification.outcomes import Finding, Result
from haros_ci.verification.problem import Problem

#: Bytes of a length.
WIDTH = 4
#: Seconds beyond its time that the solver has before it is ended; as many times as a question may take, and so many more.
FACTOR, GRACE = 2.0, 15.0
MEGABYTE = 1 << 20
TOO_LONG = "the solver did not keep its time"
ENDED = "the solver ended before an answer, perhaps for want of memory"


def demand_extra() -> None:
    """UserError if the solver is not installed."""
    if find_spec("z3") is None:
        raise UserError(
            "properties are verified with the package z3-solver, which is not installed",
            help="pip install 'haros-ci[verify]'",
        )


def verified(problem: Problem) -> Iterator[Finding]:
    """What is found out about each claim of *problem*, as it comes."""
    demand_extra()
    done: set[int] = set()
    while len(done) < len(problem.claims):
        before = len(done)
        for finding in _watched(problem, frozenset(done)):
            done.add(finding.number)
            yield finding
        if len(done) == before:  # nothing came, and nobody knows of which claim
            yield from (Finding(c.number, Result.UNDETERMINED, ENDED) for c in problem.claims if c.number not in done)
            return


def _watched(problem: Problem, passed: frozenset[int]) -> Iterator[Finding]:
    """What one child finds out; at last the claim at which it ended, or had to be ended."""
    child, pipe, life = _child(problem, passed)
    frames = _Frames(pipe)
    asked, ends = -1, time.monotonic() + problem.limits.budget * FACTOR + GRACE
    try:
        while (value := frames.next(ends)) is not None:
            if isinstance(value, Finding):
                yield value
                passed |= {value.number}
            else:
                asked, seconds = value
                ends = time.monotonic() + seconds * FACTOR + GRACE
    finally:
        with suppress(ProcessLookupError):
            os.kill(child, signal.SIGKILL)
        os.close(pipe)
        os.close(life)
        with suppress(ChildProcessError):
            os.waitpid(child, 0)
    if asked >= 0 and asked not in passed and not frames.is_whole:
        yield Finding(asked, Result.UNDETERMINED, TOO_LONG if time.monotonic() >= ends else ENDED)


class _Frames:
    """What a child writes into *pipe*; *is_whole* once it has said that nothing follows."""

    def __init__(self, pipe: int) -> None:
        self.pipe = pipe
        self.data = bytearray()
        self.is_whole = False

    def next(self, ends: float) -> Any:
        """The next value; None if there is none in time."""
        while len(self.data) < WIDTH or len(self.data) < WIDTH + self._size():
            ready, _, _ = select.select([self.pipe], [], [], max(0.0, ends - time.monotonic()))
            more = os.read(self.pipe, 1 << 16) if ready else b""
            if not more:
                return None
            self.data += more
        size = self._size()
        value = pickle.loads(bytes(self.data[WIDTH : WIDTH + size]))
        del self.data[: WIDTH + size]
        self.is_whole = value is None
        return value

    def _size(self) -> int:
        return int.from_bytes(self.data[:WIDTH], "big")


def _child(problem: Problem, passed: frozenset[int]) -> tuple[int, int, int]:
    """A process that searches; its number, where what it says can be read, and what it lives by: it ends when that is closed."""
    reading, writing = os.pipe()
    dies, life = os.pipe()
    with held():
        child = os.fork()
    if child:
        os.close(writing)
        os.close(dies)
        return child, reading, life
    try:
        release()
        os.close(life)
        os.close(reading)
        threading.Thread(target=_die_with_parent, args=(dies,), daemon=True).start()
        _search(problem, passed, writing)
    finally:
        os._exit(1)  # nothing of the parent's is flushed, closed or raised here


def _die_with_parent(life: int) -> None:
    with suppress(OSError):
        os.read(life, 1)
    os._exit(1)


def _search(problem: Problem, passed: frozenset[int], pipe: int) -> None:
    """Search, and write what is found, and what is asked, into *pipe*."""

    def say(value: Any) -> None:
        data = pickle.dumps(value, pickle.HIGHEST_PROTOCOL)
        view = memoryview(len(data).to_bytes(WIDTH, "big") + data)
        while view:
            view = view[os.write(pipe, view) :]

    import z3

    from haros_ci.verification.search import findings

    memory = problem.limits.memory
    z3.set_param("memory_max_size", memory)
    resource.setrlimit(resource.RLIMIT_AS, (_used() + 2 * memory * MEGABYTE,) * 2)
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    for finding in findings(problem, lambda number, seconds: say((number, seconds)), passed.__contains__):
        say(finding)
    say(None)


def _used() -> int:
    """The bytes of memory that are addressed so far (Linux); else some."""
    try:
        with open("/proc/self/statm", encoding="ascii") as file:
            return int(file.read().split()[0]) * resource.getpagesize()
    except (OSError, ValueError):
        return 4096 * MEGABYTE
