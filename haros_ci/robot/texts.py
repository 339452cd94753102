# SPDX-License-Identifier: Apache-2.0
"""Texts of xacro: which parts are expressions, which are substitutions, and what a value is as a literal."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import lru_cache

_PARTS = re.compile(
    r"(?P<escape>\$\$+[{(])|\$\{(?P<expression>[^}]*)\}|\$\((?P<substitution>[^)]*)\)|(?P<text>[^$]+|\$[^{($]+|\$\Z)"
)


@lru_cache(maxsize=8_192)
def parts_of(text: str) -> tuple[tuple[str, str], ...] | None:
    """*text* in pairs of kind (text, expression, substitution) and content; None if a brace is not closed (xacro's LEXER)."""
    found = []
    at = 0
    while at < len(text):
        match = _PARTS.match(text, at)
        if match is None:
            return None
        at = match.end()
        kind = match.lastgroup or "text"
        content = match[kind]
        found.append(("text", content[1:]) if kind == "escape" else (kind, content))
    return tuple(found)


def literal(value: object) -> object:
    """What xacro makes of the text of a property: a number, a truth value, a quoted text without its quotes, or the same."""
    if not isinstance(value, str):
        return value
    if len(value) >= 2 and value[0] == value[-1] == "'":
        return value[1:-1]
    if "_" in value or len(value) > 400:
        return value
    for kind in (int, float):
        try:
            return kind(value)
        except ValueError:
            pass
    return truth(value) if value in _WORDS else value


_WORDS = {"true": True, "True": True, "false": False, "False": False}


def truth(value: object) -> bool | None:
    """Whether a condition of that value holds (xacro's get_boolean_value); None if xacro refuses it."""
    if not isinstance(value, str):
        return bool(value)
    if value in _WORDS:
        return _WORDS[value]
    try:
        return bool(int(value))
    except ValueError:
        return None


_DEFAULT = r"""\$\{.*?\}|\$\(.*?\)|(?:'[^']*'|\"[^\"]*\"|[^\s'\"])+|"""
_PARAMETER = re.compile(r"^\s*([^\s:=]+?)\s*:?=\s*(\^\|?)?(" + _DEFAULT + r")(?:\s+|$)(.*)", re.DOTALL)
MAX_PARAMETERS = 300
MAX_LENGTH = 20_000


def parameters_of(text: str) -> Iterator[tuple[str, bool, str | None]]:
    """The parameters of a macro: name, whether it is forwarded (``^``) and its default, None if it has none.

    What cannot have a default by its name alone is (name, False, None). xacro's parse_macro_arg.
    """
    left = text[:MAX_LENGTH]
    for _ in range(MAX_PARAMETERS):
        if not left.strip():
            return
        match = _PARAMETER.match(left)
        if match is not None:
            name, forward, default, left = match.groups()
            yield name, bool(forward), default or None
        else:
            name, *rest = left.split(None, 1)
            left = rest[0] if rest else ""
            yield name, False, None
