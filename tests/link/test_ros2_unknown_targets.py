# SPDX-License-Identifier: Apache-2.0
"""Remapping to names that are known in parts: a name whose beginning is not known may be absolute."""

from __future__ import annotations

import pytest

from haros_ci.graph.names import resolve_target
from haros_ci.graph.ros2_process import RemappingRule, RosNode
from haros_ci.model.location import Location

CASES = (
    ("?", "/?"),
    ("?/image", "/?/image"),
    ("/a/?", "/a/?"),
    ("a/?", "/s/a/?"),
    ("a", "/s/a"),
    ("/a", "/a"),
)


@pytest.mark.parametrize(("target", "name"), (*CASES, ("~/a", "/s/n/a")))
def test_targets(target: str, name: str) -> None:
    rule = RemappingRule("", "image", target)
    node = RosNode("/s/n", "/s", "/s", "node", "rclcpp::Node", Location("n.cpp"), rules=(rule,))
    assert (node.remap("/s/image"), node.target(rule)) == (name, name)
    assert node.remap("/s/other") == "/s/other"


@pytest.mark.parametrize(("target", "name"), CASES)
def test_targets_of_ros_1(target: str, name: str) -> None:
    assert resolve_target(target, "/s", "/s/n") == name
