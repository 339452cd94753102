# SPDX-License-Identifier: Apache-2.0
"""Measures Python files with radon, one syntax tree and one token stream each; run as a script in its own process."""

from __future__ import annotations

import ast
import io
import sys
import tokenize
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import Any

if not __package__:  # run as a script: haros_ci itself, also where it is not installed
    sys.path.append(str(Path(__file__).resolve().parents[2]))

from haros_ci.linters.metrics_worker import Tokens, Unmeasurable, begin, file_metrics, serve

LAYOUT = frozenset((tokenize.NL, tokenize.NEWLINE, tokenize.INDENT, tokenize.DEDENT, tokenize.ENDMARKER))
PUNCTUATION = frozenset("()[]{},:;")
Function = ast.FunctionDef | ast.AsyncFunctionDef


def measure(source: bytes) -> dict[str, Any]:
    """The metrics of one file. A docstring counts as a comment, an ``assert`` is not a branch."""
    from radon.visitors import HalsteadVisitor

    warnings.simplefilter("ignore")
    text = _decode(source)
    tree = _parse(text)
    lines = _RadonLines(text, tree)
    rows = text.split("\n")
    functions = [_function(node, name, owner, rows, lines) for node, name, owner in _functions(tree)]
    halstead = HalsteadVisitor.from_ast(tree)
    metrics = file_metrics(
        code=lines.code,
        comments=lines.comments,
        logical=sum(isinstance(node, ast.stmt) for node in ast.walk(tree)),
        effective=len(lines.effective),
        complexity=sum(f["cc"] for f in functions),
        tokens=Tokens(halstead.operators, halstead.operands, halstead.distinct_operators, halstead.distinct_operands),
    )
    return {"functions": functions, "file": metrics}


def _decode(source: bytes) -> str:
    """The text as Python declares its encoding, else as Latin-1, which many old files are without saying so."""
    try:
        encoding, _ = tokenize.detect_encoding(io.BytesIO(source).readline)
        text = source.decode(encoding)
    except (SyntaxError, UnicodeDecodeError):
        text = source.decode("latin-1")
    return text.replace("\r\n", "\n").replace("\r", "\n")


def _parse(text: str) -> ast.Module:
    try:
        return ast.parse(text)
    except SyntaxError as error:
        version = ".".join(map(str, sys.version_info[:2]))
        raise Unmeasurable(f"Python {version} cannot parse it: {error.msg}", error.lineno) from error
    except ValueError as error:  # NUL bytes
        raise Unmeasurable("not Python source") from error


class _RadonLines:
    """The lines of code and of comment; ``effective`` ones are more than closing brackets and other punctuation."""

    def __init__(self, text: str, tree: ast.Module) -> None:
        self.code: set[int] = set()
        self.effective: set[int] = set()
        self.comments: set[int] = set()
        for token in tokenize.generate_tokens(io.StringIO(text).readline):
            span = range(token.start[0], token.end[0] + 1)
            if token.type == tokenize.COMMENT:
                self.comments.update(span)
            elif token.type not in LAYOUT:
                self.code.update(span)
                if token.string not in PUNCTUATION:
                    self.effective.update(span)
        for node in ast.walk(tree):
            if (
                isinstance(node, ast.Expr)
                and isinstance(node.value, ast.Constant)
                and isinstance(node.value.value, str)
            ):
                span = range(node.lineno, (node.end_lineno or node.lineno) + 1)
                self.comments.update(span)
                self.code.difference_update(span)
                self.effective.difference_update(span)


def _functions(tree: ast.Module) -> Iterator[tuple[Function, str, ast.AST]]:
    """Every function with its dotted name and what it is defined in, in the order of the text."""
    pending: list[tuple[ast.AST, str, ast.AST]] = [(tree, "", tree)]
    while pending:
        node, scope, owner = pending.pop()
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)):
            scope = f"{scope}.{node.name}" if scope else node.name
            if not isinstance(node, ast.ClassDef):
                yield node, scope, owner
            owner = node
        children = [child for child in ast.iter_child_nodes(node) if isinstance(child, (ast.stmt, ast.ExceptHandler))]
        if isinstance(node, ast.Match):
            children = [statement for case in node.cases for statement in case.body]
        pending.extend((child, scope, owner) for child in reversed(children))


def _function(node: Function, name: str, owner: ast.AST, rows: list[str], lines: _RadonLines) -> dict[str, Any]:
    from radon.visitors import ComplexityVisitor

    span = range(node.lineno, (node.end_lineno or node.lineno) + 1)
    visitor = ComplexityVisitor(off=False, no_assert=True)
    visitor.visit(node)
    return {
        "name": name,
        "line": node.lineno,
        "column": _column(node, rows),
        "cc": visitor.functions[0].complexity,
        "nloc": sum(line in lines.code for line in span),
        "eloc": sum(line in lines.effective for line in span),
        "parameters": _parameters(node, owner),
    }


def _column(node: Function, rows: list[str]) -> int | None:
    """Where the name stands on the line of its ``def``, counted from 1."""
    row = rows[node.lineno - 1]
    at = row.find(node.name, row.find("def") + 3)
    return at + 1 if at >= 0 else None


def _parameters(node: Function, owner: ast.AST) -> int:
    """The parameters that a caller sees: without the ``self`` or ``cls`` of a method."""
    arguments = node.args
    count = len(arguments.posonlyargs) + len(arguments.args) + len(arguments.kwonlyargs)
    count += (arguments.vararg is not None) + (arguments.kwarg is not None)
    static = any(isinstance(d, ast.Name) and d.id == "staticmethod" for d in node.decorator_list)
    bound = isinstance(owner, ast.ClassDef) and not static and bool(arguments.posonlyargs or arguments.args)
    return count - bound


if __name__ == "__main__":
    begin()
    serve(measure)
