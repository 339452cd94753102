# SPDX-License-Identifier: Apache-2.0
"""Brackets that belong together in the text of a C++ file without comments."""

from __future__ import annotations

OPENING, CLOSING = "([{", ")]}"


def opening_of(text: str, closing: int) -> int:
    """The index of the bracket that the one at *closing* ends; -1 if it is not there."""
    depth = 0
    for at in range(closing, -1, -1):
        depth += (text[at] in CLOSING) - (text[at] in OPENING)
        if depth == 0:
            return at
    return -1


def closing_of(text: str, opening: int, most: int) -> int:
    """The index of the bracket that ends the one at *opening*; -1 if it is not among the *most* characters from there on."""
    depth = 0
    for at in range(opening, min(opening + most, len(text))):
        depth += (text[at] in OPENING) - (text[at] in CLOSING)
        if depth == 0:
            return at
    return -1
