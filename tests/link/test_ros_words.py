# SPDX-License-Identifier: Apache-2.0
"""ROS 2, Python: the command line without the words that ROS takes for itself (``rclpy.utilities.remove_ros_args``)."""

from __future__ import annotations

import pytest
from follow_kit import ROS2_CMAKE, follow, only

PROGRAM = """#!/usr/bin/env python3
import argparse
import sys
import rclpy
import rclpy.utilities
from rclpy.node import Node
from rclpy.utilities import remove_ros_args
from std_msgs.msg import String


def main(argv=sys.argv):
    rclpy.init(args=argv)
    parser = argparse.ArgumentParser()
    parser.add_argument('--names', nargs='*', default=['d'])
    parser.add_argument('--prefix', default='p')
    {}
    for name in args.names:
        node = Node(f'n_{{name}}')
        node.create_publisher(String, f'{{args.prefix}}_{{name}}', 10)
        rclpy.spin(node)


if __name__ == '__main__':
    main(sys.argv)
"""
LAUNCH = """from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([Node(package='p', executable='n.py', arguments={})])
"""


def topics(code: str, arguments: str | None) -> list[str]:
    cmake = (
        ROS2_CMAKE.format("p")
        + "install(PROGRAMS n.py DESTINATION lib/p)\nament_auto_package(INSTALL_TO_SHARE launch)\n"
    )
    files = {"p/CMakeLists.txt": cmake, "p/n.py": PROGRAM.format(code)}
    if arguments is not None:
        files["p/launch/l.launch.py"] = LAUNCH.format(arguments)
    found = only(follow(files, 2))
    return sorted(
        end.name for node in found.nodes for end in node.endpoints if end.kind == "publishers" and not end.implicit
    )


READ = [
    "args = parser.parse_args(rclpy.utilities.remove_ros_args(argv)[1:])",
    "args = parser.parse_args(remove_ros_args(argv)[1:])",
    "args = parser.parse_args(args=remove_ros_args(args=argv)[1:])",
    "args = parser.parse_args(remove_ros_args(sys.argv)[1:])",
    "args = parser.parse_args(remove_ros_args()[1:])",
    "args, others = parser.parse_known_args(remove_ros_args(argv)[1:])",
]


@pytest.mark.parametrize("code", READ)
def test_the_words_of_a_launch_file_are_read(code: str) -> None:
    assert topics(code, "['--names', 'a', 'b', '--prefix', 'x']") == ["/x_a", "/x_b"]
    assert topics(code, "[]") == topics(code, None) == ["/p_d"]


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        ("['--names', 'a', '--ros-args', '-p', 'q:=1']", ["/p_a"]),
        ("['--ros-args', '-p', 'q:=1', '--', '--names', 'a']", ["/p_a"]),
        ("['--ros-args', '--log-level', 'info']", ["/p_d"]),
    ],
)
def test_words_of_ros_are_left_out(arguments: str, expected: list[str]) -> None:
    assert topics(READ[0], arguments) == expected


@pytest.mark.parametrize(
    ("code", "arguments"),
    [
        (READ[0], "['--names', LaunchConfiguration('x')]"),
        (READ[0], "['--unheard', 'a']"),
        ("args = parser.parse_args(remove_ros_args(unheard())[1:])", "['--names', 'a']"),
        ("args = parser.parse_args(clean(argv)[1:])", "['--names', 'a']"),
    ],
)
def test_what_is_not_known_stays_so(code: str, arguments: str) -> None:
    assert all("?" in topic for topic in topics(code, arguments))
