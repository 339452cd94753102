# SPDX-License-Identifier: Apache-2.0
"""Source text whose comments and texts are blanks: every other character stays at its place."""

from __future__ import annotations

import re

from haros_ci.regex import regex
from haros_ci.results.comments import C_SKIPPED, PYTHON_SKIPPED

_CPP = regex(rf"""["'/](?:{C_SKIPPED})""")
_PYTHON = regex(rf"""["'#](?:{PYTHON_SKIPPED})""")
_VISIBLE = regex(r"[^\n]")


def blanked(text: str, language: str) -> str:
    """*text* with a blank for each character of a comment or a text, but for the quotes around the latter."""
    return (_PYTHON if language == "python" else _CPP).sub(_blank, text)


def uncommented(text: str, language: str) -> str:
    """*text* with a blank for each character of a comment; texts stay."""
    return (_PYTHON if language == "python" else _CPP).sub(_blank_comment, text)


def _blank_comment(match: re.Match[str]) -> str:
    return match[0] if match[0][0] in "\"'" else _VISIBLE.sub(" ", match[0])


def _blank(match: re.Match[str]) -> str:
    found = match[0]
    if found[0] not in "\"'":
        return _VISIBLE.sub(" ", found)
    end = found[0] if len(found) > 1 and found[-1] == found[0] else ""
    return found[0] + _VISIBLE.sub(" ", found[1 : len(found) - len(end)]) + end


def closed(text: str, start: int, most: int) -> int:
    """Where the bracket at *start* of blanked text is closed, or the last of *most* characters, if it is not within these."""
    depth = 0
    end = min(len(text), start + most)
    for found in _BRACKET.finditer(text, start, end):
        depth += 1 if found[0] in "([{" else -1
        if depth <= 0:
            return found.start()
    return end - 1


def closings(text: str) -> dict[int, int]:
    """Where each bracket of blanked text is closed, by where it opens; without those that are not closed."""
    found: dict[int, int] = {}
    waiting: list[int] = []
    for bracket in _BRACKET.finditer(text):
        if bracket[0] in "([{":
            waiting.append(bracket.start())
        elif waiting:
            found[waiting.pop()] = bracket.start()
    return found


_BRACKET = regex(r"[()\[\]{}]")
