# SPDX-License-Identifier: Apache-2.0
"""Launch files of Python: an argument that ``eval`` makes a value of, as in yolo_ros, decides in an OpaqueFunction."""

from __future__ import annotations

import pytest
from follow_kit import ROS2_CMAKE, ROS2_HEAD, follow

LAUNCH = """
import ast
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, OpaqueFunction
from launch.conditions import IfCondition
from launch.substitutions import LaunchConfiguration, PythonExpression
from launch_ros.actions import Node
def generate_launch_description():
    def later(context, flag):
        flag = %s
        topic = "detections"
        if flag:
            topic = "tracking"
        return (
            Node(package="p", executable="n", name="one", remappings=[("in", topic)]),
            Node(package="p", executable="n", name="two", condition=IfCondition(PythonExpression([str(flag)]))),
        )
    flag = LaunchConfiguration("flag")
    return LaunchDescription([
        DeclareLaunchArgument("flag", default_value="%s"),
        OpaqueFunction(function=later, args=[flag]),
    ])
"""
MAIN = """int main(int argc, char ** argv) {
  rclcpp::init(argc, argv);
  auto n = std::make_shared<rclcpp::Node>("n");
  n->create_publisher<String>("in", 1);
}
"""
EVAL = "eval(context.perform_substitution(flag))"
LITERAL = "ast.literal_eval(flag.perform(context))"


def found(expression: str, default: str) -> dict[str, list[str]]:
    cmake = (
        ROS2_CMAKE.format("p") + "ament_auto_add_executable(n src/n.cpp)\nament_auto_package(INSTALL_TO_SHARE launch)\n"
    )
    files = {
        "p/CMakeLists.txt": cmake,
        "p/src/n.cpp": ROS2_HEAD + MAIN,
        "p/launch/l.launch.py": LAUNCH % (expression, default),
    }
    nodes = follow(files, 2).configurations[0].nodes
    return {node.name: [end.name for end in node.endpoints if not end.implicit] for node in nodes}


@pytest.mark.parametrize("expression", [EVAL, LITERAL])
@pytest.mark.parametrize("default", ["False", "0", "''", "[]", "None"])
def test_it_does_not_hold(expression: str, default: str) -> None:
    assert found(expression, default)["/one"] == ["/detections"]


@pytest.mark.parametrize("expression", [EVAL, LITERAL])
@pytest.mark.parametrize(
    ("default", "topic"), [("True", "/tracking"), ("1", "/tracking"), ("f()", "/?"), ("true", "/?")]
)
def test_it_holds_or_is_not_known(expression: str, default: str, topic: str) -> None:
    assert found(expression, default)["/one"] == [topic]


@pytest.mark.parametrize(("default", "nodes"), [("False", ["/one"]), ("True", ["/one", "/two"])])
def test_its_text_is_a_condition(default: str, nodes: list[str]) -> None:
    assert sorted(found(EVAL, default)) == nodes
