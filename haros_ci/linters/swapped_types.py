# SPDX-License-Identifier: Apache-2.0
"""Python code that gives a name another meaning at run time: ``std_msgs.msg.String = Int32``, ``globals().update(String=Int32)``.

The model takes a type of a message for what it is called.
"""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterable, Iterator

from haros_ci.linters.changed_code import Found, brought, notes
from haros_ci.linters.in_default import is_test
from haros_ci.linters.pylint_idioms import nodes
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Workspace
from haros_ci.regex import regex
from haros_ci.results.python_nodes import dotted
from haros_ci.results.result import Notification

#: Places that are named; the rest is counted. Longer files are not looked at.
MOST = 10
MAX_TEXT = 300_000
_QUOTED = 80
#: The modules of a package that have its interfaces.
_OF_INTERFACES = frozenset(("msg", "srv", "action"))
_MAY = regex(r"\b(?:globals|sys\.modules|msg|srv|action)\b")


def notifications(head: Workspace, base: Workspace | None) -> tuple[Notification, ...]:
    """A note for each such place of *head* that no file of *base* which changed or is gone has; none without a base."""
    if base is None:
        return ()
    return notes(brought(head, base, _look), MOST, "names are given another meaning at run time since this change")


def _look(workspace: Workspace) -> Callable[[SourceFile], Iterable[Found]]:
    effect = "gives a name another meaning at run time: the model has the one that is imported or defined"

    def look(file: SourceFile) -> Iterator[Found]:
        if file.language != "python" or is_test(file.path):
            return
        text = workspace.text(file.path)
        for line, name in swapped(text) if len(text) <= MAX_TEXT else ():
            yield line, name, f"since this change {name} {effect}"

    return look


def swapped(text: str) -> Iterator[tuple[int, str]]:
    """The lines and texts of such statements and calls."""
    if _MAY.search(text) is None:
        return
    tree = nodes(text)
    modules = {name for node in tree for name in _modules(node)}
    for node in tree:
        if isinstance(node, (ast.Assign, ast.AugAssign, ast.AnnAssign)):
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            for target in targets:
                if _is_swapped(target, modules):
                    yield node.lineno, f"{_said(target)} = …"
        elif isinstance(node, ast.Call) and _swaps(node, modules):
            yield node.lineno, f"{_said(node.func)}({', '.join((*map(_said, node.args[:2]), '…'))})"


def _said(node: ast.expr) -> str:
    """What a message has of an expression, however deep that is."""
    if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Subscript):
        return f"{dotted(node.value.value)}[…].{node.attr}"
    if isinstance(node, ast.Attribute) and not dotted(node):
        return f"{'globals()' if _is_globals(node.value) else '…'}.{node.attr}"
    if isinstance(node, ast.Subscript):
        return f"{'globals()' if _is_globals(node.value) else dotted(node.value)}[…]"
    return repr(node.value)[:_QUOTED] if isinstance(node, ast.Constant) else dotted(node)[:_QUOTED] or "…"


def _modules(node: ast.AST) -> Iterator[str]:
    """The names, dotted ones too, under which an import has a module of interfaces."""
    if isinstance(node, ast.Import):
        for name in node.names:
            if name.name.rpartition(".")[2] in _OF_INTERFACES and "." in name.name:
                yield name.asname or name.name
    elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
        for name in node.names:
            if name.name in _OF_INTERFACES:
                yield name.asname or name.name


def _is_swapped(target: ast.expr, modules: set[str]) -> bool:
    """Whether a target of an assignment is a name of a module of interfaces, of one in ``sys.modules``, or of ``globals()``."""
    if isinstance(target, ast.Attribute):
        return _is_module(target.value, modules)
    return isinstance(target, ast.Subscript) and _is_globals(target.value)


def _is_module(node: ast.expr, modules: set[str]) -> bool:
    if isinstance(node, ast.Subscript):
        return dotted(node.value) == "sys.modules"
    return dotted(node) in modules


def _is_globals(node: ast.expr) -> bool:
    return isinstance(node, ast.Call) and dotted(node.func) == "globals"


def _swaps(call: ast.Call, modules: set[str]) -> bool:
    """Whether a call is ``setattr`` on such a module, or ``globals().update``."""
    if isinstance(call.func, ast.Name) and call.func.id == "setattr" and call.args:
        return _is_module(call.args[0], modules)
    return isinstance(call.func, ast.Attribute) and call.func.attr == "update" and _is_globals(call.func.value)
