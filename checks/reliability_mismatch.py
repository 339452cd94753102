# SPDX-License-Identifier: Apache-2.0
"""Reliable subscribers of what is published best effort."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, System, incompatible

ADVICE = {
    "publishers": "publish reliably, or let all of them subscribe with best effort",
    "subscribers": "subscribe with best effort, as to sensor data (SensorDataQoS, qos_profile_sensor_data), or publish reliably",
    "services": "use the default quality of service of services",
}


def check(system: System) -> Iterator[Finding]:
    yield from incompatible(system, "reliability", "taker", ADVICE)


CHECK = Check(
    id="reliability-mismatch",
    summary="What a node subscribes to as reliable is published reliably.",
    level=Level.ERROR,
    catalogue="Q01",
    tags=("topics", "qos"),
    run=check,
)
