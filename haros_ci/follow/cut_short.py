# SPDX-License-Identifier: Apache-2.0
"""What is ruled out as far as a node was followed, and may be made by functions that are not followed any more (``follow.barren``)."""

from __future__ import annotations

from dataclasses import replace

from haros_ci.follow.walk import Walk
from haros_ci.index.index import Source
from haros_ci.model.location import Location
from haros_ci.syntax import Function

#: Why the conditions of such an endpoint are not known.
ELSEWHERE = "a function that is not followed any more may make it under other conditions"
#: Functions that are looked for; in more than these what they make is not called ruled out.
MOST = 64


def reopen(walk: Walk) -> None:
    """Rule out nothing that stands in a function which one that is not followed any more calls, by whatever way."""
    if not walk.cut:
        return
    held: dict[int, tuple[Function, list[tuple[object, ...]]]] = {}
    for key, made in walk.made.items():
        function = _around(walk, made.location) if made.dead else None
        if function is not None:
            held.setdefault(id(function), (function, []))[1].append(key)
    for number, (function, keys) in enumerate(held.values()):
        if number < MOST and not any(_reaches(walk, source, cut, function) for source, cut in walk.cut.values()):
            continue
        for key in keys:
            made = walk.made[key]
            unknown = ("conditions", ELSEWHERE, made.location)
            walk.made.note(key, replace(made, dead=0, unknowns=(*made.unknowns, unknown)))


def _reaches(walk: Walk, source: Source, cut: Function, function: Function) -> bool:
    return walk.relevance.reaches(cut, source, lambda item, _: item is function)


def _around(walk: Walk, location: Location) -> Function | None:
    """The function that a call stands in: the last one that begins before it."""
    index = walk.index
    source = index.sources.get(location.path) or index.by_place.get(location.path.removesuffix(".py"))
    if source is None or not location.line:
        return None
    before = (one for one in source.program.functions if one.body is not None and one.line <= location.line)
    return max(before, key=lambda function: function.line, default=None)
