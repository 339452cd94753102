# SPDX-License-Identifier: Apache-2.0
"""Types from annotations, base classes and except clauses."""

from __future__ import annotations

import ast
import warnings
from collections.abc import Callable

from haros_ci import syntax
from haros_ci.syntax import Expression, Type

NO_TYPE = syntax.NOTHING
_DEEPEST = 20
_LONGEST_TEXT = 500


def dotted(node: ast.expr) -> str:
    """``a.b.c`` of names and attributes; "" for anything else."""
    parts: list[str] = []
    while isinstance(node, ast.Attribute):
        parts.append(node.attr)
        node = node.value
    if not isinstance(node, ast.Name):
        return ""
    return ".".join([node.id, *reversed(parts)])


def type_of(node: ast.expr | None, value: Callable[[ast.expr], Expression], depth: int = 0) -> Type:
    """The type that an annotation names, quoted ones too (PEP 484); ``NO_TYPE`` where it names none.

    ``A | B``, ``Union`` and a tuple of exceptions are ``Union`` of them, ``Callable[[A], R]`` a function type.
    *value* lowers the arguments of ``Literal``.
    """
    if node is None or depth > _DEEPEST:
        return NO_TYPE
    if isinstance(node, (ast.Name, ast.Attribute)):
        return syntax.Type(dotted(node))
    if isinstance(node, ast.Constant):
        return _constant(node, value, depth)
    if isinstance(node, ast.Subscript):
        return _generic(node, value, depth)
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.BitOr):
        return syntax.Type("Union", tuple([type_of(side, value, depth + 1) for side in (node.left, node.right)]), "")
    if isinstance(node, ast.Tuple):
        return syntax.Type("Union", tuple([type_of(item, value, depth + 1) for item in node.elts]), "")
    return NO_TYPE


def _constant(node: ast.Constant, value: Callable[[ast.expr], Expression], depth: int) -> Type:
    if node.value is None:
        return syntax.Type("None")
    if not isinstance(node.value, str) or len(node.value) > _LONGEST_TEXT:
        return NO_TYPE
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            inner = ast.parse(node.value.strip(), mode="eval").body
    except (SyntaxError, ValueError, MemoryError, RecursionError):
        return NO_TYPE
    for part in ast.walk(inner):
        ast.copy_location(part, node)
    return type_of(inner, value, depth + 1)


def _generic(node: ast.Subscript, value: Callable[[ast.expr], Expression], depth: int) -> Type:
    name = dotted(node.value)
    items = node.slice.elts if isinstance(node.slice, ast.Tuple) else [node.slice]
    last = name.rpartition(".")[2]
    if not name:
        return NO_TYPE
    if last == "Literal":
        return syntax.Type(name, tuple([value(item) for item in items]), "")
    if last == "Callable" and len(items) == 2 and isinstance(items[0], ast.List):
        types = [type_of(item, value, depth + 1) for item in (items[1], *items[0].elts)]
        return syntax.Type("()", tuple(types), "")
    if last == "Annotated":
        return type_of(items[0], value, depth + 1)
    return syntax.Type(name, tuple([type_of(item, value, depth + 1) for item in items]), "")
