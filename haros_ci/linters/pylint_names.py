# SPDX-License-Identifier: Apache-2.0
"""Names that pylint takes for undefined, and that other statements of the module set before."""

from __future__ import annotations

import ast

from haros_ci.linters.bodies import own_nodes
from haros_ci.linters.pylint_idioms import nodes
from haros_ci.regex import regex

_SCOPES = (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)
_NAME = regex(r"[A-Za-z_]\w*")


def is_counted_up(text: str, line: int) -> bool:
    """Whether a name is changed there (``total += 1``) that a branch or loop above it, of the same function, sets.

    Pylint takes it for undefined if it is set under a condition, and says nothing of the same name where it is read.
    """
    found = [node for node in nodes(text) if isinstance(node, ast.AugAssign) and node.lineno == line]
    if len(found) != 1 or not isinstance(found[0].target, ast.Name):
        return False
    name, scopes_of_all = found[0].target.id, [node for node in nodes(text) if isinstance(node, _SCOPES)]
    around = [scope for scope in scopes_of_all if scope.lineno <= line <= (scope.end_lineno or 0)]
    scope = max(around, key=lambda scope: scope.lineno, default=next(iter(nodes(text))))
    changed = {id(node.target) for node in own_nodes(ast.iter_child_nodes(scope)) if isinstance(node, ast.AugAssign)}
    return any(
        isinstance(inner, ast.Name)
        and inner.id == name
        and isinstance(inner.ctx, ast.Store)
        and inner.lineno < line
        and id(inner) not in changed
        for inner in own_nodes(ast.iter_child_nodes(scope))
    )


def is_deleted_global(text: str, line: int, column: int) -> bool:
    """Whether the name there is a global one that functions set, and delete when they are done with it (``del recorder``).

    Pylint takes such a name for undefined in all functions: which of them has run before, it does not know.
    """
    used = _NAME.match(text.split("\n")[line - 1], column) if 0 < line <= text.count("\n") + 1 else None
    if used is None:
        return False
    name, is_set, is_deleted = used[0], False, False
    for function in nodes(text):
        if not isinstance(function, ast.FunctionDef | ast.AsyncFunctionDef):
            continue
        own = [*own_nodes(ast.iter_child_nodes(function))]
        if any(isinstance(node, ast.Global) and name in node.names for node in own):
            uses = [node.ctx for node in own if isinstance(node, ast.Name) and node.id == name]
            is_set = is_set or any(isinstance(use, ast.Store) for use in uses)
            is_deleted = is_deleted or any(isinstance(use, ast.Del) for use in uses)
    return is_set and is_deleted
