# SPDX-License-Identifier: Apache-2.0
"""What ``with`` and ``try`` of Python do beside their blocks: context managers are entered and left, names are bound again."""

from __future__ import annotations

import ast
import copy
from collections.abc import Callable
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
    return _rewritten_try(node, _raising, _raising, [])


def _raising(statement: ast.stmt, in_loop: bool) -> list[ast.stmt] | None:
    if not isinstance(statement, ast.Return):
        return None
    leaving = ast.copy_location(ast.Raise(exc=None, cause=None), statement)
    return [leaving] if statement.value is None else [ast.copy_location(ast.Expr(statement.value), statement), leaving]


def done_before_leaving(node: Tried) -> Tried | None:
    """*node* with what ``finally`` says also before each statement that leaves it; None where there is none, or there are many.

    It is done behind what a ``return`` gives: that makes no difference to what it makes. What is raised in the block counts where nothing catches it there.
    """
    count = 0

    def leaving(statement: ast.stmt, in_loop: bool) -> list[ast.stmt] | None:
        nonlocal count
        if not isinstance(statement, _LEAVING) or (in_loop and isinstance(statement, (ast.Break, ast.Continue))):
            return None
        count += 1
        return [*node.finalbody, statement]

    def caught(statement: ast.stmt, in_loop: bool) -> list[ast.stmt] | None:
        return None if isinstance(statement, ast.Raise) else leaving(statement, in_loop)

    if not node.finalbody:
        return None
    made = _rewritten_try(node, caught if node.handlers else leaving, leaving, node.finalbody)
    return made if 0 < count <= _MOST_LEAVING else None


#: Statements that leave a block, and so many of them in one are looked at.
_LEAVING = (ast.Return, ast.Raise, ast.Break, ast.Continue)
_MOST_LEAVING = 8
#: So many blocks inside blocks are gone into; each ``elif`` is one inside of the one before.
_DEEPEST = 100
_LOOPS = (ast.For, ast.AsyncFor, ast.While)
_DEFINITIONS = (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)
#: What is written for a statement, in a loop of the block or not; None for the statement itself.
_Way = Callable[[ast.stmt, bool], "list[ast.stmt] | None"]


def _rewritten_try(node: Tried, in_body: _Way, elsewhere: _Way, finalbody: list[ast.stmt]) -> Tried:
    """A copy of *node* whose block, and whose other parts, are written as the two ways say."""
    left: Any = copy.copy(node)
    left.body, left.orelse = _rewritten(node.body, in_body), _rewritten(node.orelse, elsewhere)
    left.handlers = [_with_body(handler, elsewhere) for handler in node.handlers]
    left.finalbody = finalbody
    made: Tried = left
    return made


def _rewritten(block: list[ast.stmt], way: _Way, in_loop: bool = False, depth: int = 0) -> list[ast.stmt]:
    """A copy of *block* with what *way* says for its statements, and those inside of them that are of the same function; expressions are shared."""
    if depth > _DEEPEST:
        return block
    found: list[ast.stmt] = []
    for statement in block:
        instead = way(statement, in_loop)
        if instead is not None or isinstance(statement, _DEFINITIONS):
            found += [statement] if instead is None else instead
            continue
        changed = copy.copy(statement)
        for part in ("body", "orelse", "finalbody"):
            inner = getattr(statement, part, None)
            if isinstance(inner, list):
                is_turn = in_loop or (part == "body" and isinstance(statement, _LOOPS))
                setattr(changed, part, _rewritten(inner, way, is_turn, depth + 1))
        for part in ("handlers", "cases"):
            if inner := getattr(statement, part, None):
                setattr(changed, part, [_with_body(one, way, in_loop, depth + 1) for one in inner])
        found.append(changed)
    return found


def _with_body(node: Any, way: _Way, in_loop: bool = False, depth: int = 0) -> Any:
    """A copy of a handler, or of a case."""
    changed = copy.copy(node)
    changed.body = _rewritten(node.body, way, in_loop, depth)
    return changed
