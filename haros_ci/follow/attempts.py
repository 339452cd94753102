# SPDX-License-Identifier: Apache-2.0
"""``try``: its block on all ways out of it, and its handlers from where these lead."""

from __future__ import annotations

from haros_ci import syntax
from haros_ci.follow import early, statements, thrown
from haros_ci.follow.frames import RAISED, RETURN, THROW, Frame
from haros_ci.follow.libraries import harmless
from haros_ci.follow.walk import Walk
from haros_ci.model.location import Location
from haros_ci.values.abstract import Cell, Known, Library, Opaque, Value
from haros_ci.values.state import Writes, joined


def attempt(walk: Walk, frame: Frame, statement: syntax.Try) -> str:
    """A handler begins with what the block has done wherever it may be left; what it has not is undone afterwards, too.

    Where nothing in it is seen to throw, a handler begins with anything that it may have done by then, and afterwards counts what
    the block assigns. A handler that gives up, as it returns false or nothing, is followed for what it makes, and not for what it
    leaves behind. Where the block reads a file of the workspace, what a handler assigns in its place does not count either.
    """
    block, handlers = statement.body, statement.handlers
    is_caught = frame.function is not None and frame.function.name != "main" and not harmless.are_ends(handlers)
    walk.trying += is_caught
    known = len(frame.early)
    try:
        with thrown.left(walk, handlers), thrown.tried(walk, frame, handlers) as trial:
            ended = statements.execute(walk, frame, block)
    finally:
        walk.trying -= is_caught
    early.forget(frame, known, trial)
    after = walk.state.undo(trial.mark)
    branches: list[tuple[str, Writes]] = [(ended, after)]
    trials = walk.trials
    if not trial.places:  # what no handler is seen to come to leaves no block around it
        walk.trials = []
    for handler in handlers:
        start = walk.state.mark()
        if trial.places:
            walk.state.merge(trial.places)
        else:
            for cell, value in after.items():
                walk.state.put(cell, joined(cell.value, value))
        begun = walk.state.mark()
        frame.scopes.append({})
        if handler.name:
            kind = walk.type_in(handler.type, frame)
            frame.declare(handler.name, Cell(walk.opaque("an exception", frame, handler.line, kind)))
        returned = len(frame.returned)
        with walk.under("catch", handler.text, Location(frame.source.path, handler.line, handler.column)):
            how = statements.follow_branch(walk, frame, handler.body, True)
        frame.scopes.pop()
        if (
            how == RETURN
            and not trial.is_left
            and ended not in (THROW, RAISED)
            and all(map(_is_failure, frame.returned[returned:]))
        ):
            del frame.returned[returned:], frame.exits[returned:]
        own = walk.state.since(begun)
        if trial.is_read and not trial.places:  # what stands in for a file that is there
            own = {cell: value for cell, value in own.items() if not _is_known(after.get(cell))}
        writes = walk.state.undo(start)
        branches.append((how, writes if trial.places else {**after, **own}))
    walk.trials = trials
    is_passed_on = ended == RAISED and not any(map(thrown.catches, handlers))
    live = [*range(1, len(branches))] if trial.is_left else None
    return statements.merge(walk, frame, branches[:1] if is_passed_on else branches, live)


def _is_known(value: object) -> bool:
    """Whether something is assigned of which anything is known."""
    return value is not None and not isinstance(value, Opaque)


def _is_failure(value: Value) -> bool:
    """Whether a function that returns this says that it has failed, or nothing."""
    if isinstance(value, Library):
        return value.name.endswith(("FAILURE", "ERROR"))
    return value in (Known(False), Known(None))
