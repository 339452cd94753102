# SPDX-License-Identifier: Apache-2.0
"""How many classes of Python stand one above another: pylint takes twice as long with every one of them."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

from haros_ci.model.cycles import components

#: Classes one above another beyond which no class is looked at. For one call pylint takes a second with 12 of them, three with 14 and twelve with 16;
#: those that a library adds above count, too, and are not seen here. Of 188 repositories none has more.
MOST_HEIGHT = 10


class Derived(NamedTuple):
    """A class, by the last words of its name and of the names of its bases; also ``B = A``, where *is_class* is not set."""

    name: str
    bases: tuple[str, ...]
    is_class: bool = True


def too_high(classes: Iterable[Derived]) -> frozenset[str]:
    """The names of *classes* at the end of a line of more than MOST_HEIGHT classes, each a base of the next.

    Classes whose names lead to each other (``class Node(base.Node)``) are taken to stand one above another. Time in proportion to *classes*.
    """
    several: dict[str, list[Derived]] = {}
    for one in classes:
        several.setdefault(one.name, []).append(one)
    graph = {name: [base for one in ones for base in one.bases if base in several] for name, ones in several.items()}
    heights: dict[str, int] = {}
    for group in components(graph):
        below = max((heights.get(base, 0) for name in group for base in graph[name]), default=0)
        ones = [one for name in group for one in several[name] if one.is_class]
        lowest = [one for one in ones if group.isdisjoint(one.bases)]
        heights.update(dict.fromkeys(group, below + len(ones) - len(lowest) + bool(lowest)))
    return frozenset(name for name, height in heights.items() if height > MOST_HEIGHT)
