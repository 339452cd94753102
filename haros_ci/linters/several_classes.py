# SPDX-License-Identifier: Apache-2.0
"""Calls of a method of what may be an object of several classes: pylint knows one of them."""

from __future__ import annotations

import ast

from haros_ci.linters.pylint_idioms import nodes
from haros_ci.results.python_nodes import dotted, is_same

_FUNCTIONS = (ast.FunctionDef, ast.AsyncFunctionDef)
_Function = ast.FunctionDef | ast.AsyncFunctionDef


def is_of_several_classes(text: str, line: int, column: int) -> bool:
    """Whether the method that is called there is of a variable or attribute that the file makes objects of several classes for, and the call fits one of them.

    ``self.client = Local() if near else Remote()``, or in two branches, and ``self.client.fetch()``. What a class of another file takes is not known.
    """
    for node in nodes(text):
        if not isinstance(node, ast.Call) or (node.lineno, node.col_offset) != (line, column):
            continue
        if isinstance(node.func, ast.Attribute) and dotted(node.func.value) not in ("", "self", "cls"):
            classes = _classes(text, node.func.value)
            return len(classes) > 1 and any(_fits(node, name, node.func.attr, text) for name in classes)
    return False


def _classes(text: str, owner: ast.expr) -> set[str]:
    """The names of the classes whose objects *owner* is set to, as far as they are called like classes."""
    found: set[str] = set()
    for node in nodes(text):
        targets = (
            node.targets if isinstance(node, ast.Assign) else [node.target] if isinstance(node, ast.AnnAssign) else []
        )
        value = node.value if isinstance(node, ast.Assign | ast.AnnAssign) else None
        if value is None or not any(is_same(target, owner) for target in targets):
            continue
        for one in (value.body, value.orelse) if isinstance(value, ast.IfExp) else (value,):
            name = dotted(one.func).rpartition(".")[2] if isinstance(one, ast.Call) else ""
            if name[:1].isupper():
                found.add(name)
    return found


def _fits(call: ast.Call, owner: str, method: str, text: str) -> bool:
    """Whether *call* fits the *method* of the class *owner*, as far as the file shows."""
    found = next((node for node in nodes(text) if isinstance(node, ast.ClassDef) and node.name == owner), None)
    if found is None:
        return True
    function = next((one for one in found.body if isinstance(one, _FUNCTIONS) and one.name == method), None)
    if function is None or function.decorator_list:
        return bool(found.bases) or function is not None
    return _takes(call, function)


def _takes(call: ast.Call, function: _Function) -> bool:
    if any(isinstance(one, ast.Starred) for one in call.args) or any(one.arg is None for one in call.keywords):
        return True
    taken = [one.arg for one in (*function.args.posonlyargs, *function.args.args)][1:]
    named = {one.arg for one in call.keywords}
    only = [one.arg for one in function.args.kwonlyargs]
    if len(call.args) > len(taken) and function.args.vararg is None:
        return False
    if not named <= {*taken, *only} and function.args.kwarg is None:
        return False
    optional = set(taken[len(taken) - len(function.args.defaults) :]) if function.args.defaults else set()
    optional |= {name for name, value in zip(only, function.args.kw_defaults, strict=True) if value is not None}
    return {*taken[len(call.args) :], *only} <= named | optional
