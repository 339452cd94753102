# SPDX-License-Identifier: Apache-2.0
"""What follows from a tuple alone, as a table of API rows, is worked out once: without rows of a project, every run has the same tables."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

T = TypeVar("T")
Key = TypeVar("Key", bound=tuple[object, ...])
#: So many tuples each function knows: of rows those of two languages and two versions of ROS, and those of a project's own rows.
TABLES = 8


def once(make: Callable[[Key], T]) -> Callable[[Key], T]:
    """*make*, called once for each tuple that is the same object; what it returns is shared and must not be changed.

    The last ``TABLES`` tuples are remembered, so that nothing is kept for long that one project has led to. They are compared by
    identity: rows hold mappings, and to hash a table takes as long as what is made of it.
    """
    made: dict[int, tuple[Key, T]] = {}

    def found(key: Key) -> T:
        known = made.get(id(key))
        if known is None:
            if len(made) >= TABLES:
                del made[next(iter(made))]
            known = made[id(key)] = (key, make(key))  # it is kept, so that no other one gets its identity
        return known[1]

    return found
