# SPDX-License-Identifier: Apache-2.0
"""Types and expressions: they hold each other.

Lines and columns are 1-based and count as in ``Location``; those of a call and of a ``new`` are where it begins, receiver
included.
"""

from __future__ import annotations

from typing import TypeAlias, final

from haros_ci.syntax.node import Node


@final
class Type(Node, frozen=True, tag="T"):
    """A type. *name* as written, without template arguments (``std::vector``), Python dotted.

    *arguments* are types, or expressions for value arguments; *marks* is a string with ``c`` for const, ``*`` for each
    pointer, ``&`` for each reference. A function type is called ``()`` and has what is returned, then its parameters, as arguments.
    The name is "auto" for ``auto``, and "" where Python says nothing. A member type keeps its path and has the arguments of its
    class where it has none: ``A<T>::B`` is ``A::B`` of ``T``.
    """

    name: str
    arguments: tuple[Argument, ...] = ()
    marks: str = ""

    def marked(self, marks: str) -> Type:
        """The same with more marks."""
        return Type(self.name, self.arguments, self.marks + marks)

    def bare(self) -> Type:
        """The same without marks."""
        return Type(self.name, self.arguments)

    def of(self, index: int = 0) -> Type | None:
        """The type argument at *index*; None where there is none, or a value."""
        found = self.arguments[index] if index < len(self.arguments) else None
        return found if isinstance(found, Type) else None


@final
class String(Node, frozen=True, tag="str"):
    """A text; adjacent literals are joined."""

    value: str


@final
class Number(Node, frozen=True, tag="num"):
    """A number."""

    value: int | float


@final
class Boolean(Node, frozen=True, tag="bool"):
    """``true``, ``False``."""

    value: bool


@final
class Null(Node, frozen=True, tag="none"):
    """``nullptr``, ``None``."""


@final
class Name(Node, frozen=True, tag="name"):
    """An identifier as written, qualified by ``::``; Python names are bare."""

    name: str


@final
class This(Node, frozen=True, tag="this"):
    """C++ ``this``; Python's first parameter of a method, whatever its name."""


@final
class Member(Node, frozen=True, tag="field"):
    """``a.b``, ``a->b``, Python attribute access."""

    object: Expression
    name: str


@final
class Subscript(Node, frozen=True, tag="index"):
    """``a[b]``."""

    object: Expression
    index: Expression


@final
class Call(Node, frozen=True, tag="call"):
    """A call. ``T(x)`` and ``T{x}`` are calls, too. *templates* are the template arguments of what is called."""

    callee: Expression
    arguments: tuple[Expression, ...]
    templates: tuple[Argument, ...]
    line: int
    column: int


@final
class New(Node, frozen=True, tag="new"):
    """``new T(x)``."""

    type: Type
    arguments: tuple[Expression, ...]
    line: int
    column: int


@final
class Operation(Node, frozen=True, tag="op"):
    """Unary and binary operators; ``not``, ``and``, ``or`` are spelled ``!``, ``&&``, ``||``, and ``<<`` is one."""

    operator: str
    operands: tuple[Expression, ...]


@final
class Assignment(Node, frozen=True, tag="set"):
    """``=``, ``+=``; ``++x`` is ``x += 1``, ``x++`` is ``(x += 1) - 1`` where its value is used."""

    operator: str
    target: Expression
    value: Expression


@final
class Compiled(Node, frozen=True, tag="compiled"):
    """Whether what stands under these ``#if`` lines is compiled: (line, column, text). The index writes it, no front end."""

    guards: tuple[tuple[int, int, str], ...]


@final
class Conditional(Node, frozen=True, tag="if"):
    """The conditional expression."""

    test: Expression
    then: Expression
    other: Expression


@final
class Lambda(Node, frozen=True, tag="lambda"):
    """The function at the index *function* of ``Program.functions``."""

    function: int


@final
class ListLiteral(Node, frozen=True, tag="list"):
    """Braces, Python lists, tuples and sets."""

    items: tuple[Expression, ...]


@final
class DictLiteral(Node, frozen=True, tag="dict"):
    """A Python dictionary; a key that is a ``DoubleStar`` unpacks another."""

    pairs: tuple[tuple[Expression, Expression], ...]


@final
class Format(Node, frozen=True, tag="format"):
    """A Python f-string: its parts, to be joined as text."""

    parts: tuple[Expression, ...]


@final
class Address(Node, frozen=True, tag="&"):
    """``&a``."""

    value: Expression


@final
class Dereference(Node, frozen=True, tag="*"):
    """``*a``."""

    value: Expression


@final
class Cast(Node, frozen=True, tag="cast"):
    """Any C++ cast by keyword or parentheses."""

    type: Type
    value: Expression


@final
class TypeName(Node, frozen=True, tag="type"):
    """A type where an expression is expected (template argument, typeid)."""

    type: Type


@final
class Keyword(Node, frozen=True, tag="kw"):
    """A Python keyword argument, a C++ designated initialiser."""

    name: str
    value: Expression


@final
class Star(Node, frozen=True, tag="star"):
    """``*a`` among Python arguments or elements."""

    value: Expression


@final
class DoubleStar(Node, frozen=True, tag="starstar"):
    """``**a`` among Python arguments or entries."""

    value: Expression


@final
class Unknown(Node, frozen=True, tag="?"):
    """Anything else, as source text (at most 200 characters)."""

    text: str


Expression: TypeAlias = (
    String
    | Number
    | Boolean
    | Null
    | Name
    | This
    | Member
    | Subscript
    | Call
    | New
    | Operation
    | Assignment
    | Compiled
    | Conditional
    | Lambda
    | ListLiteral
    | DictLiteral
    | Format
    | Address
    | Dereference
    | Cast
    | TypeName
    | Keyword
    | Star
    | DoubleStar
    | Unknown
)
#: A template argument.
Argument: TypeAlias = Type | Expression
#: A type that is inferred, and one that nobody says.
AUTO = Type("auto")
NOTHING = Type("")
#: The name of a type that has the template arguments of the class before a function's name among those of a call.
OF_CLASS = "[class]"


def name_of(expression: Expression) -> str:
    """The name that an identifier or a member access says, as written; "" of anything else."""
    return expression.name if type(expression) is Name or type(expression) is Member else ""


def dotted(expression: Expression) -> str:
    """The names with dots that an expression is (``sys.path.insert``); "" of anything else."""
    parts: list[str] = []
    while type(expression) is Member:
        parts.append(expression.name)
        expression = expression.object
    return ".".join((expression.name, *reversed(parts))) if type(expression) is Name else ""
