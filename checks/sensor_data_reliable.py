# SPDX-License-Identifier: Apache-2.0
"""Sensor data that is subscribed to as reliable, which drivers seldom publish."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Decidability, Finding, Level, System, can_meet, qos_in_words

#: Messages that drivers publish with the quality of service of sensors (REP 2003).
SENSORS = frozenset(
    f"sensor_msgs/msg/{name}"
    for name in ("CameraInfo", "CompressedImage", "Image", "Imu", "LaserScan", "PointCloud2", "Range")
)


def check(system: System) -> Iterator[Finding]:
    for topic in system.topics:
        for end in topic.subscribers:
            if end.type not in SENSORS or end.qos is None or end.qos.reliability != "reliable":
                continue
            if end.implicit or not end.in_source or any(can_meet(topic.publishers, (end,))):
                continue
            yield Finding(
                at=end.location,
                message=(
                    f"{end.node} subscribes to {topic} as reliable ({qos_in_words(end.qos)}), and the publisher is outside "
                    f"the system: drivers usually publish {end.type} with best effort, and then no message arrives; subscribe "
                    "with best effort (SensorDataQoS, qos_profile_sensor_data)"
                ),
                about=(topic, end),
            )


CHECK = Check(
    id="sensor-data-reliable",
    summary="Reliable subscription to sensor data from outside the system.",
    level=Level.NOTE,
    decidability=Decidability.HEURISTIC,
    catalogue="Q08",
    tags=("topics", "qos"),
    profiles=("strict",),
    run=check,
)
