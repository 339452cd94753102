# SPDX-License-Identifier: Apache-2.0
"""Reliable subscribers of what is published best effort."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, System, incompatible

ADVICE = {
    "publishers": "publish as reliable, or subscribe with best effort everywhere",
    "subscribers": "subscribe with best effort (SensorDataQoS, qos_profile_sensor_data), or publish as reliable",
    "services": "use the default quality of service of services on both sides",
}


def check(system: System) -> Iterator[Finding]:
    yield from incompatible(system, "reliability", "taker", ADVICE)


CHECK = Check(
    id="reliability-mismatch",
    summary="Best-effort publisher of a topic that a subscriber requests as reliable.",
    level=Level.ERROR,
    catalogue="Q01",
    tags=("topics", "qos"),
    run=check,
)
