# SPDX-License-Identifier: Apache-2.0
"""Names that pylint takes for undefined, and that other statements of the module set before."""

from __future__ import annotations

import ast
from functools import lru_cache

from haros_ci.linters.bodies import own_nodes
from haros_ci.linters.pylint_idioms import nodes
from haros_ci.regex import regex

_SCOPES = (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)
_FUNCTIONS = (ast.FunctionDef, ast.AsyncFunctionDef)
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


def is_set_by_main(text: str, line: int, column: int) -> bool:
    """Whether the name there is a global one that another function sets for certain, which the program begins with: ``main()``, or one that the module calls.

    Pylint does not take a ``global`` statement of a function for a definition where the module itself has none.
    """
    used = _NAME.match(text.split("\n")[line - 1], column) if 0 < line <= text.count("\n") + 1 else None
    tree = next(iter(nodes(text)), None) if used is not None and "global" in text else None
    if used is None or not isinstance(tree, ast.Module):
        return False
    called = {
        node.func.id
        for one in tree.body
        if not isinstance(one, _SCOPES)
        for node in own_nodes([one])
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name)
    }
    first = [
        one
        for one in tree.body
        if isinstance(one, _FUNCTIONS) and (one.name == "main" or one.name in called) and _sets(one, used[0])
    ]
    inside = [one for one in tree.body if one.lineno <= line <= (one.end_lineno or 0)]
    return bool(first) and bool(inside) and isinstance(inside[0], _SCOPES) and inside[0] not in first


def _sets(function: ast.FunctionDef | ast.AsyncFunctionDef, name: str) -> bool:
    """Whether *function* says that *name* is global, and sets it in a statement of its own that no branch or loop decides on."""
    own = [*own_nodes(ast.iter_child_nodes(function))]
    return any(isinstance(node, ast.Global) and name in node.names for node in own) and any(
        isinstance(target, ast.Name) and target.id == name
        for one in function.body
        if isinstance(one, ast.Assign)
        for target in one.targets
    )
