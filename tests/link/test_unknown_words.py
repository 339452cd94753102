# SPDX-License-Identifier: Apache-2.0
"""ROS 2: words of a command line beside one that is not known are known, where that is one word for certain."""

from __future__ import annotations

import pytest
from follow_kit import ROS2_CMAKE, ROS2_HEAD, explicit, follow

from haros_ci.model.architecture import Node

LAUNCH = """
import os
from launch import LaunchDescription
from launch.substitutions import EnvironmentVariable, LaunchConfiguration
from launch_ros.actions import Node
def generate_launch_description():
    found = os.listdir("/x")
    return LaunchDescription([Node(package="p", executable="n", name="n", arguments=%s)])
"""
MAIN = """int main(int argc, char ** argv) {
  rclcpp::init(argc, argv);
  auto n = std::make_shared<rclcpp::Node>("n");
  n->create_publisher<String>(std::string("one/") + argv[1], 1);
  n->create_publisher<String>(std::string("two/") + argv[2], 1);
  if (std::string(argv[2]) == "no") { n->create_publisher<String>("three", 1); }
}
"""


def started(launch: str, name: str) -> Node:
    cmake = (
        ROS2_CMAKE.format("p") + "ament_auto_add_executable(n src/n.cpp)\nament_auto_package(INSTALL_TO_SHARE launch)\n"
    )
    files = {"p/CMakeLists.txt": cmake, "p/src/n.cpp": ROS2_HEAD + MAIN, f"p/launch/{name}": launch}
    return follow(files, 2).configurations[0].nodes[0]


@pytest.mark.parametrize(
    ("words", "expected", "is_ruled_out"),
    [
        ('[str(found), "b"]', ["/one/?", "/two/b"], True),
        ('["a", str(found)]', ["/one/a", "/two/?"], False),
        ('[EnvironmentVariable("X"), "no"]', ["/one/?", "/two/no"], False),
        ('[str(found), "b b"]', ["/one/?", "/two/b b"], True),
        ('["a", "b"]', ["/one/a", "/two/b"], True),
        # how many words there are is not known
        ("found", ["/one/?", "/two/?"], False),
        ('[*found, "b"]', ["/one/?", "/two/?"], False),
        ('["a"] + found', ["/one/?", "/two/?"], False),
        ('["a", *found]', ["/one/?", "/two/?"], False),
        ('["a", [EnvironmentVariable("X"), " c"]]', ["/one/?", "/two/?"], False),
    ],
)
def test_of_a_list_in_python(words: str, expected: list[str], is_ruled_out: bool) -> None:
    found = {end.name: end.is_ruled_out for end in explicit(started(LAUNCH % words, "l.launch.py"))}
    assert found == {**dict.fromkeys(expected, False), "/three": is_ruled_out}


@pytest.mark.parametrize("words", ["$(env X) b", "a $(env X)", "$(env X)"])
def test_in_xml_they_may_be_several(words: str) -> None:
    launch = f'<launch><node pkg="p" exec="n" name="n" args="{words}"/></launch>'
    found = explicit(started(launch, "l.launch.xml"))
    assert [end.name for end in found if not end.is_ruled_out] == ["/one/?", "/two/?", "/three"]
