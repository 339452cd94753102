# SPDX-License-Identifier: Apache-2.0
"""Signals that end a run: each becomes an exception, which unwinds all that is open, and an exit code of 128 + its number."""

from __future__ import annotations

import signal
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any

#: What a terminal, a runner, a supervisor or a user sends to end a process.
NAMES = ("SIGINT", "SIGTERM", "SIGHUP", "SIGQUIT")


class Interrupted(BaseException):
    """A signal has ended the run. Only the command itself catches it for good."""

    def __init__(self, number: int) -> None:
        super().__init__(number)
        self.number = number

    @property
    def code(self) -> int:
        """The exit code that shells give to a process that the signal has ended."""
        return 128 + self.number

    @property
    def name(self) -> str:
        """``SIGTERM``."""
        return signal.Signals(self.number).name


class _SignalState:
    """What the handler knows: *ending* is the signal that ends the run; while *held* it waits as *pending*."""

    ending = 0
    pending = 0
    held = 0


@contextmanager
def listening() -> Iterator[None]:
    """In here the signals of ``NAMES`` raise Interrupted in the main thread; in other threads nothing changes.

    The first signal counts. All further ones are ignored while the run is unwound, and afterwards, so that nothing is left half
    removed. A signal that was ignored before stays ignored (nohup), and one that somebody else handles stays theirs.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    _SignalState.ending = _SignalState.pending = _SignalState.held = 0
    before: list[tuple[int, Any]] = []
    for number in (getattr(signal, name) for name in NAMES if hasattr(signal, name)):
        if signal.getsignal(number) in (signal.SIG_DFL, signal.default_int_handler):
            before.append((number, signal.signal(number, _handle)))
    hook, sys.unraisablehook = sys.unraisablehook, _unraisable
    try:
        yield
    finally:
        for number, handler in before:  # an interpreter that ends would set those back that are not ignored
            signal.signal(number, signal.SIG_IGN if _SignalState.ending else handler)
        sys.unraisablehook = hook


def _handle(number: int, frame: FrameType | None) -> None:
    if _SignalState.ending:
        return
    if _SignalState.held:
        _SignalState.pending = _SignalState.pending or number
        return
    _SignalState.ending = number
    raise Interrupted(number)


def _unraisable(dropped: Any) -> None:
    """Where Python drops what is raised (in a finalizer, in a callback) the signal is sent once more, and comes a little later."""
    if not isinstance(dropped.exc_value, Interrupted):
        sys.__unraisablehook__(dropped)
    elif _SignalState.ending == dropped.exc_value.number:
        _SignalState.ending = 0
        again = threading.Timer(
            0.01, signal.raise_signal, (dropped.exc_value.number,)
        )  # not in here, where it would be dropped, too
        again.daemon = True
        again.start()


def release() -> None:
    """For a forked child: the signals end it at once, as it has nothing to put in order."""
    for number in (getattr(signal, name) for name in NAMES if hasattr(signal, name)):
        if signal.getsignal(number) is _handle:
            signal.signal(number, signal.SIG_DFL)


def listen_anew() -> None:
    """For a forked child that has something to put in order: a signal raises in it as it does in its parent, whatever that held back."""
    _SignalState.ending = _SignalState.pending = _SignalState.held = 0


@contextmanager
def held() -> Iterator[None]:
    """What is done in here is not torn: a signal that comes meanwhile is raised at the end."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    _SignalState.held += 1
    try:
        yield
    finally:
        _SignalState.held -= 1
        if _SignalState.pending and not _SignalState.held and not _SignalState.ending:
            _SignalState.ending, _SignalState.pending = _SignalState.pending, 0
            raise Interrupted(_SignalState.ending)
