# SPDX-License-Identifier: Apache-2.0
"""Statements between ``#if`` and ``#endif``: of several branches the build takes one, or none."""

from __future__ import annotations

from haros_ci import syntax
from haros_ci.follow import statements
from haros_ci.follow.frames import NEXT, Frame
from haros_ci.follow.walk import Walk
from haros_ci.values.abstract import Cell
from haros_ci.values.state import Writes, joined


def preprocessor(walk: Walk, frame: Frame, statement: syntax.Preprocessor) -> str:
    """Follow each branch, and go on with their join; what they declare is there afterwards."""
    branches: list[tuple[str, Writes]] = []
    fresh: dict[str, Cell] = {}
    for branch in statement.branches:
        mark = walk.state.mark()
        declared: dict[str, Cell] = {}
        with walk.under("#if", branch.text, frame, branch.line, branch.column):
            frame.scopes.append(declared)
            ended = NEXT
            for item in branch.body:
                walk.step()
                ended = statements.STATEMENTS[type(item)](walk, frame, item)
                if ended != NEXT:
                    break
            frame.scopes.pop()
        writes = walk.state.undo(mark)
        for name, cell in declared.items():  # no scope of its own
            first = fresh.setdefault(name, cell)
            if first is not cell:  # one variable, declared by each branch anew
                writes[first] = writes.pop(cell, cell.value)
            else:
                writes.setdefault(cell, cell.value)
        branches.append((ended, writes))
    if not any(branch.text.startswith("#else") for branch in statement.branches):
        branches.append((NEXT, {}))
    for cell in fresh.values():  # who reads it was built with a branch that declares it
        result = [writes[cell] for _, writes in branches if cell in writes]
        value = result[0]
        for other in result[1:]:
            value = joined(value, other)
        for _, writes in branches:
            writes.setdefault(cell, value)
    frame.scopes[-1].update((name, cell) for name, cell in fresh.items() if name not in frame.scopes[-1])
    return statements.merge(walk, frame, branches, None)
