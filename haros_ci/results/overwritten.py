# SPDX-License-Identifier: Apache-2.0
"""Functions of Python that the same block defines again before anything has called them: what is wrong in the first one never happens."""

from __future__ import annotations

import ast
import warnings
from functools import lru_cache

#: What only makes names, and calls nothing that stands in it.
_DEFINITIONS = (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)


def is_overwritten(text: str, line: int) -> bool:
    """Whether *line* of *text*, counted from 1, is in a function without a decorator that a later definition of the same block replaces.

    Nothing between the two mentions the name but other functions, and no statement between them calls anything. A definition in one branch of an ``if`` or a
    ``try`` replaces nothing. A file that Python cannot parse has none.
    """
    return any(first <= line <= last for first, last in _replaced(text))


@lru_cache(maxsize=16)
def _replaced(text: str) -> tuple[tuple[int, int], ...]:
    """The first and last lines of the functions."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            tree = ast.parse(text)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return ()
    found: list[tuple[int, int]] = []
    for node in ast.walk(tree):
        if isinstance(node, (ast.Module, *_DEFINITIONS)):
            found.extend(_in_block(node.body))
    return tuple(found)


def _in_block(block: list[ast.stmt]) -> list[tuple[int, int]]:
    last: dict[str, int] = {}
    for index, statement in enumerate(block):
        if isinstance(statement, _DEFINITIONS):
            last[statement.name] = index
    found = []
    for index, statement in enumerate(block):
        if not isinstance(statement, (ast.FunctionDef, ast.AsyncFunctionDef)) or statement.decorator_list:
            continue
        again = last[statement.name]
        if again > index and not any(_may_use(other, statement.name) for other in block[index + 1 : again + 1]):
            found.append((statement.lineno, statement.end_lineno or statement.lineno))
    return found


def _may_use(statement: ast.stmt, name: str) -> bool:
    """Whether *statement*, as it is run, may call or keep the function that is called *name* then."""
    if isinstance(
        statement, (ast.FunctionDef, ast.AsyncFunctionDef)
    ):  # its body is run later; what it begins with is run now
        arguments = statement.args
        parts = (*statement.decorator_list, *arguments.defaults, *filter(None, arguments.kw_defaults))
        return any(_mentions(part, name) for part in parts)
    if isinstance(statement, ast.ClassDef):
        return _mentions(statement, name)
    return _mentions(statement, name) or any(isinstance(node, ast.Call) for node in ast.walk(statement))


def _mentions(node: ast.AST, name: str) -> bool:
    return any(isinstance(inner, ast.Name) and inner.id == name for inner in ast.walk(node))
