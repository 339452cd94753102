# SPDX-License-Identifier: Apache-2.0
"""What the statements of one function or module of Python are, without those of the functions and classes in it."""

from __future__ import annotations

import ast
from collections.abc import Iterable, Iterator
from itertools import takewhile

FUNCTIONS = (ast.FunctionDef, ast.AsyncFunctionDef, ast.Lambda)
#: Statements that are run as a whole, and expressions of which a part may not be run.
_SIMPLE = (ast.Expr, ast.Assign, ast.AugAssign, ast.Return)
_IN_PART = (ast.BoolOp, ast.IfExp, ast.Lambda)


def starts(body: list[ast.stmt]) -> tuple[int, ...]:
    """The first lines of the statements, sorted: those of decorators, and of what they decorate."""
    decorated = (one.decorator_list[:1] for one in body if isinstance(one, (*FUNCTIONS[:2], ast.ClassDef)))
    return tuple(sorted({*(one.lineno for one in body), *(one.lineno for first in decorated for one in first)}))


def sure_lines(node: ast.FunctionDef | ast.AsyncFunctionDef) -> frozenset[int]:
    """The first lines of the statements of a function before one that may leave it, without those of which a part may not be run."""
    if isinstance(node, ast.AsyncFunctionDef) or any(
        isinstance(one, ast.Yield | ast.YieldFrom) for one in own_nodes(node.body)
    ):
        return frozenset()
    sure = takewhile(lambda one: isinstance(one, _SIMPLE), node.body)
    return frozenset(one.lineno for one in sure if not any(isinstance(it, _IN_PART) for it in ast.walk(one)))


def deletions(body: list[ast.stmt]) -> set[int]:
    """Those among the outermost statements of a module or function: no branch or loop decides on them."""
    return {id(one) for one in body if isinstance(one, ast.Delete)}


def own_nodes(body: Iterable[ast.AST]) -> Iterator[ast.AST]:
    """All that a function is made of, but for what its inner functions and classes are."""
    todo: list[ast.AST] = list(body)
    while todo:
        node = todo.pop()
        yield node
        if not isinstance(node, (*FUNCTIONS, ast.ClassDef)):
            todo += ast.iter_child_nodes(node)


def names_in(body: list[ast.stmt]) -> frozenset[str]:
    """All names in the statements."""
    return frozenset(node.id for one in body for node in ast.walk(one) if isinstance(node, ast.Name))
