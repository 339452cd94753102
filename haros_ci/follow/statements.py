# SPDX-License-Identifier: Apache-2.0
"""Statements, followed on all paths: branches are tried one by one and joined, loops are turned or widened."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import nullcontext
from typing import TypeVar, cast

from haros_ci import syntax
from haros_ci.follow import (
    attempts,
    construct,
    conversions,
    early,
    expressions,
    guarded,
    library_calls,
    loops,
    members,
    narrowing,
    python_names,
    registering,
    switches,
    thrown,
)
from haros_ci.follow.frames import BREAK, CONTINUE, NEXT, RAISED, RETURN, THROW, Frame
from haros_ci.follow.walk import Walk
from haros_ci.model.location import Location
from haros_ci.syntax import Block, Statement
from haros_ci.values import abstract
from haros_ci.values.abstract import Cell, ClassValue, Known, Library, tick
from haros_ci.values.state import Writes

#: What holds in the script that is started, and in no other module: no condition at all.
MAIN_GUARD = ('__name__=="__main__"', '"__main__"==__name__')
_Kind = TypeVar("_Kind", bound=Statement)
_Execute = Callable[[Walk, Frame, Statement], str]


def execute(walk: Walk, frame: Frame, block: Block) -> str:
    """Follow the statements of *block* in a scope of their own; say how it ends."""
    frame.scopes.append({})
    try:
        return in_place(walk, frame, block)
    finally:
        frame.scopes.pop()


def in_place(walk: Walk, frame: Frame, block: Block) -> str:
    """The same in the scope that there is.

    What stands behind an early way out does so under its opposite, to the end of the block.
    """
    depth, doubts, holding = len(walk.conditions), len(walk.doubts), walk.holding
    try:
        for number in range(len(block)):
            walk.step()
            known = len(frame.early)
            ended = _judged(walk, frame, block, number)
            if walk.is_raised:
                walk.is_raised = False
                return RAISED
            if ended != NEXT:
                if ended == RETURN and len(frame.early) > known and any(map(early.shuts_down, block[:number])):
                    early.drop(frame, known)
                return ended
            if len(frame.early) > known:
                early.stand_behind(walk, frame, known)
        return NEXT
    finally:
        del walk.conditions[depth:], walk.doubts[doubts:]
        walk.holding = holding


def _judged(walk: Walk, frame: Frame, block: Block, number: int) -> str:
    """Follow one statement of a block; the next one may end the program where it fails."""
    statement = block[number]
    if number + 1 < len(block) and early.judged_next(walk, frame, statement, block[number + 1]):
        before, walk.judged = walk.judged, len(walk.active)
        try:
            return STATEMENTS[type(statement)](walk, frame, statement)
        finally:
            walk.judged = before
    return STATEMENTS[type(statement)](walk, frame, statement)


def _do(walk: Walk, frame: Frame, statement: syntax.Do) -> str:
    expressions.evaluate(walk, frame, statement.value)
    return THROW if library_calls.ends_the_program(walk, frame, statement.value) else NEXT


def _variable(walk: Walk, frame: Frame, statement: syntax.Variable) -> str:
    construct.declare(walk, frame, statement)
    return NEXT


def _static(walk: Walk, frame: Frame, statement: syntax.Static) -> str:
    """A variable that is made once. What is made in a rehearsal is kept if it is plain data: all else has made nothing of note."""
    variable = statement.statement
    name = variable.name
    kinds = (kind.name if type(kind) is syntax.Type else "" for kind in frame.templates.values())
    key = (" ".join((frame.source.path, str(variable.line), str(variable.column), *kinds)), name)
    cell = walk.globals.get(key) or walk.statics.get(key)
    if cell is None:
        mark, begun = walk.state.mark(), tick()
        _variable(walk, frame, variable)
        walk.state.settle(mark, begun)
        cell = frame.scopes[-1].get(name)
        is_plain = cell is not None and isinstance(cell.value, Known) and _starts_as_written(variable)
        if cell is None or (walk.quiet and not is_plain):
            return NEXT
        (walk.globals if is_plain else walk.statics)[key] = cell
        if is_plain:
            walk.lasting.add(cell)
        function = frame.function
        if function is not None and not frame.templates and walk.relevance.matters(statement, frame.source, function):
            walk.relevance = walk.relevance.after(statement, function)
    frame.scopes[-1][name] = cell
    return NEXT


def _starts_as_written(variable: syntax.Variable) -> bool:
    """Whether a variable begins with nothing or with a literal, so with the same whoever comes to it first."""
    literals = (syntax.Boolean, syntax.Number, syntax.String)
    return all(isinstance(literal, literals) for literal in syntax.started(variable.init))


def _global(walk: Walk, frame: Frame, statement: syntax.Global) -> str:
    scope = python_names.module_frame(walk, frame.source).scopes[0]
    for name in statement.names:
        frame.scopes[0][name] = scope.setdefault(name, Cell(walk.opaque(f"{name} is not set", frame)))
    return NEXT


def _nonlocal(walk: Walk, frame: Frame, statement: syntax.Nonlocal) -> str:
    for name in statement.names:
        cell = frame.outer.find(name) if frame.outer is not None else None
        frame.scopes[0][name] = cell or Cell(walk.opaque(f"{name} is not set", frame))
    return NEXT


def _if(walk: Walk, frame: Frame, statement: syntax.If) -> str:
    written = statement.text.replace("'", '"').replace(" ", "").strip("()")
    if written in MAIN_GUARD and frame.source.program.language == "python":
        is_run = walk.is_program and frame.source.path in walk.files
        return execute(walk, frame, statement.then) if is_run else NEXT
    asked = len(walk.absent)
    holds = _tested(walk, frame, statement)
    if walk.is_raised:
        return NEXT
    lacking = tuple(walk.absent[asked:])
    if holds is not None and walk.outer is not None:  # what a wrapper does not do as things are is nobody's
        return execute(walk, frame, statement.then if holds else statement.other)
    if statement.else_line:
        path = frame.source.path
        one, other = (
            Location(path, statement.line, statement.column),
            Location(path, statement.else_line, statement.else_column),
        )
        walk.pairs[other], walk.pairs[one] = one, other
    branches = [_side(walk, frame, statement, True, holds, lacking)]
    branches.append(_side(walk, frame, statement, False, holds, lacking) if statement.else_line else (NEXT, {}))
    return merge(walk, frame, branches, None if holds is None else [0 if holds else 1])


def _side(
    walk: Walk, frame: Frame, statement: syntax.If, is_then: bool, holds: bool | None, lacking: tuple[str, ...]
) -> tuple[str, Writes]:
    """Follow one branch of an ``if``: how it ends, and what it writes. *holds* is whether its test does, as far as that is known."""
    mark, known = walk.state.mark(), len(frame.early)
    at = (statement.line, statement.column) if is_then else (statement.else_line, statement.else_column)
    place = Location(frame.source.path, *at)
    narrower = narrowing.narrowed(walk, frame, statement.test) if is_then and holds is None else nullcontext()
    with walk.under("if" if is_then else "else", statement.text, place, holds=holds is is_then), narrower:
        block = statement.then if is_then else statement.other
        ended = follow_branch(walk, frame, block, holds is None or holds is is_then, lacking=lacking)
    writes = walk.state.undo(mark)
    is_new = len(frame.early) > known and holds is not is_then
    if is_new and early.is_aside(walk, frame, statement.test, is_then):
        early.drop(frame, known)
    return ended, writes


def _tested(walk: Walk, frame: Frame, statement: syntax.If) -> bool | None:
    """Whether the test of an ``if`` holds; the program may end where what it calls fails."""
    test, before = statement.test, walk.judged
    if early.judged(walk, frame, test, statement.then, statement.other):
        walk.judged = len(walk.active)
    try:
        return expressions.holds(walk, frame, test, expressions.evaluate(walk, frame, test))
    finally:
        walk.judged = before


def follow_branch(
    walk: Walk,
    frame: Frame,
    block: Block,
    can_be: bool,
    run: Callable[[Walk, Frame, Block], str] = execute,
    lacking: tuple[str, ...] = (),
) -> str:
    """Follow a branch by *run*; what one that cannot be taken returns does not count. *lacking* are parameters that are not set, as its condition asks."""
    before, known = frame.is_dead, len(walk.lacking)
    frame.is_dead = before or not can_be
    walk.dead += not can_be
    if lacking and not can_be:
        walk.lacking.append(lacking)
    try:
        ended = run(walk, frame, block)
        return RETURN if ended == NEXT and frame.is_dead and not before and can_be else ended
    finally:
        frame.is_dead = before
        walk.dead -= not can_be
        del walk.lacking[known:]


def merge(walk: Walk, frame: Frame, branches: list[tuple[str, Writes]], live: list[int] | None) -> str:
    """Go on with the join of the branches that can be taken; one that cannot is gone through for what it makes only."""
    chosen = branches if live is None else [branches[i] for i in live]
    going = [writes for ended, writes in chosen if ended == NEXT]
    if going:
        walk.state.merge(going)
        return NEXT
    rest = [writes for ended, writes in branches if ended == NEXT]
    if rest and not (walk.loops and walk.loops[-1].turn):  # what no turn reaches was gone through in the first
        frame.is_dead = True
        walk.state.merge(rest)
        return NEXT
    ends = {ended for ended, _ in chosen}
    return next((ended for ended in (CONTINUE, BREAK, RETURN, THROW, RAISED) if ended in ends), NEXT)


def _return(walk: Walk, frame: Frame, statement: syntax.Return) -> str:
    before = walk.judged
    walk.judged = len(walk.active) if frame.is_start or early.is_over(walk, frame) else before
    value = expressions.evaluate(walk, frame, statement.value) if statement.value is not None else Known(None)
    walk.judged = before
    if type(statement.value) is syntax.ListLiteral and frame.function is not None and frame.source.separator != ".":
        value = conversions.in_braces(value, walk.type_in(frame.function.returns, frame))
    early.returns(walk, frame, value, statement.value is None)
    if not frame.is_dead and not walk.is_raised:
        frame.returned.append(value)
        frame.exits.append(walk.state.since(frame.mark))
    return RETURN


def _throw(walk: Walk, frame: Frame, statement: syntax.Throw) -> str:
    if statement.value is not None:
        expressions.evaluate(walk, frame, statement.value)
    if walk.trials and walk.trials[-1].frame is frame:
        thrown.may_throw(walk)
        early.throws(walk, frame, walk.trials[-1])
    else:
        thrown.throws(walk, thrown.classes(walk, frame, statement))
    return THROW


def _break(walk: Walk, frame: Frame, statement: syntax.Break) -> str:
    if walk.loops:
        early.ends_turn(walk, frame, walk.loops[-1])
        if not frame.is_dead:
            walk.loops[-1].breaks.append(walk.state.since(walk.loops[-1].mark))
    return BREAK


def _continue(walk: Walk, frame: Frame, statement: syntax.Continue) -> str:
    loop = next((loop for loop in reversed(walk.loops) if not loop.is_switch), None)
    if loop is not None:
        early.ends_turn(walk, frame, loop)
        if not frame.is_dead:
            loop.continues.append(walk.state.since(loop.mark))
    return CONTINUE


def _define(walk: Walk, frame: Frame, statement: syntax.NestedFunction) -> str:
    function = frame.source.program.functions[statement.function]
    python = frame.source.separator == "."
    around = expressions.with_defaults(walk, frame, function) if python else expressions.kept(frame)
    made = abstract.Callable(frame.source, function, frame.this, frame=around)
    frame.declare(statement.name, Cell(made))
    if python and function.decorators:
        registering.given(walk, frame, made)
    return NEXT


def _class(walk: Walk, frame: Frame, statement: syntax.NestedClass) -> str:
    found = walk.class_of(statement.name, frame.source)
    if found is None:
        return NEXT
    for field in found[1].fields if found[0] is frame.source and not walk.quiet else ():
        if field.init is not None and walk.relevance.matters(field.init, frame.source):
            members.static_cell(walk, *found, field.name)
    if walk.modules.get(frame.source.path) is not frame:
        frame.declare(statement.name.rpartition(frame.source.separator)[2], Cell(ClassValue(*found)))
    return NEXT


def _import(walk: Walk, frame: Frame, statement: syntax.Import) -> str:
    value = python_names.imported(walk, frame, statement.target)
    if walk.trials and isinstance(value, Library):
        thrown.may_throw(walk)
    cell = frame.scopes[0].get(statement.name)  # blocks have no scopes of their own in Python
    if cell is None:
        frame.scopes[0][statement.name] = Cell(value)
    else:
        walk.state.write(cell, value)
    return NEXT


def _on(kind: type[_Kind], execute: Callable[[Walk, Frame, _Kind], str]) -> tuple[type[Statement], _Execute]:
    """*execute* for statements of *kind*, and for no others."""
    return cast("type[Statement]", kind), cast("_Execute", execute)


STATEMENTS: dict[type[Statement], _Execute] = dict(
    (
        _on(syntax.Do, _do),
        _on(syntax.Variable, _variable),
        _on(syntax.Static, _static),
        _on(syntax.Global, _global),
        _on(syntax.Nonlocal, _nonlocal),
        _on(syntax.If, _if),
        _on(syntax.Loop, lambda walk, frame, s: loops.loop(walk, frame, s)),
        _on(syntax.Each, lambda walk, frame, s: loops.for_each(walk, frame, s)),
        _on(syntax.Switch, lambda walk, frame, s: switches.switch(walk, frame, s)),
        _on(syntax.Try, lambda walk, frame, s: attempts.attempt(walk, frame, s)),
        _on(syntax.Preprocessor, lambda walk, frame, s: guarded.preprocessor(walk, frame, s)),
        _on(syntax.Nested, lambda walk, frame, s: execute(walk, frame, s.body)),
        _on(syntax.Return, _return),
        _on(syntax.Break, _break),
        _on(syntax.Continue, _continue),
        _on(syntax.Throw, _throw),
        _on(syntax.NestedFunction, _define),
        _on(syntax.NestedClass, _class),
        _on(syntax.Import, _import),
    )
)
