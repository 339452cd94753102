# SPDX-License-Identifier: Apache-2.0
"""What the evaluation of a query runs on: its variables, the steps that are left, what was noted."""

from __future__ import annotations

from collections.abc import Mapping

from haros_ci.query.fault import QueryBudgetExhausted, QueryError
from haros_ci.query.values import Value
from haros_ci.records import dataclass, field

#: Calls of a query's own functions within each other.
DEEPEST = 40
#: Steps that one query may take: a fraction of a microsecond to a few microseconds each.
STEPS = 5_000_000

#: The variables that a query has bound itself.
Scope = dict[str, Value]


@dataclass(slots=True)
class Machine:
    """*variables* are those that the query finds; *cache* holds what does not depend on its own."""

    variables: Mapping[str, Value] = field(default_factory=dict)
    left: int = STEPS
    cache: dict[int, Value] = field(default_factory=dict)
    depth: int = 0
    #: Steps of paths that an element had no attribute for: where, the name, and what the element was.
    missing: dict[tuple[int, str, str], tuple[str, ...]] = field(default_factory=dict)

    def tick(self, steps: int = 1) -> None:
        """Count *steps*; Exhausted when there are no more."""
        self.left -= steps
        if self.left < 0:
            self.left = 0
            help = "make the paths shorter, or join with == in where"
            raise QueryBudgetExhausted(f"the query was stopped after {STEPS:,} steps", -1, help)

    def enter(self) -> None:
        """A function of the query is called."""
        self.tick()
        if self.depth == DEEPEST:
            raise QueryError(f"functions call each other more than {DEEPEST} deep")
        self.depth += 1

    def leave(self) -> None:
        self.depth -= 1
