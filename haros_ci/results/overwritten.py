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


def is_used_before(text: str, line: int) -> bool:
    """Whether the function or class that *line* of *text* begins has the name of one before it in the block that is used in between.

    Nothing is lost then: the first one is registered as a callback, say, and the second is another's. A decorator may stand at *line*.
    """
    return any(line in lines for lines in _used(text))


@lru_cache(maxsize=16)
def _used(text: str) -> tuple[range, ...]:
    """The lines from the decorators to the head of the definitions that replace what was used."""
    found: list[range] = []
    for node in ast.walk(_parsed(text)):
        if isinstance(node, (ast.Module, *_DEFINITIONS)):
            before: dict[str, int] = {}
            for index, statement in enumerate(node.body):
                if not isinstance(statement, _DEFINITIONS):
                    continue
                first = before.get(statement.name)
                between = node.body[first + 1 : index] if first is not None else []
                if any(_mentions_now(other, statement.name) for other in between):
                    lines = [decorator.lineno for decorator in statement.decorator_list] + [statement.lineno]
                    found.append(range(min(lines), statement.lineno + 1))
                before[statement.name] = index
    return tuple(found)


def _mentions_now(statement: ast.stmt, name: str) -> bool:
    """Whether *statement* reads the name as it is run, not in the body of a function."""
    if isinstance(statement, (ast.FunctionDef, ast.AsyncFunctionDef)):
        return _may_use(statement, name)
    return _mentions(statement, name)


@lru_cache(maxsize=16)
def _replaced(text: str) -> tuple[tuple[int, int], ...]:
    """The first and last lines of the functions."""
    found: list[tuple[int, int]] = []
    for node in ast.walk(_parsed(text)):
        if isinstance(node, (ast.Module, *_DEFINITIONS)):
            found.extend(_in_block(node.body))
    return tuple(found)


def _parsed(text: str) -> ast.Module:
    """The file; an empty one where Python cannot parse it."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return ast.parse(text)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return ast.Module([], [])


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
