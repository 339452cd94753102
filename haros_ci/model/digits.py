# SPDX-License-Identifier: Apache-2.0
"""Numbers in texts that strangers write."""

from __future__ import annotations


def whole_number(text: str, *, digits: int = 9) -> int | None:
    """*text* as a number if it is one to *digits* ASCII digits, else None.

    ``str.isdigit`` is no such test: it holds for ``²`` too, of which ``int`` makes a ValueError, as of more than 4300 digits.
    """
    return int(text) if len(text) <= digits and text.isascii() and text.isdigit() else None
