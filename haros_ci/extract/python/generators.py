# SPDX-License-Identifier: Apache-2.0
"""Functions that yield, as functions that return a list of what they yield: whoever goes through it sees the same values in turn.

What such a function does while it is gone through it does at once, and ``next`` takes the first element away. A generator that is sent
values, or that a decorator makes something else of, stays as it is.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence
from typing import Any, TypeVar

#: The list: no name of Python.
YIELDED = "[yielded]"
#: Decorators that leave a generator what it is; what ``contextmanager`` makes of one has its first element for a ``with``.
_PLAIN = frozenset(("staticmethod", "classmethod", "contextmanager"))
_Node = TypeVar("_Node", bound=ast.AST)
_OWN_SCOPE = (ast.FunctionDef, ast.AsyncFunctionDef, ast.Lambda, ast.ClassDef)


def body_of(node: ast.FunctionDef | ast.AsyncFunctionDef) -> list[ast.stmt]:
    """The body of a function; of a generator that of one that returns what it yields."""
    yields = [item for item in _own(node.body) if isinstance(item, (ast.Yield, ast.YieldFrom))]
    if not yields or isinstance(node, ast.AsyncFunctionDef):
        return node.body
    statements = {id(item.value) for item in _own(node.body) if isinstance(item, ast.Expr)}
    if any(id(item) not in statements for item in yields):
        return node.body
    if any(getattr(item, "attr", getattr(item, "id", "")) not in _PLAIN for item in node.decorator_list):
        return node.body
    first, last = node.body[0], node.body[-1]
    made = ast.Assign(targets=[ast.Name(YIELDED, ast.Store())], value=ast.List([], ast.Load()))
    end = ast.Return(ast.Name(YIELDED, ast.Load()))
    return [_placed(made, first), *_block(node.body), _placed(end, last)]


def _own(body: Sequence[ast.AST]) -> Iterator[ast.AST]:
    """What stands in a function itself, and in no function or class inside of it."""
    waiting = list(body)
    while waiting:
        item = waiting.pop()
        yield item
        if not isinstance(item, _OWN_SCOPE):
            waiting += ast.iter_child_nodes(item)


def _block(body: Sequence[ast.stmt]) -> list[ast.stmt]:
    return [_statement(item) for item in body]


def _statement(node: ast.stmt) -> ast.stmt:
    """A statement with what it yields kept, and what it returns dropped."""
    if isinstance(node, _OWN_SCOPE):
        return node
    if isinstance(node, ast.Expr) and isinstance(node.value, (ast.Yield, ast.YieldFrom)):
        method = "append" if isinstance(node.value, ast.Yield) else "extend"
        value = node.value.value or ast.Constant(None)
        callee = ast.Attribute(ast.Name(YIELDED, ast.Load()), method, ast.Load())
        return _placed(ast.Expr(ast.Call(callee, [value], [])), node)
    if isinstance(node, ast.Return):
        return _placed(ast.Return(ast.Name(YIELDED, ast.Load())), node)
    return _rebuilt(node)


def _rebuilt(node: _Node) -> _Node:
    """A node with what is inside of its blocks changed."""
    fields: dict[str, Any] = {name: _inside(value) for name, value in ast.iter_fields(node)}
    return ast.copy_location(type(node)(**fields), node)


def _inside(value: object) -> object:
    if not isinstance(value, list):
        return value
    return [
        _statement(item)
        if isinstance(item, ast.stmt)
        else _rebuilt(item)
        if isinstance(item, (ast.ExceptHandler, ast.match_case))
        else item
        for item in value
    ]


def _placed(made: ast.stmt, where: ast.stmt) -> ast.stmt:
    """*made*, and what it is made of, at the place of *where*."""
    for item in ast.walk(made):
        if "lineno" in item._attributes and not hasattr(item, "lineno"):
            ast.copy_location(item, where)
    return made
