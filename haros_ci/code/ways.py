# SPDX-License-Identifier: Apache-2.0
"""What runs inside of callbacks, and the way that leads there."""

from __future__ import annotations

from haros_ci.code.body import Call
from haros_ci.code.callbacks import Callback, callbacks
from haros_ci.code.calls import Path, reached
from haros_ci.code.codebase import Codebase, Routine
from haros_ci.model.location import Location
from haros_ci.records import dataclass

KINDS = {
    "subscription": "a subscription",
    "timer": "a timer",
    "service": "a service",
    "action": "an action server",
    "response": "a client's response",
    "parameters": "the setting of parameters",
}


@dataclass(frozen=True, slots=True, eq=False)
class Reached:
    """A routine that runs in a callback: *path* are the calls that lead to it from the callback's function."""

    callback: Callback
    routine: Routine
    path: Path

    def flow(self, call: Call, words: str) -> tuple[tuple[Location, str], ...]:
        """The places from the registration to *call*, with what is to be seen there."""
        made = self.callback
        steps = [(made.location, f"{made.routine.title} is the callback of {KINDS[made.kind]}")]
        for routine, other_call in self.path:
            steps.append((place(routine, other_call), f"{routine.title} calls {other_call.name}"))
        return (*steps, (place(self.routine, call), words))


def place(routine: Routine, call: Call) -> Location:
    """Where a call stands."""
    return Location(routine.path, call.line, call.column)


def in_callbacks(code: Codebase, depth: int = 6) -> tuple[Reached, ...]:
    """Every routine that runs in a callback, with each callback that it runs in, the shortest ways first."""
    key = ("in callbacks", depth)
    if key not in code.kept:
        found = [
            Reached(callback, routine, path)
            for callback in callbacks(code)
            for routine, path in reached(code, callback.routine, depth)
        ]
        code.kept[key] = tuple(sorted(found, key=lambda other_reached: len(other_reached.path)))
    known: tuple[Reached, ...] = code.kept[key]
    return known
