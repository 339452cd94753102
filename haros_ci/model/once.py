# SPDX-License-Identifier: Apache-2.0
"""What follows from a table of API rows alone is worked out once: without rows of a project, every run has the same tables."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

from haros_ci.model.api import Row

T = TypeVar("T")
#: So many tables of rows each function knows: those of two languages and two versions of ROS, and those of a project's own rows.
TABLES = 8


def once(make: Callable[[tuple[Row, ...]], T]) -> Callable[[tuple[Row, ...]], T]:
    """*make*, called once for each tuple of rows that is the same object; what it returns is shared and must not be changed.

    The last ``TABLES`` tuples are remembered, so that nothing is kept for long that rows of one project have led to. Rows are compared by
    identity: they hold mappings, and to hash a table takes as long as what is made of it.
    """
    made: dict[int, tuple[tuple[Row, ...], T]] = {}

    def found(rows: tuple[Row, ...]) -> T:
        known = made.get(id(rows))
        if known is None:
            if len(made) >= TABLES:
                del made[next(iter(made))]
            known = made[id(rows)] = (rows, make(rows))  # the rows are kept, so that no others get their identity
        return known[1]

    return found
