# SPDX-License-Identifier: Apache-2.0
"""Places of a Python file that are reached only if something holds that the file asks for. It is parsed, never run."""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterator

from haros_ci.model.location import Location
from haros_ci.results.module_names import parsed as parsed

#: So many variables that are made of one another are followed.
MAX_STEPS = 10
#: Whether an expression, its parts aside, asks for what is meant.
Asks = Callable[[ast.AST], bool]
#: First and last line.
Span = tuple[int, int]
_ENDS = (ast.Return, ast.Raise, ast.Continue, ast.Break)
_TESTED = (ast.If, ast.IfExp, ast.While)


def is_in(spans: tuple[Span, ...], location: Location) -> bool:
    """Whether the line of *location* is in one of *spans*."""
    line = location.line
    return line is not None and any(first <= line <= last for first, last in spans)


def branches(tree: ast.Module, asks: Asks, known: frozenset[str] = frozenset()) -> tuple[Span, ...]:
    """What stands in a branch or under a ``condition=`` that *asks*, by itself or by a variable made of that or *known*.

    What stands behind a branch that leaves the function counts as the other branch.
    """
    try:
        return tuple(_found(tree, _Names(tree, asks, known)))
    except RecursionError:
        return ()


class _Names:
    """The variables of a file that are made of what is asked for, through others and functions."""

    def __init__(self, tree: ast.Module, asks: Asks, known: frozenset[str]) -> None:
        self._asks = asks
        self._names = known
        made = tuple(_made(tree))
        for _ in range(MAX_STEPS):
            names = self._names.union(*(targets for targets, value in made if self.asks(value)))
            if names == self._names:
                break
            self._names = names

    def asks(self, test: ast.expr) -> bool:
        return any(
            self._asks(node) or (isinstance(node, ast.Name) and node.id in self._names) for node in ast.walk(test)
        )


def _found(tree: ast.Module, names: _Names) -> Iterator[Span]:
    for node in ast.walk(tree):
        if isinstance(node, _TESTED) and names.asks(node.test):
            parts: list[ast.stmt] | list[ast.expr]
            parts = [node.body, node.orelse] if isinstance(node, ast.IfExp) else [*node.body, *node.orelse]
            yield from ((part.lineno, part.end_lineno or part.lineno) for part in parts)
        elif isinstance(node, ast.Call) and any(k.arg == "condition" and names.asks(k.value) for k in node.keywords):
            yield node.lineno, node.end_lineno or node.lineno
        for field in ("body", "orelse", "finalbody"):
            block = getattr(node, field, None)
            if isinstance(block, list):
                yield from _behind(block, names)


def _behind(block: list[ast.stmt], names: _Names) -> Iterator[Span]:
    """What stands in *block* behind a branch that does not come back."""
    for number, node in enumerate(block[:-1]):
        if isinstance(node, ast.If) and isinstance(node.body[-1], _ENDS) and names.asks(node.test):
            yield block[number + 1].lineno, block[-1].end_lineno or block[-1].lineno


def _made(tree: ast.Module) -> Iterator[tuple[frozenset[str], ast.expr]]:
    """The names that get a value, each with it: variables, and functions by what they return."""
    for node in ast.walk(tree):
        if isinstance(node, (ast.Assign, ast.AnnAssign, ast.NamedExpr)) and node.value is not None:
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            if not _makes_actions(node.value):
                yield frozenset(t.id for t in targets if isinstance(t, ast.Name)), node.value
        elif isinstance(node, ast.FunctionDef):
            for other_node in ast.walk(node):
                if (
                    isinstance(other_node, ast.Return)
                    and other_node.value is not None
                    and not _makes_actions(other_node.value)
                ):
                    yield frozenset((node.name,)), other_node.value


def _makes_actions(value: ast.expr) -> bool:
    """Whether *value* is a node or a description rather than the answer of a comparison: a list, or a call with keywords."""
    return isinstance(value, (ast.List, ast.IfExp)) or (isinstance(value, ast.Call) and bool(value.keywords))
