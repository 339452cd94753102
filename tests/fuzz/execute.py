# SPDX-License-Identifier: Apache-2.0
"""One input through one target, under limits of time and memory, and what is wrong with it if anything is."""

from __future__ import annotations

import dataclasses
import enum
import resource
import signal
import traceback
from collections.abc import Callable, Mapping
from pathlib import Path
from types import FrameType

#: Of the processor, for one input of a few kilobytes. A reader takes milliseconds.
SECONDS = 10.0
#: By which one input may raise the most that the process has ever used.
MEGABYTES = 400
_FRAMES = ("haros_ci", "haros_ci_checks", "checks", "targets")

Target = Callable[[bytes], object]


class Stalled(BaseException):
    """An input has used up its time. No reader catches it, as it is no Exception."""


@dataclasses.dataclass(frozen=True)
class Finding:
    """*kind* and *place* tell one finding from another; *detail* is for people."""

    kind: str
    place: str
    detail: str

    @property
    def key(self) -> tuple[str, str]:
        return self.kind, self.place


def canonical(value: object) -> object:
    """*value* as tuples and texts, sets sorted: equal wherever a promise "same input, same result" holds."""
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        return type(value).__name__, tuple(canonical(getattr(value, f.name, None)) for f in dataclasses.fields(value))
    if isinstance(value, (set, frozenset)):
        return "set", tuple(sorted(repr(canonical(item)) for item in value))
    if isinstance(value, Mapping):
        return "map", tuple((canonical(key), canonical(item)) for key, item in value.items())
    if isinstance(value, (list, tuple)):
        return tuple(canonical(item) for item in value)
    if isinstance(value, enum.Enum):
        return value.name
    return value if isinstance(value, (str, bytes, int, bool, type(None))) else repr(value)


def run(target: Target, data: bytes, *, seconds: float = SECONDS, twice: bool = False) -> Finding | None:
    """What is wrong with *target* on *data*; *twice* also asks whether the result is the same again."""
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    try:
        result = _limited(target, data, seconds)
        if twice and canonical(result) != canonical(_limited(target, data, seconds)):
            return Finding("differs", "", "the same bytes gave another result the second time")
    except Stalled as err:
        return Finding("slow", _place(err), f"more than {seconds:g} s\n{_told(err)}")
    except (KeyboardInterrupt, SystemExit) as err:
        if isinstance(err, KeyboardInterrupt):
            raise
        return Finding("SystemExit", _place(err), _told(err))
    except BaseException as err:
        return Finding(type(err).__name__, _place(err), _told(err))
    grown = (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) // 1024
    return Finding("memory", "", f"{grown} MB more than any input before") if grown > MEGABYTES else None


def _limited(target: Target, data: bytes, seconds: float) -> object:
    def stop(_: int, __: FrameType | None) -> None:
        raise Stalled

    previous = signal.signal(signal.SIGPROF, stop)
    signal.setitimer(signal.ITIMER_PROF, seconds, 1.0)  # again, in case a callback of C code swallowed the first
    try:
        return target(data)
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, previous)


def _place(err: BaseException) -> str:
    """The innermost function of the program on the way to *err*; of a recursion the function alone, as lines differ."""
    frames = [f for f in traceback.extract_tb(err.__traceback__) if set(Path(f.filename).parts) & set(_FRAMES)]
    if not frames:
        return ""
    last = frames[-1]
    module = "/".join(Path(last.filename).parts[-2:])
    if isinstance(err, (RecursionError, Stalled)):
        return f"{module}" if isinstance(err, RecursionError) else f"{'/'.join(Path(frames[0].filename).parts[-2:])}"
    return f"{module}:{last.name}:{last.lineno}"


def _told(err: BaseException) -> str:
    lines = traceback.format_exception(err)
    text = "".join(lines)
    return text if len(text) < 6000 else f"{text[:3000]}\n...\n{text[-3000:]}"
