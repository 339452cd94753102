# SPDX-License-Identifier: Apache-2.0
"""Properties of configurations about topics that no node of them is on."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

from haros_ci.api import Check, Finding, Level, alternatives, equally_near, is_moved, of_properties

if TYPE_CHECKING:
    from haros_ci.api.hpl import Properties


def check(properties: Properties) -> Iterator[Finding]:
    from haros_ci.api.hpl import found

    for stated, property in properties.sound:
        owner = stated.owner
        if owner.kind == "node" or not properties.is_complete(owner):
            continue
        known = properties.topics(owner)
        for event in property.events:
            name = event.topic if event.topic.startswith("/") else f"/{event.topic}"
            if event.topic.startswith("~") or properties.may_have(owner, event.topic):
                continue
            message = f"No node of {owner} publishes or subscribes to {event.topic}: the property says nothing of this system, and HAROS leaves it out{_meant(name, known)}"
            yield found(stated, event.topic_at, message, event.topic)


def _meant(name: str, known: Iterable[str]) -> str:
    known = sorted(known)
    moved = [other for other in known if is_moved(other, name)]
    near = alternatives(moved or equally_near(name, known))
    return f"; did you mean {near}?" if near else "; correct the topic"


CHECK = Check(
    id="hpl-unknown-topic",
    summary="Property about a topic that no node of the configuration is on.",
    level=Level.WARNING,
    catalogue="H05",
    tags=("properties",),
    project=of_properties(check),
)
