# SPDX-License-Identifier: Apache-2.0
"""Texts of xacro: which parts are expressions, which are substitutions, and what a value is as a literal."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from functools import lru_cache

from haros_ci.regex import regex

_PARTS = regex(
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


_PARAMETER = regex(r"\s*([^\s:=]+)\s*:?=(\s*)(\^\|?)?")
#: The first alternatives of a default: lazy, so they end at the first bracket that a blank follows.
_SUBSTITUTED = regex(r"\$\{.*?\}(?=\s|\Z)|\$\(.*?\)(?=\s|\Z)", re.DOTALL)
_PLAIN = regex(r"[^\s'\"]+")
#: What is no name of a parameter that a call could give, by XML: xacro had no default to split off.
_UNREAD = regex(r"[\"'=<>{}$()]|:\Z")
#: Places that are tried for the end of one default.
MAX_TRIES = 2_000
MAX_PARAMETERS = 300
MAX_LENGTH = 20_000


def parameters_of(text: str) -> Iterator[tuple[str, bool, str | None]]:
    """The parameters of a macro: name, whether it is forwarded (``^``) and its default, None if it has none.

    What cannot have a default by its name alone is (name, False, None). xacro's parse_macro_arg with its re_macro_arg.
    """
    left = text[:MAX_LENGTH]
    for _ in range(MAX_PARAMETERS):
        left = left.lstrip()
        if not left:
            return
        match = _PARAMETER.match(left)
        end = _default_end(left, match.end()) if match is not None else None
        if match is not None and end is None and match[2]:  # nothing, and the blank behind it
            yield match[1], False, None
            left = left[match.end(2) :]
        elif match is not None and end is not None:
            yield match[1], bool(match[3]), left[match.end() : end] or None
            left = left[end:]
        else:
            name, *rest = left.split(None, 1)
            left = rest[0] if rest else ""
            yield name, False, None


def is_read(names: Iterable[str]) -> bool:
    """Whether the *names* of a macro's parameters are names: what xacro cannot read ends up in one."""
    return not any(_UNREAD.search(name) for name in names)


def _default_end(text: str, start: int) -> int | None:
    """Where the default that begins at *start* ends; None where there is none to be read.

    Quoted parts end at the next quote that lets the whole be read, which is not always the nearest: ``'''`` is the quote in quotes.
    """
    substituted = _SUBSTITUTED.match(text, start)
    if substituted is not None:
        return substituted.end()
    tried = 0
    failed: set[int] = set()
    ways = [(start, start)]  # where a part begins, and where its end is searched for next
    while ways and tried < MAX_TRIES:
        tried += 1
        here, after = ways.pop()
        if here == len(text) or text[here].isspace():
            return here
        if text[here] in "'\"":
            close = text.find(text[here], max(after, here + 1))
            if close < 0:
                continue
            ways.append((here, close + 1))
            end = close + 1
        else:
            plain = _PLAIN.match(text, here)
            end = plain.end() if plain is not None else len(text)
        if end not in failed:
            failed.add(end)
            ways.append((end, end))
    return None
