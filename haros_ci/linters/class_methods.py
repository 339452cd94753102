# SPDX-License-Identifier: Apache-2.0
"""Functions that a decorator makes methods of their class, by which pylint, where the decorator is not installed, sees methods without self."""

from __future__ import annotations

import ast
import re
import warnings
from functools import lru_cache

#: How the first parameter of a method of a class, or of a metaclass, is called.
CLASS = ("cls", "klass", "mcs", "mcls", "metacls")
#: Decorators of that kind by their last names: pydantic's, SQLAlchemy's, and usual ones for properties of a class.
_MAKING = frozenset(
    "validator root_validator field_validator model_validator validates declared_attr expression comparator classproperty".split()
)

#: Characters of a line that are looked at.
_LONGEST = 1000


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
        is_called_so = first is not None and first.arg in CLASS
        if is_called_so or any(_last(other_node) in _MAKING for other_node in node.decorator_list):
            found.update(range(min(other_node.lineno for other_node in node.decorator_list), node.lineno + 1))
    return frozenset(found)


def method_at(text: str, line: int) -> tuple[str, str, bool] | None:
    """The class and the name of the undecorated method at *line* of *text* whose first parameter is not ``self``, and whether that is called
    as a class is."""
    found = ((owner, name, decorator in CLASS) for first, _, owner, name, decorator in _methods(text) if first == line)
    return next(found, None)


def takes_value(text: str, line: int) -> bool:
    """Whether *line* of *text* uses the first parameter of such a method around it: nobody knows what it is given."""
    lines = text.split("\n")
    here = lines[line - 1] if 0 < line <= len(lines) else ""
    words = set(re.findall(r"\w+", here[:_LONGEST]))
    return any(
        first < line <= last and parameter in words and parameter not in CLASS
        for first, last, _, _, parameter in _methods(text)
    )


@lru_cache(maxsize=16)
def _methods(text: str) -> tuple[tuple[int, int, str, str, str], ...]:
    """The first and last line, class, name and first parameter of each."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            tree = ast.parse(text)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return ()
    found: list[tuple[int, int, str, str, str]] = []
    for owner in (node for node in ast.walk(tree) if isinstance(node, ast.ClassDef)):
        for node in owner.body:
            if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)) and not node.decorator_list:
                first = next(iter((*node.args.posonlyargs, *node.args.args)), None)
                if first is not None and first.arg != "self" and not first.arg.startswith("_"):
                    name, end = node.name, node.end_lineno or node.lineno
                    if not name.startswith("__"):
                        found.append((node.lineno, end, owner.name, name, first.arg))
    return tuple(found)


def _last(decorator: ast.expr) -> str:
    """The last part of a decorator's name."""
    node = decorator.func if isinstance(decorator, ast.Call) else decorator
    return node.attr if isinstance(node, ast.Attribute) else node.id if isinstance(node, ast.Name) else ""
