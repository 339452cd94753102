# SPDX-License-Identifier: Apache-2.0
"""Services and actions that are called, and that nothing in a closed system offers."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Channel, Check, Decidability, Finding, Level, System, unmet


def check(system: System) -> Iterator[Finding]:
    yield from unmet(system, (*system.services, *system.actions), "givers", _statement)


def _statement(channel: Channel) -> str:
    return f"calls the {channel.kind} {channel}, but no node of the system offers it: calls fail, or wait forever"


CHECK = Check(
    id="missing-server",
    summary="Client of a service or action that no node of the system offers.",
    level=Level.WARNING,
    decidability=Decidability.CLOSED_WORLD,
    catalogue="G09",
    tags=("services", "actions"),
    run=check,
)
