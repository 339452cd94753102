# SPDX-License-Identifier: Apache-2.0
"""Both ways of a branch whose condition is not known."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

from haros_ci.launch.python.run import ScriptEvaluation, ScriptFrame
from haros_ci.model.launch_actions import Test

T = TypeVar("T")


def fork(
    run: ScriptEvaluation,
    tests: tuple[Test, Test],
    first: Callable[[], T],
    second: Callable[[], T],
    dropped: Callable[[T], bool] = lambda _: False,
    left: Callable[[T], dict[str, object] | None] = lambda _: None,
) -> tuple[T, T]:
    """Do *first*, then *second* from where the first began, and join what they leave.

    Of a branch whose outcome is *dropped* nothing counts; *left* gives the variables that it has no say in any more.
    """
    heap = run.heap
    frame = run.frames[-1] if run.frames else ScriptFrame()
    mark = len(frame.pending)
    journal = heap.open()
    one = first()
    removed = [tests for _, *tests in frame.pending[mark:]]
    settle(run, frame, mark)
    after_one = heap.close(journal)
    journal = heap.open()
    other = second()
    removed += [tests for _, *tests in frame.pending[mark:]]
    settle(run, frame, mark)
    after_other = heap.close(journal)
    for outcome, mine, others in ((one, after_one, after_other), (other, after_other, after_one)):
        variables = left(outcome)
        if variables is None:
            continue
        mine.pop(id(variables), None)
        if id(variables) in others:
            mine[id(variables)] = others[id(variables)]
    heap.join(after_one, after_other, tests, (dropped(one), dropped(other)))
    frame.pending.extend((heap.open(), here, away) for here, away in removed[:8])
    return one, other


def settle(run: ScriptEvaluation, frame: ScriptFrame, mark: int) -> None:
    """Close the journals that were left open because a branch has gone: what was done since is under the other test."""
    while len(frame.pending) > mark:
        journal, here, away = frame.pending.pop()
        run.heap.join(run.heap.close(journal), {}, (here, away), (False, False))
