# SPDX-License-Identifier: Apache-2.0
"""Functions of Python that the same block defines again before anything has called them: what is wrong in the first one never happens."""

from __future__ import annotations

import ast
import sys
import warnings
from bisect import bisect_right
from collections.abc import Container, Iterator
from functools import lru_cache

#: What only makes names, and calls nothing that stands in it.
_DEFINITIONS = (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)
#: What reaches all names of a module, or of a frame, without naming them.
_REACHES_ALL = frozenset(
    "globals locals vars eval exec modules __globals__ f_globals f_locals f_back __dict__ getmembers".split()
)
#: Decorators that Python has built in, and those of a property: they only keep the function.
_KEEPING = frozenset("property staticmethod classmethod setter getter deleter".split())
#: Pairs of a name and a statement that are looked at in one file.
_PAIRS = 500_000


def is_overwritten(text: str, line: int) -> bool:
    """Whether *line* of *text*, counted from 1, is in a function without a decorator that a later definition of the same block replaces.

    Nothing between the two mentions the name but other functions, no text of the file is the name, nothing in it reaches all names (``globals()``), and no statement between them calls anything. A definition in one branch of an ``if`` or a
    ``try`` replaces nothing. A file that Python cannot parse has none.
    """
    return any(first <= line <= last for first, last in _replaced(text))


def is_used_before(text: str, line: int) -> bool:
    """Whether the function or class that *line* of *text* begins has the name of one before it in the block that is used in between.

    Nothing is lost then: the first one is registered as a callback, say, and the second is another's. A decorator may stand at *line*.
    """
    return any(line in lines for lines in _used(text))


@lru_cache(maxsize=16)
def _used(text: str) -> tuple[range, ...]:
    """The lines from the decorators to the head of the definitions that replace what was used."""
    found: list[range] = []
    look = _Look()
    for node in ast.walk(_parsed(text)):
        if isinstance(node, (ast.Module, *_DEFINITIONS)):
            found.extend(_used_inside(node))
            before: dict[str, int] = {}
            for index, statement in enumerate(node.body):
                if not isinstance(statement, _DEFINITIONS):
                    continue
                first = before.get(statement.name)
                if first is not None and look.mentions(statement.name, node.body[first + 1 : index]):
                    lines = [decorator.lineno for decorator in statement.decorator_list] + [statement.lineno]
                    found.append(range(min(lines), statement.lineno + 1))
                before[statement.name] = index
    return tuple(found)


def _used_inside(scope: ast.Module | ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef) -> list[range]:
    """The same for definitions of *scope* that stand in its loops and branches: a callback that is handed on where it is made, say."""
    made: list[tuple[ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef, bool]] = []
    uses: dict[str, list[int]] = {}
    waiting: list[tuple[ast.AST, bool]] = [(statement, False) for statement in scope.body]
    while waiting:
        node, is_inside = waiting.pop()
        if isinstance(node, _DEFINITIONS):
            made.append((node, is_inside))
            continue
        if isinstance(node, ast.Name):
            uses.setdefault(node.id, []).append(node.lineno)
        waiting.extend((child, True) for child in ast.iter_child_nodes(node))
    for lines in uses.values():
        lines.sort()
    found: list[range] = []
    last: dict[str, tuple[int, bool]] = {}
    for node, is_inside in sorted(made, key=lambda one: one[0].lineno):
        first = last.get(node.name)
        start = min([decorator.lineno for decorator in node.decorator_list] + [node.lineno])
        if first is not None and (is_inside or first[1]):
            lines = uses.get(node.name, [])
            place = bisect_right(lines, first[0])
            if place < len(lines) and lines[place] < start:
                found.append(range(start, node.lineno + 1))
        last[node.name] = (node.end_lineno or node.lineno, is_inside)
    return found


@lru_cache(maxsize=16)
def _replaced(text: str) -> tuple[tuple[int, int], ...]:
    """The first and last lines of the functions."""
    found: list[tuple[int, int]] = []
    look = _Look()
    every = list(ast.walk(_parsed(text)))
    if any(_REACHES_ALL.intersection(_words(node)) for node in every):
        return ()
    quoted = {node.value for node in every if isinstance(node, ast.Constant) and isinstance(node.value, str)}
    for node in every:
        if isinstance(node, (ast.Module, *_DEFINITIONS)):
            found.extend(_in_block(node.body, look, quoted))
    return tuple(found)


def _words(node: ast.AST) -> tuple[str, ...]:
    if isinstance(node, ast.ImportFrom):
        return tuple(alias.name for alias in node.names)
    return (node.id,) if isinstance(node, ast.Name) else (node.attr,) if isinstance(node, ast.Attribute) else ()


def _parsed(text: str) -> ast.Module:
    """The file; an empty one where Python cannot parse it."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return ast.parse(text)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return ast.Module([], [])


def _in_block(block: list[ast.stmt], look: _Look, quoted: Container[str]) -> list[tuple[int, int]]:
    last: dict[str, int] = {}
    for index, statement in enumerate(block):
        if isinstance(statement, _DEFINITIONS):
            last[statement.name] = index
    found = []
    for index, statement in enumerate(block):
        if not isinstance(statement, (ast.FunctionDef, ast.AsyncFunctionDef)) or statement.decorator_list:
            continue
        again = last[statement.name]
        if (
            again > index
            and statement.name not in quoted
            and not look.may_use(statement.name, block[index + 1 : again + 1])
        ):
            found.append((statement.lineno, statement.end_lineno or statement.lineno))
    return found


class _Look:
    """What statements of one file mention as they are run; every statement is read once, and so many pairs of a name and a statement are looked at in all."""

    def __init__(self) -> None:
        self._read: dict[int, tuple[frozenset[str], bool]] = {}
        self._left = _PAIRS

    def mentions(self, name: str, statements: list[ast.stmt]) -> bool:
        """Whether one of them has the name where it is run, not in the body of a function; no where there are too many."""
        return self._spend(statements) and any(name in self._names(one)[0] for one in statements)

    def may_use(self, name: str, statements: list[ast.stmt]) -> bool:
        """Whether one of them, as it is run, may call or keep the function that is called *name* then; yes where there are too many."""
        if not self._spend(statements):
            return True
        return any(calls or name in names for names, calls in map(self._names, statements))

    def _spend(self, statements: list[ast.stmt]) -> bool:
        self._left -= len(statements)
        return self._left >= 0

    def _names(self, statement: ast.stmt) -> tuple[frozenset[str], bool]:
        """The names in what is run of a statement, and whether it calls something."""
        found = self._read.get(id(statement))
        if found is None:
            inner = list(_run_at_once(statement))
            names = frozenset(node.id for node in inner if isinstance(node, ast.Name))
            calls = any(isinstance(node, ast.Call) or _imports_others(node) for node in inner)
            calls |= any(not _is_plain(one) for node in inner for one in getattr(node, "decorator_list", ()))
            found = self._read[id(statement)] = (names, calls)
        return found


def _imports_others(node: ast.AST) -> bool:
    """Whether a module is run there that may import this one: none of Python's own."""
    if isinstance(node, ast.ImportFrom):
        return bool(node.level) or (node.module or "").partition(".")[0] not in sys.stdlib_module_names
    return isinstance(node, ast.Import) and any(
        alias.name.partition(".")[0] not in sys.stdlib_module_names for alias in node.names
    )


def _is_plain(decorator: ast.expr) -> bool:
    """Whether the decorator keeps the function, and calls nothing."""
    if isinstance(decorator, ast.Attribute):
        return isinstance(decorator.value, ast.Name) and decorator.attr in _KEEPING
    return isinstance(decorator, ast.Name) and decorator.id in _KEEPING


def _run_at_once(statement: ast.stmt) -> Iterator[ast.AST]:
    """What is run of a statement where it stands: not the bodies of functions, which are run when they are called."""
    waiting: list[ast.AST] = [statement]
    while waiting:
        node = waiting.pop()
        yield node
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda):
            arguments = node.args
            waiting += [*getattr(node, "decorator_list", ()), *arguments.defaults, *filter(None, arguments.kw_defaults)]
        else:
            waiting += ast.iter_child_nodes(node)
