# SPDX-License-Identifier: Apache-2.0
"""Topics that are published, and that nothing in a closed system subscribes to."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Decidability, Finding, Level, System, named_at, told, way_to

#: What people look at with tools.
TOOLS = frozenset(
    {"tf", "tf_static", "diagnostics", "diagnostics_agg", "rosout", "rosout_agg", "joint_states", "parameter_events"}
)


def check(system: System) -> Iterator[Finding]:
    if not system.closed or not system.is_launched:
        return
    for channel in system.topics:
        ends = [end for end in channel.givers if not end.implicit]
        if (
            not ends
            or channel.takers
            or channel.name.rpartition("/")[2] in TOOLS
            or not told(system, channel, "takers")
        ):
            continue
        more = f" and {len(ends) - 1} more" if len(ends) > 1 else ""
        yield Finding(
            at=named_at(ends[0]),
            message=f"{ends[0].node}{more} publishes {channel}, which nothing in the system subscribes to",
            about=(channel, *ends),
            related=tuple((end.location, str(end)) for end in ends[1:]),
            flow=way_to(ends[0]),
        )


CHECK = Check(
    id="publisher-without-subscriber",
    summary="What a node publishes is subscribed to, in a system that is closed.",
    level=Level.NOTE,
    decidability=Decidability.CLOSED_WORLD,
    catalogue="G02",
    tags=("topics",),
    run=check,
)
