# SPDX-License-Identifier: Apache-2.0
"""One turn of a loop, and loops of unknown length: what a turn changes is not known at the beginning of the next."""

from __future__ import annotations

from collections.abc import Callable

from haros_ci import syntax
from haros_ci.follow import alternatives, early, follow, foreseen
from haros_ci.follow.frames import BREAK, CONTINUE, NEXT, Frame, Loop
from haros_ci.follow.made import go_back, keep
from haros_ci.follow.walk import Walk
from haros_ci.model.location import Location
from haros_ci.values.abstract import Known, Mapped, Object, Opaque, Partial, Sequence, tick
from haros_ci.values.cells import Cell, Slot
from haros_ci.values.state import Writes, certain, joined

#: Turns that are tried to find what a loop changes.
REHEARSALS = 3
#: Turns around a loop from which on it is widened: 2 for each loop that is gone through, all of them in a rehearsal.
NESTED = 8


def turn(walk: Walk, frame: Frame, loop: Loop, body: Callable[[], str], after: Callable[[], None] | None = None) -> str:
    """One turn of a loop, and what comes *after* it if the loop goes on."""
    ended = _body(walk, frame, loop, body)
    if ended == NEXT and after is not None:
        after()
    return ended


def _body(walk: Walk, frame: Frame, loop: Loop, body: Callable[[], str]) -> str:
    """The body of a loop: the ways that continue are joined with the one that comes to its end."""
    was_dead = frame.is_dead
    loop.continues = []
    broken, known = len(loop.breaks), len(frame.early)
    walk.loops.append(loop)
    try:
        ended = body()
    finally:
        walk.loops.pop()
    early.forget(frame, known, loop)
    died = frame.is_dead and not was_dead
    frame.is_dead = was_dead
    if loop.continues:
        ways = list(loop.continues)
        if ended == NEXT and not died:
            ways.append(walk.state.since(loop.mark))
        walk.state.undo(loop.mark)
        walk.state.merge(ways)
        return NEXT
    if ended in (NEXT, CONTINUE) and not died:
        return NEXT
    if len(loop.breaks) == broken and died:
        frame.is_dead = True  # what can be taken has returned
    return BREAK if died else ended


def widened(
    walk: Walk,
    frame: Frame,
    loop: Loop,
    matters: bool,
    statement: syntax.Loop | syntax.Each,
    body: Callable[[], str],
    after: Callable[[], None] | None = None,
) -> None:
    """A loop of unknown length: whatever a turn changes is not known at the beginning of the next.

    *body* follows a turn. It is rehearsed until it changes nothing more that was known; then, if it *matters*, as it may
    make something, it is followed for what it makes (not in a rehearsal, which makes nothing). What the loop has changed
    when it was followed before is not known from the first turn on, if that turns out to be right (``follow.foreseen``).
    """
    is_real = matters and not walk.quiet
    if loop.runs_on:
        follow.meanwhile(walk, frame)
    begun, start, kept = tick(), walk.state.mark(), keep(walk) if is_real else None
    most = 1 if walk.quiet else REHEARSALS + is_real
    guess = {} if walk.quiet else foreseen.changes(walk, frame, statement)
    changed, left = dict[Slot, object](), most
    while True:
        for cell, held in guess.items():
            _forget(walk, frame, loop, statement.line, cell, certain(held))
        left -= 1 + bool(guess)  # which stands for the turn that would have found it
        inner, ended, writes = _tried(walk, frame, is_real, body, after)
        ways = [item for way in (writes, *inner.breaks) for item in way.items()]
        right = {cell: held for cell, held in guess.items() if _is_changed(cell, held, ways)}
        if len(right) < len(guess):  # begin again with what may be right
            foreseen.missed(walk, frame, statement, guess.keys() - right.keys())
            walk.state.undo(start)
            guess, left = right, most
        else:
            changed |= guess
            guess = {}
            if (is_real and not left) or not _forgotten(walk, frame, loop, statement.line, begun, ways, changed):
                break
            if not left:
                break
        if kept is not None:
            go_back(walk, kept)
    foreseen.note(walk, frame, statement, changed)
    before = walk.state.since(loop.mark)
    loop.breaks += [{**before, **way} for way in inner.breaks]
    walk.state.merge([alternatives.own(walk, writes), writes] if ended == NEXT else [{}])


def _tried(
    walk: Walk, frame: Frame, is_real: bool, body: Callable[[], str], after: Callable[[], None] | None
) -> tuple[Loop, str, Writes]:
    """One turn, undone again: its loop, how it ended, and what it wrote; a rehearsal if it is not *is_real*."""
    inner = Loop(walk.state.mark())
    walk.turns *= 1 if is_real else NESTED
    walk.quiet += not is_real
    try:
        ended = turn(walk, frame, inner, body, after)
    finally:
        walk.quiet -= not is_real
        walk.turns //= 1 if is_real else NESTED
    return inner, ended, walk.state.undo(inner.mark)


def _forgotten(
    walk: Walk,
    frame: Frame,
    loop: Loop,
    line: int,
    begun: int,
    ways: list[tuple[Slot, object]],
    changed: dict[Slot, object],
) -> bool:
    """Whether a turn has changed what was known before it; that is not known any more. *changed* gets what was known."""
    found = False
    for cell, value in ways:
        if not walk.is_older(cell, begun):  # of the turn itself
            continue
        some = _left(cell.value, value)
        if some is None:
            continue
        found = True
        if not isinstance(cell.value, Opaque):
            changed[cell] = cell.value
        _forget(walk, frame, loop, line, cell, some)
    return found


def _left(held: object, value: object) -> tuple[Cell, ...] | None:
    """What is left of what a cell *held* where a turn writes *value*: elements that it has for sure; None if nothing is lost."""
    then = joined(held, value)
    if then is held or isinstance(then, (tuple, dict, Known, Object, Sequence, Mapped)):
        return None
    some = certain(then)
    return None if isinstance(held, Opaque) and certain(held) == some else some


def _forget(walk: Walk, frame: Frame, loop: Loop, line: int, cell: Slot, some: tuple[Cell, ...]) -> None:
    """A cell holds something else after each turn, but for the elements *some*."""
    reason = loop.bound if loop.bound and not loop.is_endless else "it changes in a loop"
    place = Location(frame.source.path, line)
    unknown = Partial(reason, place, cell.type, some) if some else Opaque(reason, place, cell.type)
    walk.state.forget(cell, unknown)


def _is_changed(cell: Slot, held: object, ways: list[tuple[Slot, object]]) -> bool:
    """Whether a turn loses of what a cell *held* what was foreseen: all but the elements that it has for sure."""
    return any(_left(held, value) == certain(held) for written, value in ways if written is cell)
