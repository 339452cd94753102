# SPDX-License-Identifier: Apache-2.0
"""A limit on the processor time of checks: what a workspace makes one of them do must not stall the run."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

#: Seconds of the processor that one check may take, in all systems together, with the call graph and the base revision that it asks for;
#: half of it for the others once one has been ended, and so on.
MOST = 200.0


class Overrun(BaseException):
    """A check has taken too long. What catches the exceptions of a check's own lets it pass."""


class Patience:
    """What is left of the time of each of several checks."""

    def __init__(self) -> None:
        self.most = MOST
        self._taken: dict[str, float] = {}
        self._ended: set[str] = set()

    def has_ended(self, name: str) -> bool:
        """Whether the check called *name* has been ended."""
        return name in self._ended

    @contextmanager
    def with_(self, name: str) -> Iterator[None]:
        """In here Overrun is raised when the time of the check called *name* is up.

        Only the main thread can be ended so, on a system with interval timers, and where nobody else uses the one that is used here.
        """
        if not _can_be_ended():
            yield
            return
        is_inside, limit = True, max(self.most - self._taken.get(name, 0.0), 0.001)

        def expire(number: int, frame: FrameType | None) -> None:
            if is_inside:
                raise Overrun

        before = signal.signal(signal.SIGPROF, expire)
        signal.setitimer(signal.ITIMER_PROF, limit, 1.0)  # again each second, should something have caught it
        try:
            yield
        except Overrun:
            self._ended.add(name)
            self.most /= 2
            raise
        finally:
            is_inside = False
            left, _ = signal.setitimer(signal.ITIMER_PROF, 0)
            signal.signal(signal.SIGPROF, before)
            self._taken[name] = self._taken.get(name, 0.0) + max(limit - left, 0.0)


def _can_be_ended() -> bool:
    if not hasattr(signal, "ITIMER_PROF") or threading.current_thread() is not threading.main_thread():
        return False
    return signal.getsignal(signal.SIGPROF) is signal.SIG_DFL and signal.getitimer(signal.ITIMER_PROF)[0] == 0
