# SPDX-License-Identifier: Apache-2.0
"""One Python file: its functions measured, and its classes with their methods and what they mention."""

from __future__ import annotations

import ast
import builtins
from collections.abc import Iterable, Iterator

from haros_ci.extract.python.read import tree_of
from haros_ci.extract.python.source import Source, place
from haros_ci.measuring.facts import MOST_PROBLEMS, TOO_DEEP, ClassFacts, FileFacts, FunctionFacts
from haros_ci.measuring.python_body import PythonBody
from haros_ci.records import dataclass, field
from haros_ci.syntax import Program

_FUNCTIONS = (ast.FunctionDef, ast.AsyncFunctionDef)
_DEFINITIONS = (*_FUNCTIONS, ast.ClassDef)
_BUILT_IN = frozenset(dir(builtins)) | {"self", "cls"}


@dataclass(slots=True)
class _PythonFile:
    source: Source
    functions: list[FunctionFacts] = field(default_factory=list)
    classes: list[ClassFacts] = field(default_factory=list)
    problems: list[tuple[int, str]] = field(default_factory=list)


def read_python(text: str) -> FileFacts:
    """Measure a Python file, repaired where it is Python 2. What cannot be read is left out, with a problem."""
    found = tree_of(text)
    if isinstance(found, Program):
        return FileFacts(problems=found.problems)
    tree, source = found
    file = _PythonFile(source)
    try:
        _visit(file, tree.body)
    except RecursionError:
        return FileFacts(problems=((1, "nested too deeply to be measured; split the statements"),))
    functions = sorted(file.functions, key=lambda f: (f.line, f.column))
    classes = sorted(file.classes, key=lambda c: (c.line, c.column))
    return FileFacts(tuple(functions), tuple(classes), tuple(file.problems))


def _visit(file: _PythonFile, statements: Iterable[ast.stmt]) -> None:
    waiting = [(node, "", "") for node in _definitions(statements)]
    while waiting:
        node, scope, owner = waiting.pop()
        name = f"{scope}.{node.name}" if scope else node.name
        if isinstance(node, ast.ClassDef):
            inner = list(_definitions(node.body))
            file.classes.append(_class(file, node, name, inner))
            waiting += [(item, name, name) for item in inner]
        else:
            waiting += [(item, name, "") for item in _function(file, node, name, owner)]


def _definitions(statements: Iterable[ast.stmt]) -> Iterator[ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef]:
    """What *statements* define, inside of compound ones, too."""
    waiting: list[ast.AST] = list(statements)
    while waiting:
        node = waiting.pop()
        if isinstance(node, _DEFINITIONS):
            yield node
        elif not isinstance(node, ast.expr):
            waiting.extend(ast.iter_child_nodes(node))


def _function(
    file: _PythonFile, node: ast.FunctionDef | ast.AsyncFunctionDef, name: str, owner: str
) -> list[ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef]:
    """Measure a function; what is defined in it."""
    body = PythonBody()
    body.take(node.body)
    counts = body.counts
    line, column = _place(file.source, node)
    file.functions.append(
        FunctionFacts(
            name=name,
            class_name=owner,
            line=line,
            column=column,
            complexity=counts.complexity,
            nesting=counts.nesting,
            calls=counts.calls,
            distinct=len(counts.names),
            paths=body.paths,
            mentions=_mentions(node) if owner else (),
        )
    )
    if counts.is_too_deep and len(file.problems) < MOST_PROBLEMS:
        file.problems.append((line, TOO_DEEP))
    return body.local


def _class(file: _PythonFile, node: ast.ClassDef, name: str, inner: Iterable[ast.stmt]) -> ClassFacts:
    """Methods of one name are one: a property with its setter, the overloads of a stub."""
    names = {other_node.name for other_node in inner if isinstance(other_node, _FUNCTIONS)}
    public = {item for item in names if not item.startswith("_")}
    line, column = _place(file.source, node)
    return ClassFacts(name, line, column, len(names), len(public), _mentions(node))


def _place(source: Source, node: ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef) -> tuple[int, int]:
    """Where the name stands on the line of its ``def`` or ``class``."""
    line, column = place(source, node)
    row = source.lines[line - 1] if line <= len(source.lines) else ""
    keyword = "class" if isinstance(node, ast.ClassDef) else "def"
    at = row.find(node.name, row.find(keyword, column - 1) + len(keyword))
    return line, at + 1 if at >= 0 else column


def _mentions(root: ast.AST) -> tuple[str, ...]:
    """The dotted names under *root* that may be classes; classes and methods in it speak for themselves."""
    found: set[str] = set()
    waiting: list[ast.AST] = list(ast.iter_child_nodes(root))
    while waiting:
        node = waiting.pop()
        if isinstance(node, ast.ClassDef) or (isinstance(root, ast.ClassDef) and isinstance(node, _FUNCTIONS)):
            continue
        dotted = _dotted(node)
        if dotted:
            if dotted.partition(".")[0] not in _BUILT_IN:
                found.add(dotted)
            continue
        waiting.extend(ast.iter_child_nodes(node))
    return tuple(sorted(found))


def _dotted(node: ast.AST) -> str:
    """``a.b.c`` as text; "" for what is no such chain of names."""
    parts = []
    while isinstance(node, ast.Attribute):
        parts.append(node.attr)
        node = node.value
    return ".".join((node.id, *reversed(parts))) if isinstance(node, ast.Name) else ""
