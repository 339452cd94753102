# SPDX-License-Identifier: Apache-2.0
"""From the lines of a file to those of its later version."""

from __future__ import annotations

from bisect import bisect_right
from collections import Counter
from collections.abc import Callable
from itertools import pairwise

from haros_ci.regex import regex
from haros_ci.results.comments import lines_of

_WORD = regex(r"\w+")
_SPACE = regex(r"\s+")
_LARGEST_TABLE = 40_000  # cells; a gap without unique lines beyond that is matched at its ends only
_LARGEST_HUNK = 2_500  # cells; a larger hunk of edited lines maps by position
_LEAST_SIMILARITY = 0.4
_DEEPEST = 12


def line_mapper(old: str, new: str) -> Callable[[int], int | None]:
    """Where a 1-based line of *old* stands in *new*; None if it was deleted or *old* does not have it.

    White space does not count, so re-indented lines and other line ends map. A line that was edited maps to the most
    similar one among the lines that took its place; if none is similar, it was deleted.
    """
    before, after = lines_of(old), lines_of(new)
    kept = _kept([_SPACE.sub("", line) for line in before], [_SPACE.sub("", line) for line in after])
    starts = [pair[0] for pair in kept]
    edited: dict[int, dict[int, int]] = {}

    def mapped(line: int) -> int | None:
        index = line - 1
        if not 0 <= index < len(before):
            return None
        at = bisect_right(starts, index) - 1
        above = kept[at] if at >= 0 else (-1, -1)
        if above[0] == index:
            return above[1] + 1
        if at not in edited:
            below = kept[at + 1] if at + 1 < len(kept) else (len(before), len(after))
            edited[at] = _edited(before, after, above[0] + 1, below[0], above[1] + 1, below[1])
        place = edited[at].get(index)
        return None if place is None else place + 1

    return mapped


def words(line: str) -> Counter[str]:
    """The names and numbers in a line, to tell how much two lines have in common."""
    return Counter(_WORD.findall(line))


def _edited(before: list[str], after: list[str], low: int, high: int, new_low: int, new_high: int) -> dict[int, int]:
    """The pairing, in order, of lines that gave way and lines that took their place, with the greatest similarity."""
    width = new_high - new_low
    if width == 0 or (high - low) * width > _LARGEST_HUNK:
        return {index: new_low + index - low for index in range(low, min(high, low + width))}
    olds = [words(line) for line in before[low:high]]
    news = [words(line) for line in after[new_low:new_high]]
    similarities = [[_similarity(old, new) for new in news] for old in olds]
    table = [[0.0] * (width + 1)]
    for row in reversed(similarities):
        below, best = table[-1], [0.0] * (width + 1)
        for column in range(width - 1, -1, -1):
            best[column] = max(below[column], best[column + 1], row[column] + below[column + 1] if row[column] else 0.0)
        table.append(best)
    table.reverse()
    places: dict[int, int] = {}
    number = column = 0
    while number < len(olds) and column < width:
        value = similarities[number][column]
        if value and table[number][column] == value + table[number + 1][column + 1]:
            places[low + number] = new_low + column
            number, column = number + 1, column + 1
        elif table[number][column] == table[number + 1][column]:
            number += 1
        else:
            column += 1
    return places


def _similarity(old: Counter[str], new: Counter[str]) -> float:
    """Words in common per word, 0 where that is too little."""
    total = old.total() + new.total()
    share = 2 * sum((old & new).values()) / total if total else 0.0
    return share if share >= _LEAST_SIMILARITY else 0.0


def _kept(before: list[str], after: list[str]) -> list[tuple[int, int]]:
    """Pairs of indexes of equal lines, ascending on both sides (patience: unique lines first, then the gaps)."""
    pairs: list[tuple[int, int]] = []
    gaps = [(0, len(before), 0, len(after), 0)]
    while gaps:
        low, high, new_low, new_high, depth = gaps.pop()
        while low < high and new_low < new_high and before[low] == after[new_low]:
            pairs.append((low, new_low))
            low, new_low = low + 1, new_low + 1
        while low < high and new_low < new_high and before[high - 1] == after[new_high - 1]:
            high, new_high = high - 1, new_high - 1
            pairs.append((high, new_high))
        if low == high or new_low == new_high:
            continue
        anchors = _anchors(before, after, low, high, new_low, new_high) if depth < _DEEPEST else []
        if anchors:
            edges = [(low - 1, new_low - 1), *anchors, (high, new_high)]
            pairs.extend(anchors)
            for (a, b), (c, d) in pairwise(edges):
                if c - a > 1 and d - b > 1:
                    gaps.append((a + 1, c, b + 1, d, depth + 1))
        elif (high - low) * (new_high - new_low) <= _LARGEST_TABLE:
            pairs.extend(_longest_common(before, after, low, high, new_low, new_high))
    return sorted(pairs)


def _anchors(
    before: list[str], after: list[str], low: int, high: int, new_low: int, new_high: int
) -> list[tuple[int, int]]:
    """Lines that occur once on each side of a gap, the longest ascending series of them."""
    here, there = _unique(before, low, high), _unique(after, new_low, new_high)
    places = [(index, there[line]) for line, index in here.items() if line in there]
    places.sort()
    tails: list[int] = []  # of series by length: the smallest last index in the new text
    ends: list[int] = []  # which place that is
    previous: list[int] = []
    for number, (_, place) in enumerate(places):
        length = bisect_right(tails, place)
        previous.append(ends[length - 1] if length else -1)
        tails[length : length + 1] = [place]
        ends[length : length + 1] = [number]
    series: list[tuple[int, int]] = []
    number = ends[-1] if ends else -1
    while number >= 0:
        series.append(places[number])
        number = previous[number]
    return series[::-1]


def _unique(lines: list[str], low: int, high: int) -> dict[str, int]:
    found: dict[str, int] = {}
    for index in range(low, high):
        found[lines[index]] = -1 if lines[index] in found else index
    return {line: index for line, index in found.items() if index >= 0 and line}


def _longest_common(
    before: list[str], after: list[str], low: int, high: int, new_low: int, new_high: int
) -> list[tuple[int, int]]:
    """The longest common subsequence of a small gap, the earliest where several are as long."""
    width = new_high - new_low
    table = [[0] * (width + 1)]
    for index in range(high - 1, low - 1, -1):
        row = [0] * (width + 1)
        below = table[-1]
        for column in range(width - 1, -1, -1):
            same = before[index] == after[new_low + column]
            row[column] = below[column + 1] + 1 if same else max(below[column], row[column + 1])
        table.append(row)
    table.reverse()
    pairs: list[tuple[int, int]] = []
    row_number = column = 0
    while row_number < high - low and column < width:
        if before[low + row_number] == after[new_low + column]:
            pairs.append((low + row_number, new_low + column))
            row_number, column = row_number + 1, column + 1
        elif table[row_number + 1][column] >= table[row_number][column + 1]:
            row_number += 1
        else:
            column += 1
    return pairs
