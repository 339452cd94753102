# SPDX-License-Identifier: Apache-2.0
"""The body of a Python function: calls, nesting, decisions and paths, counted as in cpp_body.py.

Python's own: ``else`` of a loop is the way out of it, a comprehension is a loop in an expression, of ``try`` either the
block with its ``else`` or a handler is gone through, and ``finally`` after each. ``with`` decides nothing.
"""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterable, Sequence
from typing import Any

from haros_ci.measuring.facts import DEEPEST, MOST_PATHS, FunctionCounts, times

Definition = ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef


class PythonBody:
    """Counts what is in a function; functions and classes defined in it are put aside, in the order of the text."""

    def __init__(self) -> None:
        self.counts = FunctionCounts()
        self.local: list[Definition] = []
        self.paths = 1

    def take(self, statements: Sequence[ast.stmt]) -> None:
        self.paths = min(self._sequence(statements, 0, 0) + self.counts.apart, MOST_PATHS)

    def _sequence(self, statements: Iterable[ast.stmt], nesting: int, depth: int) -> int:
        paths = 1
        for statement in statements:
            paths = times(paths, self._statement(statement, nesting, depth))
        return paths

    def _statement(self, node: ast.stmt, nesting: int, depth: int) -> int:
        if depth > DEEPEST:
            self.counts.is_too_deep = True
            return 1
        handler = _STATEMENTS.get(type(node))
        if handler is not None:
            return min(handler(self, node, nesting, depth + 1), MOST_PATHS)
        return max(1, self._expression(node))

    def _if(self, node: Any, nesting: int, depth: int) -> int:
        """An ``elif`` adds a path, not a level."""
        paths = 0
        while True:
            self.counts.complexity += 1
            self.counts.nested(nesting + 1)
            paths += self._expression(node.test) + self._sequence(node.body, nesting + 1, depth)
            otherwise = node.orelse
            is_elif = len(otherwise) == 1 and isinstance(otherwise[0], ast.If)
            if not is_elif or otherwise[0].col_offset != node.col_offset:  # ``else:`` with an ``if`` of its own in it
                return paths + self._sequence(otherwise, nesting + 1, depth)
            node = otherwise[0]

    def _loop(self, node: Any, nesting: int, depth: int) -> int:
        self.counts.complexity += 1 + bool(node.orelse)
        self.counts.nested(nesting + 1)
        heads = (node.test,) if isinstance(node, ast.While) else (node.target, node.iter)
        paths = sum(map(self._expression, heads)) + self._sequence(node.body, nesting + 1, depth)
        return paths + self._sequence(node.orelse, nesting + 1, depth)

    def _with(self, node: Any, nesting: int, depth: int) -> int:
        paths = sum(self._expression(other_node) for item in node.items for other_node in ast.iter_child_nodes(item))
        return paths + self._sequence(node.body, nesting, depth)

    def _try(self, node: Any, nesting: int, depth: int) -> int:
        self.counts.complexity += len(node.handlers) + bool(node.orelse)
        self.counts.nested(nesting + 1)
        inner = nesting + 1
        paths = times(self._sequence(node.body, inner, depth), self._sequence(node.orelse, inner, depth))
        for handler in node.handlers:
            paths += 0 if handler.type is None else self._expression(handler.type)
            paths += self._sequence(handler.body, inner, depth)
        return times(min(paths, MOST_PATHS), self._sequence(node.finalbody, inner, depth))

    def _match(self, node: Any, nesting: int, depth: int) -> int:
        """Each case is a path; unless the last takes everything, there is one past all of them."""
        self.counts.nested(nesting + 1)
        paths = self._expression(node.subject)
        takes_all = False
        for case in node.cases:
            takes_all = case.guard is None and isinstance(case.pattern, ast.MatchAs) and case.pattern.pattern is None
            self.counts.complexity += not takes_all
            paths += 0 if case.guard is None else self._expression(case.guard)
            paths += self._sequence(case.body, nesting + 1, depth)
        return paths + (not takes_all)

    def _definition(self, node: Any, nesting: int, depth: int) -> int:
        """Of a function or class here only what is evaluated to define it counts."""
        self.local.append(node)
        arguments = getattr(node, "args", None)
        evaluated = (*node.decorator_list, *getattr(node, "bases", ()))
        evaluated += (
            (*arguments.defaults, *(kw_default for kw_default in arguments.kw_defaults if kw_default))
            if arguments
            else ()
        )
        for item in evaluated:
            self._expression(item)
        return 1

    def _expression(self, root: ast.AST) -> int:
        """The paths that the operators under *root* add; calls are counted on the way."""
        paths = 0
        waiting = [root]
        while waiting:
            node = waiting.pop()
            if isinstance(node, ast.BoolOp):
                paths += len(node.values) - 1
                self.counts.complexity += len(node.values) - 1
            elif isinstance(node, ast.IfExp):
                paths += 2
                self.counts.complexity += 1
            elif isinstance(node, ast.comprehension):
                paths += 1 + len(node.ifs)
                self.counts.complexity += 1 + len(node.ifs)
            elif isinstance(node, (ast.ListComp, ast.SetComp, ast.DictComp, ast.GeneratorExp)):
                paths += 1
            elif isinstance(node, ast.Lambda):
                self.counts.apart += max(1, self._expression(node.body)) - 1
                waiting.extend((*node.args.defaults, *(default for default in node.args.kw_defaults if default)))
                continue
            elif isinstance(node, ast.Call):
                self.counts.called(_called(node.func))
            waiting.extend(ast.iter_child_nodes(node))
        return min(paths, MOST_PATHS)


def _called(node: ast.expr) -> str:
    """A function's name, a method's without what it is called on; else where it stands."""
    if isinstance(node, ast.Name):
        return node.id
    if isinstance(node, ast.Attribute):
        return node.attr
    return f"{node.lineno}:{node.col_offset}"


_Handler = Callable[[PythonBody, Any, int, int], int]
_STATEMENTS: dict[type[ast.AST], _Handler] = {
    ast.If: PythonBody._if,
    ast.For: PythonBody._loop,
    ast.AsyncFor: PythonBody._loop,
    ast.While: PythonBody._loop,
    ast.With: PythonBody._with,
    ast.AsyncWith: PythonBody._with,
    ast.Try: PythonBody._try,
    ast.Match: PythonBody._match,
    ast.FunctionDef: PythonBody._definition,
    ast.AsyncFunctionDef: PythonBody._definition,
    ast.ClassDef: PythonBody._definition,
}
if hasattr(ast, "TryStar"):  # Python 3.11
    _STATEMENTS[ast.TryStar] = PythonBody._try
