# SPDX-License-Identifier: Apache-2.0
"""Topics that are published, and that nothing in a closed system subscribes to."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Decidability, Finding, Level, System, unmet

#: What people look at with tools.
TOOLS = frozenset(
    {"tf", "tf_static", "diagnostics", "diagnostics_agg", "rosout", "rosout_agg", "joint_states", "parameter_events"}
)


def check(system: System) -> Iterator[Finding]:
    topics = (topic for topic in system.topics if topic.name.rpartition("/")[2] not in TOOLS)
    yield from unmet(
        system, topics, "takers", lambda topic: f"publishes {topic}, but no node of the system subscribes to it"
    )


CHECK = Check(
    id="publisher-without-subscriber",
    summary="Published topic without a subscriber in a closed system.",
    level=Level.NOTE,
    decidability=Decidability.CLOSED_WORLD,
    catalogue="G02",
    tags=("topics",),
    run=check,
)
