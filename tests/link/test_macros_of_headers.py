# SPDX-License-Identifier: Apache-2.0
"""Functions and macros of headers that stand in branches of #if, and macros of headers that call an API: one counts, or it is said."""

from __future__ import annotations

import pytest
from follow_kit import ROS2_CMAKE, follow, node

from haros_ci.model.architecture import Node

CMAKE = ROS2_CMAKE.format("p") + "%s\nament_auto_add_executable(n src/n.cpp)\nament_auto_package()\n"
HEAD = "#include <rclcpp/rclcpp.hpp>\n#include <nav_msgs/msg/odometry.hpp>\n#include <std_srvs/srv/trigger.hpp>\ntypedef rclcpp::Node::SharedPtr Ptr;\n"
MAIN = 'int main(int argc, char** argv) { rclcpp::init(argc, argv); auto n = rclcpp::Node::make_shared("n"); %s rclcpp::spin(n); }\n'
FIRST = "template <class T> auto make(Ptr nh, const std::string& t, int size = 1, int qos = 1) { return nh->advertise<T>(t, size); }\n"
SECOND = "template <class T> auto make(Ptr nh, const std::string& t, int size = 1, rclcpp::QoS qos = 1) { return nh->create_publisher<T>(t, qos); }\n"
BOTH = f"#if V == 1\n{FIRST}#elif V == 2\n{SECOND}#endif\n"
USE = 'auto p = make<nav_msgs::msg::Odometry>(n, "t");'
SERVER = "#define SERVER(nh, T, name, cb) nh->create_service<T>(name, cb)\n"
SERVE = 'auto s = SERVER(n, std_srvs::srv::Trigger, "t", cb);'


def _node(before: str, body: str, header: str = "", cmake: str = "add_definitions(-DV=2)") -> Node:
    files = {"p/CMakeLists.txt": CMAKE % cmake, "p/src/n.cpp": HEAD + before + MAIN % body, "p/src/m.h": header}
    return node(follow(files, 2))


@pytest.mark.parametrize(
    ("before", "header"),
    [(BOTH, ""), ('#include "m.h"\n', HEAD + BOTH), (f"#if V > 1\n{SECOND}#else\n{FIRST}#endif\n", "")],
)
def test_the_function_that_is_compiled_is_called(before: str, header: str) -> None:
    found = _node(before, USE, header)
    (end,) = (end for end in found.endpoints if end.name == "/t")
    assert (end.kind, end.type, end.is_ruled_out, end.unknowns) == (
        "publishers",
        "nav_msgs/msg/Odometry",
        False,
        (),
    )


def test_of_other_signatures_the_arguments_decide() -> None:
    one = "template <class T> auto make(Ptr nh, int t) { return 1; }\n"
    assert [end.name for end in _node(one + SECOND, USE).endpoints if end.name == "/t"] == ["/t"]


def _reasons(found: Node) -> list[str]:
    return [unknown.reason for unknown in found.unknowns if "is a macro" in unknown.reason]


@pytest.mark.parametrize("header", [SERVER, f"#if V == 1\n#define SERVER(nh, T, name, cb) 1\n#else\n{SERVER}#endif\n"])
def test_a_macro_of_a_header_that_calls_an_api_is_said(header: str) -> None:
    assert _reasons(_node('#include "m.h"\n', SERVE, header)) == [
        "SERVER is a macro of another file that is not followed: it may call create_service"
    ]


@pytest.mark.parametrize(
    ("before", "body", "header"),
    [
        (SERVER, SERVE, ""),
        ('#include "m.h"\n', 'auto s = SERVER("t");', "#define SERVER(x) x.size()\n"),
        ('#include "m.h"\n', "", SERVER),
        ('#include "m.h"\n', "auto s = OTHER(n);", SERVER),
        ('#include "m.h"\n', 'RCLCPP_INFO(n->get_logger(), "t");', SERVER),
    ],
)
def test_others_are_not(before: str, body: str, header: str) -> None:
    assert _reasons(_node(before, body, header)) == []
