# SPDX-License-Identifier: Apache-2.0
"""The configuration of ROSMonitoring, held against what its README says of the keys ("Configuration Reference")."""

from __future__ import annotations

import re
from typing import Any

import pytest
import yaml

from haros_ci.report.rosmonitoring import rosmonitoring

#: Key to the type of its value; those in REQUIRED have to be there.
TOP = {"ros_version": str, "path": str, "nodes": list, "monitors": list}
MONITOR = {
    "id": str, "log": str, "silent": bool, "warning": int, "oracle": dict, "status": dict, "topics": list, "services": list,
}  # fmt: skip
TOPIC = {
    "name": str, "type": str, "action": str, "publishers": list, "subscribers": list, "ordered": bool, "ordering": dict,
}  # fmt: skip
REQUIRED = {"monitors", "id", "log", "name", "type"}
TYPES = {
    "/cmd_vel": ("geometry_msgs/Twist",),
    "/robot/scan": ("sensor_msgs/msg/LaserScan",),
    "/two": ("a_msgs/A", "b_msgs/B"),
    "/none": (),
    "/odd type": ("std_msgs/String",),
    "/odd": ("std_msgs/String\n- x",),
}


def is_documented(value: Any, keys: dict[str, type]) -> bool:
    return (
        isinstance(value, dict)
        and set(value) <= set(keys)
        and REQUIRED & set(keys) <= set(value)
        and all(isinstance(item, keys[key]) for key, item in value.items())
    )


@pytest.mark.parametrize("configuration", ["robot", "", "1", "a: b\n- c", "ä/ö"])
@pytest.mark.parametrize("properties", [[], ["globally: no /cmd_vel"], ['globally: no /a {b = "\n# x\x1b[0m"}']])
def test_it_has_the_documented_form(configuration: str, properties: list[str]) -> None:
    written = rosmonitoring(configuration, 2, ["/robot/scan", "/cmd_vel", "/cmd_vel"], TYPES, properties)
    assert written is not None and written.gaps == () and written.text.isprintable() is False
    found = yaml.safe_load(written.text)
    assert is_documented(found, TOP) and found["ros_version"] in ("ros1", "ros2")
    (row,) = found["monitors"]
    monitor = row["monitor"]
    assert is_documented(monitor, MONITOR) and re.fullmatch(r"[A-Za-z_][0-9A-Za-z_]*", monitor["id"])
    assert "oracle" not in monitor and monitor["log"].endswith(f"/{monitor['id']}.jsonl")
    assert all(is_documented(topic, TOPIC) for topic in monitor["topics"])
    assert [(topic["name"], topic["type"], topic["action"]) for topic in monitor["topics"]] == [
        ("/cmd_vel", "geometry_msgs.msg.Twist", "log"),
        ("/robot/scan", "sensor_msgs.msg.LaserScan", "log"),
    ]
    assert all(line.isprintable() for line in written.text.splitlines())


@pytest.mark.parametrize(
    ("topic", "why"),
    [
        ("/two", "its ends have several types (a_msgs/A, b_msgs/B)"),
        ("/none", "its type is not known"),
        ("/missing", "no node of the configuration has it"),
        ("/odd type", "its type or name is not one of ROS"),
        ("/odd", "its type or name is not one of ROS"),
    ],
)
def test_what_cannot_be_recorded_is_said(topic: str, why: str) -> None:
    written = rosmonitoring("robot", 1, [topic, "/cmd_vel"], TYPES, [])
    assert written is not None and written.gaps == (f"{topic} is left out: {why}",)
    assert rosmonitoring("robot", 1, [topic], TYPES, []) is None
