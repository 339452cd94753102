# SPDX-License-Identifier: Apache-2.0
"""Predicates that no message matches, or that every message matches."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from haros_ci.api import Check, Finding, Level, of_properties

if TYPE_CHECKING:
    from haros_ci.api.hpl import Properties


def check(properties: Properties) -> Iterator[Finding]:
    from haros_ci.api.hpl import Predicate, Reader, expression_text, found, is_always, is_never, outside

    for stated, _ in properties.sound:
        for event, scene in properties.scenes(stated):
            if event.predicate is None or any(
                outside(event.predicate, scene)
            ):  # the rest of what hpl-out-of-range says
                continue
            predicate = Predicate(event.predicate, Reader(scene, event.alias))
            text = f"{event.topic} {{{expression_text(event.predicate)}}}"
            if is_never(predicate):
                message = f"No message on {event.topic} matches this predicate; correct its conditions, which exclude each other or the type"
                yield found(stated, event.predicate.at, message, text)
            elif is_always(predicate):
                message = f"Every message on {event.topic} matches this predicate; correct it, or leave it out"
                yield found(stated, event.predicate.at, message, text)


CHECK = Check(
    id="hpl-constant-predicate",
    summary="Predicate that is never true, or always.",
    level=Level.WARNING,
    catalogue="H10",
    tags=("properties",),
    project=of_properties(check),
)
