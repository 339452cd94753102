# SPDX-License-Identifier: Apache-2.0
"""Calls with arguments of a former kind in functions of Python that nothing in the workspace names: they were left behind, and nothing runs them."""

from __future__ import annotations

import ast
import re

from haros_ci.linters.pylint_idioms import nodes
from haros_ci.model.workspace import Workspace
from haros_ci.regex import regex

#: Names by which frameworks find what they call.
_FOUND = regex(
    r"__\w+__|(?:test|setUp|tearDown|do|on|visit|handle|generate)(?:_\w+|[A-Z]\w*)?|main|run|callback|\w+_(?:callback|cb)"
)
#: What finds functions by a part of their names.
_BY_PARTS = regex(r"\bgetattr[ \t]*\(|\bgetmembers[ \t]*\(|\bglobals[ \t]*\(\)|\bdir[ \t]*\(|\bfire\b")
_FUNCTIONS = (ast.FunctionDef, ast.AsyncFunctionDef)


def is_found(name: str, text: str) -> bool:
    """Whether something may call a function of that *name* without naming it whole: a framework, or what the *text* of its file looks through."""
    return _FOUND.fullmatch(name) is not None or _BY_PARTS.search(text) is not None


def is_uncalled(path: str, line: int, workspace: Workspace) -> bool:
    """Whether *line* of the Python file at *path* is in a function without a decorator whose name stands nowhere but where functions of that name are defined.

    A method of a class with a base may be called by this. Who finds functions by parts of their names, in the same file, may find it, too; so may who reads a comment with the name.
    """
    text = workspace.text(path)
    around = [
        node for node in nodes(text) if isinstance(node, _FUNCTIONS) and node.lineno <= line <= (node.end_lineno or 0)
    ]
    if not around:
        return False
    function = around[0]  # the outermost: what stands in it is run by it
    if function.decorator_list or is_found(function.name, text):
        return False
    owners = [
        node for node in nodes(text) if isinstance(node, ast.ClassDef) and node.lineno <= line <= (node.end_lineno or 0)
    ]
    if any(base for node in owners for base in node.bases if not (isinstance(base, ast.Name) and base.id == "object")):
        return False
    if any(node.decorator_list or node.keywords for node in owners):
        return False
    used = re.compile(rf"(?<!def )\b{re.escape(function.name)}\b")
    return not any(
        function.name in other_text and used.search(other_text)
        for other_text in (workspace.text(file.path) for file in workspace.files)
    )
