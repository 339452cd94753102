# SPDX-License-Identifier: Apache-2.0
"""The sections of a ROS 2 parameter file: which nodes each is for, and the line that says so."""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Iterator, Mapping

from haros_ci.launch.ros2.parameter_yaml import Map, Tree
from haros_ci.launch.ros2.places import Places
from haros_ci.model.launch_facts import NodePattern
from haros_ci.model.location import Location
from haros_ci.regex import regex
from haros_ci.substitutions.names import MARK

SECTION = "ros__parameters"
#: So many parameters of a section are remembered, and so deep ones; of more none.
_NAMES, _DEPTH = 100, 10
_KEY = regex(r"^[ \t]*(['\"]?)([^'\"#\s:-][^:'\"\n]*?)\1[ \t]*:", re.MULTILINE)


def sections_of(places: Places, file: str, trees: tuple[Tree, ...], component: str | None) -> tuple[NodePattern, ...]:
    """The sections of *file*; of those that launch picks for a *component* (its full name) it is known whether they match."""
    lines = _lines(places, file)
    found = []
    for tree in trees:
        for keys, inside in _below(tree, ()):
            line = inside.line
            pattern = "".join(f"/{key.lstrip('/')}" for key in keys) if len(keys) > 1 else "".join(keys)
            if MARK in pattern or not keys:
                continue
            matches = None
            if component is not None and "?" not in component:
                matches = pattern.lstrip("/") in ("**", component.lstrip("/"))
            at = lines.get(keys[-1], ())
            place = bisect_right(at, line) - 1
            where = Location(file, at[place] if place >= 0 else line)
            found.append(NodePattern(pattern, where, matches, _names(inside.entries.get(SECTION))))
    return tuple(found)


def _below(tree: Tree, keys: tuple[str, ...]) -> Iterator[tuple[tuple[str, ...], Map]]:
    """Maps that have the section's key, with the keys that lead to them."""
    if isinstance(tree, Map):
        for key, value in tree.entries.items():
            if key == SECTION:
                yield keys, tree
            else:
                yield from _below(value, (*keys, key))


def _names(tree: Tree | None) -> tuple[str, ...]:
    """The names of the parameters in a section; () where there are too many, or too deep ones."""
    found: list[str] = []
    waiting: list[tuple[Tree | None, str, int]] = [(tree, "", 0)]
    while waiting:
        inner, name, depth = waiting.pop()
        if isinstance(inner, Map):
            if depth > _DEPTH or len(waiting) + len(inner.entries) > _NAMES:
                return ()
            waiting += [(value, f"{name}.{key}" if name else key, depth + 1) for key, value in inner.entries.items()]
        elif name:
            found.append(name)
    return tuple(sorted(found)) if len(found) <= _NAMES else ()


def _lines(places: Places, file: str) -> Mapping[str, tuple[int, ...]]:
    """The lines on which each key of a file stands, in order."""
    known = places.remembered.get(("keys", file))
    if known is None:
        text = places.workspace.text(file)
        found: dict[str, list[int]] = {}
        line, last = 1, 0
        for match in _KEY.finditer(text):
            line += text.count("\n", last, match.start(2))
            last = match.start(2)
            found.setdefault(match[2], []).append(line)
        known = places.remembered["keys", file] = {key: tuple(item) for key, item in found.items()}
    lines: Mapping[str, tuple[int, ...]] = known
    return lines
