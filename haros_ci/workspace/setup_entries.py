# SPDX-License-Identifier: Apache-2.0
"""The console scripts of setup.py: the lines that its lists, sums, comprehensions and texts are, line by line as far as they are known."""

from __future__ import annotations

import ast
from collections.abc import Callable, Mapping
from typing import Any

from haros_ci.workspace.python_values import MISSING, dotted, is_constant, summands
from haros_ci.workspace.setup_cfg import scripts_of_text

MAX_DEPTH = 10
MAX_LOOKED = 1_000

#: A line of console scripts, MISSING where it is not known, and the line and column of its place.
Line = tuple[Any, tuple[int, int]]


def script_lines(
    node: ast.expr, value: Callable[[ast.expr], Any], parts: Mapping[str, list[ast.expr]]
) -> list[Line] | None:
    """The console scripts of ``entry_points=`` *node*; None if it is not known what there is, [] if there are none.

    *value* evaluates an expression, *parts* are the expressions that a name's list is put together from.
    """
    pieces = parts.get(dotted(node), [])
    if len(pieces) == 1 and isinstance(pieces[0], ast.Dict):
        node = pieces[0]
    if isinstance(node, ast.Dict):
        sections = [v for k, v in zip(node.keys, node.values, strict=True) if is_constant(k, "console_scripts")]
        if not sections:
            return [] if None not in node.keys else None
        return _Lists(value, parts).lines(sections[0])
    known = value(node)
    if isinstance(known, dict):
        known = known.get("console_scripts", [])
    return None if known is MISSING else [(text, _place(node)) for text in _texts(known)]


class _Lists:
    """Lists taken apart, at most MAX_LOOKED expressions of them."""

    def __init__(self, value: Callable[[ast.expr], Any], parts: Mapping[str, list[ast.expr]]) -> None:
        self.value = value
        self.parts = parts
        self.looked = 0

    def lines(self, node: ast.expr, depth: int = 0) -> list[Line] | None:
        """The lines of one list; None where a part of it is no list that is known."""
        self.looked += 1
        if isinstance(node, (ast.List, ast.Tuple)):
            return self._all([self._item(item, depth) for item in node.elts])
        pieces = summands(node) if isinstance(node, ast.BinOp) else self.parts.get(dotted(node), [])
        if pieces not in ([], [node]) and depth < MAX_DEPTH and self.looked < MAX_LOOKED:
            found = self._all([self.lines(piece, depth + 1) for piece in pieces])
            if found is not None:
                return found
        known = self.value(node)
        return None if known is MISSING else [(text, _place(node)) for text in _texts(known)]

    def _item(self, item: ast.expr, depth: int) -> list[Line] | None:
        if isinstance(item, ast.Starred):
            return self.lines(item.value, depth + 1) if depth < MAX_DEPTH and self.looked < MAX_LOOKED else None
        return [(self.value(item), _place(item))]

    def _all(self, lists: list[list[Line] | None]) -> list[Line] | None:
        found: list[Line] = []
        for lines in lists:
            if lines is None:
                return None
            found += lines
        return found


def _texts(known: Any) -> list[Any]:
    """The lines of a list, or of a text with sections."""
    if isinstance(known, str):
        return scripts_of_text(known)
    return known if isinstance(known, list) else []


def _place(node: ast.expr) -> tuple[int, int]:
    return node.lineno, node.col_offset + 1
