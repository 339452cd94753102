# SPDX-License-Identifier: Apache-2.0
"""Properties of nodes about topics that the node is not on."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from haros_ci.api import Check, Finding, Level, alternatives, equally_near, of_properties

if TYPE_CHECKING:
    from haros_ci.api.hpl import Properties


def check(properties: Properties) -> Iterator[Finding]:
    from haros_ci.api.hpl import found

    for stated, property in properties.sound:
        owner = stated.owner
        if owner.kind != "node" or not properties.is_complete(owner):
            continue
        known = properties.topics(owner)
        for event in property.events:
            if properties.may_have(owner, event.topic):
                continue
            last = event.topic.rpartition("/")[2].lstrip("~")
            if any(name.rpartition("/")[2] == last for name in known):
                continue  # in which namespace it was meant is not known
            near = alternatives(equally_near(event.topic, sorted(known)))
            hint = (
                f"; did you mean {near}?" if near else "; state the property for a configuration, or correct the topic"
            )
            message = f"The node {owner.name} neither publishes nor subscribes to {event.topic}: the property says nothing of this node, and HAROS leaves it out{hint}"
            yield found(stated, event.topic_at, message, event.topic)


CHECK = Check(
    id="hpl-foreign-topic",
    summary="Property of a node about a topic that the node is not on.",
    level=Level.WARNING,
    catalogue="H06",
    tags=("properties",),
    project=of_properties(check),
)
