# SPDX-License-Identifier: Apache-2.0
"""Nodes and node handles that are given to a library which is not in the workspace: the node says that there may be more on it."""

from __future__ import annotations

import pytest
from follow_kit import cpp, ros2_cpp

from haros_ci.follow.ros.given_nodes import GIVEN
from haros_ci.model.architecture import Node

START = GIVEN.partition("{")[0]

OUTSIDE = "namespace outside { class Driver; }\nstruct Mine { Mine(ros::NodeHandle n) {} };\nvoid mine(ros::NodeHandle & n) {}\n"
OUTSIDE += "class Derived : public outside::Base { public: Derived(ros::NodeHandle n) : outside::Base(n) {} };\n"
OUTSIDE += "class Held { public: Held(ros::NodeHandle n) : d_(n) {} outside::Driver d_; };\n"

#: What a program of ROS 1 does with its node handle, and who is named.
FIRES = (
    ("outside::Driver d(nh);", "outside::Driver"),
    ('outside::Driver d(&nh, "x");', "outside::Driver"),
    ("auto d = std::make_shared<outside::Driver>(nh);", "outside::Driver"),
    ("outside::make(nh);", "outside::make"),
    ("Derived d(nh);", "outside::Base"),
    ("Held h(nh);", "outside::Driver"),
    ("outside::Driver d(1); d.start(nh);", "outside::Driver::start"),
    ("using namespace outside; Sensor s(nh);", "Sensor"),
)
QUIET = (
    "outside::Driver d(1);",
    "Mine m(nh);",
    "mine(nh);",
    "auto m = std::make_shared<Mine>(nh);",
    "std::thread t([&nh]() { nh.ok(); }); t.join();",
    "tf::TransformListener t(nh);",
    "image_transport::ImageTransport it(nh);",
    "message_filters::Subscriber<std_msgs::String> s(nh, text(), 1);",
    "ros::NodeHandle inner(nh, text());",
    "std::vector<ros::NodeHandle> v; v.push_back(nh);",
    'LOG_IT(nh, "x");',
    "QTimer timer(nh);",
    "QObject::connect(nh, text());",
    "callback(nh);",
    "f_(nh);",
    "assert(nh.ok());",
)


def reasons(found: Node) -> list[str]:
    return [item.reason for item in found.unknowns if item.reason.startswith(START)]


@pytest.mark.parametrize(("code", "name"), FIRES)
def test_a_library_is_given_a_handle(code: str, name: str) -> None:
    found = cpp(f'ADV("a", 1); {code}', OUTSIDE + "std::string text();\n")
    assert reasons(found) == [GIVEN.format(name)]


@pytest.mark.parametrize("code", QUIET)
def test_no_library_is_given_a_handle(code: str) -> None:
    assert reasons(cpp(f'ADV("a", 1); {code}', OUTSIDE + "std::string text();\n")) == []


#: The same in ROS 2, with how often it is said.
ROS2 = (
    ("outside::make(*this);", 1),
    ("d_ = std::make_shared<outside::Driver>(this);", 1),
    ("m_ = std::make_shared<Mine>(this);", 0),
    ("RCLCPP_INFO(get_logger(), text());", 0),
    ("b_ = std::make_shared<tf2_ros::TransformBroadcaster>(this);", 0),
    ("s_.subscribe(this, text());", 0),
    ("std::bind(&N::cb, this);", 0),
)


@pytest.mark.parametrize(("code", "count"), ROS2)
def test_nodes_of_ros2(code: str, count: int) -> None:
    members = (
        "void cb() {}\nstd::shared_ptr<outside::Driver> d_;\nstd::shared_ptr<Mine> m_;\nstd::shared_ptr<tf2_ros::TransformBroadcaster> b_;\n"
        "message_filters::Subscriber<String> s_;"
    )
    (found,) = ros2_cpp(
        f'create_publisher<String>("a", 1); {code}', members, "struct Mine { Mine(rclcpp::Node * n) {} };\n"
    ).nodes
    assert len(reasons(found)) == count
