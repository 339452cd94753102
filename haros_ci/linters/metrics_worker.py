# SPDX-License-Identifier: Apache-2.0
"""The loop of a measuring process: file names as JSON on stdin, one JSON object per file on stdout."""

from __future__ import annotations

import json
import math
import os
import signal
import stat
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

#: Seconds of processor time (not wall time, so that a busy machine changes nothing) that one file may take at most; a small one has less.
CPU_LIMIT = 30.0
#: What any file has, and what it has for a megabyte: several times what tools need for code.
CPU_LEAST, CPU_OF_MEGABYTE = 4.0, 60.0
RECURSION_LIMIT = 5000

Measure = Callable[[bytes], dict[str, Any]]


class Unmeasurable(Exception):
    """A file that cannot be measured, and the line to blame if one is known."""

    def __init__(self, message: str, line: int | None = None) -> None:
        super().__init__(message)
        self.message = message
        self.line = line


def begin() -> None:
    """Makes the measuring library importable, which lies in the directory that the first argument names.

    The script's own name is hidden: lizard puts its directory at the head of the path, where our adapters lie.
    """
    directory = sys.argv[1]
    sys.argv[0] = ""
    if directory not in sys.path:
        sys.path.append(directory)


def serve(measure: Measure) -> None:
    """Measures every file that stdin names: ``{"root": directory, "files": [relative paths]}``.

    Each answer is ``{"path", "functions": […], "file": {…}}`` or ``{"path", "problem", "line"}``; a file that cannot
    be read, parsed or measured in time is a problem and never stops the rest.
    """
    sys.setrecursionlimit(RECURSION_LIMIT)
    request = json.load(sys.stdin.buffer)
    for path in request["files"]:
        answer = {"path": path, **_answer(measure, request["root"], path)}
        sys.stdout.write(json.dumps(answer, sort_keys=True) + "\n")


def _answer(measure: Measure, root: str, path: str) -> dict[str, Any]:
    limit = CPU_LIMIT
    try:
        source = _read(root, path)
        limit = seconds_for(len(source))
        with cpu_limit(limit):
            return measure(source)
    except Unmeasurable as problem:
        return {"problem": problem.message, "line": problem.line}
    except TimeoutError:
        return {"problem": f"not measured within {limit:.0f} s", "line": None}
    except OSError as error:
        return {"problem": f"cannot be read: {error.strerror}", "line": None}
    except (RecursionError, MemoryError):
        return {"problem": "nested too deeply to be measured", "line": None}
    except Exception as error:  # a parser's own bug costs one file, not the run
        return {"problem": f"the parser failed: {type(error).__name__}", "line": None}


def _read(root: str, path: str) -> bytes:
    """The bytes of a regular file under *root*; links that lead elsewhere are not followed."""
    base = os.path.realpath(root)
    name = os.path.join(base, path)
    directory = os.path.realpath(os.path.dirname(name))
    if os.path.commonpath([base, directory]) != base:
        raise Unmeasurable("outside the workspace")
    flags = os.O_RDONLY | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0)
    with open(os.open(os.path.join(directory, os.path.basename(name)), flags), "rb") as stream:
        if not stat.S_ISREG(os.fstat(stream.fileno()).st_mode):
            raise Unmeasurable("not a regular file")
        return stream.read()


def seconds_for(size: int) -> float:
    """The seconds of processor time that a file of so many bytes may take."""
    return min(CPU_LIMIT, CPU_LEAST + CPU_OF_MEGABYTE * size / 1e6)


@contextmanager
def cpu_limit(seconds: float) -> Iterator[None]:
    """Raises TimeoutError in the block after *seconds* of user time, where the platform has such a timer."""
    if not hasattr(signal, "setitimer"):
        yield
        return

    def expire(*_: object) -> None:
        raise TimeoutError

    previous = signal.signal(signal.SIGVTALRM, expire)
    signal.setitimer(signal.ITIMER_VIRTUAL, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0)
        signal.signal(signal.SIGVTALRM, previous)


def halstead_volume(length: int, vocabulary: int) -> float:
    """Halstead's volume in bits: N · log2 n; 0 for an empty program."""
    return length * math.log2(vocabulary) if vocabulary else 0.0


def maintainability(volume: float, complexity: int, logical_lines: int, comment_ratio: float) -> float:
    """The maintainability index with the comment term, scaled to 0–100 as HAROS and radon compute it.

    *complexity* is the sum over the file's functions, *comment_ratio* lies in 0–1. A file without code scores 100.
    """
    if volume <= 0 or logical_lines <= 0:
        return 100.0
    comments = 50 * math.sin(math.sqrt(2.46 * math.radians(comment_ratio * 100)))
    raw = 171 - 5.2 * math.log(volume) - 0.23 * complexity - 16.2 * math.log(logical_lines) + comments
    return min(max(raw * 100 / 171, 0.0), 100.0)


@dataclass(frozen=True)
class Tokens:
    """Halstead's counts: operators and operands in all, and distinct ones."""

    operators: int
    operands: int
    distinct_operators: int
    distinct_operands: int


def file_metrics(
    *, code: set[int], comments: set[int], effective: int, logical: int, complexity: int, tokens: Tokens
) -> dict[str, float]:
    """The metrics of a whole file, from its lines of code and of comment and its token counts.

    The comment ratio is the part of the non-blank lines that hold a comment (a line can hold code too). Halstead's time
    is in seconds: the effort, which is volume times difficulty, by Stroud's 18 decisions a second.
    """
    written = len(code | comments)
    ratio = len(comments) / written if written else 0.0
    length = tokens.operators + tokens.operands
    volume = halstead_volume(length, tokens.distinct_operators + tokens.distinct_operands)
    difficulty = tokens.distinct_operators / 2 * tokens.operands / max(tokens.distinct_operands, 1)
    return {
        "cc": complexity,
        "nloc": len(code),
        "eloc": effective,
        "lloc": logical,
        "sloc": written,
        "comments": len(comments),
        "comment_ratio": ratio,
        "volume": volume,
        "bugs": volume / 3000,
        "time": difficulty * volume / 18,
        "mi": maintainability(volume, complexity, logical, ratio),
    }
