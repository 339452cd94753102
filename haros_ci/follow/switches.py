# SPDX-License-Identifier: Apache-2.0
"""``switch``: the cases that it may go to, each with those that it falls through to, and their join."""

from __future__ import annotations

from haros_ci import syntax
from haros_ci.follow import early, expressions, statements
from haros_ci.follow.frames import BREAK, NEXT, Frame, Loop
from haros_ci.follow.walk import Walk
from haros_ci.model.location import Location
from haros_ci.syntax import Expression
from haros_ci.values.abstract import Known, Value
from haros_ci.values.state import Writes


def switch(walk: Walk, frame: Frame, statement: syntax.Switch) -> str:
    cases = statement.cases
    value = expressions.evaluate(walk, frame, statement.value)
    branches: list[tuple[str, Writes]] = []
    live: list[int] = []
    default = None
    taken = _taken(walk, frame, value, [case.value for case in cases])
    can_be = taken is None
    for index, case in enumerate(cases):
        if case.value is None:
            default = len(branches)
        if taken is not None and index in taken:
            can_be = True
            live.append(len(branches))
        if not case.body and index + 1 < len(cases):  # the same as the next case
            continue
        branches.append(_case(walk, frame, statement, index, not can_be))
        can_be = taken is None
    if default is None:
        branches.append((NEXT, {}))
        default = len(branches) - 1
    if not branches:
        return NEXT
    return statements.merge(walk, frame, branches, (live or [default]) if taken is not None else None)


def _case(walk: Walk, frame: Frame, statement: syntax.Switch, index: int, is_dead: bool) -> tuple[str, Writes]:
    """Follow a case and those that it falls through to: how it ends, and what it writes."""
    was_dead = frame.is_dead
    frame.is_dead = was_dead or is_dead
    walk.dead += is_dead
    loop, known = Loop(walk.state.mark(), is_switch=True), len(frame.early)
    walk.loops.append(loop)
    ended = NEXT
    with walk.under("switch", statement.text, Location(frame.source.path, statement.line, statement.column)):
        for following in statement.cases[index:]:
            ended = statements.execute(walk, frame, following.body)
            if ended != NEXT:
                break
    walk.loops.pop()
    early.forget(frame, known, loop)
    frame.is_dead = was_dead
    walk.dead -= is_dead
    ways = list(loop.breaks)
    if ended == NEXT:
        ways.append(walk.state.since(loop.mark))
    writes = walk.state.undo(loop.mark)
    if ways:
        walk.state.merge(ways)
        writes = walk.state.undo(loop.mark)
    return NEXT if ways or ended == BREAK else ended, writes


def _taken(walk: Walk, frame: Frame, value: Value, labels: list[Expression | None]) -> set[int] | None:
    """The numbers of the cases that a switch over *value* goes to, else the default's; None if that is not known."""
    if not isinstance(value, Known):
        return None
    found = set()
    for number, label in enumerate(labels):
        expected = expressions.evaluate(walk, frame, label) if label is not None else None
        if expected is not None and not isinstance(expected, Known):
            return None
        if expected is not None and expected.value == value.value:
            found.add(number)
    return found or {number for number, label in enumerate(labels) if label is None}
