# SPDX-License-Identifier: Apache-2.0
"""Subscribers that want what was published before they came, of publishers that keep nothing."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, System, incompatible

ADVICE = {
    "publishers": "publish with transient local durability, or subscribe with volatile durability",
    "subscribers": "subscribe with volatile durability, or publish with transient local durability",
    "services": "use the default quality of service of services on both sides",
}


def check(system: System) -> Iterator[Finding]:
    yield from incompatible(system, "durability", "giver", ADVICE)


CHECK = Check(
    id="durability-mismatch",
    summary="Volatile publisher of a topic that a subscriber requests as transient local.",
    level=Level.ERROR,
    catalogue="Q02",
    tags=("topics", "qos"),
    run=check,
)
