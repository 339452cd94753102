# SPDX-License-Identifier: Apache-2.0
"""Properties that depend on messages which no node of a closed configuration publishes."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from haros_ci.api import Check, Decidability, Finding, Level, System, of_properties

if TYPE_CHECKING:
    from haros_ci.api.hpl import Properties


def check(properties: Properties) -> Iterator[Finding]:
    from haros_ci.api.hpl import OF_ALL, found

    for stated, property in properties.sound:
        for system in properties.systems(stated.owner) if stated.owner.kind == "configuration" else ():
            if not system.closed or not system.is_launched:
                continue
            for events, what in (
                (property.scope.activator, "opens its scope"),
                (property.pattern.trigger, "triggers it"),
            ):
                silent = [event for event in events if event.topic not in OF_ALL and _is_silent(system, event.topic)]
                if not events or len(silent) < len(events):
                    continue
                message = f"No node of {system.name} publishes {silent[0].topic}, which {what}: this property says nothing; correct the topic"
                yield found(stated, silent[0].topic_at, message, silent[0].topic)


def _is_silent(system: System, topic: str) -> bool:
    """Whether it is certain that nobody publishes *topic*, which somebody subscribes to."""
    from haros_ci.api.hpl import is_certainly_absent

    name = topic if topic.startswith("/") else f"/{topic}"
    channel = next((channel for channel in system.topics if channel.name == name), None)
    return channel is not None and not channel.publishers and is_certainly_absent(system, channel, "givers")


CHECK = Check(
    id="hpl-never-triggered",
    summary="Property whose trigger no node of a closed configuration publishes.",
    level=Level.WARNING,
    decidability=Decidability.CLOSED_WORLD,
    catalogue="H11",
    tags=("properties",),
    project=of_properties(check),
)
