# SPDX-License-Identifier: Apache-2.0
"""Loops: gone through turn by turn where that is known and worth it, widened where it is not."""

from __future__ import annotations

from functools import partial
from typing import Any

from haros_ci.link import expressions, statements, static_types
from haros_ci.link.run import BREAK, CONTINUE, NEXT, TURNS, Frame, Loop, Run
from haros_ci.link.state import joined
from haros_ci.link.values import Cell, Known, Mapped, Object, Opaque, Sequence, Value, opaque_of
from haros_ci.model.location import Location
from haros_ci.model.program import Block, Statement

#: Turns that are tried to find what a loop changes.
REHEARSALS = 3
#: Turns around a loop from which on it is widened: 2 for each loop that is gone through, all of them in a rehearsal.
NESTED = 8


def loop(run: Run, frame: Frame, statement: Statement) -> str:
    _, keyword, line, column, text, first, test, body = statement
    frame.scopes.append({})
    current = Loop(run.state.mark())
    try:
        for item in first:
            statements.STATEMENTS[item[0]](run, frame, item)
        with run.under(keyword, text, frame, line, column):
            for turn in range(TURNS if _worthwhile(run, frame, body) else 0):
                if turn or keyword != "do":
                    holds = statements.truth(expressions.evaluate(run, frame, test)) if test is not None else None
                    if holds is None:
                        break
                    if not holds:
                        return _leave(run, current, goes_on=True)
                run.turns *= 2
                ended = _turn(run, frame, current, lambda: statements.execute(run, frame, body))
                run.turns //= 2
                if ended != NEXT:
                    return _leave(run, current, goes_on=False, ended=ended)
            _widened(run, frame, current, body, line, lambda: statements.execute(run, frame, body))
            return _leave(run, current, goes_on=True)
    finally:
        frame.scopes.pop()


def _turn(run: Run, frame: Frame, loop: Loop, body: Any) -> str:
    """One turn of a loop: the ways that continue are joined with the one that comes to its end."""
    was_dead = frame.is_dead
    loop.continues = []
    broken = len(loop.breaks)
    run.loops.append(loop)
    try:
        ended = body()
    finally:
        run.loops.pop()
    died = frame.is_dead and not was_dead
    frame.is_dead = was_dead
    if loop.continues:
        ways = list(loop.continues)
        if ended == NEXT and not died:
            ways.append(run.state.since(loop.mark))
        run.state.undo(loop.mark)
        run.state.merge(ways)
        return NEXT
    if ended in (NEXT, CONTINUE) and not died:
        return NEXT
    if len(loop.breaks) == broken and died:
        frame.is_dead = True  # what can be taken has returned
    return BREAK if died else ended


def _leave(run: Run, loop: Loop, *, goes_on: bool, ended: str = NEXT) -> str:
    """The end of a loop: what was left by break is joined with what came to the end."""
    if not loop.breaks:
        return NEXT if goes_on or ended == BREAK else ended
    ways = list(loop.breaks)
    if goes_on:
        ways.append(run.state.since(loop.mark))
    run.state.undo(loop.mark)
    run.state.merge(ways)
    return NEXT


def _worthwhile(run: Run, frame: Frame, body: Block) -> bool:
    """Whether the turns of a loop are gone through one by one: it may make something or put a list together."""
    if run.relevance.matters(body, frame.source, frame.function):
        return run.turns < NESTED
    return run.turns == 1 and run.relevance.collects(body, frame.source)


def _widened(run: Run, frame: Frame, loop: Loop, block: Block, line: int, body: Any) -> None:
    """A loop of unknown length: whatever a turn changes is not known at the beginning of the next.

    *body* follows a turn. It is rehearsed until it changes nothing more that was known; then, if *block* may make
    something, it is followed for what it makes (not in a rehearsal, which makes nothing).
    """
    matters = run.relevance.matters(block, frame.source, frame.function)
    inner = Loop(run.state.mark())
    ended, writes = NEXT, {}
    for _ in range(1 if run.quiet else REHEARSALS):
        inner = Loop(run.state.mark())
        run.quiet += 1
        run.turns *= NESTED
        try:
            ended = _turn(run, frame, inner, body)
        finally:
            run.quiet -= 1
            run.turns //= NESTED
        writes = run.state.undo(inner.mark)
        changed = False
        for cell, value in [item for way in (writes, *inner.breaks) for item in way.items()]:
            after = joined(cell.value, value)
            if after is cell.value or isinstance(after, (tuple, dict)) or opaque_of(after) is None:
                continue
            if isinstance(after, (Known, Object, Sequence, Mapped)) or isinstance(cell.value, Opaque):
                continue
            changed = True
            run.state.write(cell, Opaque("it changes in a loop", Location(frame.source.path, line), cell.type))
        if not changed:
            break
    if matters and not run.quiet:
        inner = Loop(run.state.mark())
        ended = _turn(run, frame, inner, body)
        writes = run.state.undo(inner.mark)
    before = run.state.since(loop.mark)
    loop.breaks += [{**before, **way} for way in inner.breaks]
    run.state.merge([{}, writes] if ended == NEXT else [{}])


def each(run: Run, frame: Frame, statement: Statement) -> str:
    _, line, column, text, name, kind, iterable, body = statement
    items = static_types.elements(run, frame, iterable)
    resolved = run.type_in(kind, frame)

    def turn(value: Value | Cell) -> str:
        frame.scopes.append({})
        try:
            if isinstance(value, Cell) and "&" in resolved[2]:
                frame.declare(name, value)
            else:
                inner = value.value if isinstance(value, Cell) else value
                frame.declare(name, Cell(inner, resolved if resolved[0] not in ("", "auto") else None))
            return statements.execute(run, frame, body)
        finally:
            frame.scopes.pop()

    current = Loop(run.state.mark())
    with run.under("for", text, frame, line, column):
        unknown: Value | None = None
        if items is None:
            kind_ = static_types.element_type(run, frame, iterable) if resolved[0] in ("", "auto") else resolved
            unknown = Opaque("an element of a list that is not known", Location(frame.source.path, line), kind_)
        elif run.turns >= NESTED or len(items) > TURNS * 4:
            unknown = Opaque("an element in nested loops", Location(frame.source.path, line), resolved)
        if unknown is not None:
            _widened(run, frame, current, body, line, partial(turn, unknown))
            return _leave(run, current, goes_on=True)
        assert items is not None
        for item in items:
            run.turns *= 2
            ended = _turn(run, frame, current, partial(turn, item))
            run.turns //= 2
            if ended != NEXT:
                return _leave(run, current, goes_on=False, ended=ended)
    return _leave(run, current, goes_on=True)
