# SPDX-License-Identifier: Apache-2.0
"""Lists of a setup.py that loops, comprehensions and functions fill: what is in them is known when it runs."""

from __future__ import annotations

import ast

from haros_ci.workspace.python_values import dotted

_FILLING = ("append", "extend", "insert")
_AROUND = (ast.For, ast.While, ast.ListComp, ast.SetComp, ast.GeneratorExp)
#: Functions that take no list to fill.
_HARMLESS = frozenset(("print", "setup", "len", "sorted"))


def filled(module: ast.Module) -> frozenset[str]:
    """The names that something in a loop, a comprehension or a function other than ``main`` appends to or extends.

    A list that is given to a function whose result nobody wants is filled there.
    """
    found: set[str] = set()
    todo: list[tuple[ast.AST, bool]] = [(module, False)]
    while todo:
        node, is_inside = todo.pop()
        is_inside = (
            is_inside or isinstance(node, _AROUND) or (isinstance(node, ast.FunctionDef) and node.name != "main")
        )
        if is_inside and isinstance(node, ast.Call):
            name, _, method = dotted(node.func).rpartition(".")
            found.update({name} if method in _FILLING else ())
        elif is_inside and isinstance(node, ast.AugAssign):
            found.add(dotted(node.target))
        elif isinstance(node, ast.Expr) and isinstance(node.value, ast.Call) and isinstance(node.value.func, ast.Name):
            arguments = node.value.args if node.value.func.id not in _HARMLESS else []
            found.update(node.id for node in arguments if isinstance(node, ast.Name))
        todo += [(child, is_inside) for child in ast.iter_child_nodes(node)]
    return frozenset(found - {""})
