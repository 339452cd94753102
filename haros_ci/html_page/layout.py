# SPDX-License-Identifier: Apache-2.0
"""Where the elements of a picture are, from left to right as data flows, by graphlay (decision 0026)."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

from haros_ci.html_page.elements import Drawn, Elements
from haros_ci.records import dataclass, field

#: Sizes in px: a character, a bold and a small one, a line of what only one node has, a node's head, a channel, and how wide elements are.
CHARACTER, BOLD, SMALL, LINE, HEAD, CHANNEL = 6.6, 7.6, 6.0, 15, 38, 24
NARROWEST, WIDEST = 96, 250
#: Lines of what only one node has; of more it is said how many.
MOST_LINES = 7
GAP = 14
OPTIONS: Mapping[str, Any] = {
    "direction": "leftright",
    "routing": {"style": "diagonal"},
    "spacing": {
        "layer_gap": 56.0,
        "node_gap": 14.0,
        "dummy_gap": 7.0,
        "port_gap": 6.0,
        "compound_padding": 14.0,
        "compound_header": 20.0,
        "isolated_gap": 16.0,
        "isolated_max_columns": 6,
    },
}

Rectangle = tuple[int, int, int, int]


@dataclass(slots=True)
class Layout:
    """Rectangles (x, y, width, height in px, from the left upper corner) of nodes, channels and boxes, and of each edge the points.

    *edges* are pairs of a node and a channel by their index, with whether the arrow goes from the node, and the points as x, y, x, y …;
    () where it is drawn straight.
    """

    size: tuple[int, int] = (0, 0)
    nodes: list[Rectangle] = field(default_factory=list)
    channels: list[Rectangle] = field(default_factory=list)
    boxes: list[Rectangle] = field(default_factory=list)
    edges: list[tuple[int, int, bool, tuple[int, ...]]] = field(default_factory=list)


def laid_out(made: Elements) -> Layout | None:
    """Where everything is; None for what is too large to be drawn, or what the library refuses.

    What is behind a switch has no say in it: it stands in rows below.
    """
    import graphlay

    if made.is_too_large:
        return None
    shown = [number for number, channel in enumerate(made.channels) if not channel.switch]
    graph = graphlay.Graph()
    for number, box in enumerate(made.boxes):
        graph.node(("box", number), width=10, height=10, label="", **_parent(graph, box.parent))
    for number in range(len(made.nodes)):
        width, height = node_size(made, number)
        graph.node(("node", number), width=width, height=height, label="", **_parent(graph, made.box_of[number]))
    for number in shown:
        drawn = made.channels[number]
        graph.node(
            ("channel", number), width=channel_width(drawn), height=CHANNEL, label="", **_parent(graph, drawn.box)
        )
    ends = [(number, node, gives) for number in shown for node, gives in made.channels[number].ends]
    for number, node, gives in ends:
        pair = ("node", node), ("channel", number)
        graph.edge(*(pair if gives else pair[::-1]))
    try:
        found = graphlay.layout(graph, preset="layered", options=OPTIONS)
    except graphlay.GraphlayError:
        return None
    return _placed(made, found, ends, dict(zip(graph.ids, found.nodes, strict=True)))


def _placed(made: Elements, found: Any, ends: list[tuple[int, int, bool]], placed: Mapping[Any, Any]) -> Layout:
    least = found.bounds["min"]
    left, top = float(least["x"]) - GAP, float(least["y"]) - GAP

    def rectangle(key: tuple[str, int]) -> Rectangle:
        centre, size = placed[key]["center"], placed[key]["size"]
        width, height = float(size["width"]), float(size["height"])
        return (
            round(centre["x"] - width / 2 - left),
            round(centre["y"] - height / 2 - top),
            round(width),
            round(height),
        )

    layout = Layout()
    layout.nodes = [rectangle(("node", number)) for number in range(len(made.nodes))]
    layout.boxes = [rectangle(("box", number)) for number in range(len(made.boxes))]
    most = found.bounds["max"]
    right, bottom = round(most["x"] - left) + GAP, round(most["y"] - top) + GAP
    below = _rows([channel for channel in made.channels if channel.switch], right, bottom + GAP)
    layout.channels = [
        next(below) if channel.switch else rectangle(("channel", number))
        for number, channel in enumerate(made.channels)
    ]
    for (number, node, gives), edge in zip(ends, found.edges, strict=True):
        points = [round(value) for point in edge["points"] for value in (point["x"] - left, point["y"] - top)]
        layout.edges.append((node, number, gives, tuple(points)))
    layout.edges += [
        (node, number, gives, ())
        for number, channel in enumerate(made.channels)
        if channel.switch
        for node, gives in channel.ends
    ]
    layout.size = _size(layout, right, bottom)
    return layout


def _size(layout: Layout, right: int, bottom: int) -> tuple[int, int]:
    """Width and height of all that there is, at least so far to the right and the bottom."""
    corners = [(one[0] + one[2], one[1] + one[3]) for one in (*layout.channels, *layout.nodes, *layout.boxes)]
    return max([right, *(x for x, _ in corners)]) + GAP, max([bottom, *(y for _, y in corners)]) + GAP


def _rows(channels: Iterable[Drawn], right: int, top: int) -> Iterator[Rectangle]:
    """Places for *channels* side by side, in as many rows as it takes."""
    x, y = GAP, top
    for drawn in channels:
        width = channel_width(drawn)
        if x > GAP and x + width > max(right, 900):
            x, y = GAP, y + CHANNEL + GAP
        yield x, y, width, CHANNEL
        x += width + GAP


def _parent(graph: Any, box: int) -> dict[str, Any]:
    """The index of a box in *graph*; boxes come first, and those around others before them."""
    return {} if box == -1 else {"parent": box}


def node_size(made: Elements, number: int) -> tuple[int, int]:
    """Width and height in px of a node with the lines of what only it has."""
    own = made.own[number]
    lines = min(len(own), MOST_LINES) + (len(own) > MOST_LINES)
    node = made.nodes[number]
    name = len(node.name.rpartition("/")[2]) * BOLD
    small = [f"{node.package}/{node.type}", *(f"→ {item.name}" for item in own[:MOST_LINES])]
    return text_width(max(name, max(map(len, small)) * SMALL) / CHARACTER), HEAD + lines * LINE + (4 if lines else 0)


def channel_width(drawn: Drawn) -> int:
    """The width in px of a channel."""
    return text_width(len(drawn.channel.name)) + 12


def text_width(characters: float) -> int:
    """How wide an element with so many *characters* is, in px."""
    return round(min(max(characters * CHARACTER + 20, NARROWEST), WIDEST))


#: The size, the rectangles of elements, and edges (from, to, points as x, y, x, y …).
Plain = tuple[tuple[int, int], tuple[Rectangle, ...], tuple[tuple[int, int, tuple[int, ...]], ...]]


def plain_picture(sizes: Sequence[tuple[int, int]], edges: Sequence[tuple[int, int]]) -> Plain | None:
    """The picture of elements of these *sizes* and the *edges* between them by index; None if the library refuses it."""
    import graphlay

    graph = graphlay.Graph()
    # What stands alone is in about as many columns as rows: in six of them a hundred would make the rest small.
    alone = len(sizes) - len({end for edge in edges for end in edge})
    columns = max(OPTIONS["spacing"]["isolated_max_columns"], round(1.2 * math.sqrt(alone)))
    options = {**OPTIONS, "spacing": {**OPTIONS["spacing"], "isolated_max_columns": columns}}
    for number, (width, height) in enumerate(sizes):
        graph.node(number, width=width, height=height, label="")
    for one, other in edges:
        graph.edge(one, other)
    try:
        found = graphlay.layout(graph, preset="layered", options=options)
    except graphlay.GraphlayError:
        return None
    left, top = (float(found.bounds["min"][axis]) - GAP for axis in "xy")

    def rectangle(node: Any) -> Rectangle:
        (width, height), centre = (node["size"]["width"], node["size"]["height"]), node["center"]
        return round(centre["x"] - width / 2 - left), round(centre["y"] - height / 2 - top), round(width), round(height)

    return (
        (round(found.bounds["max"]["x"] - left) + GAP, round(found.bounds["max"]["y"] - top) + GAP),
        tuple(rectangle(node) for node in found.nodes),
        tuple(
            (one, other, tuple(round(value) for p in edge["points"] for value in (p["x"] - left, p["y"] - top)))
            for (one, other), edge in zip(edges, found.edges, strict=True)
        ),
    )
