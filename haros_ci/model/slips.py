# SPDX-License-Identifier: Apache-2.0
"""Whether a word is a known one but for a slip of the hand."""

from __future__ import annotations

from collections.abc import Iterable

#: Letters left out, put in, exchanged or swapped in a word; in one of at most SHORT letters half of them.
SLIPS = 2
SHORT = 8
LONGEST = 100  # characters of a word that is looked at
#: So much less alike than the nearest one a word is that is as near for a reader.
NEAR = 0.02
#: So many equally near words are found: one more than a message names.
_MOST = 4


def nearly(word: str, known: Iterable[str]) -> str | None:
    """The known word that *word* is but for a slip or two."""
    from difflib import get_close_matches

    if len(word) > LONGEST:
        return None
    found = get_close_matches(word, sorted(known), n=1, cutoff=0.75)
    allowed = SLIPS if len(word) > SHORT else SLIPS // 2
    return found[0] if found and slips(word, found[0]) <= allowed else None


def equally_near(word: str, known: Iterable[str], cutoff: float = 0.75) -> tuple[str, ...]:
    """The known words that *word* may be meant for, of which none is nearer than another: at most four, the nearest first; empty where none is alike."""
    from difflib import SequenceMatcher, get_close_matches

    found = get_close_matches(word, list(known), _MOST, cutoff)
    matcher = SequenceMatcher(None, "", word)
    ratios = []
    for other in found:
        matcher.set_seq1(other)
        ratios.append(matcher.ratio())
    return tuple(other for other, ratio in zip(found, ratios, strict=True) if ratio > ratios[0] - NEAR)


def slips(one: str, other: str) -> int:
    """How many letters were left out, put in, exchanged or swapped with their neighbour between two words."""
    before, row = [0] * (len(other) + 1), list(range(len(other) + 1))
    for i, letter in enumerate(one, start=1):
        above, before, row = before, row, [i]
        for j, expected in enumerate(other, start=1):
            cost = min(before[j] + 1, row[j - 1] + 1, before[j - 1] + (letter != expected))
            if i > 1 and j > 1 and letter == other[j - 2] and one[i - 2] == expected:
                cost = min(cost, above[j - 2] + 1)
            row.append(cost)
    return row[-1]
