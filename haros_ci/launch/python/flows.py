# SPDX-License-Identifier: Apache-2.0
"""How a block of statements ends, and both ways of a branch."""

from __future__ import annotations

from collections.abc import Callable

from haros_ci.launch.python.forks import fork
from haros_ci.launch.python.heap import either
from haros_ci.launch.python.run import ScriptEvaluation
from haros_ci.launch.python.values import ScriptScope, Value
from haros_ci.model.launch_actions import Test
from haros_ci.records import dataclass


@dataclass(frozen=True, slots=True)
class Flow:
    """How a block ended before its end: *kind* is return, break, continue or raise."""

    kind: str
    value: Value = None


def ways(
    run: ScriptEvaluation,
    scope: ScriptScope,
    tests: tuple[Test, Test],
    first: Callable[[], Flow | None],
    second: Callable[[], Flow | None],
) -> Flow | None:
    """Both ways of a branch. If only one of them leaves the block, what follows is under the test of the other."""
    one, other = fork(
        run,
        tests,
        first,
        second,
        dropped=lambda flow: flow is not None and flow.kind == "raise",
        left=lambda flow: scope.variables if flow is not None else None,
    )
    if one is None and other is None:
        return None
    if one is not None and one.kind == "raise":
        return other
    if other is not None and other.kind == "raise":
        return one
    if one is not None and other is not None:
        if one.kind == other.kind:
            return Flow(one.kind, either(one.value, other.value, tests)) if one.kind == "return" else one
        leave(run, one, tests)
        return other
    removed, stays = (one, tests) if one is not None else (other, (tests[1], tests[0]))
    leave(run, removed, stays)
    return None


def leave(run: ScriptEvaluation, flow: Flow | None, tests: tuple[Test, Test]) -> None:
    """Note that a way has left under the first test: what follows is under the second."""
    if flow is not None:
        frame = run.frames[-1]
        if flow.kind == "return":
            frame.returns.append(((tests[0],), flow.value))
        frame.pending.append((run.heap.open(), tests[1], tests[0]))
