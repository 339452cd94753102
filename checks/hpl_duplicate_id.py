# SPDX-License-Identifier: Apache-2.0
"""Properties of one owner, or of one file, that have the same id."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from haros_ci.api import Check, Finding, Level, Location, line_of, of_properties

if TYPE_CHECKING:
    from haros_ci.api.hpl import Properties


def check(properties: Properties) -> Iterator[Finding]:
    from haros_ci.api.hpl import found

    first: dict[tuple[str, str, str], Location] = {}
    for stated in properties.stated:
        given = stated.parsed.metadata_of("id") if stated.parsed is not None else None
        if given is None:
            continue
        place = stated.at(given.value_at)
        before = first.setdefault((str(stated.owner), stated.source.path, given.value), place)
        if before != place:
            message = f"The id {given.value} is that of another property of {stated.owner} ({line_of(before)}): results of the two "
            message += "cannot be told apart; give this one another id"
            yield found(stated, given.value_at, message, related=((before, "has the id first"),))


CHECK = Check(
    id="hpl-duplicate-id",
    summary="Two properties with one id.",
    level=Level.WARNING,
    catalogue="H04",
    tags=("properties",),
    project=of_properties(check),
)
