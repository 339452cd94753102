# SPDX-License-Identifier: Apache-2.0
"""Comparisons with NaN by ``is`` that ask for the very object, and not for a number."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterable
from itertools import islice

from haros_ci.linters.pylint_idioms import nodes
from haros_ci.regex import regex
from haros_ci.results.python_nodes import dotted

_NAN = regex(r"\bnan\b", re.IGNORECASE)
#: Comparisons in a line that are looked at.
_MOST = 20


def is_of_nan_itself(text: str, line: int) -> bool:
    """Whether ``is`` asks there for the very object that the same file sets the value to: ``m = np.nan``, and then ``if m is np.nan``.

    So does it for a default of a parameter, and for items of a list, or of an array of objects, that was filled with it. Numbers in other arrays are copied: there the question is never true.
    """
    every = nodes(text) if _NAN.search(text) else ()
    pairs = (
        pair
        for node in every
        if isinstance(node, ast.Compare) and node.lineno <= line <= (node.end_lineno or 0)
        for pair in zip((node.left, *node.comparators), node.ops, node.comparators, strict=False)
    )
    asked = [pair for pair in islice(pairs, _MOST) if _is_nan(pair[0]) != _is_nan(pair[2])]
    return bool(asked) and all(
        isinstance(operator, ast.Is | ast.IsNot) and _is_set_to_nan(right if _is_nan(left) else left, every)
        for left, operator, right in asked
    )


def _is_set_to_nan(value: ast.expr, every: Iterable[ast.AST]) -> bool:
    """Whether one of the nodes sets *value*, a name, an attribute or an item of one, to the object NaN."""
    is_item = isinstance(value, ast.Subscript)
    name = dotted(value.value if isinstance(value, ast.Subscript) else value)
    for node in every if name else ():
        if isinstance(node, ast.Assign | ast.AnnAssign) and node.value is not None:
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            is_given = _keeps_nan(node.value) if is_item else _is_nan(node.value)
            if is_given and any(dotted(target) == name for target in targets):
                return True
        if isinstance(node, ast.arguments) and not is_item:
            positional = zip(reversed((*node.posonlyargs, *node.args)), reversed(node.defaults), strict=False)
            keywords = zip(node.kwonlyargs, node.kw_defaults, strict=False)
            if any(one.arg == name and _is_nan(default) for one, default in (*positional, *keywords)):
                return True
    return False


def _keeps_nan(value: ast.expr) -> bool:
    """Whether *value* has the object NaN as an item: ``[np.nan] * 3``, ``np.full(3, np.nan, dtype=object)``."""
    if isinstance(value, ast.BinOp) and isinstance(value.op, ast.Mult):
        return any(isinstance(side, ast.List) and _keeps_nan(side) for side in (value.left, value.right))
    if isinstance(value, ast.List | ast.Tuple):
        return any(map(_is_nan, value.elts))
    return isinstance(value, ast.Call) and any(
        keyword.arg == "dtype"
        and (
            dotted(keyword.value) in ("object", "np.object_", "numpy.object_")
            or (isinstance(keyword.value, ast.Constant) and keyword.value.value in ("O", "object"))
        )
        for keyword in value.keywords
    )


def _is_nan(node: ast.expr | None) -> bool:
    """Whether *node* is the object NaN of a module: ``np.nan``, ``math.nan``, or its name alone."""
    return node is not None and dotted(node).rpartition(".")[2] in ("nan", "NaN", "NAN")
