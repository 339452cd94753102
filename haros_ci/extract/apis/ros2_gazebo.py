# SPDX-License-Identifier: Apache-2.0
"""API rows of gazebo_ros (C++, ROS 2): the node of a plug-in of Gazebo Classic (gazebo_ros/node.hpp)."""

from __future__ import annotations

from collections.abc import Mapping

# fmt: off
ROWS: tuple[Mapping[str, object], ...] = (
    {"class": "gazebo_ros::Node", "bases": ["rclcpp::Node"]},
    # The simulator's own node.
    {"call": "gazebo_ros::Node::Get", "args": [0], "makes": [{"kind": "node", "name": "gazebo"}],
     "returns": "gazebo_ros::Node"},
    # Its name is that of the plug-in, or the second argument; its namespace stands in the description, too.
    {"call": "gazebo_ros::Node::Get", "args": [1], "makes": [{"kind": "node", "name": "{0}", "namespace": "{0}"}],
     "returns": "gazebo_ros::Node"},
    {"call": "gazebo_ros::Node::Get", "args": [2], "makes": [{"kind": "node", "name": "{1}", "namespace": "{0}"}],
     "returns": "gazebo_ros::Node"},
    *({"call": f"gazebo_ros::Node::{name}", "args": [0]} for name in ("get_qos", "Initialize")),
    {"call": "gazebo_ros::Executor", "args": [0]},
)
