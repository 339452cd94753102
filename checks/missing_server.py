# SPDX-License-Identifier: Apache-2.0
"""Services and actions that are called, and that nothing in a closed system offers."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Channel, Check, Decidability, Finding, Level, System, unmet


def check(system: System) -> Iterator[Finding]:
    yield from unmet(system, (*system.services, *system.actions), "givers", _says)


def _says(channel: Channel) -> str:
    return (
        f"calls the {channel.kind} {channel}, which nothing in the system offers: it waits for ever, or its calls fail"
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
