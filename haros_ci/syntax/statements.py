# SPDX-License-Identifier: Apache-2.0
"""Statements, and blocks of them."""

from __future__ import annotations

from typing import TypeAlias, final

from haros_ci.syntax.expressions import Expression, Type
from haros_ci.syntax.node import Node, Record


@final
class Equals(Node, frozen=True, tag="="):
    """``T x = value``."""

    value: Expression


@final
class Parentheses(Node, frozen=True, tag="("):
    """``T x(arguments)``."""

    arguments: tuple[Expression, ...]


@final
class Braces(Node, frozen=True, tag="{"):
    """``T x{arguments}``."""

    arguments: tuple[Expression, ...]


#: How a variable begins.
Init: TypeAlias = Equals | Parentheses | Braces


def started(init: Init | None) -> tuple[Expression, ...]:
    """The expressions that a variable starts with."""
    if init is None:
        return ()
    return (init.value,) if isinstance(init, Equals) else init.arguments


@final
class Do(Node, frozen=True, tag="do"):
    """An expression statement."""

    value: Expression


@final
class Variable(Node, frozen=True, tag="var"):
    """A local variable."""

    name: str
    type: Type
    init: Init | None
    line: int
    column: int


@final
class Static(Node, frozen=True, tag="static"):
    """A local variable that is made once."""

    statement: Variable


@final
class Global(Node, frozen=True, tag="global"):
    """Python: the names are the module's variables in this function."""

    names: tuple[str, ...]


@final
class Nonlocal(Node, frozen=True, tag="nonlocal"):
    """Python: the names are variables of a function around this one."""

    names: tuple[str, ...]


@final
class If(Node, frozen=True, tag="if"):
    """*text* is the condition as written, spaces collapsed; *else_line* is 0 without else.

    ``else if`` is an else with one if in it. Python's elif: the else stands at the ``elif``.
    """

    line: int
    column: int
    text: str
    test: Expression
    then: Block
    else_line: int
    else_column: int
    other: Block


@final
class Loop(Node, frozen=True, tag="loop"):
    """*keyword* is for, while or do; *before* comes before the first turn."""

    keyword: str
    line: int
    column: int
    text: str
    before: Block
    test: Expression | None
    body: Block


@final
class Step(Node, frozen=True, tag="step"):
    """The step expression, last in the body of a ``for``: ``continue`` goes here."""

    value: Expression


@final
class Each(Node, frozen=True, tag="each"):
    """Range-for and Python for (*name* "" where it is a pattern)."""

    line: int
    column: int
    text: str
    name: str
    type: Type
    iterable: Expression
    body: Block


@final
class Case(Record, frozen=True):
    """A case of a switch; its value is None for default."""

    value: Expression | None
    body: Block


@final
class Switch(Node, frozen=True, tag="switch"):
    """Fall-through is kept: a block that does not end in break is followed by the next one's."""

    line: int
    column: int
    text: str
    value: Expression
    cases: tuple[Case, ...]


@final
class Handler(Record, frozen=True):
    """``catch``, ``except``."""

    line: int
    column: int
    text: str
    name: str
    type: Type
    body: Block


@final
class Try(Node, frozen=True, tag="try"):
    """A block with its handlers."""

    body: Block
    handlers: tuple[Handler, ...]


@final
class Branch(Record, frozen=True):
    """``#if``, ``#elif``, ``#else``."""

    line: int
    column: int
    text: str
    body: Block


@final
class Preprocessor(Node, frozen=True, tag="pre"):
    """A preprocessor conditional inside a body."""

    branches: tuple[Branch, ...]


@final
class Nested(Node, frozen=True, tag="block"):
    """A scope of its own."""

    body: Block


@final
class Return(Node, frozen=True, tag="return"):
    """``return``."""

    value: Expression | None


@final
class Break(Node, frozen=True, tag="break"):
    """``break``."""


@final
class Continue(Node, frozen=True, tag="continue"):
    """``continue``."""


@final
class Throw(Node, frozen=True, tag="throw"):
    """``throw``, ``raise``."""

    value: Expression | None


@final
class NestedFunction(Node, frozen=True, tag="def"):
    """A nested Python function: the one at the index *function* of ``Program.functions``."""

    name: str
    function: int


@final
class NestedClass(Node, frozen=True, tag="class"):
    """A nested class, in ``Program.classes`` under its qualified name."""

    name: str


@final
class Import(Node, frozen=True, tag="import"):
    """A Python import inside a function: its local name and dotted target."""

    name: str
    target: str


Statement: TypeAlias = (
    Do
    | Variable
    | Static
    | Global
    | Nonlocal
    | If
    | Loop
    | Step
    | Each
    | Switch
    | Try
    | Preprocessor
    | Nested
    | Return
    | Break
    | Continue
    | Throw
    | NestedFunction
    | NestedClass
    | Import
)
Block: TypeAlias = tuple[Statement, ...]
