# SPDX-License-Identifier: Apache-2.0
"""A process that is asked several things, one after the other: lines of JSON both ways."""

from __future__ import annotations

import json
import os
import subprocess
import threading
from collections.abc import Iterator
from pathlib import Path
from types import TracebackType
from typing import Any

from haros_ci.linters.linter import Command
from haros_ci.linters.process import (
    OUTPUT_LIMIT,
    Lifeline,
    TimedOut,
    Unstartable,
    environment,
    kill_group,
    limit,
    small_files,
)

#: Bytes of one line that the process says.
LONGEST_LINE = 8_000_000


class Ended(Exception):
    """The process went away, or talked nonsense, before it was done; the message says how, with its last words."""


class Conversation:
    """*command*, running in *scratch* with nothing of the user's environment; ended, with all that it started, at the end."""

    def __init__(self, command: Command, *, root: Path, scratch: Path, seconds: float) -> None:
        """*seconds* is the time that one answer may take."""
        scratch.mkdir(parents=True, exist_ok=True)
        self.seconds = seconds
        self._said = scratch / ".stderr"
        self._lifeline = Lifeline()
        with open(self._said, "wb") as stderr, small_files():
            try:
                self._process = subprocess.Popen(
                    command.argv,
                    stdin=subprocess.PIPE,
                    stdout=subprocess.PIPE,
                    stderr=stderr,
                    cwd=command.cwd or scratch,
                    env={**environment(os.environ, root, scratch), **command.environment},
                    start_new_session=True,
                    pass_fds=self._lifeline.inherited,
                )
            except (OSError, ValueError) as err:
                self._lifeline.close()
                raise Unstartable(str(err)) from err
        self._lifeline.tie(self._process)
        limit(self._process.pid, 3 * seconds)

    def __enter__(self) -> Conversation:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, err: BaseException | None, trace: TracebackType | None
    ) -> None:
        kill_group(self._process)
        self._process.wait()
        self._lifeline.close()
        for stream in (self._process.stdin, self._process.stdout):
            assert stream is not None
            try:
                stream.close()
            except OSError:
                pass

    def ask(self, request: object) -> Iterator[dict[str, Any]]:
        """What the process answers to *request*, up to its ``{"kind": "done"}``; raises TimedOut and Ended."""
        expired = threading.Event()

        def expire() -> None:
            expired.set()
            kill_group(self._process)

        timer = threading.Timer(self.seconds, expire)
        timer.daemon = True
        timer.start()
        try:
            yield from self._answer(request)
        except Ended:
            if expired.is_set():
                raise TimedOut from None
            raise
        finally:
            timer.cancel()

    def _answer(self, request: object) -> Iterator[dict[str, Any]]:
        stdin, stdout = self._process.stdin, self._process.stdout
        assert stdin is not None and stdout is not None
        try:
            stdin.write(json.dumps(request).encode("ascii") + b"\n")
            stdin.flush()
        except OSError as err:
            raise Ended(self._last_words()) from err
        size = 0
        while True:
            line = stdout.readline(LONGEST_LINE)
            size += len(line)
            if not line.endswith(b"\n") or size > OUTPUT_LIMIT:
                raise Ended("it wrote more than it may" if line else self._last_words())
            try:
                message = json.loads(line)
            except (ValueError, RecursionError) as err:
                raise Ended("its output cannot be parsed") from err
            if not isinstance(message, dict):
                raise Ended("its output cannot be parsed")
            if message.get("kind") == "done":
                return
            yield message

    def _last_words(self) -> str:
        """How the process ended, and the last line that it wrote to stderr."""
        code = self._process.wait()
        how = f"it was ended by signal {-code}" if code < 0 else f"it ended with {code}"
        with open(self._said, "rb") as stream:
            stream.seek(max(0, self._said.stat().st_size - 4000))
            lines = [line.strip() for line in stream.read().decode("utf-8", "replace").splitlines() if line.strip()]
        return f"{how}: {lines[-1][:300]}" if lines else how
