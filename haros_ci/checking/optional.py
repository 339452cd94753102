# SPDX-License-Identifier: Apache-2.0
"""Places of a Python launch file that only machines with some package reach: the file asks for the package before."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from functools import lru_cache

from haros_ci.checking.branches import Span, branches, is_in, parsed
from haros_ci.checking.system import System
from haros_ci.model.launch_facts import LaunchFact
from haros_ci.model.location import Location

#: What lists the packages that are installed (ament_index_python), and what is raised where one is not (with its bases).
_LISTED = frozenset(("get_packages_with_prefixes", "has_resource", "get_resources"))
_MISSING = frozenset(("PackageNotFoundError",))
_BASES = frozenset(("KeyError", "LookupError", "Exception", "BaseException"))
_WHERE = frozenset(("get_package_share_directory", "get_package_share_path", "get_package_prefix"))
_WORDS = (*_LISTED, *_MISSING, *_WHERE)


def depends_on_package(text: str, location: Location) -> bool:
    """Whether the line of *location* in the Python file *text* is reached only if some package is installed, or a missing one is caught.

    That is a branch or a ``condition=`` on what ``get_packages_with_prefixes()`` returns, a ``try`` with a handler for PackageNotFoundError
    that raises nothing itself, and a branch on what such a ``try`` sets or such a function returns.
    """
    return is_in(_spans(text), location)


def is_optional(fact: LaunchFact, system: System) -> bool:
    """As ``depends_on_package``, of what a launch file says."""
    path, workspace = fact.location.path, system.workspace
    return path.endswith(".py") and workspace is not None and depends_on_package(workspace.text(path), fact.location)


@lru_cache(maxsize=1024)
def _spans(text: str) -> tuple[Span, ...]:
    tree = parsed(text) if any(word in text for word in _WORDS) else None
    if tree is None:
        return ()
    tried = frozenset(node for node in ast.walk(tree) if isinstance(node, ast.Try) and _catches(node))
    own = tuple(sorted((node.lineno, node.end_lineno or node.lineno) for node in tried))
    return (*own, *branches(tree, _lists, frozenset(_set(tree, tried))))


def _lists(node: ast.AST) -> bool:
    return _name(node) in _LISTED


def _catches(node: ast.Try) -> bool:
    """Whether a package that is missing ends in a handler of *node*, which goes on."""
    for handler in node.handlers:
        kinds = handler.type.elts if isinstance(handler.type, ast.Tuple) else [handler.type]
        names = {_name(kind) if kind is not None else "BaseException" for kind in kinds}
        if names & _MISSING or (names & _BASES and _looks(node.body)):
            return not _leaves(handler.body[-1])
    return False


def _looks(body: list[ast.stmt]) -> bool:
    return any(_name(node) in _WHERE for statement in body for node in ast.walk(statement))


def _leaves(last: ast.stmt) -> bool:
    """Whether the launch ends there."""
    is_exit = isinstance(last, ast.Expr) and isinstance(last.value, ast.Call) and _name(last.value.func) == "exit"
    return is_exit or isinstance(last, ast.Raise)


def _set(tree: ast.Module, tried: frozenset[ast.Try]) -> Iterator[str]:
    """The variables that *tried* statements set, and the functions that have one and return what a branch can ask."""
    for node in tried:
        for other_node in ast.walk(node):
            if isinstance(other_node, ast.Assign):
                yield from (target.id for target in other_node.targets if isinstance(target, ast.Name))
    for function in ast.walk(tree):
        if isinstance(function, ast.FunctionDef) and any(node in tried for node in ast.walk(function)):
            returned = [node.value for node in ast.walk(function) if isinstance(node, ast.Return)]
            if any(value is None or (isinstance(value, ast.Constant) and not value.value) for value in returned):
                yield function.name


def _name(node: ast.AST) -> str:
    """The last part of a name."""
    return node.id if isinstance(node, ast.Name) else node.attr if isinstance(node, ast.Attribute) else ""
