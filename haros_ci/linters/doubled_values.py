# SPDX-License-Identifier: Apache-2.0
"""Texts and lists of Python that a few lines make so large that pylint, which infers them, takes its memory and its time: ``A1 = [*A0, *A0]``."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterable

from haros_ci.linters.linter import Unit
from haros_ci.linters.pylint_idioms import nodes
from haros_ci.model.workspace import Workspace
from haros_ci.regex import regex

#: Items of a list, or characters of a text, above which no file is looked at: pylint takes a second for so many.
MOST_ITEMS = 1_000_000
TOO_LARGE = f"it makes a value of more than {MOST_ITEMS:,} items of a few lines"
#: An assignment to a name; it may double where its right side has one name twice. Fewer of them make nothing large.
_ASSIGNED = regex(r"^[ \t]*([A-Za-z_]\w{0,80})[ \t]*(?:\+=|=(?!=))([^\n]{1,2000})", re.M)
_WORD = regex(r"\b[A-Za-z_]\w*")
_FEW = 10


def why_not(workspace: Workspace, units: Iterable[Unit]) -> dict[str, str]:
    """For those of *units* whose own text doubles a value too often the reason, by path."""
    return {unit.file.path: TOO_LARGE for unit in units if doubles(workspace.text(unit.file.path))}


def doubles(text: str) -> bool:
    """Whether *text* adds values to themselves until one has too many items; what it repeats by a number is not counted."""
    made = 0
    for match in _ASSIGNED.finditer(text):
        words = _WORD.findall(match[2])
        made += len(words) != len(set(words)) or match[1] in words
    if made <= _FEW:
        return False
    sizes: dict[str, int] = {}
    for node in nodes(text):
        if isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name):
            sizes[node.targets[0].id] = _size(node.value, sizes)
        elif isinstance(node, ast.AugAssign) and isinstance(node.target, ast.Name) and isinstance(node.op, ast.Add):
            sizes[node.target.id] = sizes.get(node.target.id, 1) + _size(node.value, sizes)
    return any(size > MOST_ITEMS + 4 * len(text) for size in sizes.values())


def _size(value: ast.expr, sizes: dict[str, int]) -> int:
    """How many items *value* has as it is written; one for what is not known, and where it is nested deeply."""
    total, waiting = 0, [value]
    while waiting:
        node = waiting.pop()
        if isinstance(node, ast.Name):
            total += sizes.get(node.id, 1)
        elif isinstance(node, ast.Constant):
            total += len(node.value) if isinstance(node.value, str | bytes) else 1
        elif isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add):
            waiting += [node.left, node.right]
        elif isinstance(node, ast.List | ast.Tuple | ast.Set):
            total += sum(not isinstance(item, ast.Starred) for item in node.elts)
            waiting += [item.value for item in node.elts if isinstance(item, ast.Starred)]
        elif isinstance(node, ast.JoinedStr):
            waiting += node.values
        elif isinstance(node, ast.FormattedValue):
            waiting.append(node.value)
        else:
            total += 1
    return min(total, 1 << 60)
