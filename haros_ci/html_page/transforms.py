# SPDX-License-Identifier: Apache-2.0
"""The frames of a configuration: who broadcasts where each is, where nodes are at odds about one, and the picture of the tree."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from haros_ci.checking.transforms import Broadcast, at_odds, origin
from haros_ci.html_page.layout import BOLD, CHARACTER, HEAD, SMALL, plain_picture, text_width
from haros_ci.html_page.pool import NONE, Pool
from haros_ci.model.cycles import in_circles

#: The most transforms of a configuration that are shown, and characters of a frame's second line that make room.
MOST, WORDS = 1_000, 34

Frame = tuple[str, str]


def transforms(pool: Pool, every: Iterable[Broadcast]) -> int:
    """The index of a configuration's transforms, ``NONE`` for none.

    They are: the transforms (child and parent as indexes of frames, parent ``NONE`` where it is not known; static, whether it is at odds with
    another, origin, node, place, what is said of it), the frames (name, topic of tf, whether it is in a circle) and their picture.
    """
    rows = sorted(every, key=_place)[:MOST]
    if not rows:
        return NONE
    joined = [ends(one) for one in rows]
    frames = sorted({frame for pair in joined for frame in pair if frame is not None})
    index = {frame: number for number, frame in enumerate(frames)}
    pairs = {(index[parent], index[child]): None for child, parent in joined if parent is not None}
    hung: dict[Frame, list[Frame]] = {frame: [] for frame in frames}
    for parent, child in pairs:
        hung[frames[child]].append(frames[parent])
    circles = in_circles(hung)
    sizes = [(text_width(max(len(name) * BOLD, WORDS * SMALL) / CHARACTER), HEAD) for _, name in frames]
    return pool.row(
        "transforms",
        (
            _rows(pool, rows, index),
            tuple((pool.text(name), pool.text(topic), int((topic, name) in circles)) for topic, name in frames),
            plain_picture(sizes, tuple(pairs)),
        ),
    )


def _place(one: Broadcast) -> tuple[str, str, str, str, str, int]:
    return one.topic, one.child, one.parent or "", str(one.node), one.at.path, one.at.line or 0


def _rows(pool: Pool, rows: Sequence[Broadcast], index: Mapping[Frame, int]) -> tuple[tuple[Any, ...], ...]:
    odd = odd_ones(rows)
    return tuple(
        (
            index[child],
            NONE if parent is None else index[parent],
            int(one.is_static),
            int(number in odd),
            origin(one),
            pool.text(one.node.name),
            pool.place(one.at),
            pool.text(one.what),
        )
        for number, one in enumerate(rows)
        for child, parent in (ends(one),)
    )


def ends(one: Broadcast) -> tuple[Frame, Frame | None]:
    """Child and parent with the topic that says so: trees of two topics of tf are two."""
    return (one.topic, one.child), None if not one.parent else (one.topic, one.parent)


def odd_ones(rows: Sequence[Broadcast]) -> set[int]:
    """The transforms that say something else than another of the same frame."""
    by_child: dict[Frame, list[int]] = {}
    for number, one in enumerate(rows):
        by_child.setdefault(ends(one)[0], []).append(number)
    found: set[int] = set()
    for numbers in by_child.values():
        for at, number in enumerate(numbers[:30]):
            for other in numbers[at + 1 : 30]:
                if at_odds(rows[number], rows[other]):
                    found |= {number, other}
    return found
