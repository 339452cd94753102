# SPDX-License-Identifier: Apache-2.0
"""ROS 1: queues of one message."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, System


def check(system: System) -> Iterator[Finding]:
    for end in system.ends:
        if end.node.ros == 1 and end.raw.queue_size == 1 and end.in_source and not end.implicit and not end.raw.latched:
            does = "publishes" if end.kind == "publishers" else "subscribes to"
            yield Finding(
                at=end.location,
                message=(
                    f"{end.node} {does} {end.name} with a queue of one message: when several messages arrive together, all "
                    "but the last are lost; use a longer queue"
                ),
                about=(end,),
            )


CHECK = Check(
    id="queue-of-one",
    summary="Queue of a single message.",
    level=Level.NOTE,
    tags=("topics", "qos"),
    profiles=("strict",),
    run=check,
)
