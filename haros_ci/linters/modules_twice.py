# SPDX-License-Identifier: Apache-2.0
"""Calls into modules of which there are several of one name: pylint knows one by it, and Python takes the one beside the script."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from functools import lru_cache

from haros_ci.linters.pylint_idioms import nodes
from haros_ci.model.workspace import Workspace
from haros_ci.regex import regex
from haros_ci.results.result import Result

_IMPORTED = regex(
    r"^[ \t]*(?:from[ \t]+([A-Za-z_][\w.]*)[ \t]+import\b|import[ \t]+([A-Za-z_][\w, \t]{0,300}))", re.MULTILINE
)
_ARGUMENT = regex(r"argument '(\w+)'")
_CALLED = regex(r"[\w.]+")
_LONGEST = 400
#: So many modules of one name are looked at.
_MOST = 20
_FUNCTIONS = (ast.FunctionDef, ast.AsyncFunctionDef)


def is_of_another(result: Result, workspace: Workspace) -> bool:
    """Whether what pylint says of a call in *result* does not fit the module that Python takes, which lies beside the file; another one of its name lies elsewhere.

    It fits where the file itself, or that module, has what the message is about: a function that takes such an argument, or is called so.
    """
    path = result.location.path
    text = workspace.text(path)
    beside = [workspace.text(name) for name in _doubles(path, text, workspace)]
    if not beside or not all(nodes(one) for one in (text, *beside)):
        return False
    own, *others = [frozenset(_names(one, result)) for one in (text, *beside)]
    argument = _ARGUMENT.search(result.message)
    if result.rule in ("no-value-for-parameter", "missing-kwoa"):
        return argument is not None and not any(argument[1] in names for names in (own, *others))
    name = argument[1] if argument is not None else _callee(result, text)
    return name not in own and any(name in names for names in others)


def _doubles(path: str, text: str, workspace: Workspace) -> Iterator[str]:
    """The modules beside the file at *path* that its *text* imports by name and of which there is another one elsewhere."""
    folder = path[: path.rfind("/") + 1]
    for found in _IMPORTED.finditer(text):
        for word in (found[1] or found[2]).split(","):
            module = word.split()[0] if word.split() else ""
            end = f"{module.replace('.', '/')}.py"
            name = f"{folder}{end}"
            others = _modules(workspace.names).get(module.rpartition(".")[2], ()) if name in workspace.names else ()
            others = tuple(other for other in others if f"/{other}".endswith(f"/{end}"))
            if any(workspace.text(other) != workspace.text(name) for other in others):
                yield name


@lru_cache(maxsize=4)
def _modules(names: frozenset[str]) -> dict[str, tuple[str, ...]]:
    """The Python files among *names* by what modules they would be; of many of one name the first."""
    found: dict[str, list[str]] = {}
    for name in sorted(names):
        base = name.rpartition("/")[2]
        if base.endswith(".py") and len(found.setdefault(base[:-3], [])) < _MOST:
            found[base[:-3]].append(name)
    return {module: tuple(paths) for module, paths in found.items()}


def _names(text: str, result: Result) -> Iterator[str]:
    """The parameters of all functions, or for messages that name none what functions and classes are called."""
    is_named = _ARGUMENT.search(result.message) is not None
    for node in nodes(text):
        if isinstance(node, (*_FUNCTIONS, ast.ClassDef)) and not is_named:
            yield node.name
        elif isinstance(node, _FUNCTIONS):
            yield from (one.arg for one in (*node.args.posonlyargs, *node.args.args, *node.args.kwonlyargs))


def _callee(result: Result, text: str) -> str:
    """The last part of what is called there; "" if that is not seen."""
    lines = text.split("\n")
    line, column = result.location.line or 0, max((result.location.column or 1) - 1, 0)
    called = _CALLED.match(lines[line - 1][column : column + _LONGEST]) if 0 < line <= len(lines) else None
    return called[0].rpartition(".")[2] if called is not None else ""
