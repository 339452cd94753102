# SPDX-License-Identifier: Apache-2.0
"""What nodes of a syntax tree of Python say, however deep a hostile file nests them: ``ast.unparse`` and ``ast.dump`` call themselves for each level."""

from __future__ import annotations

import ast
import re

#: A name of more parts is none that anybody looks for.
MOST_PARTS = 30


def dotted(node: ast.AST) -> str:
    """The dotted name that *node* is (``a.b.c``); "" for anything else, and for a name of too many parts."""
    names: list[str] = []
    while isinstance(node, ast.Attribute) and len(names) < MOST_PARTS:
        names.append(node.attr)
        node = node.value
    return ".".join((node.id, *reversed(names))) if isinstance(node, ast.Name) else ""


def mentions(node: ast.AST, name: re.Pattern[str]) -> bool:
    """Whether a variable or an attribute in *node* is called as *name* searches for it."""
    return any(
        name.search(part.id if isinstance(part, ast.Name) else part.attr) is not None
        for part in ast.walk(node)
        if isinstance(part, ast.Name | ast.Attribute)
    )


def is_same(one: ast.AST, other: ast.AST) -> bool:
    """Whether two nodes are written alike, but for blanks, comments and places, and for what is read here and set there."""
    pairs: list[tuple[object, object]] = [(one, other)]
    while pairs:
        first, second = pairs.pop()
        if type(first) is not type(second):
            return False
        if isinstance(first, ast.AST) and isinstance(second, ast.AST):
            pairs += (
                (getattr(first, name, None), getattr(second, name, None)) for name in first._fields if name != "ctx"
            )
        elif isinstance(first, list) and isinstance(second, list):
            if len(first) != len(second):
                return False
            pairs += zip(first, second, strict=True)
        elif first != second:
            return False
    return True
