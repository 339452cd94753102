# SPDX-License-Identifier: Apache-2.0
"""A function's body as a list of plain facts: its calls with what stands around them, variables, assignments, returns.

Lambdas and nested functions are not part of the body that they stand in: they run when they are called.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from typing import Any

from haros_ci.model.program import Block, Expression, Function, Statement, Type

#: The parts of statements that are blocks or hold them are walked by kind; all other parts are expressions.
Around = tuple["Place", ...]
#: Expressions that are made of no others.
LEAVES = frozenset(("name", "str", "num", "bool", "this", "none", "type"))


@dataclass(frozen=True, slots=True, eq=False)
class Place:
    """Something that stands around code: *kind* is try, handler, loop, then, else, case.

    *statement* is the statement itself; for handler the handler's tuple, for then and else the condition's expression.
    """

    kind: str
    statement: Any
    outer: Around = ()


@dataclass(frozen=True, slots=True, eq=False)
class Call:
    """A call: *name* is the last part of the callee's name, "" where a value is called. *whole* is the expression."""

    name: str
    whole: Expression
    around: Around
    #: It is an expression statement: nobody takes what it returns.
    is_bare: bool = False

    @property
    def callee(self) -> Expression:
        return self.whole[1]

    @property
    def args(self) -> tuple[Expression, ...]:
        return tuple(self.whole[2])

    @property
    def templates(self) -> tuple[Any, ...]:
        return tuple(self.whole[3])

    @property
    def line(self) -> int:
        return int(self.whole[4])

    @property
    def column(self) -> int:
        return int(self.whole[5])

    @property
    def receiver(self) -> Expression | None:
        """What the method is called on; None for a name alone."""
        return self.callee[1] if self.callee[0] == "field" else None

    def argument(self, position: int, keyword: str = "") -> Expression | None:
        """The argument at *position* or with *keyword*; None where it is not given, or may be in an unpacking."""
        plain = [each for each in self.args if each[0] != "kw"]
        named = next((each[2] for each in self.args if each[0] == "kw" and each[1] == keyword), None)
        if any(each[0] in ("star", "starstar") for each in plain[: position + 1]):
            return None
        return named if named is not None else plain[position] if position < len(plain) else None


@dataclass(frozen=True, slots=True, eq=False)
class Variable:
    """A local variable: *init* as in a ``var`` statement, or ("each", E) for what a loop goes through."""

    name: str
    type: Type
    init: Any
    line: int
    column: int
    around: Around
    is_static: bool = False


@dataclass(slots=True)
class Body:
    """What a function does, in the order of the text; of calls in one another the outer one first."""

    calls: list[Call] = field(default_factory=list)
    variables: dict[str, list[Variable]] = field(default_factory=dict)
    #: Assignments: (target, operator, value, what stands around).
    sets: list[tuple[Expression, str, Expression, Around]] = field(default_factory=list)
    returns: list[tuple[Expression | None, Around]] = field(default_factory=list)
    loops: list[tuple[Statement, Around]] = field(default_factory=list)
    #: ``new T(...)``: the type, the arguments, the place.
    news: list[tuple[Type, tuple[Expression, ...], int, int]] = field(default_factory=list)
    #: Lambdas and nested functions by index in the program, and what stands around them.
    inner: list[tuple[int, Around]] = field(default_factory=list)
    #: Nested functions of Python and local imports, by name.
    nested: dict[str, int] = field(default_factory=dict)
    imports: dict[str, str] = field(default_factory=dict)
    #: There is text in it that no front end understands, or a preprocessor conditional.
    is_partial: bool = False


def body_of(function: Function) -> Body:
    """The facts of *function*; nothing for a declaration."""
    body = Body()
    for name, _, args, _, _ in function.inits:
        for each in args:
            _expression(each, body, ())
        value = args[0] if len(args) == 1 else ("list", tuple(args))
        body.sets.append((("field", ("this",), name), "=", value, ()))
    _block(function.body or (), body, ())
    return body


def _block(block: Block, body: Body, around: Around) -> None:
    for statement in block:
        _statement(statement, body, around)


def _in(kind: str, statement: Any, around: Around) -> Around:
    return (*around, Place(kind, statement, around))


def _statement(statement: Statement, body: Body, around: Around) -> None:
    kind = statement[0]
    if kind == "do":
        _expression(statement[1], body, around, is_bare=True)
    elif kind == "var":
        _, name, declared, init, line, column = statement
        body.variables.setdefault(name, []).append(Variable(name, declared, init, line, column, around))
        if init is not None:
            for each in (init[1],) if init[0] == "=" else init[1]:
                _expression(each, body, around)
    elif kind == "if":
        _expression(statement[4], body, around)
        _block(statement[5], body, _in("then", statement[4], around))
        _block(statement[8], body, _in("else", statement[4], around))
    elif kind == "loop":
        _block(statement[5], body, around)
        inner = _in("loop", statement, around)
        body.loops.append((statement, around))
        if statement[6] is not None:
            _expression(statement[6], body, inner)
        _block(statement[7], body, inner)
    elif kind == "each":
        _, line, column, _, name, declared, over, block = statement
        _expression(over, body, around)
        inner = _in("loop", statement, around)
        if name:
            body.variables.setdefault(name, []).append(Variable(name, declared, ("each", over), line, column, inner))
        _block(block, body, inner)
    elif kind == "switch":
        _expression(statement[4], body, around)
        for test, block in statement[5]:
            if test is not None:
                _expression(test, body, around)
            _block(block, body, _in("case", statement, around))
    elif kind == "try":
        _block(statement[1], body, _in("try", statement, around))
        for handler in statement[2]:
            _block(handler[5], body, _in("handler", handler, around))
    elif kind == "pre":
        body.is_partial = True
        for branch in statement[1]:
            _block(branch[3], body, around)
    elif kind == "block":
        _block(statement[1], body, around)
    elif kind == "static":
        _statement(statement[1], body, around)
        if statement[1][0] == "var" and (made := body.variables.get(statement[1][1])):
            made[-1] = replace(made[-1], is_static=True)
    elif kind in ("return", "throw"):
        if statement[1] is not None:
            _expression(statement[1], body, around)
        if kind == "return":
            body.returns.append((statement[1], around))
    elif kind == "step":
        _expression(statement[1], body, around)
    elif kind == "def":
        body.nested[statement[1]] = statement[2]
        body.inner.append((statement[2], around))
    elif kind == "import":
        body.imports[statement[1]] = statement[2]


def _expression(expression: Expression, body: Body, around: Around, is_bare: bool = False) -> None:
    waiting = [expression] if expression[0] not in LEAVES else []
    while waiting:
        node = waiting.pop()
        kind = node[0]
        if kind == "call":
            body.calls.append(Call(last_part(node[1]), node, around, is_bare and node is expression))
        elif kind == "lambda":
            body.inner.append((node[1], around))
            continue
        elif kind == "set":
            body.sets.append((node[2], node[1], node[3], around))
        elif kind == "new":
            body.news.append((node[1], tuple(node[2]), node[3], node[4]))
        elif kind == "?":
            body.is_partial = True
            continue
        waiting.extend([each for each in reversed(parts(node)) if each[0] not in LEAVES])


def parts(node: Expression) -> list[Expression]:
    """The expressions that an expression is made of, in the order of the text."""
    kind = node[0]
    if kind in ("field", "&", "*", "star", "starstar"):
        return [node[1]]
    if kind == "call":
        return [node[1], *node[2]]
    if kind in ("index",):
        return [node[1], node[2]]
    if kind == "new":
        return list(node[2])
    if kind in ("op",):
        return list(node[2])
    if kind == "set":
        return [node[2], node[3]]
    if kind == "if":
        return [node[1], node[2], node[3]]
    if kind in ("list", "format"):
        return list(node[1])
    if kind == "dict":
        return [each for pair in node[1] for each in pair if each]
    if kind in ("cast", "kw"):
        return [node[2]]
    return []


def nodes(expression: Expression) -> Iterator[Expression]:
    """*expression* and all that it is made of, outermost first; lambdas are not entered."""
    waiting = [expression]
    while waiting:
        node = waiting.pop()
        yield node
        waiting.extend(reversed(parts(node)))


def last_part(callee: Expression) -> str:
    """The last part of the name that is called."""
    if callee[0] == "name":
        return str(callee[1]).rpartition("::")[2]
    return str(callee[2]).rpartition("::")[2] if callee[0] == "field" else ""


def names_in(expression: Expression) -> frozenset[str]:
    """The plain names that *expression* reads."""
    return frozenset(node[1] for node in nodes(expression) if node[0] == "name")
