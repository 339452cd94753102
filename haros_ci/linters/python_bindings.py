# SPDX-License-Identifier: Apache-2.0
"""What the names of a Python file are bound to, as far as its own text tells: evidence for filters of findings, which a comment or a text is not."""

from __future__ import annotations

import ast
from collections.abc import Iterable

from haros_ci.regex import regex
from haros_ci.results.python_nodes import dotted, mentions

#: Modules whose ``raises`` and ``assertRaises`` fail unless what they call raises (docs.pytest.org, numpy.org, nose, testtools).
_OF_TESTS = frozenset({"pytest", "_pytest.python_api", "nose.tools", "numpy.testing", "testtools", "unittest", "numpy"})
_RAISES = regex(r"raises|assert_?[Rr]aises\w*")
_NAME_ERROR = regex(r"NameError")
_METHOD = regex(r"assert_?[Rr]aises\w*")
_OF_VERSIONS = regex(r"version_info|hexversion|PY[23]|python_version\w*")


def is_of_tests(function: ast.expr, nodes: Iterable[ast.AST]) -> bool:
    """Whether *function* is ``raises`` or ``assertRaises`` of a test framework: by an import of the file, or a method of the test that the file does not define."""
    *owner, name = dotted(function).split(".")
    if _RAISES.fullmatch(name) is None:
        return False
    nodes = tuple(nodes)
    own = frozenset({name, *owner[:1]})
    if any(
        isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef) and node.name in own for node in nodes
    ):
        return False
    if any(isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store) and node.id in own for node in nodes):
        return False
    if owner in (["self"], ["cls"]):
        return _METHOD.fullmatch(name) is not None
    bound = owner[0] if owner else name
    for node in nodes:
        if isinstance(node, ast.Import) and owner:
            if any(
                (alias.asname or alias.name.partition(".")[0]) == bound and alias.name in _OF_TESTS
                for alias in node.names
            ):
                return True
        elif isinstance(node, ast.ImportFrom) and node.level == 0:
            for alias in node.names:
                origin = node.module if not owner else f"{node.module}.{alias.name}"
                if (alias.asname or alias.name) == bound and origin in _OF_TESTS:
                    return _RAISES.fullmatch(alias.name) is not None or bool(owner)
    return False


def asks_for_version(nodes: Iterable[ast.AST], line: int) -> bool:
    """Whether the innermost function, or else the outermost statement, around *line* tests the version of Python, or is ready for a NameError."""
    around: ast.AST | None = None
    for node in nodes:  # from the outermost to the innermost
        if isinstance(node, ast.Module):
            around = next((one for one in node.body if one.lineno <= line <= (one.end_lineno or 0)), None)
        elif isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef) and node.lineno <= line <= (node.end_lineno or 0):
            around = node
    return around is not None and any(map(_tests_version, ast.walk(around)))


def _tests_version(node: ast.AST) -> bool:
    if isinstance(node, ast.ExceptHandler):
        return node.type is not None and mentions(node.type, _NAME_ERROR)
    if isinstance(node, ast.If | ast.IfExp | ast.While | ast.Assert):
        return any(
            _OF_VERSIONS.fullmatch(part.id if isinstance(part, ast.Name) else part.attr) is not None
            for part in ast.walk(node.test)
            if isinstance(part, ast.Name | ast.Attribute)
        )
    return False
