# SPDX-License-Identifier: Apache-2.0
"""A setup.py whose ``setup()`` is not setuptools', or is never called: what it says is read, and nothing of it is installed."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from haros_ci.linters.pylint_idioms import nodes
from haros_ci.model.workspace import Workspace
from haros_ci.results.constant_tests import constants_of, leaves, truth
from haros_ci.results.python_nodes import dotted
from haros_ci.results.result import Notification
from haros_ci.results.rule import Level
from haros_ci.results.unreached import EXITS

_MODULES = ("setuptools", "distutils", "core")


def notifications(head: Workspace, base: Workspace | None) -> tuple[Notification, ...]:
    """A note for each such setup.py of *head* that was none in *base*; none without a base."""
    if base is None:
        return ()
    old = {file.path: file.digest for file in base.files}
    found = []
    for file in head.files:
        is_setup = file.path.rpartition("/")[2] == "setup.py" and old.get(file.path) != file.digest
        if not is_setup or file.third_party or not head.reports_on(file.path):
            continue
        why = lost_setup(head.text(file.path))
        if why is not None and not (file.path in old and lost_setup(base.text(file.path))):
            line, words = why
            text = f"since this change {words}: nothing of what it says is installed; look at it"
            found.append(Notification(Level.NOTE, text, path=file.path, line=line))
    return tuple(found)


def lost_setup(text: str) -> tuple[int, str] | None:
    """The line, and what it is in words; None where setup() may well be called."""
    if "setup" not in text:
        return None
    every = nodes(text)
    calls = [node for node in every if isinstance(node, ast.Call) and _is_setup(node.func)]
    if not calls:
        return None
    for line in _bindings(every, {_called(call) for call in calls}):
        return line, "setup() is not that of setuptools"
    unrun = {id(node) for node in _unrun(every)}
    if all(id(call) in unrun for call in calls):
        return calls[0].lineno, "setup() is never called"
    return None


def _is_setup(function: ast.expr) -> bool:
    if isinstance(function, ast.Attribute):
        return function.attr == "setup" and isinstance(function.value, ast.Name) and function.value.id in _MODULES
    return isinstance(function, ast.Name) and function.id == "setup"


def _called(call: ast.Call) -> str:
    return dotted(call.func).partition(".")[0]


def _bindings(every: tuple[ast.AST, ...], names: set[str]) -> Iterator[int]:
    """Lines that give one of *names* another meaning than an import of setup() or of its module does."""
    for node in every:
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
            if node.name in names and not _calls(node, node.name):
                yield node.lineno
        elif isinstance(node, ast.Name) and not isinstance(node.ctx, ast.Load):
            if node.id in names:
                yield node.lineno
        elif isinstance(node, ast.Attribute) and not isinstance(node.ctx, ast.Load):
            if node.attr == "setup" and isinstance(node.value, ast.Name) and node.value.id in _MODULES:
                yield node.lineno
        elif isinstance(node, ast.Import | ast.ImportFrom):
            for alias in node.names:
                if alias.asname in names and alias.name.rpartition(".")[2] not in ("setup", *_MODULES):
                    yield node.lineno


def _calls(function: ast.AST, name: str) -> bool:
    """Whether a function ``setup`` of setup.py's own hands on what it is given, to one of its module."""
    return any(
        isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr == name
        for node in ast.walk(function)
    )


def _unrun(every: tuple[ast.AST, ...]) -> Iterator[ast.AST]:
    """All that stands where nothing runs: under a condition that never holds, behind what always leaves, in functions that nothing names."""
    given = constants_of(every)
    named = {node.id for node in every if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load)}
    blocks: list[list[ast.stmt]] = []
    for node in every:
        if isinstance(node, ast.If | ast.While):
            known = truth(node.test, given)
            blocks += [node.body] if known is False else [node.orelse] if known is True else []
        elif isinstance(node, ast.FunctionDef) and node.name not in named and not node.decorator_list:
            blocks.append(node.body)
        block = getattr(node, "body", None)
        if isinstance(block, list):
            last = next((number for number, one in enumerate(block) if _ends(one, given)), len(block))
            blocks.append(block[last + 1 :])
    for block in blocks:
        for statement in block:
            yield from ast.walk(statement)


def _ends(statement: ast.AST, given: dict[str, object]) -> bool:
    if isinstance(statement, ast.Expr) and isinstance(statement.value, ast.Call):
        return dotted(statement.value.func) in EXITS
    return isinstance(statement, ast.stmt) and leaves(statement, given)
