# SPDX-License-Identifier: Apache-2.0
"""The names that a module of Python has once it is imported, as far as its text says."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from functools import lru_cache

from haros_ci.checking.branches import parsed
from haros_ci.regex import regex

#: What may give a module further names: what is imported from elsewhere, and names that are made while it runs.
_MADE = regex(
    r"\bimport[ \t]*\(?[ \t]*\*|\b__getattr__\b|\b__dict__\b|\b(?:globals|locals|vars|setattr|exec|eval)[ \t]*\(|\bsys\.modules\b|\bimportlib\b"
)
_FUNCTIONS = (ast.FunctionDef, ast.AsyncFunctionDef)


@lru_cache(maxsize=512)
def names_of(text: str) -> frozenset[str] | None:
    """The names that the module with this *text* binds in any branch; None where it may have others, or cannot be parsed.

    Those of functions and classes are not in it, but for what a function declares as ``global``.
    """
    tree = parsed(text) if _MADE.search(text) is None else None
    return None if tree is None else frozenset(_bound(tree))


def _bound(tree: ast.Module) -> Iterator[str]:
    todo: list[ast.AST] = [tree]
    while todo:
        node = todo.pop()
        if isinstance(node, (*_FUNCTIONS, ast.ClassDef)):
            yield node.name
            yield from _global(node)
            continue
        if isinstance(node, ast.Lambda):
            continue
        if isinstance(node, ast.alias):
            yield (node.asname or node.name).partition(".")[0]
        elif isinstance(node, ast.Name):
            if not isinstance(node.ctx, ast.Load):
                yield node.id
        elif isinstance(node, (ast.ExceptHandler, ast.MatchAs, ast.MatchStar)) and node.name:
            yield node.name
        elif isinstance(node, ast.MatchMapping) and node.rest:
            yield node.rest
        todo += ast.iter_child_nodes(node)


def _global(node: ast.AST) -> Iterator[str]:
    for inner in ast.walk(node):
        if isinstance(inner, ast.Global):
            yield from inner.names
