# SPDX-License-Identifier: Apache-2.0
"""Macros with parameters of another file (``#define SERVER(nh, T, name) nh->create_service<T>(name, …)``) that were not given to the file that uses them.

They have several definitions, or are no expression or statement there. Where the text of one calls an API, what it makes is missing; that is said of the node.
"""

from __future__ import annotations

from haros_ci.follow.frames import Frame
from haros_ci.follow.walk import Walk
from haros_ci.model.location import Location
from haros_ci.regex import regex

#: Names that a macro's text calls as methods, also with template arguments.
_METHOD = regex(r"(?:\.|->)\s*(?:template\s+)?([A-Za-z_]\w*)\s*[<(]")
#: Macros of one name that are looked at, and how much of the text of each.
MOST, LONGEST = 20, 4000


def note(walk: Walk, frame: Frame, name: str, location: Location) -> None:
    """*name* is called, and nothing is known of it: say so where it is a macro whose text calls an API."""
    if frame.source.separator != "::" or walk.quiet:
        return
    every = walk.index.caches.setdefault("calling macros", {})
    if not every:
        every["all"] = _found(walk)
    bodies = every["all"].get(name, ())
    trace = walk.index.trace
    if trace is not None:
        trace.names.add(name)
        trace.paths.update(path for path, _ in bodies)
    methods = (match[1] for _, body in bodies[:MOST] for match in _METHOD.finditer(body[:LONGEST]))
    made = next((method for method in methods if walk.relevance.called(f".{method}")), None)
    if made is not None:
        walk.gaps.setdefault(f"{name} is a macro of another file that is not followed: it may call {made}", location)


def _found(walk: Walk) -> dict[str, list[tuple[str, str]]]:
    """The texts of the workspace's macros with parameters by their names, with the files that define them."""
    found: dict[str, list[tuple[str, str]]] = {}
    for source in walk.index.sources.values():
        for name, parameters, body in source.program.macros:
            if parameters is not None:
                found.setdefault(name, []).append((source.path, body))
    return found
