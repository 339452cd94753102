# SPDX-License-Identifier: Apache-2.0
"""Classes and functions of a Python text by indentation, for any Python version and with syntax errors."""

from __future__ import annotations

import re

from haros_ci.regex import regex
from haros_ci.results.comments import PYTHON_SKIPPED
from haros_ci.results.scope import mark

_HIDDEN = regex(rf"""["'#](?:{PYTHON_SKIPPED})""")
_DEFINITION = regex(r"[ \t\f]*(?:(?:async[ \t]+)?def|class)[ \t]+(\w+)")
_LONGEST_NAME = 400


def python_marks(text: str) -> list[tuple[int, str]]:
    """(line, qualified name from there on), ascending."""
    marks: list[tuple[int, str]] = []
    open_scopes: list[tuple[int, str]] = []  # (indentation, qualified name), outermost first
    depth = 0  # of brackets
    continued = False
    last_code = 0
    for number, line in enumerate(_HIDDEN.sub(_hide, text).split("\n"), 1):
        if not line or line.isspace():
            continued = False
            continue
        definition = None if continued else _DEFINITION.match(line)
        if definition:
            depth = 0  # no bracket can hold a definition: an earlier one was left open
        if not continued and depth == 0:
            indentation = _indentation(line)
            while open_scopes and open_scopes[-1][0] >= indentation:
                open_scopes.pop()
                mark(marks, last_code + 1, open_scopes[-1][1] if open_scopes else "")
            if definition:
                outer = open_scopes[-1][1] if open_scopes else ""
                name = f"{outer}.{definition[1]}" if outer else definition[1]
                open_scopes.append((indentation, name if len(name) <= _LONGEST_NAME else outer))
                mark(marks, number, open_scopes[-1][1])
        depth = max(0, depth + sum(map(line.count, "([{")) - sum(map(line.count, ")]}")))
        continued = line.endswith("\\")
        last_code = number
    if open_scopes:
        mark(marks, last_code + 1, "")
    return marks


def _hide(match: re.Match[str]) -> str:
    """A literal becomes a quote that goes on over as many lines as it did; a comment vanishes."""
    return '"' + "\\\n" * match[0].count("\n") if match[0][0] != "#" else ""


def _indentation(line: str) -> int:
    """In columns; a tab goes to the next multiple of 8, as the language defines."""
    code = line.lstrip(" \t\f")
    return len(line[: len(line) - len(code)].replace("\f", "").expandtabs(8))
