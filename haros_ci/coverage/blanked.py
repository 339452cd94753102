# SPDX-License-Identifier: Apache-2.0
"""Source text whose comments and texts are blanks: every other character stays at its place."""

from __future__ import annotations

import re

_CPP = re.compile(
    r"//(?:[^\\\n]|\\.)*|/\*.*?(?:\*/|\Z)"
    r"|\bu?8?[LUR]{0,2}R\"(?P<end>[^\s()\\\"]{0,16})\(.*?(?:\)(?P=end)\"|\Z)"
    r"|\"(?:[^\"\\\n]|\\.)*(?:\"|$)|(?<![0-9a-zA-Z_])'(?:[^'\\\n]|\\.)*(?:'|$)",
    re.DOTALL | re.MULTILINE,
)
_PYTHON = re.compile(
    r"#[^\n]*|\"\"\"(?:[^\\]|\\.)*?(?:\"\"\"|\Z)|'''(?:[^\\]|\\.)*?(?:'''|\Z)"
    r"|\"(?:[^\"\\\n]|\\.)*(?:\"|$)|'(?:[^'\\\n]|\\.)*(?:'|$)",
    re.DOTALL | re.MULTILINE,
)
_VISIBLE = re.compile(r"[^\n]")


def blanked(text: str, language: str) -> str:
    """*text* with a blank for each character of a comment; of a text in quotes the quotes stay."""
    return (_PYTHON if language == "python" else _CPP).sub(_blank, text)


def _blank(match: re.Match[str]) -> str:
    found = match[0]
    if found[:1] in "\"'" and len(found) > 1:
        return found[0] + _VISIBLE.sub(" ", found[1:-1]) + (found[-1] if found[-1] != "\n" else "\n")
    return _VISIBLE.sub(" ", found)


def closed(text: str, start: int, most: int = 20_000) -> int:
    """Where the bracket at *start* of blanked text is closed, or the last place that is looked at."""
    depth = 0
    end = min(len(text), start + most)
    for found in _BRACKET.finditer(text, start, end):
        depth += 1 if found[0] in "([{" else -1
        if depth <= 0:
            return found.start()
    return end - 1


_BRACKET = re.compile(r"[()\[\]{}]")
