# SPDX-License-Identifier: Apache-2.0
"""Places and text of syntax nodes: ast counts UTF-8 bytes of what it parsed, a Location code points of the file."""

from __future__ import annotations

import ast
from bisect import bisect_left
from collections.abc import Mapping

from haros_ci import syntax
from haros_ci.records import dataclass
from haros_ci.regex import regex

#: A changed piece of a line: (column in the parsed line, column in the file's, characters put in, characters taken
#: out); columns from 0.
Edit = tuple[int, int, int, int]

_SPACE = regex(r"(?:\\\n|\s)+")
_LONGEST_UNKNOWN = 200


@dataclass(frozen=True, slots=True)
class Source:
    """The lines of a file, and of the text that was parsed in its place where a repair changed them."""

    lines: tuple[str, ...]
    parsed: tuple[str, ...]
    edits: Mapping[int, list[Edit]]
    is_ascii: bool
    wide: dict[int, list[int]]  # line -> where, in bytes, one more byte than characters has gone by; grows on demand


def source_of(text: str, parsed: str, edits: Mapping[int, list[Edit]]) -> Source:
    """*edits* by line (from 1), ascending; neither text has another line end than ``\\n``."""
    lines = tuple(text.split("\n"))
    return Source(lines, lines if parsed is text else tuple(parsed.split("\n")), edits, parsed.isascii(), {})


def place(source: Source, node: ast.AST) -> tuple[int, int]:
    """Line and column of a node's first character, 1-based, in code points."""
    line: int = node.lineno  # type: ignore[attr-defined]  # statements and expressions have a line
    return line, column(source, line, node.col_offset) + 1  # type: ignore[attr-defined]  # the same


def column(source: Source, line: int, offset: int) -> int:
    """The column from 0 in the file of the byte at *offset* of the parsed line."""
    if not source.is_ascii:
        if line not in source.wide:
            source.wide[line] = _continuations(source.parsed[line - 1] if line <= len(source.parsed) else "")
        offset -= bisect_left(source.wide[line], offset)
    return _unedited(source.edits[line], offset) if line in source.edits else offset


def between(source: Source, first: ast.AST, last: ast.AST, limit: int | None = None) -> str:
    """The file's text from one node's start to another's end, at most *limit* characters."""
    line, start = place(source, first)
    end_line: int = min(last.end_lineno, len(source.lines))  # type: ignore[attr-defined]  # statements have an end
    end = column(source, end_line, last.end_col_offset)  # type: ignore[attr-defined]  # statements have an end
    if line >= end_line:
        return source.lines[end_line - 1][start - 1 : end if limit is None else min(end, start - 1 + limit)]
    pieces = [source.lines[line - 1][start - 1 :][:limit]]
    size = len(pieces[0])
    for number in range(line + 1, end_line + 1):
        if limit is not None and size > limit:
            break
        text = source.lines[number - 1]
        pieces.append((text[:end] if number == end_line else text)[:limit])
        size += len(text) + 1
    return "\n".join(pieces)[:limit]


def condition(source: Source, first: ast.AST, last: ast.AST) -> str:
    """The text of a condition as written, each run of white space a single space."""
    return _SPACE.sub(" ", between(source, first, last)).strip()


def unknown(source: Source, node: ast.AST) -> syntax.Expression:
    """Unknown text, for what the little language has no words for."""
    return syntax.Unknown(between(source, node, node, _LONGEST_UNKNOWN))


def _continuations(line: str) -> list[int]:
    return [] if line.isascii() else [i for i, byte in enumerate(line.encode("utf-8")) if byte & 0xC0 == 0x80]


def _unedited(edits: list[Edit], position: int) -> int:
    index = bisect_left(edits, (position,)) - 1
    if index < 0:
        return position
    parsed, start, added, removed = edits[index]
    if position < parsed + added:
        return start + min(position - parsed, removed)
    return position - parsed - added + start + removed
