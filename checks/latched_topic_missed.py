# SPDX-License-Identifier: Apache-2.0
"""Volatile subscribers of topics whose publishers keep their last messages for those who come late."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Channel, Check, Decidability, End, Finding, Level, Location, System, can_meet, qos_in_words
from haros_ci.api.code import publishes_again


def check(system: System) -> Iterator[Finding]:
    found: dict[Location, list[tuple[Channel, End, End]]] = {}
    for topic in system.topics:
        if any(_durability(end) == "transient_local" for end in topic.publishers):
            for subscriber in topic.subscribers:
                if _durability(subscriber) == "volatile" and subscriber.in_source and not subscriber.implicit:
                    publisher = _keeper(topic, subscriber, system)
                    if publisher is not None:
                        found.setdefault(subscriber.location, []).append((topic, publisher, subscriber))
    for place, alike in found.items():
        topic, publisher, subscriber = min(
            alike, key=lambda item: (len(item[2].presence), item[0].name, item[2].node.name)
        )
        others = [end for end in topic.subscribers if _durability(end) == "transient_local" and end.in_source]
        yield Finding(
            at=place,
            message=(
                f"{publisher.node} keeps the last messages of {topic} for late subscribers "
                f"({qos_in_words(publisher.qos)}), but {subscriber.node} subscribes as volatile "
                f"({qos_in_words(subscriber.qos)}): if it starts later, it misses all earlier messages; subscribe with "
                "transient local durability"
            ),
            about=(topic, publisher, subscriber),
            related=(
                (publisher.location, f"{publisher}: {qos_in_words(publisher.qos)}"),
                *((other.location, f"{other} requests them: {qos_in_words(other.qos)}") for other in others[:3]),
            ),
            level=Level.WARNING if others else Level.NOTE,
            apart=("durability",),
        )


def _durability(end: End) -> str | None:
    return end.qos.durability if end.qos is not None else None


def _sends_again(publisher: End, system: System) -> bool:
    place, workspace = publisher.location, system.workspace
    if not publisher.in_source or workspace is None:
        return False
    return publishes_again(workspace.text(place.path), place.line, place.path.endswith(".py"))


def _keeper(topic: Channel, subscriber: End, system: System) -> End | None:
    """The publisher in another node that keeps its messages, if all that *subscriber* can meet do, and none sends them again."""
    met = [publisher for publisher, _ in can_meet(topic.publishers, (subscriber,))]
    kept = [end for end in met if _durability(end) == "transient_local" and not end.implicit]
    if (
        any(_sends_again(end, system) for end in met)
        or len(kept) < len(met)
        or any(end.node is subscriber.node for end in met)
    ):
        return None
    if any(
        end.conditions and _durability(end) != "volatile" for end in topic.subscribers if end.node is subscriber.node
    ):
        return None
    fit = [end for end in kept if None in (end.type, subscriber.type) or end.type == subscriber.type]
    return min(fit, key=lambda end: (len(end.presence), end.node.name)) if fit else None


CHECK = Check(
    id="latched-topic-missed",
    summary="Volatile subscription to a topic that is published as transient local.",
    level=Level.WARNING,
    profiles=("strict",),
    decidability=Decidability.HEURISTIC,
    catalogue="Q06",
    tags=("topics", "qos"),
    run=check,
)
