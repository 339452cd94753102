# SPDX-License-Identifier: Apache-2.0
"""One Python file as a Program."""

from __future__ import annotations

import ast
import sys
import warnings
from collections.abc import Mapping

from haros_ci.extract.python.annotations import NO_TYPE
from haros_ci.extract.python.encoding import other_encoding
from haros_ci.extract.python.other_versions import repair
from haros_ci.extract.python.scope import Bindings, Collected, PythonScope, bound
from haros_ci.extract.python.source import Edit, Source, source_of
from haros_ci.extract.python.statements import block
from haros_ci.extract.python.tokens import longest_chain
from haros_ci.syntax import Function, Program

LANGUAGE = "python"
_UNREADABLE = (SyntaxError, ValueError, MemoryError, RecursionError)
#: Python 3.10 builds a tree of any depth and dies of it; later ones refuse.
_BOUNDS_DEPTH = sys.version_info >= (3, 11)
_SMALL_TEXT = 100_000
_LONGEST_CHAIN = 400


def read_python(text: str) -> Program:
    """Lower a Python 3 file, or a Python 2 file that differs only in spelling, without executing anything.

    Line ends may be ``\\n``, ``\\r\\n`` or ``\\r``; a byte-order mark counts as no column. A file that the running
    Python cannot parse gives a Program with a problem that says why and nothing else. Never raises.
    """
    found = tree_of(text)
    if isinstance(found, Program):
        return found
    tree, source = found
    try:
        return _program(tree, Collected(source))
    except RecursionError:
        return _failed(1, "nested too deeply to be read; split the statements")


def tree_of(text: str) -> tuple[ast.Module, Source] | Program:
    """The tree of *text*, repaired where it is Python 2, and the places in it; a Program that says why if there is none."""
    text = text.removeprefix("\ufeff").replace("\r\n", "\n").replace("\r", "\n")
    if not text.isascii():
        text = text.encode("utf-8", "replace").decode("utf-8")
    if "coding" in text[:2000] and (encoding := other_encoding(text)):
        return _failed(
            1,
            f"it declares the encoding {encoding!a}, in which code may look like a comment: it is not read; save it as UTF-8",
        )
    if not _BOUNDS_DEPTH and len(text) > _SMALL_TEXT and longest_chain(text) > _LONGEST_CHAIN:
        return _failed(1, "an expression is too long for this version of Python; run haros-ci on Python 3.11 or later")
    edits: Mapping[int, list[Edit]] = {}
    parsed = text
    try:
        tree = _parse(text)
    except _UNREADABLE as error:
        if not isinstance(error, SyntaxError) or "\0" in text:
            return _unreadable(error, text)
        parsed, edits = repair(text)
        try:
            tree = _parse(parsed)
        except _UNREADABLE as second:
            return _unreadable(second if edits else error, text)
    return tree, source_of(text, parsed, edits)


def syntax_error(text: str) -> tuple[int, str] | None:
    """Line and message of what makes *text* no Python 3; None if nothing does, or it is too much for the parser."""
    if not _BOUNDS_DEPTH and len(text) > _SMALL_TEXT and longest_chain(text) > _LONGEST_CHAIN:
        return None
    try:
        _parse(text)
    except SyntaxError as error:
        return error.lineno or 1, error.msg
    except _UNREADABLE:
        return None
    return None


def _parse(text: str) -> ast.Module:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return ast.parse(text)


def _program(tree: ast.Module, file: Collected) -> Program:
    bindings = Bindings()
    file.functions.append(None)
    body = block(tree.body, PythonScope(file, "module", bindings=bindings), 0)
    file.functions[0] = Function("", "", "module", (), NO_TYPE, 1, 1, body, body_line=1, body_column=1)
    return Program(
        language=LANGUAGE,
        functions=tuple(function for function in file.functions if function is not None),
        classes=tuple(file.classes),
        variables=bound(bindings, file.source, file.rebound),
        aliases=tuple(file.aliases),
        problems=tuple(file.problems),
    )


def _unreadable(error: BaseException, text: str) -> Program:
    if "\0" in text:
        return _failed(text.count("\n", 0, text.index("\0")) + 1, "not Python text: it has a null byte")
    if isinstance(error, SyntaxError):
        reason = (error.msg or "invalid syntax")[:200]
        line = min(max(error.lineno or 1, 1), text.count("\n") + 1)
        version = f"Python {sys.version_info.major}.{sys.version_info.minor}"
        return _failed(
            line,
            f"{version} cannot parse the file ({reason}): correct this line, or run haros-ci with the Python version that the file is written for",
        )
    return _failed(1, "nested too deeply to be parsed; split the statements")


def _failed(line: int, message: str) -> Program:
    return Program(language=LANGUAGE, problems=((line, message),))
