# SPDX-License-Identifier: Apache-2.0
"""How often a call runs each time that its function does: conditions, ways out before it, and loops around it."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci import syntax
from haros_ci.code import classes, kinds
from haros_ci.code.body import Call
from haros_ci.code.codebase import Codebase, Routine
from haros_ci.model.location import Location
from haros_ci.rates.sleeps import every_turn, hertz, rate_slept, seconds, turns_of
from haros_ci.records import dataclass
from haros_ci.regex import regex
from haros_ci.syntax import Block, Expression, Statement
from haros_ci.syntax.walk import everything

#: Why a call in a loop is not known to run a number of times.
OPEN = "it is in a loop of unknown length"
#: Conditions that hold as long as the program runs.
RUNNING = regex(
    r"(true|1|True|not rospy\.is_shutdown\(\)|(ros|rclcpp|rclpy)(::|\.)ok\([\w.>()-]{0,60}\)|(ros::)?ok\(\)"
    r"|[\w.>-]{1,40}(\.|->)ok\(\)|!ros::isShuttingDown\(\)|__name__ == ['\"]__main__['\"])"
)


@dataclass(frozen=True, slots=True)
class Paced:
    """A loop that sleeps in each turn: *made* is where its rate is made, *hertz* the turns a second if they are written out there, else 0.

    Without a rate, *hertz* are the most turns that a sleep of a known time allows.

    *is_endless*: it ends with the program alone.
    """

    made: Location | None
    is_endless: bool
    hertz: float = 0.0


@dataclass(frozen=True, slots=True)
class Turns:
    """A call runs once for each run of its function, or *times* (loops of a known length), or at most so (*is_sometimes*), or as its loop says.

    *paced* is the innermost loop with a rate around it, *reason* why a loop has no rate that is known.
    """

    is_sometimes: bool = False
    paced: Paced | None = None
    reason: str = ""
    times: int = 1


def turns(code: Codebase, routine: Routine, call: Call) -> Turns:
    """How often *call* runs when *routine* runs."""
    key = ("turns", id(call.whole))
    if key not in code.kept:
        code.kept[key] = _turns(code, routine, call)
    found: Turns = code.kept[key]
    return found


def _turns(code: Codebase, routine: Routine, call: Call) -> Turns:
    found = _Search(call.whole)
    found.block(routine.function.body or ())
    if not found.is_found:
        return Turns(reason="it is not in a statement of its own")
    sometimes = found.is_sometimes
    times = 1
    for loop in reversed(found.loops):
        counted = turns_of(code, routine, loop)
        if counted is not None:
            sometimes = sometimes or any(map(_leaves_loop, _inside(loop.body)))
            times *= counted
            continue
        if not isinstance(loop, syntax.Loop):
            return Turns(reason=OPEN)
        return _paced(code, routine, loop, call, Turns(sometimes, times=times))
    return Turns(sometimes, times=times)


def _paced(code: Codebase, routine: Routine, loop: syntax.Loop, call: Call, inner: Turns) -> Turns:
    """The turns of a call that runs as *inner* says in each turn of a loop of unknown length."""
    is_open = _is_running(loop.text)
    calls = tuple(every_turn(loop.body))
    rate = rate_slept(calls)
    made = rate_made(code, routine, rate) if rate is not None else None
    longest = max((seconds(code, routine, one) or 0.0 for one in calls), default=0.0)
    if made is None and not longest:
        if rate is not None:
            return Turns(reason="it is not seen where the rate of the loop is made")
        return Turns(reason="it is in a loop without a rate" if is_open else OPEN)
    if _goes_on_behind(loop.body, call.whole):
        return Turns(reason="the loop may go on without the sleep of its rate")
    is_endless = is_open and made is not None and _is_kept(loop.body)
    written = hertz(code, routine, rate) if rate is not None and made is not None else 1.0 / longest
    paced = Paced(made, is_endless, written)
    return Turns(inner.is_sometimes, paced, times=inner.times)


def _is_running(condition: str) -> bool:
    """Whether a condition holds as long as the program runs."""
    return RUNNING.fullmatch(" ".join(condition.split())) is not None


def _is_kept(body: Block) -> bool:
    """Whether nothing leaves a loop with this body, and it sleeps in one place."""
    if any(isinstance(node, (syntax.Break, syntax.Return, syntax.Throw)) for node in _inside(body)):
        return False
    every = list(everything(body))
    if any(isinstance(node, (syntax.Return, syntax.Throw)) for node in every):
        return False
    return sum(isinstance(one, syntax.Call) and _sleeps(one) for one in every) == 1


def _leaves_loop(statement: Statement) -> bool:
    return isinstance(statement, (syntax.Break, syntax.Continue, syntax.Return, syntax.Throw))


def _goes_on_behind(block: Block, target: syntax.Call) -> bool:
    """Whether a ``continue`` of the loop with this body may come behind the call *target* in it."""
    for number, statement in enumerate(block):
        if not any(node is target for node in everything(statement)):
            continue
        if any(isinstance(node, syntax.Continue) for node in _inside(block[number + 1 :])):
            return True
        if isinstance(statement, (syntax.Loop, syntax.Each)):
            return False
        return any(_goes_on_behind(inner, target) for inner in blocks(statement))
    return False


def _sleeps(call: syntax.Call) -> bool:
    return "sleep" in syntax.name_of(call.callee).lower()


def _inside(block: Block) -> Iterator[Statement]:
    """The statements of a loop's body, those of loops in it left out."""
    for statement in block:
        yield statement
        for inner in blocks(statement):
            if not isinstance(statement, (syntax.Loop, syntax.Each)):
                yield from _inside(inner)


def blocks(statement: Statement) -> tuple[Block, ...]:
    """The blocks in a statement."""
    if isinstance(statement, syntax.If):
        return statement.then, statement.other
    if isinstance(statement, (syntax.Loop, syntax.Each, syntax.Nested)):
        return (statement.body,)
    if isinstance(statement, syntax.Switch):
        return tuple(case.body for case in statement.cases)
    if isinstance(statement, syntax.Try):
        return (statement.body, *(handler.body for handler in statement.handlers))
    if isinstance(statement, syntax.Preprocessor):
        return tuple(branch.body for branch in statement.branches)
    return ()


class _Search:
    """The way from a function's body to a call: whether it is conditional, and the loops around it."""

    def __init__(self, target: syntax.Call) -> None:
        self.target = target
        self.is_found = False
        self.is_sometimes = False
        self.loops: list[syntax.Loop | syntax.Each] = []

    def block(self, block: Block) -> bool:
        exits = False
        for statement in block:
            if self._statement(statement):
                self.is_sometimes = self.is_sometimes or exits
                return True
            exits = exits or _leaves(statement)
        return False

    def _statement(self, statement: Statement) -> bool:
        inner = blocks(statement)
        for number, block in enumerate(inner):
            if not self.block(block):
                continue
            if isinstance(statement, (syntax.Loop, syntax.Each)):
                self.loops.insert(0, statement)
            self.is_sometimes = self.is_sometimes or _may_pass_over(statement, number)
            return True
        own = _evaluated(statement)
        if own is None or not any(node is self.target for node in everything(own)):
            return False
        self.is_found = True
        if isinstance(statement, syntax.Loop):
            self.loops.insert(0, statement)
            self.is_sometimes = True
        if own is not self.target:  # a part of an expression that may not be evaluated
            whole = [node for node in everything(own) if isinstance(node, (syntax.Operation, syntax.Conditional))]
            self.is_sometimes = self.is_sometimes or bool(whole)
        return True


def _may_pass_over(statement: Statement, number: int) -> bool:
    """Whether the block of that number in a statement may not run when the statement does; loops are counted by themselves."""
    if isinstance(statement, syntax.If):
        return number != 0 or not _is_running(statement.text)
    if isinstance(statement, syntax.Try):
        return number != 0
    return not isinstance(statement, (syntax.Loop, syntax.Each, syntax.Nested))


def _evaluated(statement: Statement) -> Expression | None:
    """What a statement itself evaluates; None where that is nothing that can be a call."""
    own: Expression | None = None
    if isinstance(statement, (syntax.Do, syntax.Return, syntax.Switch)):
        own = statement.value
    elif isinstance(statement, syntax.Variable):
        own = next(iter(syntax.started(statement.init)), None)
    elif isinstance(statement, (syntax.If, syntax.Loop)):
        own = statement.test
    return own.value if isinstance(own, syntax.Assignment) else own


def _leaves(statement: Statement) -> bool:
    """Whether what follows a statement may be passed over: a way out of the function, or of the turn of the loop around it."""
    if any(isinstance(node, (syntax.Return, syntax.Throw)) for node in everything(statement)):
        return True
    return any(isinstance(node, (syntax.Break, syntax.Continue)) for node in _inside((statement,)))


def rate_made(code: Codebase, routine: Routine, rate: Expression) -> Location | None:
    """Where the rate object is made that an expression is: a variable or member that begins in one place."""
    while isinstance(rate, (syntax.Dereference, syntax.Address)):
        rate = rate.value
    if isinstance(rate, syntax.Name):
        made = _variable(code, routine, rate.name)
        if made is not None:
            return made
        if kinds.is_local(code, routine, rate.name):
            return None
    if not isinstance(rate, (syntax.Name, syntax.Member)):
        return None
    if isinstance(rate, syntax.Member) and not isinstance(rate.object, syntax.This):
        return None
    owner = classes.owner_of(code, routine)
    values = kinds.attribute_values(code, owner, syntax.name_of(rate)) if owner is not None else ()
    if len(values) == 1:
        where, value = values[0]
        if isinstance(value, syntax.Call):
            return Location(where.path, value.line, value.column)
        if not routine.is_python:
            return Location(where.path, where.function.line, None)
    return None


def _variable(code: Codebase, routine: Routine, name: str) -> Location | None:
    return _in_python(code, routine, name) if routine.is_python else _in_cpp(code, routine, name)


def _in_cpp(code: Codebase, routine: Routine, name: str) -> Location | None:
    found = kinds.variable(code, routine, name)
    if not (isinstance(found, tuple) and len(found) == 2):
        return None
    where, local = found
    if len(code.body(where).variables.get(name, ())) != 1:
        return None
    if any(_is_name(target, name) for target, *_ in code.body(where).sets):
        return None
    if isinstance(local.value, syntax.Call) and local.type.name in ("", "auto"):
        return Location(where.path, local.value.line, local.value.column)
    return Location(where.path, local.line, local.column)


def _in_python(code: Codebase, routine: Routine, name: str) -> Location | None:
    around: Routine | None = routine
    while around is not None:
        values = [value for target, _, value, _ in code.body(around).sets if _is_name(target, name)]
        if values:
            only = values[0]
            one = isinstance(only, syntax.Call) and len(values) == 1
            return Location(around.path, only.line, only.column) if one and isinstance(only, syntax.Call) else None
        around = around.outer
    modules = [other for other in code.routines(routine.path) if other.function.kind == "module"]
    if routine not in modules and len(modules) == 1:
        return _in_python(code, modules[0], name)
    return None


def _is_name(target: Expression, name: str) -> bool:
    return isinstance(target, syntax.Name) and target.name == name
