# SPDX-License-Identifier: Apache-2.0
"""Room for deep calls, so that they do not ask the system for memory again and again.

CPython keeps the frames of Python functions in chunks of 16 KiB. A call that does not fit into the last one maps another, and its return unmaps
that (``push_chunk`` and ``_PyThreadState_PopFrame`` in Python/pystate.c of 3.11 to 3.13). Code that calls deeply, as the interpreter of programs
does, stands at the end of a chunk for long: each call there costs two calls of the system and a fault of a page, 1.5 million in a cold run of
navigation2, a tenth of its processor time. A chunk is as large as the frame that it is made for asks, up to the next power of two.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

T = TypeVar("T")
#: Values that the frame has place for, 1 MiB: with what every frame needs it is more, so that the chunk has 2 MiB, and as much is left for what is called.
SLOTS = 1 << 17


def with_room(function: Callable[[], T]) -> T:
    """What *function* returns, called from a large frame; memory that nobody touches is only reserved."""
    return function()


with_room.__code__ = with_room.__code__.replace(co_stacksize=SLOTS)
