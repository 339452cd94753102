# SPDX-License-Identifier: Apache-2.0
"""The frames of a configuration: who broadcasts where each is, where nodes are at odds about one, and the picture of the tree."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

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
    rows = sorted(
        every, key=lambda one: (one.topic, one.child, one.parent or "", str(one.node), one.at.path, one.at.line or 0)
    )
    rows = rows[:MOST]
    if not rows:
        return NONE
    frames = sorted({frame for one in rows for frame in ends(one) if frame is not None})
    index = {frame: number for number, frame in enumerate(frames)}
    pairs = [(index[parent], index[child]) for child, parent in map(ends, rows) if parent is not None]
    circles = in_circles({frame: [p for c, p in map(ends, rows) if c == frame and p is not None] for frame in frames})
    odd = odd_ones(rows)
    return pool.row(
        "transforms",
        (
            tuple(
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
            ),
            tuple((pool.text(name), pool.text(topic), int((topic, name) in circles)) for topic, name in frames),
            plain_picture(
                [(text_width(max(len(name) * BOLD, WORDS * SMALL) / CHARACTER), HEAD) for _, name in frames],
                tuple(dict.fromkeys(pairs)),
            ),
        ),
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
