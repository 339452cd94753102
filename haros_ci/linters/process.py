# SPDX-License-Identifier: Apache-2.0
"""Running one process: no shell, a sandbox, its own process group, a time limit, a cap on what it writes.

It does not outlive us, however we end.
"""

from __future__ import annotations

import os
import re
import signal
import subprocess
import threading
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

from haros_ci.interruption import held
from haros_ci.linters import sandbox
from haros_ci.linters.linter import Command, Output
from haros_ci.linters.sandbox import Confinement

#: Bytes read of stdout and of stderr each; also the largest file that a tool may write.
OUTPUT_LIMIT = 64_000_000
#: Bytes of memory that a process can write to; far above what any tool needs, below what would take the machine down. Address
#: space would not do: programs in Haskell, Java or JavaScript reserve terabytes of it and use little.
MEMORY_LIMIT = 4_000_000_000

#: Seconds that a tool which writes what it is at may stay with one file, or one configuration of it.
STALL = 60.0
#: By how much that is divided once it has stayed so long with one, two and more of its files: all of a hostile set together cost little more than the first.
_IMPATIENCE = (1, 3, 6, 12)

#: Seconds that one tool may lose in processes that were ended before they were done; whatever of it is left then is not started.
LOST = 900.0

_LIMITING = threading.Lock()


class TimedOut(Exception):
    """The process was killed when its time was up."""


class Stalled(TimedOut):
    """The process was killed because it did not get on with the file *at*."""

    def __init__(self, at: str, seconds: float) -> None:
        super().__init__(at)
        self.at, self.seconds = at, seconds


class Unstartable(Exception):
    """The program could not be started at all."""


class Processes:
    """Starts processes and, when the run is abandoned, ends those that still live."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._alive: set[subprocess.Popen[bytes]] = set()
        self._stopped = False
        self._stalls: dict[str, int] = {}
        self._lost: dict[str, float] = {}

    @property
    def is_stopped(self) -> bool:
        """Whether the run is abandoned: nothing needs what a process has said."""
        return self._stopped

    def run(
        self,
        command: Command,
        *,
        root: Path,
        scratch: Path,
        timeout: float,
        confinement: Confinement | None = None,
        tool: str = "",
    ) -> Output:
        """What *command* left behind. Raises TimedOut (Stalled if it is known at which file), Unstartable; the latter, too, once the *tool* has lost LOST seconds.

        The more files the *tool* has stalled at in other processes, the sooner it is taken to do so. With *confinement* it can open nothing else, as far as this machine can see to that. Both streams go to files in *scratch*: neither a full pipe nor an orphan that holds one open can then hang us.
        """
        if self._lost.get(tool, 0.0) >= LOST:
            raise Unstartable(f"it has been stopped for {LOST:g} s in all")
        scratch.mkdir(parents=True, exist_ok=True)
        streams = [scratch / name for name in (".stdin", ".stdout", ".stderr")]
        streams[0].write_bytes(command.stdin)
        with open(streams[0], "rb") as stdin, open(streams[1], "wb") as stdout, open(streams[2], "wb") as stderr:
            files = (stdin.fileno(), stdout.fileno(), stderr.fileno())
            process, lifeline = self._start(command, root, scratch, files, confinement)
        began = time.monotonic()
        limit(process.pid, timeout)
        expired = threading.Event()

        def expire() -> None:
            expired.set()
            kill_group(process)

        timer = threading.Timer(timeout, expire)
        timer.start()
        ended, stalled = threading.Event(), threading.Event()
        patience = STALL / _IMPATIENCE[min(self._stalls.get(tool, 0), len(_IMPATIENCE) - 1)]
        if command.progress is not None and patience < timeout:
            watch = (streams[1], command.progress, patience, ended, stalled, lambda: kill_group(process))
            threading.Thread(target=_watch, args=watch, daemon=True).start()
        try:
            code, seconds = _wait(process)
        except BaseException:
            kill_group(process)
            process.wait()
            raise
        finally:
            ended.set()
            timer.cancel()
            with self._lock:
                self._alive.discard(process)
            lifeline.close()
        kill_group(process)  # what it may have left running
        if stalled.is_set() or expired.is_set():
            with self._lock:
                self._lost[tool] = self._lost.get(tool, 0.0) + (time.monotonic() - began)
        if stalled.is_set() and command.progress is not None:
            begun = command.progress.findall(_head(streams[1]))
            with self._lock:
                self._stalls[tool] = self._stalls.get(tool, 0) + 1
            raise Stalled(os.fsdecode(begun[-1]), patience) if begun else TimedOut
        if expired.is_set():
            raise TimedOut
        truncated = any(_size(stream) >= OUTPUT_LIMIT for stream in streams[1:])
        return Output(_head(streams[1]), _head(streams[2]), code, truncated, seconds)

    def stop(self) -> None:
        """Ends every process and lets no further one start."""
        with self._lock:
            self._stopped = True
            for process in self._alive:
                kill_group(process)

    def _start(
        self,
        command: Command,
        root: Path,
        scratch: Path,
        files: tuple[int, int, int],
        confinement: Confinement | None,
    ) -> tuple[subprocess.Popen[bytes], Lifeline]:
        """The process, with *files* as its standard streams."""
        stdin, stdout, stderr = files
        lifeline = Lifeline()

        def start() -> subprocess.Popen[bytes]:
            with self._lock:
                if self._stopped:
                    raise Unstartable("the run was abandoned")
                with small_files():
                    process = subprocess.Popen(
                        command.argv,
                        stdin=stdin,
                        stdout=stdout,
                        stderr=stderr,
                        cwd=command.cwd or root,
                        env={**environment(os.environ, root, scratch), **command.environment},
                        start_new_session=True,
                        pass_fds=lifeline.inherited,
                    )
                lifeline.tie(process)
                self._alive.add(process)
                return process

        try:
            with held():  # a signal that came meanwhile would leave a process that nobody knows
                return sandbox.confined(start, confinement), lifeline
        except (OSError, ValueError) as err:
            lifeline.close()
            raise Unstartable(str(err)) from err
        except BaseException:
            lifeline.close()
            raise


class Lifeline:
    """A pipe by which the kernel ends a process group when we are gone, even if we were killed (Linux; else it does nothing).

    The process inherits the reading end, which is set to send SIGKILL to its group when something happens (fcntl(2),
    F_SETOWN, F_SETSIG, O_ASYNC). The only thing that can happen is that the writing end is closed, which we hold.
    A signal on the parent's death (prctl) would have to be asked for by the process itself, between fork and exec.
    Between its start and ``tie`` the process is not tied yet: if we are killed in that moment, it goes on until it ends by itself.
    """

    def __init__(self) -> None:
        self._ends: list[int] = []
        try:
            import fcntl

            if hasattr(fcntl, "F_SETSIG"):
                self._ends = list(os.pipe())
        except (ImportError, OSError):
            pass

    @property
    def inherited(self) -> tuple[int, ...]:
        """What a process has to inherit."""
        return tuple(self._ends[:1])

    def tie(self, process: subprocess.Popen[bytes]) -> None:
        """From now on the *process*, which leads its group, ends with us."""
        if not self._ends:
            return
        import fcntl

        reading = self._ends.pop(0)
        try:
            fcntl.fcntl(reading, fcntl.F_SETOWN, -process.pid)
            fcntl.fcntl(reading, fcntl.F_SETSIG, signal.SIGKILL)
            fcntl.fcntl(reading, fcntl.F_SETFL, os.O_ASYNC)
        except OSError:
            pass
        finally:
            os.close(reading)

    def close(self) -> None:
        """Call it when the process has ended: what is left of its group ends, too."""
        while self._ends:
            os.close(self._ends.pop())


def environment(inherited: Mapping[str, str], root: Path, scratch: Path) -> dict[str, str]:
    """A minimal environment: nothing of the user's configuration and nothing of the workspace leaks into a tool."""
    return {
        "PATH": os.pathsep.join(search_path(inherited, root)),
        "HOME": str(scratch),
        "TMPDIR": str(scratch),
        "LANG": "C.UTF-8",
        "LC_ALL": "C.UTF-8",
    }


def search_path(inherited: Mapping[str, str], *roots: Path | None) -> list[str]:
    """The absolute directories of PATH that do not lie in one of *roots*."""
    forbidden = [os.path.realpath(root) for root in roots if root is not None]
    directories = inherited.get("PATH", os.defpath).split(os.pathsep)
    return [d for d in dict.fromkeys(directories) if os.path.isabs(d) and not _within(os.path.realpath(d), forbidden)]


def kill_group(process: subprocess.Popen[bytes]) -> None:
    """Ends the process and everything it started in its group, if any of it is left."""
    try:
        os.killpg(process.pid, signal.SIGKILL)
    except (ProcessLookupError, PermissionError):
        pass


def _wait(process: subprocess.Popen[bytes]) -> tuple[int, float]:
    """Exit code and CPU seconds of the process when it has ended, 0.0 where the system does not tell."""
    if not hasattr(os, "wait4"):
        return process.wait(), 0.0
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    return process.returncode, usage.ru_utime + usage.ru_stime


def _watch(
    stdout: Path,
    progress: re.Pattern[bytes],
    patience: float,
    ended: threading.Event,
    stalled: threading.Event,
    kill: Callable[[], None],
) -> None:
    """Until the process has *ended*: end it, by *kill*, when *stdout* has not grown for *patience*, in seconds.

    A tool that has not named a file yet, as one of a version that names none, has the time of its batch.
    """
    size, since = 0, time.monotonic()
    while not ended.wait(min(1.0, patience / 4)):
        now = _size(stdout)
        if now != size:
            size, since = now, time.monotonic()
        elif time.monotonic() - since > patience and not ended.is_set() and progress.search(_head(stdout)) is not None:
            stalled.set()
            kill()
            return


def _within(path: str, roots: list[str]) -> bool:
    return any(path == root or path.startswith(root.rstrip("/") + "/") for root in roots)


@contextmanager
def small_files() -> Iterator[None]:
    """A process started in here inherits the limit on files before its first instruction, as does what it forks.

    ``limit`` comes too late for a child that it forks at once. Nothing of ours writes as much meanwhile.
    """
    with _LIMITING:
        try:
            import resource

            soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
            cap = OUTPUT_LIMIT if hard == resource.RLIM_INFINITY else min(OUTPUT_LIMIT, hard)
            resource.setrlimit(resource.RLIMIT_FSIZE, (cap, hard))
        except (ImportError, OSError, ValueError):
            yield
            return
        try:
            yield
        finally:
            resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))


def limit(pid: int, timeout: float) -> None:
    """Limits from outside (Linux): a preexec function would be unsafe beside threads.

    The one on processor time ends what outlives us, should we be killed before its time is up.
    """
    try:
        import resource

        seconds = int(timeout) + 10
        resource.prlimit(pid, resource.RLIMIT_CPU, (seconds, seconds))
        resource.prlimit(pid, resource.RLIMIT_CORE, (0, 0))
        resource.prlimit(pid, resource.RLIMIT_FSIZE, (OUTPUT_LIMIT, OUTPUT_LIMIT))
        resource.prlimit(pid, resource.RLIMIT_DATA, (MEMORY_LIMIT, MEMORY_LIMIT))
    except (ImportError, AttributeError, OSError, ValueError):
        pass


def _head(path: Path) -> bytes:
    with open(path, "rb") as stream:
        return stream.read(OUTPUT_LIMIT)


def _size(path: Path) -> int:
    return path.stat().st_size
