# SPDX-License-Identifier: Apache-2.0
"""Functions that a decorator makes methods of their class, by which pylint, where the decorator is not installed, sees methods without self."""

from __future__ import annotations

import ast
import warnings
from functools import lru_cache

#: How the first parameter of a method of a class, or of a metaclass, is called.
_CLASS = ("cls", "klass", "mcs", "mcls", "metacls")
#: Decorators of that kind by their last names: pydantic's, SQLAlchemy's, and usual ones for properties of a class.
_MAKING = frozenset(
    "validator root_validator field_validator model_validator validates declared_attr expression comparator classproperty".split()
)


def is_class_method(text: str, line: int) -> bool:
    """Whether the function at *line* of *text* has a decorator and ``cls`` as first parameter, or one of the known decorators."""
    return line in _lines(text)


@lru_cache(maxsize=16)
def _lines(text: str) -> frozenset[int]:
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            tree = ast.parse(text)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return frozenset()
    found: set[int] = set()
    for node in ast.walk(tree):
        if not isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)) or not node.decorator_list:
            continue
        first = next(iter((*node.args.posonlyargs, *node.args.args)), None)
        is_called_so = first is not None and first.arg in _CLASS
        if is_called_so or any(_last(each) in _MAKING for each in node.decorator_list):
            found.update(range(min(each.lineno for each in node.decorator_list), node.lineno + 1))
    return frozenset(found)


def _last(decorator: ast.expr) -> str:
    """The last part of a decorator's name."""
    node = decorator.func if isinstance(decorator, ast.Call) else decorator
    return node.attr if isinstance(node, ast.Attribute) else node.id if isinstance(node, ast.Name) else ""
