# SPDX-License-Identifier: Apache-2.0
"""Edits of Python launch files: they are parsed, never run."""

from __future__ import annotations

import ast

from haros_ci.model.location import Location
from haros_ci.results.fix import Edit


def renamed_keyword(text: str, call: Location, old: str, new: str) -> Edit | None:
    """The keyword argument *old* of the call at *call* in *text* becomes *new*; None if it is not written there."""
    try:
        tree = ast.parse(text)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return None
    lines = text.split("\n")
    for node in ast.walk(tree):
        if not isinstance(node, ast.Call) or node.lineno != call.line or _column(lines, node) != call.column:
            continue
        names = {keyword.arg: keyword for keyword in node.keywords}
        if old in names and new not in names:
            found = names[old]
            start = (found.lineno, _column(lines, found))
            return Edit(call.path, start, (start[0], start[1] + len(old)), new)
    return None


def _column(lines: list[str], node: ast.Call | ast.keyword) -> int:
    """1-based, in code points; ast counts bytes of UTF-8."""
    before = lines[node.lineno - 1].encode()[: node.col_offset]
    return len(before.decode(errors="replace")) + 1
