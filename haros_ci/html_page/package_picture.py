# SPDX-License-Identifier: Apache-2.0
"""The picture of what packages need of each other to be built: from what is built first to what is built last."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from haros_ci.html_page.layout import BOLD, CHARACTER, GAP, OPTIONS, SMALL, text_width

#: The most packages that are drawn, the height of one in px, and the characters of "123 findings, 12,345 lines".
MOST, HEIGHT, WORDS = 300, 38, 26


def package_picture(needs: Mapping[str, Iterable[str]], circles: Mapping[str, int]) -> dict[str, Any] | None:
    """Size, the rectangle of each package by name in order, and edges (needed, who needs it, points); None for none, or too many.

    A need that follows from others is left out; within a circle all are drawn.
    """
    import graphlay

    names = sorted(needs)
    if not names or len(names) > MOST:
        return None
    index = {name: number for number, name in enumerate(names)}
    graph = graphlay.Graph()
    for name in names:
        graph.node(name, width=text_width(max(len(name) * BOLD, WORDS * SMALL) / CHARACTER), height=HEIGHT, label="")
    edges = [(other, name) for name in names for other in direct(name, needs, circles)]
    for needed, name in edges:
        graph.edge(needed, name)
    try:
        found = graphlay.layout(graph, preset="layered", options=OPTIONS)
    except graphlay.GraphlayError:
        return None
    left, top = (float(found.bounds["min"][axis]) - GAP for axis in "xy")

    def rectangle(node: Any) -> tuple[int, int, int, int]:
        (width, height), centre = (node["size"]["width"], node["size"]["height"]), node["center"]
        return round(centre["x"] - width / 2 - left), round(centre["y"] - height / 2 - top), round(width), round(height)

    return {
        "size": [round(found.bounds["max"][axis] - start) + GAP for axis, start in (("x", left), ("y", top))],
        "places": [rectangle(node) for node in found.nodes],
        "edges": [
            (index[needed], index[name], [round(v) for p in edge["points"] for v in (p["x"] - left, p["y"] - top)])
            for (needed, name), edge in zip(edges, found.edges, strict=True)
        ],
    }


def direct(name: str, needs: Mapping[str, Iterable[str]], circles: Mapping[str, int]) -> list[str]:
    """What *name* needs and does not need already because of something else that it needs; all that is in its circle."""
    own = set(needs[name])
    kept = []
    for other in sorted(own):
        is_circle = name in circles and circles.get(other) == circles[name]
        ways = (each for each in own if each != other and circles.get(each, -1) != circles.get(other, -2))
        if is_circle or not any(other in reached(each, needs, name) for each in ways):
            kept.append(other)
    return kept


def reached(start: str, needs: Mapping[str, Iterable[str]], without: str) -> set[str]:
    """All that *start* needs, directly or not, on ways that do not lead through *without*."""
    found: set[str] = set()
    work = [start]
    while work:
        for each in needs.get(work.pop(), ()):
            if each not in found and each != without:
                found.add(each)
                work.append(each)
    return found
