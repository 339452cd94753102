# SPDX-License-Identifier: Apache-2.0
"""A function's body as steps: what is evaluated together, under which conditions, and where the function or a turn is left."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci import syntax
from haros_ci.code.body import nodes
from haros_ci.code.codebase import Codebase, Routine
from haros_ci.records import dataclass, field
from haros_ci.syntax import Block, Expression, Statement


@dataclass(frozen=True, slots=True, eq=False)
class Guard:
    """A condition around a step: *text* as written, *test* its expressions. *is_met* is False for an else branch.

    *kind* is if, loop, switch, handler or directive.
    """

    kind: str
    text: str
    line: int
    column: int
    test: tuple[Expression, ...]
    is_met: bool = True


@dataclass(frozen=True, slots=True, eq=False)
class Step:
    """What is evaluated together, by *number* in the order of the text.

    *name* is the local variable that it declares, of the *type* as written; *line* and *column* are those of it, or of what a constructor
    gives a member, 0 for anything else. *leaves* says how it leaves: return, throw, break, continue.
    """

    number: int
    values: tuple[Expression, ...]
    around: tuple[Guard, ...]
    name: str = ""
    type: syntax.Type = syntax.NOTHING
    leaves: str = ""
    is_static: bool = False
    line: int = 0
    column: int = 0

    @property
    def loops(self) -> tuple[Guard, ...]:
        """The loops around it."""
        return tuple(guard for guard in self.around if guard.kind == "loop")


def steps(code: Codebase, routine: Routine) -> tuple[Step, ...]:
    """The steps of *routine*, in the order of the text."""
    key = ("steps", id(routine))
    if key not in code.kept:
        made = _Steps()
        for init in routine.function.inits:
            value = init.arguments[0] if len(init.arguments) == 1 else syntax.ListLiteral(init.arguments)
            values = (syntax.Assignment("=", syntax.Member(syntax.This(), init.name), value),)
            made.found.append(Step(len(made.found), values, (), line=init.line, column=init.column))
        made.block(routine.function.body or (), ())
        code.kept[key] = tuple(made.found)
        code.kept["keep", id(routine)] = routine  # so that its identity stays its own
    found: tuple[Step, ...] = code.kept[key]
    return found


def step_of(code: Codebase, routine: Routine, call: syntax.Call) -> Step | None:
    """The step that *call* stands in."""
    key = ("steps of calls", id(routine))
    if key not in code.kept:
        made: dict[int, Step] = {}
        for step in steps(code, routine):
            for node in all_nodes(step.values):
                if isinstance(node, syntax.Call):
                    made.setdefault(id(node), step)
        code.kept[key] = made
    known: dict[int, Step] = code.kept[key]
    return known.get(id(call))


def all_nodes(values: tuple[Expression, ...]) -> Iterator[Expression]:
    """All that *values* are made of; lambdas are not entered."""
    for value in values:
        yield from nodes(value)


@dataclass(slots=True)
class _Steps:
    found: list[Step] = field(default_factory=list)

    def add(self, around: tuple[Guard, ...], values: tuple[Expression, ...], leaves: str = "") -> None:
        self.found.append(Step(len(self.found), values, around, leaves=leaves))

    def variable(self, around: tuple[Guard, ...], statement: syntax.Variable, is_static: bool) -> None:
        values = syntax.started(statement.init)
        at = statement.line, statement.column
        self.found.append(Step(len(self.found), values, around, statement.name, statement.type, "", is_static, *at))

    def block(self, block: Block, around: tuple[Guard, ...]) -> None:
        for statement in block:
            self.statement(statement, around)

    def statement(self, statement: Statement, around: tuple[Guard, ...]) -> None:
        if isinstance(statement, (syntax.Do, syntax.Step)):
            self.add(around, (statement.value,))
        elif isinstance(statement, (syntax.Variable, syntax.Static)):
            is_static = isinstance(statement, syntax.Static)
            self.variable(around, statement.statement if isinstance(statement, syntax.Static) else statement, is_static)
        elif isinstance(statement, (syntax.Return, syntax.Throw)):
            word = "return" if isinstance(statement, syntax.Return) else "throw"
            self.add(around, () if statement.value is None else (statement.value,), word)
        elif isinstance(statement, (syntax.Break, syntax.Continue)):
            self.add(around, (), "break" if isinstance(statement, syntax.Break) else "continue")
        elif isinstance(statement, syntax.Nested):
            self.block(statement.body, around)
        else:
            self.branching(statement, around)

    def branching(self, statement: Statement, around: tuple[Guard, ...]) -> None:
        if isinstance(statement, syntax.If):
            self.add(around, (statement.test,))
            line, column = statement.else_line or statement.line, statement.else_column or statement.column
            for block, is_met, at in (
                (statement.then, True, (statement.line, statement.column)),
                (statement.other, False, (line, column)),
            ):
                self.block(block, (*around, Guard("if", statement.text, *at, (statement.test,), is_met)))
        elif isinstance(statement, (syntax.Loop, syntax.Each)):
            self.loop(statement, around)
        elif isinstance(statement, syntax.Switch):
            for case in statement.cases:
                test = (statement.value,) if case.value is None else (statement.value, case.value)
                guard = Guard("switch", statement.text, statement.line, statement.column, test)
                self.add(around, test)
                self.block(case.body, (*around, guard))
        elif isinstance(statement, syntax.Try):
            self.block(statement.body, around)
            for handler in statement.handlers:
                self.block(handler.body, (*around, Guard("handler", handler.text, handler.line, handler.column, ())))
        elif isinstance(statement, syntax.Preprocessor):
            for branch in statement.branches:
                self.block(branch.body, (*around, Guard("directive", branch.text, branch.line, branch.column, ())))

    def loop(self, statement: syntax.Loop | syntax.Each, around: tuple[Guard, ...]) -> None:
        if isinstance(statement, syntax.Each):
            guard = Guard("loop", statement.text, statement.line, statement.column, (statement.iterable,))
            inner = (*around, guard)
            self.found.append(Step(len(self.found), (statement.iterable,), inner, statement.name, statement.type))
        else:
            self.block(statement.before, around)
            test = () if statement.test is None else (statement.test,)
            guard = Guard("loop", statement.text, statement.line, statement.column, test)
            inner = (*around, guard)
            if test:
                self.add(inner, test)
        self.block(statement.body, inner)
