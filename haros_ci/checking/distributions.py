# SPDX-License-Identifier: Apache-2.0
"""Places of a Python launch file that only some ROS distributions reach: the file asks for ``ROS_DISTRO`` before."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from functools import lru_cache

from haros_ci.model.location import Location

#: So many variables that are made of one another are followed.
MAX_STEPS = 10
_VARIABLE = "ROS_DISTRO"
_ENDS = (ast.Return, ast.Raise, ast.Continue, ast.Break)
_TESTED = (ast.If, ast.IfExp, ast.While)


def depends_on_distribution(text: str, location: Location) -> bool:
    """Whether the line of *location* in the Python file *text* stands in a branch or under a ``condition=`` that compares ``ROS_DISTRO``.

    ROS sets the variable to the name of the distribution (REP 149). What stands behind a branch that leaves the function counts as the other
    branch. The file is parsed, never run.
    """
    line = location.line
    return line is not None and any(first <= line <= last for first, last in _spans(text))


@lru_cache(maxsize=64)
def _spans(text: str) -> tuple[tuple[int, int], ...]:
    if _VARIABLE not in text:
        return ()
    try:
        tree = ast.parse(text)
        return tuple(_found(tree))
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return ()


def _found(tree: ast.Module) -> Iterator[tuple[int, int]]:
    names = _names(tree)
    for node in ast.walk(tree):
        if isinstance(node, _TESTED) and _asks(node.test, names):
            parts: list[ast.stmt] | list[ast.expr]
            parts = [node.body, node.orelse] if isinstance(node, ast.IfExp) else [*node.body, *node.orelse]
            yield from ((part.lineno, part.end_lineno or part.lineno) for part in parts)
        elif isinstance(node, ast.Call) and any(k.arg == "condition" and _asks(k.value, names) for k in node.keywords):
            yield node.lineno, node.end_lineno or node.lineno
        for field in ("body", "orelse", "finalbody"):
            block = getattr(node, field, None)
            if isinstance(block, list):
                yield from _behind(block, names)


def _behind(block: list[ast.stmt], names: frozenset[str]) -> Iterator[tuple[int, int]]:
    """What stands in *block* behind a branch that does not come back."""
    for number, each in enumerate(block[:-1]):
        if isinstance(each, ast.If) and isinstance(each.body[-1], _ENDS) and _asks(each.test, names):
            yield block[number + 1].lineno, block[-1].end_lineno or block[-1].lineno


def _asks(test: ast.expr, names: frozenset[str]) -> bool:
    return any(
        (isinstance(each, ast.Constant) and each.value == _VARIABLE)
        or (isinstance(each, ast.Name) and each.id in names)
        for each in ast.walk(test)
    )


def _names(tree: ast.Module) -> frozenset[str]:
    """The variables that are made of ``ROS_DISTRO``, through others and functions of the file."""
    made: list[tuple[frozenset[str], ast.expr]] = []
    for node in ast.walk(tree):
        if isinstance(node, (ast.Assign, ast.AnnAssign, ast.NamedExpr)) and node.value is not None:
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            made.append((frozenset(t.id for t in targets if isinstance(t, ast.Name)), node.value))
        elif isinstance(node, ast.FunctionDef):
            returned = (
                each.value for each in ast.walk(node) if isinstance(each, ast.Return) and each.value is not None
            )
            made += [(frozenset((node.name,)), value) for value in returned if not _makes_actions(value)]
    found: frozenset[str] = frozenset()
    for _ in range(MAX_STEPS):
        more = found.union(*(targets for targets, value in made if not _makes_actions(value) and _asks(value, found)))
        if more == found:
            break
        found = more
    return found


def _makes_actions(value: ast.expr) -> bool:
    """Whether *value* is a node or a description rather than the answer of a comparison: a list, or a call with keywords."""
    return isinstance(value, (ast.List, ast.IfExp)) or (isinstance(value, ast.Call) and bool(value.keywords))
