# SPDX-License-Identifier: Apache-2.0
"""The picture of what packages need of each other to be built: from what is built first to what is built last."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import Any

from haros_ci.html_page.layout import BOLD, CHARACTER, SMALL, plain_picture, text_width

#: The most packages that are drawn, the least height of one in px, what the largest has more, and the characters of "123 findings, 12,345 lines".
MOST, HEIGHT, GROWTH, WORDS = 300, 38, 60, 26


def package_picture(
    needs: Mapping[str, Iterable[str]], circles: Mapping[str, int], lines: Mapping[str, int]
) -> dict[str, Any] | None:
    """Size, the rectangle of each package by name in order, and edges (needed, who needs it, points); None for none, or too many.

    The height of a package grows with the root of its *lines*. A need that follows from others is left out; within a circle all are drawn.
    """
    names = sorted(needs)
    if not names or len(names) > MOST:
        return None
    index = {name: number for number, name in enumerate(names)}
    most = max((lines.get(name, 0) for name in names), default=0) or 1
    sizes = [
        (
            text_width(max(len(name) * BOLD, WORDS * SMALL) / CHARACTER),
            HEIGHT + round(GROWTH * math.sqrt(lines.get(name, 0) / most)),
        )
        for name in names
    ]
    edges = [(index[other], index[name]) for name in names for other in direct(name, needs, circles)]
    drawn = plain_picture(sizes, edges)
    return None if drawn is None else dict(zip(("size", "places", "edges"), drawn, strict=True))


def direct(name: str, needs: Mapping[str, Iterable[str]], circles: Mapping[str, int]) -> list[str]:
    """What *name* needs and does not need already because of something else that it needs; all that is in its circle."""
    own = set(needs[name])
    kept = []
    for other in sorted(own):
        is_circle = name in circles and circles.get(other) == circles[name]
        ways = (item for item in own if item != other and circles.get(item, -1) != circles.get(other, -2))
        if is_circle or not any(other in reached(way, needs, name) for way in ways):
            kept.append(other)
    return kept


def reached(start: str, needs: Mapping[str, Iterable[str]], without: str) -> set[str]:
    """All that *start* needs, directly or not, on ways that do not lead through *without*."""
    found: set[str] = set()
    work = [start]
    while work:
        for need in needs.get(work.pop(), ()):
            if need not in found and need != without:
                found.add(need)
                work.append(need)
    return found
