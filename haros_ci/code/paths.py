# SPDX-License-Identifier: Apache-2.0
"""Ways through a body: whether something is done on each of them before the function returns.

Lenient: ways that a shutdown takes, that throw, or that a flag may exclude are none to speak of.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from operator import or_

from haros_ci import syntax
from haros_ci.code.body import last_part, nodes
from haros_ci.code.outcome_flags import Flag, known_outcomes, outcome_flags
from haros_ci.records import dataclass, field
from haros_ci.syntax import Block, Expression, Statement

#: True while the program runs and the goal is served, and what is true once that is over.
RUNNING = frozenset("ok isOk isActive is_active is_executing is_server_active".split())
OVER = frozenset(
    "is_shutdown isShuttingDown is_shutting_down isNewGoalAvailable is_new_goal_available shutdown".split()
)


@dataclass(slots=True)
class _Ways:
    """The states, done or not, in which a block is left."""

    on: set[bool] = field(default_factory=set)
    breaks: set[bool] = field(default_factory=set)
    continues: set[bool] = field(default_factory=set)
    #: The ways that return: the conditions that the last one that was not done stands under.
    undone: list[tuple[int, int]] = field(default_factory=list)


@dataclass(frozen=True, slots=True)
class _Doing:
    """What does it, and the variables that tell that it has been done."""

    does: Callable[[Expression], bool]
    flags: Mapping[str, Flag]

    def __call__(self, expression: Expression) -> bool:
        return self.does(expression)


def undone_ways(
    block: Block, does: Callable[[Expression], bool], end: tuple[int, int], not_null: frozenset[str] = frozenset()
) -> tuple[tuple[int, int], ...]:
    """Where the function returns without having done it: the nearest statement with a line, *end* for its own end.

    Ways on which one of the *not_null* variables is null are left out, and those where a flag says that it was done before.
    """
    block = tuple(_without_null_tests(statement, not_null) for statement in block)
    ways = _Ways()
    _block(block, False, _Doing(does, outcome_flags(block, does)), ways, end)
    return tuple(dict.fromkeys([*ways.undone, *([end] if False in ways.on else [])]))


def _without_null_tests(statement: Statement, not_null: frozenset[str]) -> Statement:
    """The statement that runs where the *not_null* variables are not null, for ``if (given) { ... }`` at the outermost level."""
    if not isinstance(statement, syntax.If):
        return statement
    test = statement.test
    if (
        isinstance(test, syntax.Operation)
        and test.operator in ("!=", "==")
        and len(test.operands) == 2
        and _is_null(test.operands[1])
    ):
        test = test.operands[0] if test.operator == "!=" else syntax.Operation("!", (test.operands[0],))
    if isinstance(test, syntax.Name) and test.name in not_null:
        return syntax.Nested(
            tuple(_without_null_tests(other_statement, not_null) for other_statement in statement.then)
        )
    if (
        isinstance(test, syntax.Operation)
        and test.operator == "!"
        and isinstance(test.operands[0], syntax.Name)
        and test.operands[0].name in not_null
    ):
        return syntax.Nested(statement.other)
    return statement


def _is_null(expression: Expression) -> bool:
    return isinstance(expression, syntax.Null) or (
        isinstance(expression, syntax.Name) and expression.name in ("nullptr", "NULL")
    )


def _block(block: Block, done: bool, does: _Doing, ways: _Ways, near: tuple[int, int]) -> None:
    states = {done}
    for statement in block:
        after: set[bool] = set()
        if len(states) == 2 and isinstance(statement, syntax.If) and _may_do(statement.then, does):
            states = {True}  # the condition distinguishes the paths, as far as can be seen
        for state in states:
            inner = _Ways()
            _statement(statement, state, does, inner, near)
            after |= inner.on
            ways.breaks |= inner.breaks
            ways.continues |= inner.continues
            ways.undone += inner.undone
        states = after
        if not states:
            break
    ways.on |= states


def _statement(statement: Statement, done: bool, does: _Doing, ways: _Ways, near: tuple[int, int]) -> None:  # noqa: C901 - one branch for each kind of statement
    if isinstance(statement, (syntax.Do, syntax.Step)):
        ways.on.add(done or does(statement.value))
    elif isinstance(statement, syntax.Variable):
        ways.on.add(done or any(map(does, syntax.started(statement.init))))
    elif isinstance(statement, syntax.Return):
        if not done and not (statement.value is not None and does(statement.value)):
            ways.undone.append(near)
    elif isinstance(statement, syntax.Throw):
        pass
    elif isinstance(statement, syntax.Break):
        ways.breaks.add(done)
    elif isinstance(statement, syntax.Continue):
        ways.continues.add(done)
    elif isinstance(statement, syntax.If):
        _if(statement, done, does, ways)
    elif isinstance(statement, (syntax.Loop, syntax.Each)):
        _loop(statement, done, does, ways)
    elif isinstance(statement, syntax.Switch):
        _switch(statement, done or does(statement.value), does, ways)
    elif isinstance(statement, syntax.Try):
        _block(statement.body, done, does, ways, near)
        for handler in statement.handlers:
            _block(handler.body, done, does, ways, (handler.line, handler.column))
    elif isinstance(statement, syntax.Preprocessor):
        ways.on.add(True)  # what is compiled is not known
    elif isinstance(statement, syntax.Nested):
        _block(statement.body, done, does, ways, near)
    elif isinstance(statement, syntax.Static):
        _statement(statement.statement, done, does, ways, near)
    else:
        ways.on.add(done)


def _if(statement: syntax.If, done: bool, does: _Doing, ways: _Ways) -> None:
    test = statement.test
    done = done or does(test)
    then_over, else_over = map(or_, _over(test), known_outcomes(test, does.flags))
    at = (statement.line, statement.column)
    _block(statement.then, done or then_over, does, ways, at)
    if statement.other:
        _block(
            statement.other,
            done or else_over,
            does,
            ways,
            (statement.else_line or at[0], statement.else_column or at[1]),
        )
    else:
        ways.on.add(done or else_over)


def _loop(statement: syntax.Loop | syntax.Each, done: bool, does: _Doing, ways: _Ways) -> None:
    inner = _Ways()
    body, at = statement.body, (statement.line, statement.column)
    if isinstance(statement, syntax.Each):
        done = done or does(statement.iterable)
        endless, over = False, False
    else:
        test = statement.test
        endless = (test is None and statement.keyword == "for") or (
            isinstance(test, (syntax.Boolean, syntax.Number)) and bool(test.value)
        )
        over = test is not None and any(_over(test))
        done = done or (test is not None and does(test))
    _block(body, done, does, inner, at)
    ways.undone += inner.undone
    ways.on |= inner.breaks
    if over:
        ways.on.add(True)  # it ends with a shutdown, or is left by a break
    elif not endless and not (not inner.on and inner.continues and _counts(statement)):
        turned = inner.on | inner.continues
        if isinstance(statement, syntax.Loop) and statement.keyword != "for" and True in turned:
            ways.on.add(True)  # its condition is about that, as far as can be seen
        else:
            ways.on |= {done} | turned


def _counts(statement: syntax.Loop | syntax.Each) -> bool:
    """Whether each ``continue`` of a ``for`` is under a condition on what it counts (``if (attempt < 2) continue;``): so the last turn returns, as far as can be seen."""
    if isinstance(statement, syntax.Each):
        counted = frozenset((statement.name,)) - {""}
    elif statement.keyword == "for" and statement.test is not None:
        counted = _named(statement.test)
    else:
        return False
    return all(not counted.isdisjoint(names) for names in _continues(statement.body, frozenset()))


def _continues(block: Block, names: frozenset[str]) -> Iterator[frozenset[str]]:
    """For each ``continue`` of the loop with the body *block* the names in the conditions that it stands under, with those in *names*."""
    for statement in block:
        if isinstance(statement, syntax.Continue):
            yield names
        elif isinstance(statement, syntax.If):
            inner = names | _named(statement.test)
            yield from _continues(statement.then, inner)
            yield from _continues(statement.other, inner)
        elif isinstance(statement, syntax.Nested):
            yield from _continues(statement.body, names)
        elif isinstance(statement, syntax.Switch):
            for case in statement.cases:
                yield from _continues(case.body, names)
        elif isinstance(statement, syntax.Try):
            yield from _continues(statement.body, names)
            for handler in statement.handlers:
                yield from _continues(handler.body, names)


def _named(test: Expression) -> frozenset[str]:
    return frozenset(node.name for node in nodes(test) if isinstance(node, syntax.Name))


def _may_do(block: Block, does: _Doing) -> bool:
    """Whether one of the ways through *block* does it."""
    ways = _Ways()
    _block(block, False, does, ways, (0, 0))
    return True in ways.on | ways.breaks | ways.continues or not (ways.on or ways.undone)


def _switch(statement: syntax.Switch, done: bool, does: _Doing, ways: _Ways) -> None:
    states: set[bool] = set()
    has_default = False
    at = (statement.line, statement.column)
    for case in statement.cases:
        has_default = has_default or case.value is None
        inner = _Ways()
        for state in {done} | states:
            _block(case.body, state, does, inner, at)
        ways.on |= inner.breaks
        ways.undone += inner.undone
        ways.continues |= inner.continues
        states = inner.on
    ways.on |= states
    if not has_default and not statement.cases:
        ways.on.add(done)


def _over(test: Expression) -> tuple[bool, bool]:
    """Whether the program or the goal is over where a condition holds, and where it does not; both may be for compound ones."""
    turned = False
    while isinstance(test, syntax.Operation) and test.operator == "!":
        turned, test = not turned, test.operands[0]
    found = {_asked(node) for node in nodes(test)} & (RUNNING | OVER)
    if not found:
        return False, False
    if _asked(test) not in found:
        return True, True
    holds = (_asked(test) in OVER) != turned
    return holds, not holds


def _asked(node: Expression) -> str:
    """The last part of the name of a call, or of a property that is read."""
    return (
        last_part(node.callee)
        if isinstance(node, syntax.Call)
        else node.name
        if isinstance(node, syntax.Member)
        else ""
    )
