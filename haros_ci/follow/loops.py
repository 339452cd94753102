# SPDX-License-Identifier: Apache-2.0
"""Loops: gone through turn by turn where that is known and worth it, widened where it is not."""

from __future__ import annotations

from collections.abc import Callable as Function_
from functools import partial, reduce

from haros_ci import syntax
from haros_ci.follow import (
    beside,
    expressions,
    follow,
    lookup,
    loop_copies,
    statements,
    static_types,
    thrown,
    unknown_calls,
    widening,
)
from haros_ci.follow.frames import BOUND, BREAK, NEXT, Frame, Loop
from haros_ci.follow.libraries import gazebo
from haros_ci.follow.made import forget_dead, go_back, keep
from haros_ci.follow.walk import TURNS, Walk
from haros_ci.model.location import Location
from haros_ci.syntax import Block, Expression
from haros_ci.values.abstract import Callable, Cell, Object, Opaque, Pointer, Sequence, Value, join, tick

#: Steps after which the turns of a loop are no longer gone through one by one; those of rehearsals in it that do not count.
LONG, REHEARSED = 2_000, 8_000
#: Why a turn may not be taken.
SOME_PATHS = "what it is made for is an element of the list on some paths only"
UNORDERED = "the loop ends at an element of the list, of which the order is not known"
#: Why a value is not known after turns that are not gone through one by one, where a bound is reached.
TOO_LONG = f"{BOUND}{LONG} steps for the turns of a loop is reached"
TOO_MANY = f"{BOUND}{TURNS} turns of a loop is reached"
TOO_MANY_ITEMS = f"{BOUND}{TURNS * 4} elements of a loop is reached"
TOO_DEEP = f"{BOUND}loops in loops is reached"
CHANGED = "an element of a list that is changed while it is gone through"
#: Elements that turns change which are not gone through one by one: what these leave of more is not known.
CHANGING = 8
#: Why an element of a list that is empty as things are may be there all the same.
NAMED = "the list is a matter of parameters"


def loop(walk: Walk, frame: Frame, statement: syntax.Loop) -> str:
    keyword, line, column, text = statement.keyword, statement.line, statement.column, statement.text
    first, test, body = statement.before, statement.test, statement.body
    frame.scopes.append({})
    current = Loop(walk.state.mark())
    known = len(walk.made)

    step = body[-1] if body and type(body[-1]) is syntax.Step else None

    def one() -> str:
        return statements.execute(walk, frame, body[:-1] if step else body)

    def after() -> None:
        if step is not None:
            expressions.evaluate(walk, frame, step.value)

    def after_and_test() -> None:
        after()
        if test is not None:
            with widening.first_of_do(walk, keyword == "do"):
                expressions.evaluate(walk, frame, test)

    try:
        for item in first:
            statements.STATEMENTS[type(item)](walk, frame, item)
        begins = keyword == "do" or _holds(walk, frame, test)  # what stands in the test is done in any case
        with walk.under(keyword, text, Location(frame.source.path, line, column)):
            ended = _turned(walk, frame, statement, current, begins, one, after)
            if ended is not None:
                return ended
            current.turn = 0
            matters = _matters(walk, frame, body, test)
            widening.widened(walk, frame, current, matters, line, one, after_and_test)
            return _leave(walk, current, goes_on=True)
    finally:
        frame.scopes.pop()
        forget_dead(walk, known)


def _turned(
    walk: Walk,
    frame: Frame,
    statement: syntax.Loop,
    loop: Loop,
    begins: bool | None,
    one: Function_[[], str],
    after: Function_[[], None],
) -> str | None:
    """Go through a loop turn by turn, as long as that is known and worth it: how it ends; None if that is not seen.

    *begins* says whether it has a first turn, as far as that is known.
    """
    test, before = statement.test, (walk.steps - walk.aside, walk.quiet_steps)
    worthwhile = _worthwhile(walk, frame, statement.body, test)
    loop.is_endless = thrown.is_endless(test)
    if beside.come_between_turns(walk):
        loop.runs_on = loop.is_endless or thrown.asks_whether_it_goes_on(test)
    is_kept = loop.is_endless and worthwhile and not walk.quiet
    start, first = (keep(walk), walk.state.mark()) if is_kept else None, 0
    for turn in range(TURNS):
        is_sure = statement.keyword == "do" and turn < 2  # of the test that ends the first turn
        with widening.first_of_do(walk, is_sure):
            holds = _holds(walk, frame, test) if turn else begins
        if not holds:
            return _leave(walk, loop, goes_on=True) if holds is False else None
        if not worthwhile or _is_long(walk, loop, *before):
            break
        if loop.runs_on:
            follow.meanwhile(walk, frame)
        there, begun, mark = walk.extent(), tick(), walk.state.mark()
        with widening.first_of_do(walk, is_sure and not turn):
            ended = _counted(walk, frame, loop, turn, one, after)
        if ended != NEXT:
            return _leave(walk, loop, goes_on=False, ended=ended)
        first = first or len(walk.made)
        if walk.extent() == there and not loop.continues and walk.state.is_as_at(mark, begun):
            break  # the next turn does the same
    else:
        loop.bound = TOO_MANY
    if start is not None and len(walk.made) > first:  # which of its turns there are is not known
        go_back(walk, start[0])
        walk.state.undo(start[1])
        loop.breaks.clear()
    return None


def _is_long(walk: Walk, loop: Loop, steps: int, rehearsed: int) -> bool:
    """Whether the turns since that many *steps*, of which some were *rehearsed*, are enough.

    What is rehearsed in a loop (a function that is given away) does not count, unless it is very much, or the loop itself
    is, or half of what rehearsals of the node may take is gone.
    """
    counts = walk.quiet or walk.quiet_steps > walk.most // 2
    taken, aside = walk.steps - walk.aside - steps, 0 if counts else walk.quiet_steps - rehearsed
    if taken - aside <= LONG and aside <= REHEARSED:
        return False
    loop.bound = TOO_LONG
    return True


def _holds(walk: Walk, frame: Frame, test: Expression | None) -> bool | None:
    """Whether the test of a loop is true; None if that is not known, or there is none."""
    if test is None:
        return None
    return expressions.holds(walk, frame, test, expressions.evaluate(walk, frame, test))


def _counted(
    walk: Walk,
    frame: Frame,
    loop: Loop,
    number: int,
    body: Function_[[], str],
    after: Function_[[], None] | None = None,
) -> str:
    """The turn of that *number*, where they are gone through one by one."""
    walk.turns *= 2
    walk.turning.append(loop)
    loop.turn = number
    try:
        return widening.turn(walk, frame, loop, body, after)
    finally:
        walk.turning.pop()
        walk.turns //= 2


def _leave(walk: Walk, loop: Loop, *, goes_on: bool, ended: str = NEXT) -> str:
    """The end of a loop: what was left by break is joined with what came to the end."""
    if not loop.breaks:
        return NEXT if goes_on or ended == BREAK else ended
    ways = list(loop.breaks)
    if goes_on:
        ways.append(walk.state.since(loop.mark))
    walk.state.undo(loop.mark)
    walk.state.merge(ways)
    return NEXT


def _matters(walk: Walk, frame: Frame, body: Block, test: Expression | None) -> bool:
    blocks = (body,) if test is None else (body, test)
    function = frame.function
    if function is None and frame.source.separator == ".":  # the module's variables may hold functions
        function = next((function for function in frame.source.program.functions if function.kind == "module"), None)
    return any(walk.relevance.matters(block, frame.source, function) for block in blocks)


def _worthwhile(walk: Walk, frame: Frame, body: Block, test: Expression | None) -> bool:
    """Whether the turns of a loop are gone through one by one: it may make something or put a list together."""
    if _matters(walk, frame, body, test):
        return walk.turns < widening.NESTED
    if (
        walk.turns < widening.NESTED
        and test is not None
        and type(test) is syntax.Operation
        and walk.relevance.edits(body, frame.source)
    ):
        return True
    return walk.turns == 1 and (walk.relevance.collects(body, frame.source) or _goes_through(walk, frame, test))


def _goes_through(walk: Walk, frame: Frame, test: Expression | None) -> bool:
    """Whether a loop goes from one element of a description to the next: ``while (e)``, ``while (e != nullptr)``."""
    items = test.operands if type(test) is syntax.Operation else (test,)
    cells = (lookup.named_cell(walk, frame, item.name) for item in items if type(item) is syntax.Name)
    return any(cell is not None and gazebo.is_one_of_several(cell.value) for cell in cells)


def for_each(walk: Walk, frame: Frame, statement: syntax.Each) -> str:
    """The turns for the elements of a container; a text whose characters a turn of C++ sets is not known behind it."""
    text = loop_copies.changed_text(walk, frame, statement)
    ended = _each(walk, frame, statement)
    if text is not None:
        walk.state.write(text, walk.opaque("its characters are changed", frame, statement.line, text.type))
    return ended


def _each(walk: Walk, frame: Frame, statement: syntax.Each) -> str:
    line, column, text = statement.line, statement.column, statement.text
    iterable, body = statement.iterable, statement.body
    items, others, is_ordered = static_types.some_elements(walk, frame, iterable)
    if walk.is_raised:
        return NEXT
    listed, before = _listed(walk, frame, iterable) if items else (None, None)
    resolved = walk.type_in(statement.type, frame)
    turn = partial(loop_copies.turn, walk, frame, statement, resolved)
    current = Loop(walk.state.mark())
    with walk.under("for", text, Location(frame.source.path, line, column)):
        unknown: Value | None = None
        if others is not None:
            kind_ = loop_copies.type_of_element(walk, frame, iterable, resolved)
            unknown = Opaque("an element of a list that is not known", Location(frame.source.path, line), kind_)
        doubt = None
        loads = walk.context.of_base is not None and walk.relevance.loads(body, frame.source)
        if others is None and not items and loads:
            doubt = NAMED
            unknown = Opaque(
                NAMED, Location(frame.source.path, line), loop_copies.type_of_element(walk, frame, iterable, resolved)
            )
        if items and (walk.turns >= widening.NESTED or len(items) > TURNS * 4):
            unknown = unknown or _one_function(items)
            unknown = unknown or Opaque(_too_much(walk), Location(frame.source.path, line), resolved)
            if loop_copies.changes_elements(walk, statement, resolved, items):
                _changed_elements(walk, frame, current, items, turn)
            items = []
        possible, reason = list[Value | Cell](others or ()), SOME_PATHS
        ended = _one_by_one(walk, frame, current, items, turn, is_ordered)
        if ended == UNORDERED:
            possible, reason = [*possible, *items], UNORDERED
        elif ended != NEXT:
            return _leave(walk, current, goes_on=False, ended=ended)
        if listed is not None and listed.content.value is not before and unknown is None:
            unknown = Opaque(CHANGED, Location(frame.source.path, line), resolved)
        matters = _matters(walk, frame, body, None) if possible or unknown is not None else False
        if possible and (unknown is None or (matters and not walk.quiet)):
            current.turn = 0
            _possible(walk, frame, current, [partial(turn, item) for item in possible], reason)
        if unknown is not None:
            current.turn = 0
            with walk.doubted(doubt):
                widening.widened(walk, frame, current, loads or matters, line, partial(turn, unknown))
    return _leave(walk, current, goes_on=True)


def _one_by_one(
    walk: Walk,
    frame: Frame,
    loop: Loop,
    items: list[Value | Cell],
    turn: Function_[[Value | Cell], str],
    is_ordered: bool,
) -> str:
    """How the turns for the *items* end; ``UNORDERED`` where one ends the loop, and it is not known which comes first: then none is done."""
    known, kept = len(walk.made), None if is_ordered else keep(walk)
    for number, item in enumerate(items):
        ended = _counted(walk, frame, loop, number, partial(turn, item))
        forget_dead(walk, known)
        if ended == NEXT:
            continue
        if kept is None:
            return ended
        go_back(walk, kept)
        walk.state.undo(loop.mark)
        loop.breaks.clear()
        return UNORDERED
    return NEXT


def _changed_elements(
    walk: Walk, frame: Frame, loop: Loop, items: list[Value | Cell], turn: Function_[[Value | Cell], str]
) -> None:
    """What turns may change in elements that are known, where the turns are not gone through one by one."""
    walk.quiet += 1
    try:
        _possible(walk, frame, loop, [partial(turn, item) for item in items[:CHANGING]], SOME_PATHS)
    finally:
        walk.quiet -= 1
    for item in items[CHANGING:]:
        cell = item if isinstance(item, Cell) else Cell(item)
        held = cell.value.cell.value if isinstance(cell.value, Pointer) else cell.value
        for changed in held.fields.values() if isinstance(held, Object) else (cell,):
            unknown_calls.forget(walk, frame, changed, CHANGED)


def _listed(walk: Walk, frame: Frame, iterable: Expression) -> tuple[Sequence | None, object]:
    """The list of Python that a name stands for, and its elements: a loop sees what its turns change in it."""
    is_named = frame.source.separator == "." and isinstance(iterable, (syntax.Name, syntax.Member))
    cell = expressions.cell_of(walk, frame, iterable) if is_named else None
    value = cell.value if cell is not None else None
    return (value, value.content.value) if isinstance(value, Sequence) else (None, None)


def _one_function(items: list[Value | Cell]) -> Value | None:
    """One of the *items*, if all are functions, and few enough to be kept apart: what is called is one of them."""
    values = [item.value if isinstance(item, Cell) else item for item in items]
    if not all(isinstance(value, Callable) for value in values):
        return None
    joined = reduce(join, values)
    return None if isinstance(joined, Opaque) else joined


def _too_much(walk: Walk) -> str:
    """Why the elements of a list that is known are not gone through."""
    return TOO_DEEP if walk.turns >= widening.NESTED else TOO_MANY_ITEMS


def _possible(walk: Walk, frame: Frame, loop: Loop, turns: list[Function_[[], str]], reason: str) -> None:
    """Turns that there may be, for the *reason* given: what these make and leave behind may be so."""
    mark = walk.state.mark()
    for turn in turns:
        with walk.doubted(reason):
            ended = widening.turn(walk, frame, loop, turn)
        writes = walk.state.undo(mark)
        walk.state.merge([{}, writes] if ended == NEXT else [{}])
        mark = walk.state.mark()
