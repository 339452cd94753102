# SPDX-License-Identifier: Apache-2.0
"""Definitions of Python of which pylint does not see what they are when the line runs: a class whose name is given away, a function that is there twice."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from typing import TypeAlias

from haros_ci.linters.pylint_idioms import nodes
from haros_ci.results.python_nodes import is_same

_DEFINITIONS = (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)
_Definition: TypeAlias = ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef
#: Decorators that hand a function on under another name, which they are given: those of Socket.IO, discord.py and the like.
#: Flask's ``route`` is none: it takes no second function of one name.
_REGISTERING = frozenset(
    "errorhandler event exception_handler handle handler listen listener on on_event on_message subscribe".split()
)


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


def loses_nothing(text: str, line: int) -> bool:
    """Whether nothing is lost where the function or class that begins at *line* takes the place of the one of its name before it in the block.

    It is word for word the same, or both are registered under names of their own: ``@io.on("open")`` above one ``def done``, ``@io.on("close")``
    above the other. Whoever calls those does not call them by the name that they share. Or what it replaces is a value of a class, which the
    class has used by then: ``format = "…"``, ``FORMATS = {1: format}``, ``def format(self, record)``.
    """
    for block in _blocks(text):
        before: dict[str, _Definition] = {}
        for statement in block:
            if not isinstance(statement, _DEFINITIONS):
                continue
            first = before.get(statement.name)
            begin = min([statement.lineno, *(decorator.lineno for decorator in statement.decorator_list)])
            if first is not None and begin <= line <= statement.lineno:
                one, other = _registered_as(first), _registered_as(statement)
                return is_same(first, statement) or (bool(one and other) and one != other)
            before[statement.name] = statement
    return any(
        _is_of_used_value(node, line)
        for node in nodes(text)
        if isinstance(node, ast.ClassDef) and node.lineno < line <= (node.end_lineno or 0)
    )


def _is_of_used_value(owner: ast.ClassDef, line: int) -> bool:
    """Whether the method of *owner* that begins at *line* takes the place of a value that the body of the class reads above it, and that no method reads."""
    read: set[str] = set()  # since its last assignment
    given: set[str] = set()
    for statement in owner.body:
        if isinstance(statement, _DEFINITIONS):
            begin = min([statement.lineno, *(decorator.lineno for decorator in statement.decorator_list)])
            if begin <= line <= statement.lineno:
                name = statement.name
                return name in given and name in read and not _is_read_as_value(owner, name)
            given.discard(statement.name)
            continue
        names = [node for node in ast.walk(statement) if isinstance(node, ast.Name)]
        stored = {node.id for node in names if not isinstance(node.ctx, ast.Load)}
        given |= stored
        read -= stored
        read |= {node.id for node in names if isinstance(node.ctx, ast.Load)} - stored
    return False


def _is_read_as_value(owner: ast.ClassDef, name: str) -> bool:
    """Whether *owner* reads its attribute *name* without calling it: it may have the value in mind, and gets the method."""
    inner = list(ast.walk(owner))
    called = {id(node.func) for node in inner if isinstance(node, ast.Call)}
    return any(
        isinstance(node, ast.Attribute)
        and node.attr == name
        and isinstance(node.value, ast.Name)
        and node.value.id in ("self", "cls", owner.name)
        and id(node) not in called
        for node in inner
    )


def _registered_as(definition: _Definition) -> str:
    """The only decorator of *definition*, a function, that registers it under a text; "" if it has no such decorator, or several."""
    if isinstance(definition, ast.ClassDef) or len(definition.decorator_list) != 1:
        return ""
    call = definition.decorator_list[0]
    if not (isinstance(call, ast.Call) and isinstance(call.func, ast.Attribute) and call.func.attr in _REGISTERING):
        return ""
    first = call.args[0] if call.args else None
    if not (isinstance(first, ast.Constant) and isinstance(first.value, str)):
        return ""
    return ast.dump(call)


def _blocks(text: str) -> Iterator[list[ast.stmt]]:
    for node in nodes(text):
        if isinstance(node, (ast.Module, *_DEFINITIONS)):
            yield node.body
