# SPDX-License-Identifier: Apache-2.0
"""Services and actions that are called, and that nothing in a closed system offers."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Decidability, Finding, Level, System, named_at, told, way_to


def check(system: System) -> Iterator[Finding]:
    if not system.closed or not system.is_launched:
        return
    for channel in (*system.services, *system.actions):
        ends = [end for end in channel.takers if not end.implicit]
        if not ends or channel.givers or not told(system, channel, "givers"):
            continue
        more = f" and {len(ends) - 1} more" if len(ends) > 1 else ""
        yield Finding(
            at=named_at(ends[0]),
            message=f"{ends[0].node}{more} calls the {channel.kind} {channel}, which nothing in the system offers: it waits for ever, or its calls fail",
            about=(channel, *ends),
            related=tuple((end.location, str(end)) for end in ends[1:]),
            flow=way_to(ends[0]),
        )


CHECK = Check(
    id="missing-server",
    summary="What a node calls is offered, in a system that is closed.",
    level=Level.WARNING,
    decidability=Decidability.CLOSED_WORLD,
    catalogue="G09",
    tags=("services", "actions"),
    run=check,
)
