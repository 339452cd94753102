# SPDX-License-Identifier: Apache-2.0
"""Predicates that compare a field with a number that its type cannot hold, or index an array outside its length."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from haros_ci.api import Check, Finding, Level, of_properties

if TYPE_CHECKING:
    from haros_ci.api.hpl import Properties


def check(properties: Properties) -> Iterator[Finding]:
    from haros_ci.api.hpl import found, outside

    for stated, _ in properties.sound:
        for event, scene in properties.scenes(stated):
            for value, message in outside(event.predicate, scene):
                yield found(stated, value.at, message, event.topic, message)


CHECK = Check(
    id="hpl-out-of-range",
    summary="Number outside the type of the field, or index outside the array.",
    level=Level.WARNING,
    catalogue="H09",
    tags=("properties",),
    project=of_properties(check),
)
