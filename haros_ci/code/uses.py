# SPDX-License-Identifier: Apache-2.0
"""Every mention of a local variable in a routine, with what happens to it there."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from haros_ci.code.body import last_part
from haros_ci.code.codebase import Codebase, Routine
from haros_ci.model.program import Expression

#: What makes no other value of its argument.
SAME = frozenset(("move", "forward"))


@dataclass(frozen=True, slots=True, eq=False)
class Use:
    """A mention: *path* are the members that follow the name (``header``, ``stamp``), "" for an element of a list.

    *role* is set, read, argument, receiver, address, returned or captured; *call* the call that it is an argument or receiver of.
    """

    path: tuple[str, ...]
    role: str
    call: Expression | None = None


def uses(code: Codebase, routine: Routine, name: str) -> tuple[Use, ...]:
    """All mentions of the variable *name* in a routine and in the lambdas in it; its declaration is none."""
    found = list(_visit(routine.function.body or (), name, "read", None))
    for index, _ in code.body(routine).inner:
        inner = code.inner(routine, index)
        if inner is not None and any(_visit(inner.function.body or (), name, "read", None)):
            found.append(Use((), "captured"))
    return tuple(found)


def _path(node: Any, name: str) -> tuple[str, ...] | None:
    """The members between *name* and *node*; None if it does not begin with the name."""
    path: list[str] = []
    while True:
        if node[0] == "name":
            return tuple(reversed(path)) if node[1] == name else None
        if node[0] == "field":
            path.append(node[2])
            node = node[1]
        elif node[0] == "index":
            path.append("")
            node = node[1]
        elif node[0] == "*":
            node = node[1]
        else:
            return None


def _visit(node: Any, name: str, role: str, call: Any) -> Iterator[Use]:
    if not isinstance(node, (tuple, list)) or not node:
        return
    tag = node[0]
    if tag in ("name", "field", "index", "*") and (path := _path(node, name)) is not None:
        yield Use(path, role, call)
        yield from _indexes(node, name)
        return
    if tag == "set" and len(node) == 4 and isinstance(node[1], str):
        yield from _visit(node[2], name, "set", None)
        yield from _visit(node[3], name, "read", None)
    elif tag == "call" and len(node) == 6:
        callee = node[1]
        if callee[0] == "field":
            yield from _visit(callee[1], name, "receiver", node)
        else:
            yield from _visit(callee, name, "read", None)
        same = last_part(callee) in SAME and call is not None
        for each in node[2]:
            yield from _visit(each, name, "argument", call if same else node)
    elif tag == "&" and len(node) == 2:
        yield from _visit(node[1], name, "address", call)
    elif tag == "return" and len(node) == 2:
        yield from _visit(node[1], name, "returned", None)
    elif tag in ("cast", "kw") and len(node) == 3:
        yield from _visit(node[2], name, role, call)
    elif tag == "op" and len(node) == 3 and node[1] in ("<<", ">>"):
        for each in node[2]:
            yield from _visit(each, name, "address", None)
    elif tag == "var" and len(node) == 6:
        if node[3] is not None:
            inner = (node[3][1],) if node[3][0] == "=" else node[3][1]
            #: a reference to it, or an object that is given it
            how = "address" if "&" in node[2][2] or "*" in node[2][2] or node[3][0] != "=" else "read"
            for each in inner:
                yield from _visit(each, name, how, None)
    else:
        for each in node:
            yield from _visit(each, name, "read", None)


def _indexes(node: Any, name: str) -> Iterator[Use]:
    """Mentions inside the brackets of ``a[i].b[j]``."""
    while node[0] in ("field", "index", "*"):
        if node[0] == "index":
            yield from _visit(node[2], name, "read", None)
        node = node[1]
