# SPDX-License-Identifier: Apache-2.0
"""What of a syntax tree of Python is never run: behind what leaves a block or ends the program, and under a condition that is written false."""

from __future__ import annotations

import ast
from collections.abc import Collection, Iterable, Iterator, Sequence

from haros_ci.results.python_nodes import dotted

#: What leaves its block ("Simple statements" in Python's reference).
_LEAVES = (ast.Return, ast.Raise, ast.Continue, ast.Break)
#: What ends the program, and the names that nothing else may be called by.
EXITS, EXITING = frozenset(("exit", "quit", "sys.exit", "os._exit")), frozenset(("exit", "quit", "sys", "os"))
_INNER = (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef, ast.Lambda)
_BLOCKS = ("body", "orelse", "finalbody")


def dead_parts(node: ast.AST, exits: Collection[str] = EXITS) -> Iterator[Sequence[ast.stmt | ast.expr]]:
    """The statements, or values of a condition, right below *node* that are never run; *exits* are the functions that end the program."""
    yield from _dead_blocks(node, exits)
    yield from _dead_values(node)


def _dead_values(node: ast.AST) -> Iterator[Sequence[ast.expr]]:
    """What ``or`` does not evaluate behind a constant that is true, nor ``and`` behind one that is false."""
    if isinstance(node, ast.BoolOp):
        decided = next((index for index, value in enumerate(node.values) if _decides(node.op, value)), len(node.values))
        if node.values[decided + 1 :]:
            yield node.values[decided + 1 :]


def _decides(op: ast.boolop, value: ast.expr) -> bool:
    return isinstance(value, ast.Constant) and bool(value.value) is isinstance(op, ast.Or)


def _dead_blocks(node: ast.AST, exits: Collection[str]) -> Iterator[Sequence[ast.stmt]]:
    if isinstance(node, (ast.If, ast.While)):
        test = node.test
        if isinstance(test, ast.BoolOp) and _decides(test.op, test.values[0]):
            test = test.values[0]
        if isinstance(test, ast.Constant) and not test.value:
            yield node.body
        elif isinstance(test, ast.Constant) and isinstance(node, ast.If) and node.orelse:
            yield node.orelse
    for name in _BLOCKS:
        block = getattr(node, name, None)
        if not isinstance(block, list):  # a lambda's body is an expression
            continue
        leaves = next((index for index, statement in enumerate(block) if _leaves(statement, exits)), len(block))
        if block[leaves + 1 :]:
            yield block[leaves + 1 :]


def _leaves(statement: ast.stmt, exits: Collection[str]) -> bool:
    """Whether nothing behind *statement* in its block is run."""
    if isinstance(statement, ast.Expr) and isinstance(statement.value, ast.Call):
        function = statement.value.func
        return dotted(function) in exits
    if isinstance(statement, ast.While):
        is_endless = isinstance(statement.test, ast.Constant) and bool(statement.test.value)
        return is_endless and not _breaks(statement.body)
    return isinstance(statement, _LEAVES)


def _breaks(block: Iterable[ast.stmt]) -> bool:
    """Whether a ``break`` in *block*, but in no loop or function in it, ends the loop around it."""
    waiting: list[ast.AST] = [*block]
    while waiting:
        node = waiting.pop()
        if isinstance(node, ast.Break):
            return True
        if isinstance(node, ast.For | ast.AsyncFor | ast.While):
            waiting += node.orelse
        elif not isinstance(node, _INNER):
            waiting += ast.iter_child_nodes(node)
    return False


def is_bound(nodes: Iterable[ast.AST], names: frozenset[str]) -> bool:
    """Whether the file may give one of *names* a meaning of its own: as a variable, a parameter, a class, an attribute, by an import, or by a text with the name."""
    for node in nodes:
        if isinstance(node, ast.Name | ast.Attribute) and isinstance(node.ctx, ast.Store | ast.Del):
            if (node.id if isinstance(node, ast.Name) else node.attr) in names:
                return True
        elif isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef | ast.ExceptHandler):
            if node.name in names:
                return True
        elif isinstance(node, ast.ImportFrom):
            if any(alias.name == "*" or (alias.asname or alias.name) in names for alias in node.names):
                return True
        elif isinstance(node, ast.Import):
            if any(alias.asname in names and alias.asname != alias.name for alias in node.names):
                return True
        elif isinstance(node, ast.Constant) and isinstance(node.value, str) and node.value in names:
            return True
        elif isinstance(node, ast.MatchAs | ast.MatchStar) and node.name in names:
            return True
        elif isinstance(node, ast.arg) and node.arg in names:
            return True
    return False
