# SPDX-License-Identifier: Apache-2.0
"""Deep calls have room on the stack of frames: no chunk of it is mapped and unmapped for each."""

from __future__ import annotations

import resource
from collections.abc import Callable

import pytest

from haros_ci.stack_room import SLOTS, with_room

CALLS = 50


def deep(depth: int) -> int:
    """Calls at each depth down to *depth*, so that some stand at the end of a chunk wherever that is."""
    found = sum(leaf(number) for number in range(CALLS))
    return found if depth == 0 else deep(depth - 1)


def leaf(number: int) -> int:
    return number


def faults(run: Callable[[], object]) -> int:
    before = resource.getrusage(resource.RUSAGE_SELF).ru_minflt
    run()
    return resource.getrusage(resource.RUSAGE_SELF).ru_minflt - before


def test_deep_calls_map_nothing() -> None:
    def run() -> None:
        for _ in range(4):
            deep(300)

    with_room(run)  # what else is made the first time
    assert with_room(lambda: faults(run)) < CALLS


def test_room_returns_what_is_called() -> None:
    assert with_room(lambda: 3) == 3
    assert with_room.__code__.co_stacksize == SLOTS


def test_errors_pass() -> None:
    with pytest.raises(KeyError, match="here"):
        with_room(lambda: {}["here"])
