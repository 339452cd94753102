# SPDX-License-Identifier: Apache-2.0
"""Ways through a body: whether something is done on each of them before the function returns.

Lenient: ways that a shutdown takes, that throw, or that a flag may exclude are none to speak of.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from haros_ci.code.body import last_part, nodes
from haros_ci.model.program import Block, Expression

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


def undone_ways(
    block: Block, does: Callable[[Expression], bool], end: tuple[int, int], given: frozenset[str] = frozenset()
) -> tuple[tuple[int, int], ...]:
    """Where the function returns without having done it: the nearest statement with a line, *end* for its own end.

    Ways on which one of the *given* variables is null are left out.
    """
    block = tuple(_without_null_tests(each, given) for each in block)
    ways = _Ways()
    _block(block, False, does, ways, end)
    return tuple(dict.fromkeys([*ways.undone, *([end] if False in ways.on else [])]))


def _without_null_tests(statement: Any, given: frozenset[str]) -> Any:
    """The statement that runs where the *given* variables are not null, for ``if (given) { ... }`` at the outermost level."""
    if statement[0] != "if":
        return statement
    test = statement[4]
    if test[0] == "op" and test[1] in ("!=", "==") and len(test[2]) == 2 and _is_null(test[2][1]):
        test = test[2][0] if test[1] == "!=" else ("op", "!", (test[2][0],))
    if test[0] == "name" and test[1] in given:
        return ("block", tuple(_without_null_tests(each, given) for each in statement[5]))
    if test[0] == "op" and test[1] == "!" and test[2][0][0] == "name" and test[2][0][1] in given:
        return ("block", statement[8])
    return statement


def _is_null(expression: Expression) -> bool:
    return expression[0] == "none" or (expression[0] == "name" and expression[1] in ("nullptr", "NULL"))


def _block(block: Block, done: bool, does: Callable[[Expression], bool], ways: _Ways, near: tuple[int, int]) -> None:
    states = {done}
    for statement in block:
        after: set[bool] = set()
        if len(states) == 2 and statement[0] == "if" and _may_do(statement[5], does):
            states = {True}  # the condition tells the ways apart, as far as can be seen
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


def _statement(
    statement: Any, done: bool, does: Callable[[Expression], bool], ways: _Ways, near: tuple[int, int]
) -> None:
    kind = statement[0]
    if kind in ("do", "step"):
        ways.on.add(done or does(statement[1]))
    elif kind == "var":
        init = statement[3]
        inner = () if init is None else (init[1],) if init[0] == "=" else init[1]
        ways.on.add(done or any(map(does, inner)))
    elif kind == "return":
        if not done and not (statement[1] is not None and does(statement[1])):
            ways.undone.append(near)
    elif kind == "throw":
        pass
    elif kind == "break":
        ways.breaks.add(done)
    elif kind == "continue":
        ways.continues.add(done)
    elif kind == "if":
        _if(statement, done, does, ways)
    elif kind in ("loop", "each"):
        _loop(statement, done, does, ways)
    elif kind == "switch":
        _switch(statement, done or does(statement[4]), does, ways)
    elif kind == "try":
        _block(statement[1], done, does, ways, near)
        for handler in statement[2]:
            _block(handler[5], done, does, ways, (handler[0], handler[1]))
    elif kind == "pre":
        ways.on.add(True)  # what is compiled is not known
    elif kind == "block":
        _block(statement[1], done, does, ways, near)
    elif kind == "static":
        _statement(statement[1], done, does, ways, near)
    else:
        ways.on.add(done)


def _if(statement: Any, done: bool, does: Callable[[Expression], bool], ways: _Ways) -> None:
    test = statement[4]
    done = done or does(test)
    then_over, else_over = _over(test)
    at = (statement[1], statement[2])
    _block(statement[5], done or then_over, does, ways, at)
    if statement[8]:
        _block(statement[8], done or else_over, does, ways, (statement[6] or at[0], statement[7] or at[1]))
    else:
        ways.on.add(done or else_over)


def _loop(statement: Any, done: bool, does: Callable[[Expression], bool], ways: _Ways) -> None:
    inner = _Ways()
    if statement[0] == "each":
        done = done or does(statement[6])
        endless, over, body, at = False, False, statement[7], (statement[1], statement[2])
    else:
        test = statement[6]
        endless = (test is None and statement[1] == "for") or (
            test is not None and test[0] in ("bool", "num") and bool(test[1])
        )
        over = test is not None and any(_over(test))
        body, at = statement[7], (statement[2], statement[3])
        done = done or (test is not None and does(test))
    _block(body, done, does, inner, at)
    ways.undone += inner.undone
    ways.on |= inner.breaks
    if over:
        ways.on.add(True)  # it ends with a shutdown, or is left by a break
    elif not endless:
        turned = inner.on | inner.continues
        if statement[0] == "loop" and statement[1] != "for" and True in turned:
            ways.on.add(True)  # its condition is about that, as far as can be seen
        else:
            ways.on |= {done} | turned


def _may_do(block: Block, does: Callable[[Expression], bool]) -> bool:
    """Whether one of the ways through *block* does it."""
    ways = _Ways()
    _block(block, False, does, ways, (0, 0))
    return True in ways.on | ways.breaks | ways.continues or not (ways.on or ways.undone)


def _switch(statement: Any, done: bool, does: Callable[[Expression], bool], ways: _Ways) -> None:
    states: set[bool] = set()
    has_default = False
    at = (statement[1], statement[2])
    for test, block in statement[5]:
        has_default = has_default or test is None
        inner = _Ways()
        for state in {done} | states:
            _block(block, state, does, inner, at)
        ways.on |= inner.breaks
        ways.undone += inner.undone
        ways.continues |= inner.continues
        states = inner.on
    ways.on |= states
    if not has_default and not statement[5]:
        ways.on.add(done)


def _over(test: Expression) -> tuple[bool, bool]:
    """Whether the program or the goal is over where a condition holds, and where it does not; both may be for compound ones."""
    turned = False
    while test[0] == "op" and test[1] == "!":
        turned, test = not turned, test[2][0]
    found = {_asked(node) for node in nodes(test)} & (RUNNING | OVER)
    if not found:
        return False, False
    if _asked(test) not in found:
        return True, True
    holds = (_asked(test) in OVER) != turned
    return holds, not holds


def _asked(node: Expression) -> str:
    """The last part of the name of a call, or of a property that is read."""
    return last_part(node[1]) if node[0] == "call" else str(node[2]) if node[0] == "field" else ""
