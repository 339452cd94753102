# SPDX-License-Identifier: Apache-2.0
"""The words of a query (pyflwor-ext 1.2, ``lexer.py``)."""

from __future__ import annotations

import re

from haros_ci.query.fault import QueryError, short
from haros_ci.records import dataclass
from haros_ci.regex import regex

#: Longer ones are refused; the longest of HAROS's published queries has 700 characters.
LONGEST_QUERY = 20_000

#: Reserved words; after ``.`` and ``/`` they are names.
WORDS = frozenset(
    "some every in not satisfies and or subset superset proper is for let return where order by ascd desc"
    " function if then else flatten collect as with".split()
)

_TOKEN = regex(
    r"""(?P<space>[ \t\r\n\f\v\ufeff]+|//[^\n]*|/\*.*?\*/)
    |(?P<number>0[xX][0-9a-fA-F]+|[0-9]*\.[0-9]+(?:[Ee][+-]?[0-9]+)?|[0-9]+[Ee][+-]?[0-9]+|[0-9]+)
    |(?P<name>[A-Za-z_][A-Za-z_0-9]*)
    |(?P<text>"[^"]*"|'[^']*')
    |(?P<sign>==|!=|<=|>=|/(?!\*)|[-=<>.*+,:|()\[\]{}&])""",
    re.DOTALL | re.VERBOSE,
)


@dataclass(frozen=True, slots=True)
class QueryToken:
    """One word: *kind* is ``number``, ``name``, ``text``, ``end``, or the sign or reserved word itself."""

    kind: str
    text: str
    at: int
    value: int | float | str | None = None


def tokens(query: str) -> tuple[QueryToken, ...]:
    """The words of *query*, without comments, ``end`` as the last one; QueryError at a character that begins no token."""
    if len(query) > LONGEST_QUERY:
        raise QueryError(f"the query has more than {LONGEST_QUERY} characters", 0, "take it apart")
    found, at = [], 0
    while at < len(query):
        match = _TOKEN.match(query, at)
        if match is None:
            raise _stray(query, at)
        kind, text = str(match.lastgroup), match.group()
        if kind == "number":
            found.append(QueryToken("number", text, at, _number(text, at)))
        elif kind == "name":
            found.append(QueryToken(text if text in WORDS else "name", text, at, text))
        elif kind == "text":
            found.append(QueryToken("text", text, at, text[1:-1]))
        elif kind == "sign":
            found.append(QueryToken(text, text, at))
        at = match.end()
    return (*found, QueryToken("end", "", len(query)))


def _stray(query: str, at: int) -> QueryError:
    sign = query[at]
    if sign in "'\"":
        return QueryError("the text that begins here has no end", at, f"close it with {sign}")
    if query.startswith("/*", at):
        return QueryError("the comment that begins here has no end", at, "close it with */")
    return QueryError(f"{short(sign)!r} is no sign of the language", at)


def _number(text: str, at: int) -> int | float:
    if text[:2] in ("0x", "0X"):
        return int(text, 16)
    if text.isdigit():
        if len(text) > 1000:
            raise QueryError("the number has more than 1000 digits", at)
        if len(text) > 1 and text[0] == "0":
            if set(text) & set("89"):
                raise QueryError(f"{short(text)} begins with 0, which makes it octal, and has an 8 or 9", at)
            return int(text, 8)
        return int(text)
    return float(text)
