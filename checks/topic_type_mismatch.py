# SPDX-License-Identifier: Apache-2.0
"""Publishers and subscribers of one topic that disagree on its type."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Channel, Check, End, Finding, Level, System


def check(system: System) -> Iterator[Finding]:
    for topic in system.topics:
        if len(topic.types) < 2 or any(end.type is None for end in topic.ends):
            continue
        told = set()
        for publisher, subscriber in topic.pairs():
            kind = (publisher.type, subscriber.type)
            if publisher.type == subscriber.type or kind in told or fits(topic, publisher, subscriber):
                continue
            told.add(kind)
            alike = [p for p, s in topic.pairs() if (p.type, s.type) == kind and s.node is subscriber.node]
            names = ", ".join(sorted({p.node.name for p in alike}))
            yield Finding(
                at=subscriber.location,
                message=(
                    f"{subscriber.node} subscribes to {topic} as {subscriber.type}, "
                    f"but {names} publishes {publisher.type}: no such message arrives"
                ),
                about=(topic, publisher, subscriber),
                related=tuple((p.location, f"{p.node} publishes {p.type}") for p in alike),
            )


def fits(topic: Channel, publisher: End, subscriber: End) -> bool:
    """Whether the two make a choice of types under conditions, and have one in common: then they may choose it together."""
    if not publisher.conditions and not subscriber.conditions:
        return False
    given = {end.type for end in topic.publishers if end.node is publisher.node}
    return any(end.type in given for end in topic.subscribers if end.node is subscriber.node)


CHECK = Check(
    id="topic-type-mismatch",
    summary="The publishers and subscribers of a topic have the same message type.",
    level=Level.ERROR,
    catalogue="G06",
    tags=("topics",),
    run=check,
)
