# SPDX-License-Identifier: Apache-2.0
"""Conflict markers that a merge has left in a text (git-merge(1), HOW CONFLICTS ARE PRESENTED)."""

from __future__ import annotations

#: The markers in their order; git writes seven signs, and a name after the first and the last.
CONFLICT_BEGINS, _BETWEEN, CONFLICT_ENDS = "<<<<<<< ", "=======", ">>>>>>> "


def conflicts(text: str, opening: str = "", closing: str = "") -> list[int]:
    """The lines of *text* in which conflicts begin, those in comments between *opening* and *closing* left out; takes linear time."""
    found: list[int] = []
    begun, is_half, is_comment = 0, False, False
    for number, line in enumerate(text.split("\n"), 1):
        if line.startswith(CONFLICT_BEGINS) and not is_comment:
            begun, is_half = number, False
        elif begun and line.rstrip() == _BETWEEN:
            is_half = True
        elif begun and is_half and line.startswith(CONFLICT_ENDS):
            found.append(begun)
            begun, is_half = 0, False
        if opening and not begun:
            is_comment = _is_open(line, opening, closing, is_comment)
    return found


def _is_open(line: str, opening: str, closing: str, is_open: bool) -> bool:
    """Whether a comment is open after *line*."""
    start, end = line.rfind(opening), line.rfind(closing)
    return is_open if start == end else start > end
