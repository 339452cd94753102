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


@pytest.mark.parametrize(
    "header",
    [
        f"#if V == 1\n#define SERVER(nh, T, name, cb) 1\n#else\n{SERVER}#endif\n",
        SERVER.replace("cb)\n", "cb) }\n"),  # no expression
        SERVER + SERVER.replace("name,", '"other",'),
    ],
)
def test_a_macro_of_a_header_that_is_not_followed_is_said(header: str) -> None:
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


PUBLISH = "#define PUB(n, T, name) auto name##_pub = n->create_publisher<T>(#name, 5)\n"
LATCHED = "#define READ(n, name) n->declare_parameter(#name, 1.5)\n"
NESTED = PUBLISH + "#define BOTH(n, name) PUB(n, std_msgs::msg::Bool, name); READ(n, name)\n" + LATCHED
LISTED = "#define TOPICS(X) X(one) X(two)\n"
MINE = '#define PUB(n, T, name) auto q = n->create_publisher<T>("mine", 5)\n'


def _ends(before: str, body: str, header: str) -> list[str]:
    ends = [end for end in _node(before, body, header).endpoints if not end.implicit]
    return sorted(f"{end.name} {end.type}" for end in ends if end.kind != "getters")


INCLUDED = '#include "m.h"\n'


@pytest.mark.parametrize(
    ("before", "body", "header", "expected"),
    [
        (INCLUDED, "PUB(n, std_msgs::msg::Bool, a);", PUBLISH, ["/a std_msgs/msg/Bool"]),
        (INCLUDED, SERVE, SERVER, ["/t std_srvs/srv/Trigger"]),
        (INCLUDED, "READ(n, rate);", LATCHED, ["/n:rate double"]),
        (INCLUDED, "BOTH(n, a);", NESTED, ["/a std_msgs/msg/Bool", "/n:a double"]),
        (
            INCLUDED,
            "\n#define ADD(name) auto name##_p = n->create_publisher<std_msgs::msg::Bool>(#name, 1);\nTOPICS(ADD)\n",
            LISTED,
            ["/one std_msgs/msg/Bool", "/two std_msgs/msg/Bool"],
        ),
        # the file's own definition, no include, and texts
        (INCLUDED + MINE, "PUB(n, std_msgs::msg::Bool, a);", PUBLISH, ["/mine std_msgs/msg/Bool"]),
        ("", "PUB(n, std_msgs::msg::Bool, a);", PUBLISH, []),
        ('#include "other/m.h"\n', "PUB(n, std_msgs::msg::Bool, a);", PUBLISH, []),
        (INCLUDED, 'std::string s = "PUB(n, std_msgs::msg::Bool, a)";', PUBLISH, []),
        # macros that call themselves, or have too few arguments
        (INCLUDED, "A(n);", "#define A(n) B(n); n->create_publisher<T>(1)\n#define B(n) A(n)\n", []),
        (INCLUDED, "PUB(n);", PUBLISH, []),
    ],
)
def test_a_macro_of_a_header_is_followed(before: str, body: str, header: str, expected: list[str]) -> None:
    head = "#include <std_msgs/msg/bool.hpp>\n"
    found = [end for end in _ends(head + before, body, header) if "None" not in end]
    assert found == expected


def test_what_a_macro_makes_is_at_its_use() -> None:
    (end,) = (end for end in _node(INCLUDED, "\n" + SERVE, SERVER).endpoints if end.name == "/t")
    assert end.location is not None and (end.location.path, end.location.line) == ("p/src/n.cpp", 7)


def test_a_header_over_another_one() -> None:
    files = {
        "p/CMakeLists.txt": CMAKE % "",
        "p/src/n.cpp": HEAD + '#include "p/all.h"\n' + MAIN % SERVE,
        "p/include/p/all.h": '#pragma once\n#include "p/detail/m.h"\n',
        "p/include/p/detail/m.h": SERVER,
    }
    assert [end.type for end in node(follow(files, 2)).endpoints if end.name == "/t"] == ["std_srvs/srv/Trigger"]
