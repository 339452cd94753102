# SPDX-License-Identifier: Apache-2.0
"""Keywords that stand in a dictionary of a call: ``f(**{"a": 1})`` and ``f(**dict(a=1))`` are ``f(a=1)``."""

from __future__ import annotations

import ast
from collections.abc import Iterable, Iterator


def written_out(keywords: Iterable[ast.keyword]) -> Iterator[ast.keyword]:
    """*keywords* with those of a dictionary that is written in the call itself in its place; one with other keys stays as it is."""
    for keyword in keywords:
        inner = None if keyword.arg is not None else _pairs(keyword.value)
        if inner is None:
            yield keyword
        else:
            yield from (ast.copy_location(ast.keyword(arg=name, value=value), value) for name, value in inner)


def _pairs(node: ast.expr) -> list[tuple[str, ast.expr]] | None:
    """The names and values of a dictionary all of whose keys are names."""
    if isinstance(node, ast.Dict):
        texts = (key.value if isinstance(key, ast.Constant) else None for key in node.keys)
        names = [text for text in texts if isinstance(text, str) and text.isidentifier()]
        return list(zip(names, node.values, strict=True)) if len(names) == len(node.keys) else None
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "dict" and not node.args:
        named = [(one.arg, one.value) for one in node.keywords if one.arg is not None]
        return named if len(named) == len(node.keywords) else None
    return None
