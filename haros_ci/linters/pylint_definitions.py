# SPDX-License-Identifier: Apache-2.0
"""Definitions of Python of which pylint does not see what they are when the line runs: a class whose name is given away, a function that is there twice."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from haros_ci.linters.pylint_idioms import nodes
from haros_ci.results.python_nodes import is_same

_DEFINITIONS = (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)


def is_of_renamed(text: str, line: int, column: int) -> bool:
    """Whether the method that is called there is of a name that a class of the file has, and that something else is assigned to: ``arm = arm()``.

    Pylint takes it for the class, whose methods lack an object. The *column* counts characters, from 0.
    """
    lines = text.split("\n")
    if not 0 < line <= len(lines):
        return False
    at = len(lines[line - 1][:column].encode("utf-8", "replace"))
    owners = {
        node.func.value.id
        for node in nodes(text)
        if isinstance(node, ast.Call)
        and (node.lineno, node.col_offset) == (line, at)
        and isinstance(node.func, ast.Attribute)
        and isinstance(node.func.value, ast.Name)
    }
    named = {node.name for node in nodes(text) if isinstance(node, ast.ClassDef)} & owners
    return any(
        isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store) and node.id in named for node in nodes(text)
    )


def is_the_same(text: str, line: int) -> bool:
    """Whether the function or class that begins at *line* is word for word the one of its name before it in the block: nothing is lost."""
    for block in _blocks(text):
        before: dict[str, ast.stmt] = {}
        for statement in block:
            if not isinstance(statement, _DEFINITIONS):
                continue
            first = before.get(statement.name)
            begin = min([statement.lineno, *(decorator.lineno for decorator in statement.decorator_list)])
            if first is not None and begin <= line <= statement.lineno:
                return is_same(first, statement)
            before[statement.name] = statement
    return False


def _blocks(text: str) -> Iterator[list[ast.stmt]]:
    for node in nodes(text):
        if isinstance(node, (ast.Module, *_DEFINITIONS)):
            yield node.body
