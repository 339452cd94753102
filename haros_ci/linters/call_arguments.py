# SPDX-License-Identifier: Apache-2.0
"""The arguments of a call in C and C++."""

from __future__ import annotations

from haros_ci.regex import regex

_TOKEN = regex(r"\"(?:[^\"\\\n]|\\.)*\"|'(?:[^'\\\n]|\\.){1,8}'|[()\[\]{},;]")
#: Characters of a call that are looked at.
_LONGEST = 4_000


def arguments(text: str, opening: int) -> list[str]:
    """The arguments of the call whose bracket stands at *opening*, as they are written; none where it does not end."""
    depth, start, found = 0, opening + 1, list[str]()
    for token in _TOKEN.finditer(text, opening, opening + _LONGEST):
        mark = token[0]
        if depth == 1 and mark in ";]}":
            return []
        if mark in "([{":
            depth += 1
        elif mark in ")]}":
            depth -= 1
            if depth == 0:
                last = text[start : token.start()]
                return [*found, last] if found or last.strip() else []
        elif mark == "," and depth == 1:
            found.append(text[start : token.start()])
            start = token.end()
    return []
