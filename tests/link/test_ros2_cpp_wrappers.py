# SPDX-License-Identifier: Apache-2.0
"""ROS 2 C++: node classes of the workspace that wrap the client library's functions."""

from __future__ import annotations

import pytest
from follow_kit import ends, ros2_main

BASE = """
namespace own {
class Node : public rclcpp::Node {
public:
  Node(const std::string & name) : rclcpp::Node(name) {}
  template<typename T> typename rclcpp::Publisher<T>::SharedPtr create_publisher(const std::string & topic) {
    return rclcpp::create_publisher<T>(*this, "own/" + topic, rclcpp::QoS(7));
  }
};
}
namespace app {
class N : public own::Node {
public:
  N() : own::Node("n") { %s }
};
}
"""


@pytest.mark.parametrize(
    "call",
    (
        'create_publisher<std_msgs::msg::String>("out");',
        'this->create_publisher<std_msgs::msg::String>("out");',
        'own::Node::create_publisher<std_msgs::msg::String>("out");',
    ),
)
def test_a_base_class_of_the_workspace_is_called_before_that_of_the_library(call: str) -> None:
    (node,) = ros2_main("rclcpp::spin(std::make_shared<app::N>());", BASE % call).nodes
    (end,) = (end for end in ends(node, "publishers") if not end.implicit)
    assert (end.name, end.qos and end.qos.depth) == ("/own/out", 7)
