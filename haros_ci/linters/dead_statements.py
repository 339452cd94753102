# SPDX-License-Identifier: Apache-2.0
"""What of Python is never run, as a statement before it in its block always leaves it, or as a condition is written false."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence
from functools import lru_cache

from haros_ci.linters.pylint_idioms import nodes

#: Errors of pylint that stand in dead code as well: of the compiler, which stops at the whole file, of what a function becomes by them, and of characters that
#: deceive who reads.
OF_FILES = frozenset(
    """
    await-outside-async bidirectional-unicode continue-in-finally duplicate-argument-name init-is-generator invalid-character-backspace
    invalid-character-carriage-return invalid-character-esc invalid-character-nul invalid-character-sub invalid-character-zero-width-space
    invalid-star-assignment-target nonlocal-and-global nonlocal-without-binding not-in-loop return-arg-in-generator return-outside-function
    star-needs-assignment-target syntax-error too-many-star-expressions used-prior-global-declaration yield-inside-async-function
    yield-outside-function
    """.split()
)
#: What leaves its block ("Simple statements" in Python's reference).
_LEAVES = (ast.Return, ast.Raise, ast.Continue, ast.Break)
_BLOCKS = ("body", "orelse", "finalbody")
#: From a line and byte to a line and byte, both included.
_Range = tuple[tuple[int, int], tuple[int, int]]


def is_dead(text: str, line: int, column: int | None) -> bool:
    """Whether what stands at *line*, counted from 1, and *column*, from 0 in characters, of *text* is never run.

    It stands behind a ``return``, ``raise``, ``continue`` or ``break`` of the same block, in the ``if`` or ``while`` of a constant that is
    false, in the ``else`` of an ``if`` of one that is true, or behind a constant that decides a condition (``True or a``). Without a *column* all of the line does. A file that Python cannot parse has no such place.
    """
    found = _dead(text)
    if not found:
        return False
    lines = text.split("\n")
    here = lines[line - 1] if 0 < line <= len(lines) else ""
    begin = len(here) - len(here.lstrip()) if column is None else column
    at = (line, len(here[:begin].encode("utf-8", "replace")))
    return any(start <= at <= end for start, end in found)


@lru_cache(maxsize=8)
def _dead(text: str) -> tuple[_Range, ...]:
    return tuple(
        (_start(block[0]), (block[-1].end_lineno or 0, block[-1].end_col_offset or 0))
        for node in nodes(text)
        for block in _dead_parts(node)
    )


def _dead_parts(node: ast.AST) -> Iterator[Sequence[ast.stmt | ast.expr]]:
    yield from _dead_blocks(node)
    yield from _dead_values(node)


def _dead_values(node: ast.AST) -> Iterator[Sequence[ast.expr]]:
    """What ``or`` does not evaluate behind a constant that is true, nor ``and`` behind one that is false."""
    if isinstance(node, ast.BoolOp):
        decided = next((index for index, value in enumerate(node.values) if _decides(node.op, value)), len(node.values))
        if node.values[decided + 1 :]:
            yield node.values[decided + 1 :]


def _decides(op: ast.boolop, value: ast.expr) -> bool:
    return isinstance(value, ast.Constant) and bool(value.value) is isinstance(op, ast.Or)


def _dead_blocks(node: ast.AST) -> Iterator[Sequence[ast.stmt]]:
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
        leaves = next((index for index, statement in enumerate(block) if isinstance(statement, _LEAVES)), len(block))
        if block[leaves + 1 :]:
            yield block[leaves + 1 :]


def _start(statement: ast.stmt | ast.expr) -> tuple[int, int]:
    """Where *statement* begins, with its decorators, which stand before it in the tree's positions."""
    places = [statement, *getattr(statement, "decorator_list", ())]
    return min((place.lineno, place.col_offset) for place in places)
