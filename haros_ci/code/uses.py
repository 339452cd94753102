# SPDX-License-Identifier: Apache-2.0
"""Every mention of a local variable in a routine, with what happens to it there."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci import syntax
from haros_ci.code.body import last_part
from haros_ci.code.codebase import Codebase, Routine
from haros_ci.records import dataclass
from haros_ci.syntax import Record
from haros_ci.syntax.walk import Part, below

#: What makes no other value of its argument.
SAME = frozenset(("move", "forward"))


@dataclass(frozen=True, slots=True, eq=False)
class Use:
    """A mention: *path* are the members that follow the name (``header``, ``stamp``), "" for an element of a list.

    *role* is set, read, argument, receiver, address, returned or captured; *call* the call that it is an argument or receiver of.
    """

    path: tuple[str, ...]
    role: str
    call: syntax.Call | None = None


def uses(code: Codebase, routine: Routine, name: str) -> tuple[Use, ...]:
    """All mentions of the variable *name* in a routine and in the lambdas in it; its declaration does not count."""
    found = list(_visit(routine.function.body or (), name, "read", None))
    for index, _ in code.body(routine).inner:
        inner = code.inner(routine, index)
        if inner is not None and any(_visit(inner.function.body or (), name, "read", None)):
            found.append(Use((), "captured"))
    return tuple(found)


def _path(node: Record, name: str) -> tuple[str, ...] | None:
    """The members between *name* and *node*; None if it does not begin with the name."""
    path: list[str] = []
    while True:
        if isinstance(node, syntax.Name):
            return tuple(reversed(path)) if node.name == name else None
        if isinstance(node, syntax.Member):
            path.append(node.name)
            node = node.object
        elif isinstance(node, syntax.Subscript):
            path.append("")
            node = node.object
        elif isinstance(node, syntax.Dereference):
            node = node.value
        else:
            return None


def _visit(node: Part, name: str, role: str, call: syntax.Call | None) -> Iterator[Use]:
    if isinstance(node, syntax.Record) and (path := _path(node, name)) is not None:
        yield Use(path, role, call)
        yield from _indexes(node, name)
    elif isinstance(node, syntax.Assignment):
        yield from _visit(node.target, name, "set", None)
        yield from _visit(node.value, name, "read", None)
    elif isinstance(node, syntax.Call):
        callee = node.callee
        if isinstance(callee, syntax.Member):
            yield from _visit(callee.object, name, "receiver", node)
        else:
            yield from _visit(callee, name, "read", None)
        same = last_part(callee) in SAME and call is not None
        for argument in node.arguments:
            yield from _visit(argument, name, "argument", call if same else node)
    elif isinstance(node, syntax.Address):
        yield from _visit(node.value, name, "address", call)
    elif isinstance(node, syntax.Return):
        yield from _visit(node.value, name, "returned", None)
    elif isinstance(node, (syntax.Cast, syntax.Keyword)):
        yield from _visit(node.value, name, role, call)
    elif isinstance(node, syntax.Operation) and node.operator in ("<<", ">>"):
        for operand in node.operands:
            yield from _visit(operand, name, "address", None)
    elif isinstance(node, syntax.Variable):
        marks = node.type.marks
        #: a reference to it, or an object that is given it
        how = "address" if "&" in marks or "*" in marks or not isinstance(node.init, syntax.Equals) else "read"
        for literal in syntax.started(node.init):
            yield from _visit(literal, name, how, None)
    else:
        for inner in below(node):
            yield from _visit(inner, name, "read", None)


def _indexes(node: Record, name: str) -> Iterator[Use]:
    """Mentions inside the brackets of ``a[i].b[j]``."""
    while isinstance(node, (syntax.Member, syntax.Subscript, syntax.Dereference)):
        if isinstance(node, syntax.Subscript):
            yield from _visit(node.index, name, "read", None)
        node = node.value if isinstance(node, syntax.Dereference) else node.object
