# SPDX-License-Identifier: Apache-2.0
"""Statements between ``#if`` and ``#endif``: of several branches the build takes one, or none."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager

from haros_ci import syntax
from haros_ci.follow import early, statements
from haros_ci.follow.frames import NEXT, Frame
from haros_ci.follow.walk import Walk
from haros_ci.model.architecture import Condition
from haros_ci.model.location import Location
from haros_ci.values.abstract import Cell
from haros_ci.values.state import Writes, joined


def preprocessor(walk: Walk, frame: Frame, statement: syntax.Preprocessor) -> str:
    """Follow each branch, and go on with the join of those that may be compiled; what they declare is there afterwards."""
    branches: list[tuple[str, Writes]] = []
    fresh: dict[str, Cell] = {}
    verdicts = [walk.is_compiled(frame.source.path, branch.line) for branch in statement.branches]
    if True in verdicts:
        verdicts = [verdict is True for verdict in verdicts]
    if True in verdicts and walk.outer is not None:  # what a wrapper does not do as things are is nobody's
        return statements.in_place(walk, frame, statement.branches[verdicts.index(True)].body)
    for branch, verdict in zip(statement.branches, verdicts, strict=True):
        mark, known, depth = walk.state.mark(), len(frame.early), len(walk.conditions)
        declared: dict[str, Cell] = {}
        with walk.under("#if", branch.text, Location(frame.source.path, branch.line, branch.column)):
            frame.scopes.append(declared)
            ended = statements.follow_branch(walk, frame, branch.body, verdict is not False, statements.in_place)
            frame.scopes.pop()
        early.compiled(frame, known, depth, verdict if branch.text else False)  # without a text it stands in no file
        branches.append((ended, _with_declared(walk.state.undo(mark), declared, fresh)))
    if not any(branch.text.startswith("#else") for branch in statement.branches):
        branches.append((NEXT, {}))
        verdicts.append(False if True in verdicts else None)
    live = [i for i, verdict in enumerate(verdicts) if verdict is not False] if False in verdicts else None
    _complete(fresh.values(), [writes for _, writes in branches], live)
    frame.scopes[-1].update((name, cell) for name, cell in fresh.items() if name not in frame.scopes[-1])
    return statements.merge(walk, frame, branches, live)


@contextmanager
def under(walk: Walk, path: str, guards: Sequence[tuple[int, int, str]]) -> Iterator[None]:
    """What is followed inside stands under the ``#if`` lines *guards* of the file at *path*; ruled out where the build does not compile one."""
    depth = len(walk.conditions)
    left_out = sum(walk.is_compiled(path, line) is False for line, _, _ in guards)
    walk.conditions += [Condition("#if", text, Location(path, line, column)) for line, column, text in guards]
    walk.dead += left_out
    try:
        yield
    finally:
        walk.dead -= left_out
        del walk.conditions[depth:]


def _with_declared(writes: Writes, declared: dict[str, Cell], fresh: dict[str, Cell]) -> Writes:
    """What a branch has written, and what it declares, which has no scope of its own."""
    for name, cell in declared.items():
        first = fresh.setdefault(name, cell)
        if first is not cell:  # one variable, declared by each branch anew
            writes[first] = writes.pop(cell, cell.value)
        else:
            writes.setdefault(cell, cell.value)
    return writes


def _complete(cells: Iterable[Cell], branches: list[Writes], live: list[int] | None) -> None:
    """Let what branches declare be declared by all: who reads it was built with one that does."""
    counting = branches if live is None else [branches[i] for i in live]
    for cell in cells:
        result = [writes[cell] for writes in counting if cell in writes]
        result = result or [writes[cell] for writes in branches if cell in writes]
        value = result[0]
        for other in result[1:]:
            value = joined(value, other)
        for writes in branches:
            writes.setdefault(cell, value)
