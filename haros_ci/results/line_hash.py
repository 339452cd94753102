# SPDX-License-Identifier: Apache-2.0
"""GitHub's ``primaryLocationLineHash``, computed exactly as its upload action does."""

from __future__ import annotations

import re
from collections.abc import Collection
from operator import mul

_WINDOW = 100
_MASK = (1 << 64) - 1
_POWERS = tuple(pow(37, _WINDOW - 1 - i, 1 << 64) for i in range(_WINDOW))


def github_line_hashes(text: str, lines: Collection[int]) -> dict[int, str]:
    """``hex:k`` for each of *lines* (1-based) that *text* has.

    Source: codeql-action, fingerprints.ts. Over UTF-16 code units with blanks dropped and line ends made LF, the
    hash of a line is the sum of unit_i · 37^(99-i) modulo 2^64 over the 100 units from its first one, where one
    unit 65535 and zeros follow the text; k counts equal hashes from the top. A byte-order mark, if *text* has one,
    counts as a unit, as it does there.
    """
    if not lines:
        return {}
    units = text.replace("\r\n", "\n").replace("\r", "\n").replace(" ", "").replace("\t", "")
    if units and max(units) > "\uffff":
        units = re.sub("[\U00010000-\U0010ffff]", _surrogates, units)
    rows = units.split("\n")
    units += "\uffff" + "\0" * _WINDOW
    requested, last = frozenset(lines), max(lines)
    counts: dict[str, int] = {}
    hashes: dict[int, str] = {}
    start = 0
    for number, row in enumerate(rows, 1):
        window = units[start : start + _WINDOW]
        counts[window] = counts.get(window, 0) + 1
        if number in requested:
            hashes[number] = f"{_polynomial(window):x}:{counts[window]}"
        if number >= last:
            break
        start += len(row) + 1
    return hashes


def _polynomial(window: str) -> int:
    total: int = sum(map(mul, map(ord, window), _POWERS))
    return total & _MASK


def _surrogates(match: re.Match[str]) -> str:
    code = ord(match[0]) - 0x10000
    return chr(0xD800 + (code >> 10)) + chr(0xDC00 + (code & 0x3FF))
