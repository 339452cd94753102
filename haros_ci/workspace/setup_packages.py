# SPDX-License-Identifier: Apache-2.0
"""The import packages that ``packages=`` of a setup.py names."""

from __future__ import annotations

import ast
from collections.abc import Callable
from typing import Any

from haros_ci.model.location import Location


def package_names(
    node: ast.expr | None, value: Callable[[ast.expr], Any], path: str
) -> tuple[tuple[tuple[str, Location], ...], bool]:
    """The names in the expression *node* of the setup.py at *path*, none where it is computed, and whether these are all.

    They are all where one list is written out in the call. A list with a name may grow elsewhere.
    """
    names = value(node) if node is not None else None
    if node is None or not isinstance(names, list):
        return (), False
    where = Location(path, node.lineno, node.col_offset + 1)
    is_whole = isinstance(node, (ast.List, ast.Tuple)) and all(isinstance(name, str) for name in names)
    return tuple((name, where) for name in names if isinstance(name, str)), is_whole
