# SPDX-License-Identifier: Apache-2.0
"""Topics of std_msgs/Empty."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, System

TYPES = ("std_msgs/Empty", "std_msgs/msg/Empty")


def check(system: System) -> Iterator[Finding]:
    for topic in system.topics:
        for end in topic.ends:
            if end.type in TYPES and end.in_source and not end.implicit:
                yield Finding(
                    at=end.location,
                    message=f"{topic} has the type {end.type}: the message carries neither sender nor time, and cannot be extended; "
                    "use a message with a header",
                    about=(end,),
                )


CHECK = Check(
    id="empty-message",
    summary="Topic of type std_msgs/Empty.",
    level=Level.NOTE,
    aliases=("std_msgs_empty",),
    tags=("topics",),
    profiles=("strict",),
    run=check,
)
