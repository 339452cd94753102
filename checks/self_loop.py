# SPDX-License-Identifier: Apache-2.0
"""Nodes that subscribe to what they publish themselves."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Status, System, can_meet, named_at

#: Everybody is on both sides of these.
SHARED = frozenset({"tf", "tf_static", "bond", "diagnostics", "rosout", "parameter_events", "clock"})


def check(system: System) -> Iterator[Finding]:
    for topic in system.topics:
        if topic.name.rpartition("/")[2] in SHARED:
            continue
        for publisher, subscriber in can_meet(topic.givers, topic.takers):
            if publisher.node is subscriber.node and not publisher.implicit and not subscriber.implicit:
                yield Finding(
                    at=named_at(subscriber),
                    message=f"{subscriber.node} subscribes to {topic}, which it also publishes: it receives its own messages; filter "
                    "them, or use two topics",
                    about=(topic, publisher, subscriber),
                    related=((named_at(publisher), str(publisher)),),
                )
                break


CHECK = Check(
    id="self-loop",
    summary="Node that subscribes to its own topic.",
    level=Level.NOTE,
    status=Status.PREVIEW,
    catalogue="G14",
    tags=("topics",),
    run=check,
)
