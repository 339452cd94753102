# SPDX-License-Identifier: Apache-2.0
"""Whether a text is code, whatever the name of its file says: Python by its grammar or its lines, C++ by the bodies of functions.

Nothing is run. Text that only the program makes that runs it (a value in a data file, a pickle) is not recognised.
"""

from __future__ import annotations

import ast
import re
import warnings

from haros_ci.regex import regex

#: Texts with more characters are recognised by their lines alone.
_LARGEST_PARSED = 300_000
#: What every program of Python that does anything has somewhere: a call, an import, a definition.
_MAYBE = regex(r"\w[ \t]*\(|^[ \t]*(?:import|from|def|class|del|raise)\b", re.M)
_LINE = regex(
    r"^[ \t]*(?:import [A-Za-z_][\w.]*|from [\w.]+ import\b[^\n]*|(?:async )?def \w+ ?\([^\n]*|class \w+(?: ?\([^()\n]*\))?:)",
    re.M,
)
_STATEMENTS = (
    *(
        ast.Import,
        ast.ImportFrom,
        ast.FunctionDef,
        ast.AsyncFunctionDef,
        ast.ClassDef,
        ast.For,
        ast.AsyncFor,
        ast.While,
    ),
    *(ast.If, ast.With, ast.AsyncWith, ast.Try, ast.Raise, ast.Assert, ast.Delete, ast.Global, ast.Match),
)
#: A body of a function, which is what findings are in; a template without one has values alone.
_NO_CPP = regex(r"\A#!|^syntax = \"proto[23]\";$", re.M)
_BODY = regex(r"\)[^;{}()]{0,80}(?:\{|<%)|\]\s*\{")
_COMMENTS = regex(r"//[^\n]*|/\*[^*]*(?:\*(?!/)[^*]*)*\*/")


def is_python(text: str, *, with_calls: bool = True) -> bool:
    """Whether *text* is a program of Python 3: all of it parses, and it imports, defines or decides something, or, *with_calls*, calls something.

    Settings that happen to parse (``rate = 10``, ``key: value``, JSON) are none.
    """
    if not _MAYBE.search(text):
        return False
    if len(text) > _LARGEST_PARSED:
        return has_lines_of_python(text)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            tree = ast.parse(text)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return False
    return any(isinstance(node, _STATEMENTS) or (with_calls and _calls(node)) for node in tree.body)


def has_lines_of_python(text: str) -> bool:
    """Whether a line of *text* imports or defines something in the words of Python; the rest may be anything."""
    return _LINE.search(text) is not None


def is_cpp(text: str) -> bool:
    """Whether *text* has functions of C++, as far as it tells: Protocol Buffers and shell scripts have what looks like some."""
    return has_body(text) and ";" in text and not _NO_CPP.search(text)


def has_body(text: str) -> bool:
    """Whether *text* has the body of a function of C++."""
    return _BODY.search(text) is not None or _BODY.search(_COMMENTS.sub(" ", text)) is not None


def _calls(node: ast.stmt) -> bool:
    value = node.value if isinstance(node, ast.Expr | ast.Assign | ast.AugAssign | ast.AnnAssign) else None
    return value is not None and any(isinstance(part, ast.Call) for part in ast.walk(value))
