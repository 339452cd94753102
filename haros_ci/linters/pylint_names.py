# SPDX-License-Identifier: Apache-2.0
"""Names that pylint takes for undefined, and that other statements of the module set before."""

from __future__ import annotations

import ast
from functools import lru_cache

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
    return used is not None and used[0] in _deleted_globals(text)


@lru_cache(maxsize=4)
def _deleted_globals(text: str) -> frozenset[str]:
    """The global names that functions set, and those that they delete, too."""
    were_set: set[str] = set()
    deleted: set[str] = set()
    for function in nodes(text):
        if isinstance(function, ast.FunctionDef | ast.AsyncFunctionDef):
            own = [*own_nodes(ast.iter_child_nodes(function))]
            stated = {name for node in own if isinstance(node, ast.Global) for name in node.names}
            for use in own if stated else ():
                if isinstance(use, ast.Name) and use.id in stated and not isinstance(use.ctx, ast.Load):
                    (were_set if isinstance(use.ctx, ast.Store) else deleted).add(use.id)
    return frozenset(were_set & deleted)
