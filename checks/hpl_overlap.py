# SPDX-License-Identifier: Apache-2.0
"""Triggers and answers that one and the same message can be."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from haros_ci.api import Check, Finding, Level, of_properties

if TYPE_CHECKING:
    from haros_ci.api.hpl import Properties


def check(properties: Properties) -> Iterator[Finding]:
    from haros_ci.api.hpl import PatternKind, event_text, found, overlap

    for stated, property in properties.sound:
        if property.pattern.kind is not PatternKind.CAUSES:
            continue
        read = properties.compared(stated).read
        for trigger in property.pattern.trigger:
            for answer in property.pattern.behaviour:
                if trigger.topic == answer.topic and overlap(read(trigger), read(answer)):
                    message = f"A message can be trigger and answer at once ({event_text(trigger)} and {event_text(answer)}): HAROS's monitors "
                    message += "take it as the answer alone, here it asks for another answer, too; make the predicates exclude each other"
                    yield found(stated, answer.at, message, event_text(trigger), event_text(answer))


CHECK = Check(
    id="hpl-overlap",
    summary="Property whose trigger can be its own answer.",
    level=Level.WARNING,
    catalogue="H13",
    tags=("properties",),
    project=of_properties(check),
)
