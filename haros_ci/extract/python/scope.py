# SPDX-License-Identifier: Apache-2.0
"""What lowering a Python file collects, and where in it a statement stands."""

from __future__ import annotations

import ast
from dataclasses import replace

import msgspec

from haros_ci import syntax
from haros_ci.extract.python.source import Source, unknown
from haros_ci.records import dataclass, field
from haros_ci.syntax import Alias, Class, Expression, Field, Function, Type

#: Statements and expressions within each other; what lies deeper is unknown, and a problem says where.
DEEPEST = 100
_LONGEST_NAME = 1000


@dataclass(slots=True)
class Bindings:
    """Names that a module's or class's own statements bind; of *uncertain* ones no single value is known."""

    fields: dict[str, tuple[Field, ast.AST]] = field(default_factory=dict)
    uncertain: set[str] = field(default_factory=set)


@dataclass(slots=True)
class Collected:
    """What grows while a file is lowered: the parts of its Program, and names *rebound* from inside a function."""

    source: Source
    functions: list[Function | None] = field(default_factory=list)
    classes: list[Class] = field(default_factory=list)
    aliases: dict[Alias, None] = field(default_factory=dict)
    rebound: set[str] = field(default_factory=set)
    problems: list[tuple[int, str]] = field(default_factory=list)


@dataclass(frozen=True, slots=True)
class PythonScope:
    """*name* is qualified; *this* the name of the method's first parameter; *bindings* are a module's or class's."""

    file: Collected
    kind: str  # module, class or function
    name: str = ""
    this: str | None = None
    bindings: Bindings | None = None
    conditional: bool = False


def qualified(scope: PythonScope, name: str) -> str:
    """*name* within *scope*, joined by a dot; cut where no one would write it so long."""
    return (f"{scope.name}.{name}" if scope.name else name)[:_LONGEST_NAME]


def conditionally(scope: PythonScope) -> PythonScope:
    """The same scope inside a statement that may not run, or more than once."""
    return scope if scope.bindings is None or scope.conditional else replace(scope, conditional=True)


def bind(
    scope: PythonScope, name: str, type_: Type, value: Expression | None, node: ast.AST, place: tuple[int, int]
) -> None:
    """Note a binding of *name* in a module or class; *value* None where a statement says only the type."""
    bindings = scope.bindings
    if bindings is None:
        return
    if name in bindings.fields or scope.conditional:
        bindings.uncertain.add(name)
    init = None if value is None else syntax.Equals(value)
    bindings.fields.setdefault(name, (Field(name, type_, init, *place, is_static=scope.kind == "class"), node))


def bound(bindings: Bindings, source: Source, elsewhere: set[str]) -> tuple[Field, ...]:
    """The fields in order; one that is bound twice, conditionally, or *elsewhere* has its statement as unknown text."""
    return tuple(
        msgspec.structs.replace(found, init=syntax.Equals(unknown(source, node)))
        if name in bindings.uncertain or name in elsewhere
        else found
        for name, (found, node) in bindings.fields.items()
    )


def rebind(scope: PythonScope, *names: str) -> None:
    """Note that a module or class binds *names* in a way that has no value to show."""
    if scope.bindings is not None:
        scope.bindings.uncertain.update(names)


def too_deep(scope: PythonScope, node: ast.AST) -> None:
    """Note once per file that it is nested deeper than is read."""
    message = f"nested deeper than {DEEPEST} levels: what lies deeper is unknown; split the statement or function"
    if all(text != message for _, text in scope.file.problems):
        scope.file.problems.append((node.lineno, message))  # type: ignore[attr-defined]  # statements and expressions have a line
