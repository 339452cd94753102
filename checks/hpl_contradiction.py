# SPDX-License-Identifier: Apache-2.0
"""Assumptions of one owner that cannot hold together."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from haros_ci.api import Check, Finding, Level, line_of, of_properties

if TYPE_CHECKING:
    from haros_ci.api.hpl import Properties, Stated


#: Assumptions of one owner that are compared, each with each.
MOST = 150


def check(properties: Properties) -> Iterator[Finding]:
    groups: dict[tuple[str, str], list[Stated]] = {}
    for stated, _ in properties.matched:
        if stated.is_axiom:
            groups.setdefault((stated.owner.kind, stated.owner.name), []).append(stated)
    for group in groups.values():
        yield from _excluded(properties, group[:MOST])


def _excluded(properties: Properties, group: list[Stated]) -> Iterator[Finding]:
    from haros_ci.api.hpl import excluded, found

    compared = [(stated, properties.compared(stated)) for stated in group]
    for stated, one in compared:
        for other, second in compared:
            reason = excluded(one, second) if other is not stated else None
            if reason is not None:
                message = f"This assumption and the one at {line_of(other.location)} cannot hold together: {reason}; correct one of them"
                yield found(stated, one.stated.at, message, other.identity, related=((other.location, other.identity),))


CHECK = Check(
    id="hpl-contradiction",
    summary="Two assumptions that contradict each other.",
    level=Level.ERROR,
    catalogue="H15",
    tags=("properties",),
    project=of_properties(check),
)
