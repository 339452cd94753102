# SPDX-License-Identifier: Apache-2.0
"""A function's body as a list of plain facts: its calls with what stands around them, variables, assignments, returns.

Lambdas and nested functions are not part of the body that they stand in: they run when they are called.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any

from haros_ci import syntax
from haros_ci.records import dataclass, field
from haros_ci.syntax import Block, Expression, Function, Statement, Type

#: The parts of statements that are blocks or hold them are walked by kind; all other parts are expressions.
Around = tuple["Place", ...]
#: Expressions that are made of no others.
_LEAVES: frozenset[type] = frozenset(
    (syntax.Name, syntax.String, syntax.Number, syntax.Boolean, syntax.This, syntax.Null, syntax.TypeName)
)
#: Expressions that a body notes.
_NOTED: frozenset[type] = frozenset((syntax.Call, syntax.Lambda, syntax.Assignment, syntax.New, syntax.Unknown))


@dataclass(frozen=True, slots=True, eq=False)
class Place:
    """Something that stands around code: *kind* is try, handler, loop, then, else, case; *test* the condition of a then or else."""

    kind: str
    statement: Statement | syntax.Handler
    outer: Around = ()
    test: Expression | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Call:
    """A call: *name* is the last part of the callee's name, "" where a value is called. *whole* is the expression."""

    name: str
    whole: syntax.Call
    around: Around
    #: It is an expression statement: nobody takes what it returns.
    is_bare: bool = False

    @property
    def callee(self) -> Expression:
        return self.whole.callee

    @property
    def args(self) -> tuple[Expression, ...]:
        return self.whole.arguments

    @property
    def templates(self) -> tuple[syntax.Argument, ...]:
        return self.whole.templates

    @property
    def line(self) -> int:
        return self.whole.line

    @property
    def column(self) -> int:
        return self.whole.column

    @property
    def receiver(self) -> Expression | None:
        """What the method is called on; None for a name alone."""
        return self.callee.object if isinstance(self.callee, syntax.Member) else None

    def argument(self, position: int, keyword: str = "") -> Expression | None:
        """The argument at *position* or with *keyword*; None where it is not given, or may be in an unpacking."""
        plain = [argument for argument in self.args if not isinstance(argument, syntax.Keyword)]
        keywords = [argument for argument in self.args if isinstance(argument, syntax.Keyword)]
        named = next((other_keyword.value for other_keyword in keywords if other_keyword.name == keyword), None)
        if any(isinstance(literal, (syntax.Star, syntax.DoubleStar)) for literal in plain[: position + 1]):
            return None
        return named if named is not None else plain[position] if position < len(plain) else None


@dataclass(frozen=True, slots=True)
class Iterated:
    """How the variable of a loop begins: as an element of *value*."""

    value: Expression


@dataclass(frozen=True, slots=True, eq=False)
class Variable:
    """A local variable."""

    name: str
    type: Type
    init: syntax.Init | Iterated | None
    line: int
    column: int
    around: Around
    is_static: bool = False

    @property
    def parts(self) -> tuple[Expression, ...]:
        """The expressions that it starts with."""
        if self.init is None:
            return ()
        return (self.init.value,) if isinstance(self.init, (syntax.Equals, Iterated)) else self.init.arguments

    @property
    def value(self) -> Expression | None:
        """The one expression that it starts as; None without one, or for an element of it."""
        return self.parts[0] if len(self.parts) == 1 and not isinstance(self.init, Iterated) else None

    @property
    def assigned(self) -> Expression | None:
        """The expression behind its ``=``."""
        return self.init.value if isinstance(self.init, syntax.Equals) else None


@dataclass(slots=True)
class Body:
    """What a function does, in the order of the text; of calls in one another the outer one first."""

    calls: list[Call] = field(default_factory=list)
    variables: dict[str, list[Variable]] = field(default_factory=dict)
    #: Assignments: (target, operator, value, what stands around).
    sets: list[tuple[Expression, str, Expression, Around]] = field(default_factory=list)
    returns: list[tuple[Expression | None, Around]] = field(default_factory=list)
    loops: list[tuple[syntax.Loop, Around]] = field(default_factory=list)
    #: ``new T(...)``: the type, the arguments, the place.
    news: list[tuple[Type, tuple[Expression, ...], int, int]] = field(default_factory=list)
    #: Lambdas and nested functions by index in the program, and what stands around them.
    inner: list[tuple[int, Around]] = field(default_factory=list)
    #: Nested functions of Python and local imports, by name.
    nested: dict[str, int] = field(default_factory=dict)
    imports: dict[str, str] = field(default_factory=dict)
    #: There is text in it that no front end understands, or a preprocessor conditional.
    is_partial: bool = False
    _assigned: dict[str, list[Expression]] | None = field(default=None, repr=False, compare=False)

    def assigned(self, name: str) -> list[Expression]:
        """What the variable *name* is assigned to, in the order of the text; looked up once for all names, as each may be asked for."""
        if self._assigned is None:
            self._assigned = {}
            for target, _, value, _ in self.sets:
                if isinstance(target, syntax.Name):
                    self._assigned.setdefault(str(target.name), []).append(value)
        return self._assigned.get(name, [])


def body_of(function: Function) -> Body:
    """The facts of *function*; nothing for a declaration."""
    body = Body()
    for init in function.inits:
        for argument in init.arguments:
            _expression(argument, body, ())
        value = init.arguments[0] if len(init.arguments) == 1 else syntax.ListLiteral(init.arguments)
        body.sets.append((syntax.Member(syntax.This(), init.name), "=", value, ()))
    _block(function.body or (), body, ())
    return body


def _block(block: Block, body: Body, around: Around) -> None:
    for statement in block:
        _statement(statement, body, around)


def _in(kind: str, statement: Statement | syntax.Handler, around: Around, test: Expression | None = None) -> Around:
    return (*around, Place(kind, statement, around, test))


def _statement(statement: Statement, body: Body, around: Around) -> None:  # noqa: C901 - one branch for each kind of statement
    if isinstance(statement, syntax.Do):
        _expression(statement.value, body, around, is_bare=True)
    elif isinstance(statement, syntax.Variable):
        made = Variable(statement.name, statement.type, statement.init, statement.line, statement.column, around)
        body.variables.setdefault(statement.name, []).append(made)
        for part in made.parts:
            _expression(part, body, around)
    elif isinstance(statement, syntax.If):
        _expression(statement.test, body, around)
        _block(statement.then, body, _in("then", statement, around, statement.test))
        _block(statement.other, body, _in("else", statement, around, statement.test))
    elif isinstance(statement, syntax.Loop):
        _block(statement.before, body, around)
        inner = _in("loop", statement, around)
        body.loops.append((statement, around))
        if statement.test is not None:
            _expression(statement.test, body, inner)
        _block(statement.body, body, inner)
    elif isinstance(statement, syntax.Each):
        _expression(statement.iterable, body, around)
        inner = _in("loop", statement, around)
        name, start = statement.name, Iterated(statement.iterable)
        if name:
            made = Variable(name, statement.type, start, statement.line, statement.column, inner)
            body.variables.setdefault(name, []).append(made)
        _block(statement.body, body, inner)
    elif isinstance(statement, syntax.Switch):
        _expression(statement.value, body, around)
        for case in statement.cases:
            if case.value is not None:
                _expression(case.value, body, around)
            _block(case.body, body, _in("case", statement, around))
    elif isinstance(statement, syntax.Try):
        _block(statement.body, body, _in("try", statement, around))
        for handler in statement.handlers:
            _block(handler.body, body, _in("handler", handler, around))
    elif isinstance(statement, syntax.Preprocessor):
        body.is_partial = True
        for branch in statement.branches:
            _block(branch.body, body, around)
    elif isinstance(statement, syntax.Nested):
        _block(statement.body, body, around)
    elif isinstance(statement, syntax.Static):
        _statement(statement.statement, body, around)
        every = body.variables[statement.statement.name]
        every[-1] = replace(every[-1], is_static=True)
    elif isinstance(statement, (syntax.Return, syntax.Throw)):
        if statement.value is not None:
            _expression(statement.value, body, around)
        if isinstance(statement, syntax.Return):
            body.returns.append((statement.value, around))
    elif isinstance(statement, syntax.Step):
        _expression(statement.value, body, around)
    elif isinstance(statement, syntax.NestedFunction):
        body.nested[statement.name] = statement.function
        body.inner.append((statement.function, around))
    elif isinstance(statement, syntax.Import):
        body.imports[statement.name] = statement.target


def _expression(expression: Expression, body: Body, around: Around, is_bare: bool = False) -> None:
    waiting = [expression] if expression.__class__ not in _LEAVES else []
    while waiting:
        node = waiting.pop()
        kind = node.__class__
        if kind not in _NOTED:
            pass
        elif isinstance(node, syntax.Call):
            body.calls.append(Call(last_part(node.callee), node, around, is_bare and node is expression))
        elif isinstance(node, syntax.Lambda):
            body.inner.append((node.function, around))
            continue
        elif isinstance(node, syntax.Assignment):
            body.sets.append((node.target, node.operator, node.value, around))
        elif isinstance(node, syntax.New):
            body.news.append((node.type, node.arguments, node.line, node.column))
        elif isinstance(node, syntax.Unknown):
            body.is_partial = True
            continue
        if (parts_of := _PARTS.get(kind)) is not None:
            waiting.extend([part for part in reversed(parts_of(node)) if part.__class__ not in _LEAVES])


def parts(node: Expression) -> list[Expression]:
    """The expressions that an expression is made of, in the order of the text."""
    of_its_kind = _PARTS.get(node.__class__)
    return of_its_kind(node) if of_its_kind is not None else []


def _value(node: Any) -> list[Expression]:
    return [node.value]


#: How ``parts`` finds those of an expression, by its class: there are hundreds of thousands of them.
_PARTS: dict[type, Callable[[Any], list[Expression]]] = {
    syntax.Member: lambda node: [node.object],
    **dict.fromkeys((syntax.Address, syntax.Dereference, syntax.Star, syntax.DoubleStar), _value),
    **dict.fromkeys((syntax.Cast, syntax.Keyword), _value),
    syntax.Call: lambda node: [node.callee, *node.arguments],
    syntax.Subscript: lambda node: [node.object, node.index],
    syntax.New: lambda node: list(node.arguments),
    syntax.Operation: lambda node: list(node.operands),
    syntax.Assignment: lambda node: [node.target, node.value],
    syntax.Conditional: lambda node: [node.test, node.then, node.other],
    syntax.ListLiteral: lambda node: list(node.items),
    syntax.Format: lambda node: list(node.parts),
    syntax.DictLiteral: lambda node: [literal for pair in node.pairs for literal in pair],
}


def nodes(expression: Expression) -> Iterator[Expression]:
    """*expression* and all that it is made of, outermost first; lambdas are not entered."""
    waiting = [expression]
    while waiting:
        node = waiting.pop()
        yield node
        waiting.extend(reversed(parts(node)))


def last_part(callee: Expression) -> str:
    """The last part of the name that is called."""
    return syntax.name_of(callee).rpartition("::")[2]


def names_in(expression: Expression) -> frozenset[str]:
    """The plain names that *expression* reads."""
    return frozenset(node.name for node in nodes(expression) if isinstance(node, syntax.Name))
