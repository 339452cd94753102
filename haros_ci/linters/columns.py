# SPDX-License-Identifier: Apache-2.0
"""Columns as locations count them (code points from 1), made of what tools tell."""

from __future__ import annotations

import re
from functools import lru_cache

from haros_ci.model.location import Location
from haros_ci.regex import regex

_NEWLINE = regex("\r\n|\r|\n")


def from_bytes(line: str, offset: object) -> int | None:
    """The column of the byte *offset* (from 0) in the UTF-8 form of *line*; None if it is not in it."""
    if not isinstance(offset, int) or offset < 0:
        return None
    data = line.encode("utf-8", "surrogatepass")
    return len(data[:offset].decode("utf-8", "ignore")) + 1 if offset <= len(data) else None


def of_word(line: str, word: str, nth: int = 0) -> int | None:
    """The column of the *nth* (from 0) occurrence of *word* as a word of its own in *line*."""
    for count, match in enumerate(re.finditer(rf"(?<!\w){re.escape(word)}(?!\w)", line)):
        if count == nth:
            return match.start() + 1
    return None


def word_at(path: str, text: str, line: int, word: str, nth: int = 0) -> Location:
    """The place of a word of line *line*: that line alone if it is not found there."""
    column = of_word(line_of(text, line), word, nth)
    return Location(path, line) if column is None else Location(path, line, column, line, column + len(word))


def line_of(text: str, number: int) -> str:
    """Line *number* (from 1) of *text*; "" if there is none."""
    lines = _lines(text)
    return lines[number - 1] if 0 < number <= len(lines) else ""


@lru_cache(maxsize=8)
def _lines(text: str) -> list[str]:
    """Lines as Python's tokenizer has them: str.splitlines would also split at form feeds."""
    return _NEWLINE.split(text)
