# SPDX-License-Identifier: Apache-2.0
"""Recordings in lines of JSON: ours, and the event logs of ROSMonitoring (docs/monitor.md states the format)."""

from __future__ import annotations

import json
import math
import os
import stat
from collections.abc import Iterator
from pathlib import Path
from typing import Any, BinaryIO

from haros_ci.errors import UserError
from haros_ci.recordings.recording import LATEST, LONGEST_NAME, MOST_CHANNELS, Recording, full_name

#: Bytes of a line.
LONGEST_LINE = 16 << 20
#: Lines that are no messages before the file is taken for something else.
MOST_FAULTS = 1_000
SECOND = 1_000_000_000
#: What ROSMonitoring writes beside the fields of a message.
_OF_EVENTS = frozenset(("topic", "time"))


class NoMessage(Exception):
    """Why a line is no message."""


class OfService(Exception):
    """A line is a request or a response of a service, as ROSMonitoring writes them."""


class JsonLines(Recording):
    """A file with a message in each line."""

    def __init__(self, path: Path) -> None:
        super().__init__(path.name)
        self.path = path
        self.file: BinaryIO | None = None

    def share(self) -> float | None:
        return share_of(self.file)

    def know(self, topic: str) -> None:
        """Take a topic; NoMessage if its name is too long, or there are too many."""
        if len(topic) > LONGEST_NAME:
            raise NoMessage(f"its topic has a name of more than {LONGEST_NAME:,} characters")
        if topic not in self.topics and len(self.topics) >= MOST_CHANNELS:
            raise NoMessage(f"it is on one more topic than {MOST_CHANNELS:,}")
        self.topics.setdefault(topic, set())

    def times(self) -> Iterator[tuple[str, int]]:
        return ((topic, time) for topic, _, time, _ in self._messages(None))

    def messages(self, requested: frozenset[str]) -> Iterator[tuple[str, Any, int, int]]:
        return self._messages(requested)

    def _messages(self, requested: frozenset[str] | None) -> Iterator[tuple[str, Any, int, int]]:
        faults = calls = 0
        with opened(self.path) as file:
            self.file = file
            for row, line in enumerate(lines(file), 1):
                if not line.strip():
                    continue
                try:
                    topic, time, message = message_of(line)
                    self.know(topic)
                except OfService:
                    calls += 1
                    continue
                except NoMessage as err:
                    faults += 1
                    if faults == 1:
                        self.damage = f"line {row} is not a message: {err}"
                        self.notes.append(self.damage)
                    if faults > MOST_FAULTS:
                        raise UserError(
                            f"{self.name}: more than {MOST_FAULTS} lines are no messages",
                            help="docs/monitor.md states the format",
                        ) from None
                    continue
                number = self.passed(time)
                if requested is None or topic in requested:
                    yield topic, message, time, number
        if faults > 1:
            self.notes.append(f"{faults - 1} further lines are no messages")
        if calls:
            self.notes.append(f"{calls} lines are requests and responses of services, which are not looked at")


def opened(path: Path) -> BinaryIO:
    """A regular file for reading; UserError for what is none."""
    try:
        if not stat.S_ISREG(path.stat().st_mode):
            raise UserError(f"{path}: is no file", help="name a recording")
        return path.open("rb")
    except (OSError, ValueError) as err:
        why = getattr(err, "strerror", None) or err
        raise UserError(f"{path}: cannot be read: {why}", help="name a recording") from err


def share_of(file: BinaryIO | None) -> float | None:
    """How much of an open file has been read."""
    if file is None or file.closed:
        return None
    return file.tell() / max(os.fstat(file.fileno()).st_size, 1)


def lines(file: BinaryIO) -> Iterator[bytes]:
    """The lines; of one that is too long only the beginning, which is no JSON."""
    while line := file.readline(LONGEST_LINE):
        if not line.endswith(b"\n") and len(line) == LONGEST_LINE:
            while (rest := file.readline(LONGEST_LINE)) and not rest.endswith(b"\n"):
                pass
            line = b"\x00"
        yield line


def message_of(line: bytes) -> tuple[str, int, Any]:
    """Topic, time in nanoseconds and message of a line; NoMessage or OfService if it is none."""
    try:
        found = json.loads(line, parse_int=_whole)
    except (ValueError, RecursionError):
        raise NoMessage("it is not JSON, or too long") from None
    if not isinstance(found, dict):
        raise NoMessage("it is not a JSON object")
    topic, time = found.get("topic"), found.get("time")
    if topic is None and isinstance(found.get("service"), str):
        raise OfService
    if not isinstance(topic, str) or not topic:
        raise NoMessage("its 'topic' is missing, or not a text")
    if (
        isinstance(time, bool)
        or not isinstance(time, (int, float))
        or not math.isfinite(time)
        or not 0 <= time * SECOND < LATEST
    ):
        raise NoMessage("its 'time' is missing, or not a number of seconds")
    at = time * SECOND if isinstance(time, int) else round(time * SECOND)
    if isinstance(found.get("msg"), dict):
        return full_name(topic), at, found["msg"]
    return full_name(topic), at, {name: value for name, value in found.items() if name not in _OF_EVENTS}


def _whole(text: str) -> int | float:
    return int(text) if len(text) < 40 else float(text)
