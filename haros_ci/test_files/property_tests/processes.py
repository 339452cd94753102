# SPDX-License-Identifier: Apache-2.0
"""Processes that are started for tests, and that none of which is left: after Ctrl-C, a failure, or when this process is killed.

Every process leads a group of its own, and a keeper ends the groups that are left once the pipe from this process closes, however it ended.
"""

from __future__ import annotations

import atexit
import contextlib
import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Mapping, Sequence

#: Seconds that a process has to end after SIGINT, and after SIGTERM.
GENTLE, FIRM = 1.0, 1.0

#: The keeper: it reads "+group" and "-group", and ends those that are left at the end of its input.
_KEEPER = """
import os, signal, sys
signal.signal(signal.SIGINT, signal.SIG_IGN)
signal.signal(signal.SIGTERM, signal.SIG_IGN)
signal.signal(signal.SIGHUP, signal.SIG_IGN)
left = set()
for line in sys.stdin:
    (left.add if line[0] == "+" else left.discard)(int(line[1:]))
for group in left:
    try:
        os.killpg(group, signal.SIGKILL)
    except OSError:
        pass
"""


class Processes:
    """Process groups that this process has started."""

    def __init__(self, gentle: float = GENTLE, firm: float = FIRM) -> None:
        self.gentle, self.firm = gentle, firm
        self.running: dict[str, subprocess.Popen[bytes]] = {}
        self._keeper: subprocess.Popen[bytes] | None = None
        self._lock = threading.RLock()

    def start(
        self, name: str, command: Sequence[str], env: Mapping[str, str], output: str | None
    ) -> subprocess.Popen[bytes]:
        """Start *command* as the leader of a group of its own; what it prints is added to the file *output*, or comes out here (None)."""
        with self._lock, contextlib.ExitStack() as open_files:
            keeper = self._kept()
            log = None if output is None else open_files.enter_context(open(output, "ab"))
            errors = None if log is None else subprocess.STDOUT
            process = subprocess.Popen(
                list(command),
                env=dict(env),
                stdin=subprocess.DEVNULL,
                stdout=log,
                stderr=errors,
                start_new_session=True,
            )
            self.running[name] = process
            _say(keeper, f"+{process.pid}\n")
            return process

    def _kept(self) -> subprocess.Popen[bytes]:
        if self._keeper is None:
            self._keeper = subprocess.Popen(
                [sys.executable, "-S", "-E", "-c", _KEEPER], stdin=subprocess.PIPE, start_new_session=True
            )
            atexit.register(self.end_all)
            _end_on_sigterm()
        return self._keeper

    def ended(self) -> list[str]:
        """The processes that have ended by themselves, each with how."""
        found = {name: _code(process) for name, process in self.running.items()}
        return [f"{name} ended with {_how(code)}" for name, code in found.items() if code is not None]

    def end(self, names: Sequence[str]) -> None:
        """End these: SIGINT, as roslaunch does, then SIGTERM, then SIGKILL, always for the whole group."""
        with self._lock:
            here = [(name, self.running[name]) for name in names if name in self.running]
            for number, seconds in (
                (signal.SIGINT, self.gentle),
                (signal.SIGTERM, self.firm),
                (signal.SIGKILL, self.firm),
            ):
                waiting = [process for _, process in here if _code(process) is None]
                for process in waiting:
                    _signal(process.pid, number)
                _wait(waiting, seconds)
            for name, process in here:
                _signal(process.pid, signal.SIGKILL)  # what its leader has left behind
                process.wait()
                if self._keeper is not None:
                    _say(self._keeper, f"-{process.pid}\n")
                del self.running[name]

    def end_all(self) -> None:
        """End every process, the last one started first."""
        with self._lock:
            for name in reversed(list(self.running)):
                self.end([name])
            if self._keeper is not None and self._keeper.stdin is not None:
                self._keeper.stdin.close()
                self._keeper.wait(FIRM)
                self._keeper = None


def _say(keeper: subprocess.Popen[bytes], line: str) -> None:
    assert keeper.stdin is not None
    try:
        keeper.stdin.write(line.encode())
        keeper.stdin.flush()
    except OSError:  # the keeper is gone; what is started is still ended here
        pass


def _signal(group: int, number: int) -> None:
    try:
        os.killpg(group, number)
    except OSError:
        pass


def _wait(processes: Sequence[subprocess.Popen[bytes]], seconds: float) -> None:
    until = time.monotonic() + seconds
    while any(_code(process) is None for process in processes) and time.monotonic() < until:
        time.sleep(0.005)


def _code(process: subprocess.Popen[bytes]) -> int | None:
    """How *process* has ended, None if it runs. It is left as it is: until it is waited for, nothing else gets its number."""
    if process.returncode is not None:
        return process.returncode
    found = os.waitid(os.P_PID, process.pid, os.WEXITED | os.WNOHANG | os.WNOWAIT)
    if found is None:
        return None
    return found.si_status if found.si_code == os.CLD_EXITED else -found.si_status


def _how(code: int) -> str:
    if code >= 0:
        return f"exit code {code}"
    try:
        return f"signal {signal.Signals(-code).name}"
    except ValueError:
        return f"signal {-code}"


def _end_on_sigterm() -> None:
    """SIGTERM ends Python without atexit, unless somebody handles it."""
    if threading.current_thread() is threading.main_thread() and signal.getsignal(signal.SIGTERM) is signal.SIG_DFL:
        signal.signal(signal.SIGTERM, lambda number, frame: sys.exit(128 + number))
