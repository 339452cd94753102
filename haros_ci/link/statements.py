# SPDX-License-Identifier: Apache-2.0
"""Statements, followed on all paths: branches are tried one by one and joined, loops are turned or widened."""

from __future__ import annotations

from functools import partial
from typing import Any

from haros_ci.link import construct, expressions, lookup, static_types
from haros_ci.link.run import TURNS, Frame, Loop, Run
from haros_ci.link.state import Writes, joined
from haros_ci.link.values import Cell, Known, Mapped, Object, Opaque, Sequence, Value, opaque_of
from haros_ci.model.location import Location
from haros_ci.model.program import Block, Statement

#: How a block ends: it falls through, or it leaves in one of these ways.
NEXT, RETURN, BREAK, CONTINUE, THROW = "next", "return", "break", "continue", "throw"


#: Turns that are tried to find what a loop changes.
REHEARSALS = 3
#: What holds in the script that is started, and in no other module: no condition at all.
MAIN_GUARD = ('__name__=="__main__"', '"__main__"==__name__')


def execute(run: Run, frame: Frame, block: Block) -> str:
    """Follow the statements of *block* in a scope of their own; say how it ends."""
    frame.scopes.append({})
    try:
        for statement in block:
            run.step()
            ended = STATEMENTS[statement[0]](run, frame, statement)
            if ended != NEXT:
                return ended
        return NEXT
    finally:
        frame.scopes.pop()


def truth(value: Value) -> bool | None:
    """Whether a condition holds, None if that is not known."""
    if isinstance(value, Known):
        return bool(value.value)
    if isinstance(value, (Object,)):
        return True
    if isinstance(value, Sequence) and isinstance(value.content.value, tuple):
        return bool(value.content.value)
    return None


def _do(run: Run, frame: Frame, statement: Statement) -> str:
    expressions.evaluate(run, frame, statement[1])
    return NEXT


def _variable(run: Run, frame: Frame, statement: Statement) -> str:
    _, name, kind, init, line, column = statement
    construct.declare(run, frame, name, kind, init, line, column)
    return NEXT


def _if(run: Run, frame: Frame, statement: Statement) -> str:
    _, line, column, text, test, then, else_line, else_column, other = statement
    if text.replace("'", '"').replace(" ", "").strip("()") in MAIN_GUARD and frame.source.program.language == "python":
        return execute(run, frame, then) if frame.source.path in run.files else NEXT
    holds = truth(expressions.evaluate(run, frame, test))
    branches = []
    mark = run.state.mark()
    with run.under("if", text, frame, line, column):
        ended = _followed(run, frame, then, holds is not False)
    branches.append((ended, run.state.undo(mark)))
    if else_line:
        path = frame.source.path
        run.pairs[Location(path, else_line, else_column)] = Location(path, line, column)
        with run.under("else", text, frame, else_line, else_column):
            ended = _followed(run, frame, other, holds is not True)
        branches.append((ended, run.state.undo(mark)))
    else:
        branches.append((NEXT, {}))
    return _merge(run, frame, branches, None if holds is None else [0 if holds else 1])


def _followed(run: Run, frame: Frame, block: Block, can_be: bool) -> str:
    """Follow a branch; what one that cannot be taken returns does not count."""
    before = frame.is_dead
    frame.is_dead = before or not can_be
    try:
        return execute(run, frame, block)
    finally:
        frame.is_dead = before


def _merge(run: Run, frame: Frame, branches: list[tuple[str, Writes]], live: list[int] | None) -> str:
    """Go on with the join of the branches that can be taken; one that cannot is gone through for what it makes only."""
    chosen = branches if live is None else [branches[i] for i in live]
    going = [writes for ended, writes in chosen if ended == NEXT]
    if going:
        run.state.merge(going)
        return NEXT
    rest = [writes for ended, writes in branches if ended == NEXT]
    if rest:
        frame.is_dead = True
        run.state.merge(rest)
        return NEXT
    ends = {ended for ended, _ in chosen}
    return next((ended for ended in (CONTINUE, BREAK, RETURN, THROW) if ended in ends), NEXT)


def _loop(run: Run, frame: Frame, statement: Statement) -> str:
    _, keyword, line, column, text, first, test, body = statement
    frame.scopes.append({})
    loop = Loop(run.state.mark())
    try:
        for item in first:
            STATEMENTS[item[0]](run, frame, item)
        with run.under(keyword, text, frame, line, column):
            for turn in range(TURNS if _worthwhile(run, frame, body) else 0):
                if turn or keyword != "do":
                    holds = truth(expressions.evaluate(run, frame, test)) if test is not None else None
                    if holds is None:
                        break
                    if not holds:
                        return _leave(run, loop, goes_on=True)
                run.turns *= 2
                ended = _turn(run, frame, loop, lambda: execute(run, frame, body))
                run.turns //= 2
                if ended != NEXT:
                    return _leave(run, loop, goes_on=False, ended=ended)
            _widened(
                run, frame, loop, lambda: execute(run, frame, body), line, run.relevance.matters(body, frame.source, frame.function)
            )
            return _leave(run, loop, goes_on=True)
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
        return run.turns < 8
    return run.turns == 1 and run.relevance.collects(body, frame.source)


def _widened(run: Run, frame: Frame, loop: Loop, body: Any, line: int, matters: bool) -> None:
    """A loop of unknown length: whatever a turn changes is not known at the beginning of the next.

    Rehearsed until a turn changes nothing more that was known; then, if the body *matters*, followed for what it makes.
    """
    inner = Loop(run.state.mark())
    ended, writes = NEXT, {}
    for _ in range(1 if run.quiet else REHEARSALS):
        inner = Loop(run.state.mark())
        run.quiet += 1
        try:
            ended = _turn(run, frame, inner, body)
        finally:
            run.quiet -= 1
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
    if matters:
        inner = Loop(run.state.mark())
        ended = _turn(run, frame, inner, body)
        writes = run.state.undo(inner.mark)
    before = run.state.since(loop.mark)
    loop.breaks += [{**before, **way} for way in inner.breaks]
    run.state.merge([{}, writes] if ended == NEXT else [{}])


def _each(run: Run, frame: Frame, statement: Statement) -> str:
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
            return execute(run, frame, body)
        finally:
            frame.scopes.pop()

    loop = Loop(run.state.mark())
    with run.under("for", text, frame, line, column):
        if items is None:
            kind_ = static_types.element_type(run, frame, iterable) if resolved[0] in ("", "auto") else resolved
            unknown = Opaque("an element of a list that is not known", Location(frame.source.path, line), kind_)
            _widened(run, frame, loop, lambda: turn(unknown), line, run.relevance.matters(body, frame.source, frame.function))
            return _leave(run, loop, goes_on=True)
        if run.turns >= 8 or len(items) > TURNS * 4:
            unknown = Opaque("an element in nested loops", Location(frame.source.path, line), resolved)
            _widened(run, frame, loop, lambda: turn(unknown), line, run.relevance.matters(body, frame.source, frame.function))
            return _leave(run, loop, goes_on=True)
        for item in items:
            run.turns *= 2
            ended = _turn(run, frame, loop, partial(turn, item))
            run.turns //= 2
            if ended != NEXT:
                return _leave(run, loop, goes_on=False, ended=ended)
    return _leave(run, loop, goes_on=True)


def _switch(run: Run, frame: Frame, statement: Statement) -> str:
    _, line, column, text, test, cases = statement
    value = expressions.evaluate(run, frame, test)
    branches: list[tuple[str, Writes]] = []
    live: list[int] = []
    default = None
    known = isinstance(value, Known)
    for index, (label, _) in enumerate(cases):
        was_dead = frame.is_dead
        loop = Loop(run.state.mark(), is_switch=True)
        run.loops.append(loop)
        ended = NEXT
        with run.under("switch", text, frame, line, column):
            for _, block in cases[index:]:
                ended = execute(run, frame, block)
                if ended != NEXT:
                    break
        run.loops.pop()
        frame.is_dead = was_dead
        ways = list(loop.breaks)
        if ended == NEXT:
            ways.append(run.state.since(loop.mark))
        writes = run.state.undo(loop.mark)
        if ways:
            run.state.merge(ways)
            writes = run.state.undo(loop.mark)
        branches.append((NEXT if ways or ended == BREAK else ended, writes))
        if label is None:
            default = index
        elif isinstance(value, Known):
            wanted = expressions.evaluate(run, frame, label)
            if not isinstance(wanted, Known):
                known = False
            elif wanted.value == value.value:
                live.append(index)
    if default is None:
        branches.append((NEXT, {}))
        default = len(branches) - 1
    if not branches:
        return NEXT
    return _merge(run, frame, branches, (live or [default]) if known else None)


def _try(run: Run, frame: Frame, statement: Statement) -> str:
    """A handler begins with anything that the block may have done by then; afterwards counts what it assigns itself.

    What else the block has left undone where it threw is not thought of: most never throw.
    """
    _, block, handlers = statement
    mark = run.state.mark()
    ended = execute(run, frame, block)
    after = run.state.undo(mark)
    branches: list[tuple[str, Writes]] = [(ended, after)]
    for line, column, text, name, kind, handler in handlers:
        start = run.state.mark()
        for cell, value in after.items():
            run.state.write(cell, joined(cell.value, value))
        begun = run.state.mark()
        frame.scopes.append({})
        if name:
            frame.declare(name, Cell(run.opaque("an exception", frame, line, run.type_in(kind, frame))))
        with run.under("catch", text, frame, line, column):
            how = execute(run, frame, handler)
        frame.scopes.pop()
        own = run.state.since(begun)
        run.state.undo(start)
        branches.append((how, {**after, **own}))
    return _merge(run, frame, branches, None)


def _preprocessor(run: Run, frame: Frame, statement: Statement) -> str:
    branches: list[tuple[str, Writes]] = []
    for line, column, text, block in statement[1]:
        mark = run.state.mark()
        declared: dict[str, Cell] = {}
        with run.under("#if", text, frame, line, column):
            frame.scopes.append(declared)
            ended = NEXT
            for item in block:
                run.step()
                ended = STATEMENTS[item[0]](run, frame, item)
                if ended != NEXT:
                    break
            frame.scopes.pop()
        for name, cell in declared.items():  # no scope of its own: what it declares is there afterwards
            frame.scopes[-1].setdefault(name, cell)
        branches.append((ended, run.state.undo(mark)))
    if not any(text.startswith("#else") for _, _, text, _ in statement[1]):
        branches.append((NEXT, {}))
    for _, writes in branches:  # what one branch alone declares keeps its value
        for cell in writes:
            if cell in frame.scopes[-1].values():
                for _, other in branches:
                    other.setdefault(cell, writes[cell])
    return _merge(run, frame, branches, None)


def _return(run: Run, frame: Frame, statement: Statement) -> str:
    value = expressions.evaluate(run, frame, statement[1]) if statement[1] is not None else Known(None)
    if not frame.is_dead:
        frame.returned.append(value)
        frame.exits.append(run.state.since(frame.mark))
    return RETURN


def _throw(run: Run, frame: Frame, statement: Statement) -> str:
    if statement[1] is not None:
        expressions.evaluate(run, frame, statement[1])
    return THROW


def _break(run: Run, frame: Frame, statement: Statement) -> str:
    if run.loops and not frame.is_dead:
        run.loops[-1].breaks.append(run.state.since(run.loops[-1].mark))
    return BREAK


def _continue(run: Run, frame: Frame, statement: Statement) -> str:
    if not frame.is_dead:
        for loop in reversed(run.loops):
            if not loop.is_switch:
                loop.continues.append(run.state.since(loop.mark))
                break
    return CONTINUE


def _define(run: Run, frame: Frame, statement: Statement) -> str:
    from haros_ci.link.values import Callable

    function = frame.source.program.functions[statement[2]]
    frame.declare(statement[1], Cell(Callable(frame.source, function, frame.this, frame=frame)))
    return NEXT


def _class(run: Run, frame: Frame, statement: Statement) -> str:
    found = run.class_of(statement[1], frame.source)
    if found is not None:
        from haros_ci.link.values import ClassValue

        frame.declare(statement[1].rpartition(frame.source.separator)[2], Cell(ClassValue(*found)))
    return NEXT


def _import(run: Run, frame: Frame, statement: Statement) -> str:
    frame.declare(statement[1], Cell(lookup.imported(run, frame, statement[2])))
    return NEXT


STATEMENTS = {
    "do": _do,
    "var": _variable,
    "if": _if,
    "loop": _loop,
    "each": _each,
    "switch": _switch,
    "try": _try,
    "pre": _preprocessor,
    "block": lambda run, frame, s: execute(run, frame, s[1]),
    "return": _return,
    "break": _break,
    "continue": _continue,
    "throw": _throw,
    "def": _define,
    "class": _class,
    "import": _import,
}
