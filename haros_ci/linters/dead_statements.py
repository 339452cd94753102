# SPDX-License-Identifier: Apache-2.0
"""What of Python is never run, as a statement before it in its block always leaves it, or as a condition is written false."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence
from functools import lru_cache

from haros_ci.linters.pylint_idioms import nodes
from haros_ci.regex import regex
from haros_ci.results.constant_tests import truth
from haros_ci.results.python_nodes import mentions
from haros_ci.results.unreached import EXITING, EXITS, dead_parts, is_bound

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
_VERSION, _CHECKING = regex(r"version_info"), regex(r"TYPE_CHECKING")
#: From a line and byte to a line and byte, both included.
_Range = tuple[tuple[int, int], tuple[int, int]]


def is_dead(text: str, line: int, column: int | None) -> bool:
    """Whether what stands at *line*, counted from 1, and *column*, from 0 in characters, of *text* is never run.

    It stands behind a ``return``, ``raise``, ``continue`` or ``break``, an ``exit()`` or a loop without an end of the same block, in the ``if`` or ``while`` of a constant that is
    false, in the ``else`` of an ``if`` of one that is true, or behind a constant that decides a condition (``True or a``). Without a *column* all of the line does. A file that Python cannot parse has no such place.
    """
    return _is_in(_dead(text), text, line, column)


def is_for_python2(text: str, line: int, column: int | None) -> bool:
    """Whether Python 2 alone runs what stands there: the branch of ``if sys.version_info[0] < 3``. Names that are not there may be wrong in it all the same."""
    return "version_info" in text and _is_in(_for_python2(text), text, line, column)


def _is_in(found: Sequence[_Range], text: str, line: int, column: int | None) -> bool:
    if not found:
        return False
    lines = text.split("\n")
    here = lines[line - 1] if 0 < line <= len(lines) else ""
    begin = len(here) - len(here.lstrip()) if column is None else column
    at = (line, len(here[:begin].encode("utf-8", "replace")))
    return any(start <= at <= end for start, end in found)


@lru_cache(maxsize=8)
def _for_python2(text: str) -> tuple[_Range, ...]:
    return tuple(
        (_start(part[0]), (part[-1].end_lineno or 0, part[-1].end_col_offset or 0))
        for node in nodes(text)
        for part in _of_python2(node)
    )


@lru_cache(maxsize=8)
def _dead(text: str) -> tuple[_Range, ...]:
    every = nodes(text)
    exits = frozenset() if is_bound(every, EXITING) else EXITS
    return tuple(
        (_start(part[0]), (part[-1].end_lineno or 0, part[-1].end_col_offset or 0))
        for node in every
        for part in dead_parts(node, exits)
    )


def _of_python2(node: ast.AST) -> Iterator[Sequence[ast.stmt]]:
    """The branch that no Python 3 runs, which is what pylint reads a file as."""
    if isinstance(node, ast.If) and mentions(node.test, _VERSION) and not mentions(node.test, _CHECKING):
        known = truth(node.test, {})
        if known is False:
            yield node.body
        elif known is True and node.orelse:
            yield node.orelse


def _start(statement: ast.stmt | ast.expr) -> tuple[int, int]:
    """Where *statement* begins, with its decorators, which stand before it in the tree's positions."""
    places = [statement, *getattr(statement, "decorator_list", ())]
    return min((place.lineno, place.col_offset) for place in places)
