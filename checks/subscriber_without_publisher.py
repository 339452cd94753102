# SPDX-License-Identifier: Apache-2.0
"""Topics that are subscribed to, and that nothing in a closed system publishes."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Channel, Check, Decidability, Finding, Level, System, unmet


def check(system: System) -> Iterator[Finding]:
    yield from unmet(system, system.topics, "givers", _statement)


def _statement(topic: Channel) -> str:
    return f"subscribes to {topic}, but no node of the system publishes it: no message ever arrives"


CHECK = Check(
    id="subscriber-without-publisher",
    summary="Subscription to a topic without a publisher in a closed system.",
    level=Level.NOTE,
    decidability=Decidability.CLOSED_WORLD,
    catalogue="G01",
    tags=("topics",),
    run=check,
)
