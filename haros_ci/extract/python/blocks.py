# SPDX-License-Identifier: Apache-2.0
"""What ``with`` and ``try`` of Python do beside their blocks: context managers are entered and left, names are bound again."""

from __future__ import annotations

import ast
import copy
from typing import Any, Protocol

from haros_ci import syntax
from haros_ci.extract.python.imports import imported
from haros_ci.extract.python.scope import PythonScope
from haros_ci.syntax import Block, Expression


def may_enter(manager: ast.expr) -> bool:
    """Whether what a ``with`` names may be of the workspace: no file that is opened, and no lock."""
    called = manager.func if isinstance(manager, ast.Call) else manager
    name = called.attr if isinstance(called, ast.Attribute) else getattr(called, "id", "")
    return name not in ("open", "suppress", "") and not any(word in name.lower() for word in ("lock", "mutex"))


def of_manager(manager: Expression, method: str, at: tuple[int, int]) -> Expression:
    """What a ``with`` calls of its context manager at its beginning and its end (docs.python.org, the with statement)."""
    return syntax.Call(syntax.Member(manager, method), (), (), *at)


def suppressed_by(entered: ast.expr) -> ast.Call | None:
    """``contextlib.suppress(…)``: the body of the ``with`` ends at these exceptions, as that of a ``try`` that passes over them."""
    if not isinstance(entered, ast.Call) or not entered.args:
        return None
    name = entered.func.attr if isinstance(entered.func, ast.Attribute) else getattr(entered.func, "id", "")
    return entered if name == "suppress" else None


class Tried(Protocol):
    """``try`` with ``except`` and with ``except*``, which Python 3.10 does not have."""

    body: list[ast.stmt]
    handlers: list[ast.ExceptHandler]
    orelse: list[ast.stmt]
    finalbody: list[ast.stmt]


def bound_again(node: Tried, scope: PythonScope) -> Block:
    """The imports of a module's tried block whose names a handler assigns to (``except ImportError: Foo = None``)."""
    if scope.kind != "module" or not any(isinstance(one, (ast.Import, ast.ImportFrom)) for one in node.body):
        return ()
    names = {
        name.id
        for handler in node.handlers
        for one in handler.body
        for target in (one.targets if isinstance(one, ast.Assign) else ())
        for name in (target.elts if isinstance(target, (ast.Tuple, ast.List)) else (target,))
        if isinstance(name, ast.Name)
    }
    found = [pair for one in node.body if isinstance(one, (ast.Import, ast.ImportFrom)) for pair in imported(one)]
    return tuple([syntax.Import(name, target) for name, target in found if name in names])


def left_by_finally(node: Tried) -> Tried | None:
    """*node* without what ``finally`` says and with ``raise`` for ``return``, where ``finally`` returns something: that counts, and no exception leaves it.

    docs.python.org/3/reference/compound_stmts.html, the try statement. None where it returns nothing, or under a condition.
    """
    if not any(isinstance(statement, ast.Return) for statement in node.finalbody):
        return None
    left: Any = copy.copy(node)
    left.finalbody = []
    left.body, left.orelse, left.handlers = (
        [_Raising().visit(copy.deepcopy(item)) for item in items] for items in (node.body, node.orelse, node.handlers)
    )
    for name in ("body", "orelse"):
        setattr(
            left, name, [one for item in getattr(left, name) for one in (item if isinstance(item, list) else [item])]
        )
    made: Tried = left
    return made


def done_before_leaving(node: Tried) -> Tried | None:
    """*node* with what ``finally`` says also before each statement that leaves it; None where there is none, or there are many.

    It is done behind what a ``return`` gives: that makes no difference to what it makes. What is raised in the block counts where nothing catches it there.
    """
    parts = (node.body, node.orelse, *(handler.body for handler in node.handlers))
    if not node.finalbody or not any(
        isinstance(one, _LEAVING) for part in parts for top in part for one in ast.walk(top)
    ):
        return None
    left: Any = copy.copy(node)
    leaving = _Leaving(node.finalbody)
    left.body = leaving.block(node.body, raises=not node.handlers)
    left.orelse = leaving.block(node.orelse, raises=True)
    left.handlers = [copy.copy(handler) for handler in node.handlers]
    for handler in left.handlers:
        handler.body = leaving.block(handler.body, raises=True)
    made: Tried = left
    return made if 0 < leaving.count <= _MOST_LEAVING else None


#: Statements that leave a block, and so many of them in one are looked at.
_LEAVING = (ast.Return, ast.Raise, ast.Break, ast.Continue)
_MOST_LEAVING = 8


class _Leaving(ast.NodeTransformer):
    """Puts statements before each one that leaves a block of a function itself."""

    def __init__(self, before: list[ast.stmt]) -> None:
        self.before = before
        self.count = self._loops = 0
        self._raises = True

    def block(self, statements: list[ast.stmt], *, raises: bool) -> list[ast.stmt]:
        """A copy of *statements* with the others put in; before ``raise`` only where it leaves the block."""
        self._raises = raises
        found = [self.visit(copy.deepcopy(one)) for one in statements]
        return [one for item in found for one in (item if isinstance(item, list) else [item])]

    def _leave(self, node: ast.stmt) -> list[ast.stmt]:
        self.count += 1
        return [*self.before, node]

    def visit_Return(self, node: ast.Return) -> list[ast.stmt]:
        return self._leave(node)

    def visit_Raise(self, node: ast.Raise) -> list[ast.stmt] | ast.stmt:
        return self._leave(node) if self._raises else node

    def visit_Break(self, node: ast.Break) -> list[ast.stmt] | ast.stmt:
        return node if self._loops else self._leave(node)

    def visit_Continue(self, node: ast.Continue) -> list[ast.stmt] | ast.stmt:
        return node if self._loops else self._leave(node)

    def visit_For(self, node: ast.For | ast.AsyncFor | ast.While) -> ast.AST:
        self._loops += 1
        node.body = [one for item in map(self.visit, node.body) for one in (item if isinstance(item, list) else [item])]
        self._loops -= 1
        return node

    visit_AsyncFor = visit_While = visit_For

    def _keep(self, node: ast.AST) -> ast.AST:
        return node

    visit_FunctionDef = visit_AsyncFunctionDef = visit_ClassDef = visit_Lambda = _keep


class _Raising(ast.NodeTransformer):
    """Puts ``raise`` in the place of each ``return`` of a function itself."""

    def visit_Return(self, node: ast.Return) -> list[ast.stmt]:
        leaving = ast.copy_location(ast.Raise(exc=None, cause=None), node)
        return [leaving] if node.value is None else [ast.copy_location(ast.Expr(node.value), node), leaving]

    def _keep(self, node: ast.AST) -> ast.AST:
        return node

    visit_FunctionDef = visit_AsyncFunctionDef = visit_ClassDef = visit_Lambda = _keep
