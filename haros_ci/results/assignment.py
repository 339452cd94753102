# SPDX-License-Identifier: Apache-2.0
"""Pairing of equals by place, so that of several copies the nearest ones belong together."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Sequence

#: A line, and what orders equals on it.
Place = tuple[int, int]

_LARGEST_TABLE = 200_000  # cells


def assign(here: Sequence[Place], there: Sequence[Place], limit: int | None = None) -> list[tuple[int, int]]:
    """Pairs (position in *here*, position in *there*), one-to-one, at the least total line distance.

    As many pairs as the shorter side allows; with a *limit*, only pairs at most that many lines apart, nearest first.
    """
    if len(here) == 1 == len(there):
        return [(0, 0)] if limit is None or abs(here[0][0] - there[0][0]) <= limit else []
    rows = sorted(range(len(here)), key=lambda i: here[i])
    columns = sorted(range(len(there)), key=lambda i: there[i])
    lines, others = [here[i][0] for i in rows], [there[i][0] for i in columns]
    if limit is not None:
        found = _nearest_first(lines, others, limit)
    elif len(lines) <= len(others):
        found = _in_order(lines, others)
    else:
        found = [(b, a) for a, b in _in_order(others, lines)]
    return [(rows[a], columns[b]) for a, b in found]


def _nearest_first(lines: list[int], others: list[int], limit: int) -> list[tuple[int, int]]:
    choices: list[tuple[int, int, int]] = []
    for a, line in enumerate(lines):
        for b in range(bisect_left(others, line - limit), len(others)):
            if others[b] > line + limit or len(choices) >= _LARGEST_TABLE:
                break
            choices.append((abs(others[b] - line), a, b))
    used_a: set[int] = set()
    used_b: set[int] = set()
    found = []
    for _, a, b in sorted(choices):
        if a not in used_a and b not in used_b:
            used_a.add(a)
            used_b.add(b)
            found.append((a, b))
    return found


def _in_order(few: list[int], many: list[int]) -> list[tuple[int, int]]:
    """Both ascending: the cheapest pairing never crosses, so each of *few* chooses how many of *many* to leave out."""
    surplus = len(many) - len(few)
    if surplus == 0 or len(few) * (surplus + 1) > _LARGEST_TABLE:
        return [(i, i) for i in range(len(few))]
    cost = [0] * (surplus + 1)
    choices: list[list[int]] = []
    for i, line in enumerate(few):
        best = 0  # the number of skipped ones so far that is cheapest
        chosen = []
        for skipped in range(surplus + 1):
            if cost[skipped] < cost[best]:
                best = skipped
            chosen.append(best)
        cost = [cost[chosen[skipped]] + abs(many[i + skipped] - line) for skipped in range(surplus + 1)]
        choices.append(chosen)
    skipped = min(range(surplus + 1), key=lambda s: cost[s])
    found = []
    for i in range(len(few) - 1, -1, -1):
        found.append((i, i + skipped))
        skipped = choices[i][skipped]
    return found[::-1]
