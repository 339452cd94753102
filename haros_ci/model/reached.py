# SPDX-License-Identifier: Apache-2.0
"""All that one thing leads to."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Iterator
from typing import TypeVar

T = TypeVar("T")


def reached(
    first: T, onward: Callable[[T], Iterable[T]], key: Callable[[T], Hashable] = lambda one: one
) -> Iterator[T]:
    """*first* and all that *onward* leads to from it, depth first; what several ways lead to comes once, by its *key*."""
    waiting, seen = [first], set[Hashable]()
    while waiting:
        one = waiting.pop()
        if key(one) not in seen:
            seen.add(key(one))
            yield one
            waiting += reversed([*onward(one)])
