# SPDX-License-Identifier: Apache-2.0
"""Logical lines of Python 2 or 3 text, from a scan that needs no valid syntax."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.records import dataclass
from haros_ci.regex import regex

_TOKEN = regex(
    r"""(?P<space>[ \t\f]+|\\\n)|(?P<comment>\#[^\n]*)|(?P<newline>\n)
    |(?P<string>(?:[uUbBfF]?[rR]?|[rR][bBfF])(?:
        "\""[^"\\]*(?:(?:\\[\s\S]?|"(?!""))[^"\\]*)*(?:"\""|\Z)
        |'''[^'\\]*(?:(?:\\[\s\S]?|'(?!''))[^'\\]*)*(?:'''|\Z)
        |"[^"\\\n]*(?:\\[\s\S]?[^"\\\n]*)*"?|'[^'\\\n]*(?:\\[\s\S]?[^'\\\n]*)*'?))
    |(?P<name>[^\W\d]\w*)|(?P<number>\.?\d(?:(?<=[eE])[+-](?=\d)|[\w.])*)
    |(?P<op><>|>>=?|<<=?|\*\*=?|//=?|[-+*/%&|^=!<>]=|[\s\S])""",
    re.VERBOSE,
)
OPENING, CLOSING = frozenset("([{"), frozenset(")]}")
_CHAINED = frozenset(("string", "name", "number", "newline"))


@dataclass(frozen=True, slots=True)
class Token:
    """A token that is neither space nor comment; *depth* counts the brackets around it (its own not)."""

    kind: str
    text: str
    start: int
    end: int
    depth: int


def logical_lines(text: str) -> Iterator[list[Token]]:
    """Tokens of one logical line after the other, without the line ends."""
    line: list[Token] = []
    depth = 0
    for found in _TOKEN.finditer(text):
        kind = found.lastgroup or "op"
        if kind in ("space", "comment"):
            continue
        if kind == "newline":
            if depth == 0 and line:
                yield line
                line = []
            continue
        piece = found[0]
        if piece in CLOSING:
            depth = max(0, depth - 1)
        line.append(Token(kind, piece, found.start(), found.end(), depth))
        if piece in OPENING:
            depth += 1
    if line:
        yield line


def longest_chain(text: str) -> int:
    """The most operators, dots and brackets in one expression between two commas: how deep its tree can get.

    Python before 3.11 overflows the C stack on very deep trees, so this is counted before they are built.
    """
    longest = 0
    for line in logical_lines(text):
        counts: list[int] = [0]
        for token in line:
            if token.kind in _CHAINED:
                continue
            if token.text in (",", ";"):
                counts[-1] = 0
            elif token.text in CLOSING:
                if len(counts) > 1:
                    counts.pop()
            else:
                counts[-1] += 1
                longest = max(longest, counts[-1])
                if token.text in OPENING:
                    counts.append(0)
    return longest
