# SPDX-License-Identifier: Apache-2.0
"""Publishers and subscribers of one topic that disagree on its type."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, System


def check(system: System) -> Iterator[Finding]:
    for topic in system.topics:
        for publisher, subscriber in topic.pairs():
            if publisher.type is None or subscriber.type is None or publisher.type == subscriber.type:
                continue
            yield Finding(
                at=subscriber.location,
                message=(
                    f"{subscriber.node} subscribes to {topic} as {subscriber.type}, "
                    f"but {publisher.node} publishes {publisher.type}: no message arrives"
                ),
                about=(topic, publisher, subscriber),
                related=((publisher.location, f"{publisher.node} publishes {publisher.type}"),),
            )


CHECK = Check(
    id="topic-type-mismatch",
    summary="The publishers and subscribers of a topic have the same message type.",
    level=Level.ERROR,
    catalogue="G06",
    tags=("topics",),
    run=check,
)
