# SPDX-License-Identifier: Apache-2.0
"""Messages through a namespace that is opened again to bring in an inner one, and through a macro that stands for a namespace."""

from __future__ import annotations

import pytest
from follow_kit import ROS2_CMAKE, follow, node

CMAKE = ROS2_CMAKE.format("p") + "%s\nament_auto_add_executable(n src/n.cpp)\nament_auto_package()\n"
HEAD = "#include <rclcpp/rclcpp.hpp>\n#include <own_msgs/msg/odometry_message0104.hpp>\n#include <nav_msgs/msg/odometry.hpp>\n"
MAIN = 'int main(int argc, char** argv) {\nrclcpp::init(argc, argv);\n%s\nauto p = n->create_publisher<%s>("t", 1);\nrclcpp::spin(n);\n}\n'
NODE = 'auto n = rclcpp::Node::make_shared("n");'
OWN = "own_msgs/msg/OdometryMessage0104"
TOLD = (
    ("namespace own_msgs { using namespace msg; }", "own_msgs::OdometryMessage0104", OWN),
    ("namespace own_msgs { using namespace own_msgs::msg; }", "own_msgs::OdometryMessage0104", OWN),
    ("namespace own_msgs { using namespace ::own_msgs::msg; }", "own_msgs::OdometryMessage0104", OWN),
    ("namespace nav_msgs { using namespace msg; }", "nav_msgs::Odometry", "nav_msgs/msg/Odometry"),
    ("#define ros_nav nav_msgs::msg", "ros_nav::Odometry", "nav_msgs/msg/Odometry"),
    ("#define ros_own own_msgs::msg", "ros_own::OdometryMessage0104", OWN),
    ("#define ros_own own_msgs", "ros_own::msg::OdometryMessage0104", OWN),
    ("#if V == 1\n#define m own_msgs\n#elif V == 2\n#define m own_msgs::msg\n#endif", "m::OdometryMessage0104", OWN),
)
NOT_TOLD = (
    ("namespace other { using namespace msg; }", "own_msgs::OdometryMessage0104"),
    ("namespace own_msgs { using namespace srv; }", "own_msgs::OdometryMessage0104"),
    ("#if W\n#define m own_msgs::msg\n#else\n#define m nav_msgs::msg\n#endif", "m::OdometryMessage0104"),
    ("#define m own_msgs::msg::", "m::OdometryMessage0104"),
    ("#define m m", "m::OdometryMessage0104"),
)


def _type(before: str, kind: str) -> str | None:
    files = {
        "p/CMakeLists.txt": CMAKE % "add_definitions(-DV=2)",
        "p/src/n.cpp": f"{HEAD}{before}\n" + MAIN % (NODE, kind),
    }
    (found,) = (end for end in node(follow(files, 2)).endpoints if end.name == "/t")
    return found.type


@pytest.mark.parametrize(("before", "kind", "expected"), TOLD)
def test_it_is_told(before: str, kind: str, expected: str) -> None:
    assert _type(before, kind) == expected


@pytest.mark.parametrize(("before", "kind"), NOT_TOLD)
def test_it_is_not_told(before: str, kind: str) -> None:
    assert _type(before, kind) is None


VERSIONS = """#if __V == 0
int n = 0;
#elif __V == 1
auto n = rclcpp::Node::make_shared("one");
#elif __V == 2
auto n = rclcpp::Node::make_shared("two");
#else
#error no version
#endif"""
FROM_ROS = (
    "if(NOT DEFINED ROS_VERSION AND DEFINED ENV{ROS_VERSION})\nset(ROS_VERSION $ENV{ROS_VERSION})\nendif()\n"
    "add_compile_options(-D__V=${ROS_VERSION})",
    "if(DEFINED ROS_VERSION)\nadd_compile_options(-D__V=${ROS_VERSION})\nelse()\nadd_compile_options(-D__V=0)\nendif()",
    "if(ROS_VERSION EQUAL 2)\nadd_definitions(-D__V=2)\nelse()\nadd_definitions(-D__V=1)\nendif()",
    "add_definitions(-D__V=$ENV{ROS_VERSION})",
)


def _ends(cmake: str) -> list[tuple[str, list[str]]]:
    files = {
        "p/CMakeLists.txt": CMAKE % cmake,
        "p/src/n.cpp": HEAD + MAIN % (VERSIONS.replace("#if", "\n#if", 1), "nav_msgs::msg::Odometry"),
        "p/package.xml": "<package><name>p</name></package>",
    }
    found = follow(files, 2).configurations
    ends = [end for one in found for inner in one.nodes for end in inner.endpoints if end.name == "/t"]
    return [("made" if not end.is_ruled_out else "out", [u.reason for u in end.unknowns]) for end in ends]


@pytest.mark.parametrize("cmake", FROM_ROS)
def test_the_version_of_ros_decides(cmake: str) -> None:
    assert _ends(cmake) == [("made", [])]


@pytest.mark.parametrize("cmake", ["", "add_definitions(-D__V=${OTHER_VERSION})"])
def test_what_a_build_alone_knows_does_not(cmake: str) -> None:
    assert any(reasons for _, reasons in _ends(cmake))
