# SPDX-License-Identifier: Apache-2.0
"""Parameters that come or go with a plug-in, not with a change of code: reported as one change, ``node:prefix.*``."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace

from haros_ci.changes.change import ADDED, REMOVED, Difference, tail
from haros_ci.changes.nodes import said_ends
from haros_ci.model.architecture import Architecture
from haros_ci.model.location import Location


class Calls:
    """The places in a file at which parameters with a last name are declared."""

    def __init__(self, architecture: Architecture, moved: Callable[[str], str]) -> None:
        self._places: dict[tuple[str, str], set[tuple[int, int]]] = {}
        for configuration in architecture.configurations:
            for node in configuration.nodes:
                for end in said_ends(node):
                    if end.kind == "parameters" and end.location is not None:
                        place = (end.location.line or 0, end.location.column or 0)
                        self._places.setdefault((moved(end.location.path), tail(end.name)), set()).add(place)

    def count(self, path: str, name: str) -> int:
        return len(self._places.get((path, tail(name)), ()))


def by_instance(found: Iterable[Difference], base: Calls, head: Calls) -> list[Difference]:
    """*found* with the parameters that both revisions' code declares, where a plug-in is loaded, as one difference each prefix."""
    kept: list[Difference] = []
    groups: dict[tuple[str, str, str, str], list[Difference]] = {}
    for difference in found:
        key = _prefix(difference)
        if key is None or not _is_of_both(difference, base, head):
            kept.append(difference)
        else:
            groups.setdefault((difference.configuration, difference.node, difference.action, key), []).append(
                difference
            )
    return [*kept, *(_together(key, group) for (_, _, _, key), group in groups.items())]


def _prefix(difference: Difference) -> str | None:
    """``/ns/node:plugin`` of a parameter that was added or removed below a prefix."""
    if difference.what != "parameter" or difference.action not in (ADDED, REMOVED):
        return None
    node, colon, name = difference.name.partition(":")
    first, dot, _ = name.partition(".")
    return f"{node}:{first}" if colon and dot else None


def _is_of_both(difference: Difference, base: Calls, head: Calls) -> bool:
    """Whether the other side has as many calls that declare it: then it is another node's, or another plug-in's, there."""
    place: Location | None = difference.head if difference.action == ADDED else difference.base
    if place is None:
        return False
    here, there = (head, base) if difference.action == ADDED else (base, head)
    return there.count(place.path, difference.name) >= here.count(place.path, difference.name) > 0


def _together(prefix: str, group: list[Difference]) -> Difference:
    if len(group) == 1:
        return group[0]
    text = f"{len(group)} parameters"
    first = group[0]
    return replace(
        first,
        name=f"{prefix}.*",
        aspect="plug-in",
        before=text if first.action == REMOVED else None,
        after=text if first.action == ADDED else None,
        base=None,
        head=None,
        users=(),
        details=tuple(sorted(difference.name for difference in group)),
    )
