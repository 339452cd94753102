# SPDX-License-Identifier: Apache-2.0
"""One turn of a loop, and loops of unknown length: what a turn changes is not known at the beginning of the next."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager

from haros_ci.follow import alternatives, early, follow
from haros_ci.follow.frames import BREAK, CONTINUE, NEXT, Frame, Loop
from haros_ci.follow.made import go_back, keep
from haros_ci.follow.walk import Walk
from haros_ci.model.location import Location
from haros_ci.values.abstract import Known, Mapped, Object, Opaque, Partial, Sequence, tick
from haros_ci.values.cells import Slot
from haros_ci.values.state import certain, joined

#: Turns that are tried to find what a loop changes.
REHEARSALS = 3
#: Turns around a loop from which on it is widened: 2 for each loop that is gone through, all of them in a rehearsal.
NESTED = 8


@contextmanager
def first_of_do(walk: Walk, is_so: bool) -> Iterator[None]:
    """The first turn of ``do … while`` and the test behind it do not stand under the test of the loop; all else does."""
    last = walk.conditions.pop() if is_so else None
    try:
        yield
    finally:
        if last is not None:
            walk.conditions.append(last)


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
    line: int,
    body: Callable[[], str],
    after: Callable[[], None] | None = None,
) -> None:
    """A loop of unknown length: whatever a turn changes is not known at the beginning of the next.

    *body* follows a turn. It is rehearsed until it changes nothing more that was known; then, if it *matters*, as it may
    make something, it is followed for what it makes (not in a rehearsal, which makes nothing).
    """
    is_real = matters and not walk.quiet
    if loop.runs_on:
        follow.meanwhile(walk, frame)
    begun = tick()
    for left in reversed(range(1 if walk.quiet else REHEARSALS + is_real)):
        inner = Loop(walk.state.mark())
        kept = keep(walk) if is_real else None
        walk.turns *= 1 if is_real else NESTED
        walk.quiet += not is_real
        try:
            ended = turn(walk, frame, inner, body, after)
        finally:
            walk.quiet -= not is_real
            walk.turns //= 1 if is_real else NESTED
        writes = walk.state.undo(inner.mark)
        if is_real and not left:
            break
        ways = [item for way in (writes, *inner.breaks) for item in way.items()]
        if not _forgotten(walk, frame, loop, line, begun, ways):
            break
        if kept is not None:
            go_back(walk, kept)
    before = walk.state.since(loop.mark)
    loop.breaks += [{**before, **way} for way in inner.breaks]
    walk.state.merge([alternatives.own(walk, writes), writes] if ended == NEXT else [{}])


def _forgotten(walk: Walk, frame: Frame, loop: Loop, line: int, begun: int, ways: list[tuple[Slot, object]]) -> bool:
    """Whether a turn has changed what was known before it; that is not known any more."""
    changed = False
    for cell, value in ways:
        if not walk.is_older(cell, begun):  # of the turn itself
            continue
        then = joined(cell.value, value)
        if then is cell.value or isinstance(then, (tuple, dict, Known)):
            continue
        some = certain(then)
        is_opaque = isinstance(cell.value, Opaque) and certain(cell.value) == some
        if isinstance(then, (Known, Object, Sequence, Mapped)) or is_opaque:
            continue
        changed = True
        reason = loop.bound if loop.bound and not loop.is_endless else "it changes in a loop"
        result = Opaque(reason, Location(frame.source.path, line), cell.type)
        walk.state.forget(cell, Partial(result.reason, result.location, result.type, some) if some else result)
    return changed
