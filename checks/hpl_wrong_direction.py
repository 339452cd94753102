# SPDX-License-Identifier: Apache-2.0
"""Properties of nodes that promise what the node does not publish, but receives."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from haros_ci.api import Check, Finding, Level, of_properties

if TYPE_CHECKING:
    from haros_ci.api.hpl import Properties


def check(properties: Properties) -> Iterator[Finding]:
    from haros_ci.api.hpl import PatternKind, found

    active = (PatternKind.SOME, PatternKind.CAUSES, PatternKind.REQUIRES)
    for stated, property in properties.sound:
        owner = stated.owner
        if (
            owner.kind != "node"
            or stated.is_axiom
            or property.pattern.kind not in active
            or not properties.is_complete(owner)
        ):
            continue
        ends = [properties.ends(owner, event.topic) for event in property.pattern.behaviour]
        if not all(ends) or any(end.kind == "publishers" for publishers in ends for end in publishers):
            continue
        for event, publishers in zip(property.pattern.behaviour, ends):
            message = f"The node {owner.name} subscribes to {event.topic} and does not publish it, so it cannot keep this promise; "
            message += "swap the events, or list the property under 'assumptions'"
            yield found(
                stated, event.topic_at, message, event.topic, related=((publishers[0].location, str(publishers[0])),)
            )


CHECK = Check(
    id="hpl-wrong-direction",
    summary="Property of a node that promises messages which only others publish.",
    level=Level.WARNING,
    catalogue="H07",
    tags=("properties",),
    project=of_properties(check),
)
