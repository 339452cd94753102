# SPDX-License-Identifier: Apache-2.0
"""Parameters of a container's process: for the nodes of its components that the components are not given them for."""

from __future__ import annotations

from follow_kit import ROS2_HEAD, Architecture, explicit, follow, only, ros2_files

CHILD = (
    "class N : public rclcpp::Node {\npublic:\nexplicit N(const rclcpp::NodeOptions & options)\n"
    ': Node("n", options), child_(std::make_shared<rclcpp::Node>("child", rclcpp::NodeOptions().arguments('
    '{"--ros-args", "-r", "__node:=child"}))) {\n'
    'declare_parameter("a", "code"); child_->declare_parameter("a", "code"); declare_parameter("b", "code");\n}\n'
    "std::shared_ptr<rclcpp::Node> child_;\n};\n"
)
YAML = "n:\n  ros__parameters: {a: of_file, b: of_file}\nchild:\n  ros__parameters: {a: of_file}\n"
LAUNCH = (
    '<launch><node_container pkg="rclcpp_components" exec="component_container" name="c" namespace="">'
    '<param from="$(find-pkg-share p)/launch/y.yaml"/>'
    '<composable_node pkg="p" plugin="N" name="n"><param name="a" value="of_component"/></composable_node>'
    "</node_container></launch>"
)


def values(found: Architecture) -> dict[str, object]:
    return {end.name: end.effective for node in only(found).nodes for end in explicit(node, "parameters")}


def test_what_a_container_is_given_is_for_nodes_that_components_make() -> None:
    """A component's own node does not see what the process is given (use_global_arguments(false))."""
    files = ros2_files(ROS2_HEAD + CHILD, {"l.launch.xml": LAUNCH, "y.yaml": YAML})
    assert values(follow(files, 2)) == {"/n:a": "of_component", "/n:b": "code", "/child:a": "of_file"}


def test_what_a_component_is_given_is_for_its_own_node() -> None:
    launch = LAUNCH.replace('<param from="$(find-pkg-share p)/launch/y.yaml"/>', "")
    files = ros2_files(ROS2_HEAD + CHILD, {"l.launch.xml": launch, "y.yaml": YAML})
    assert values(follow(files, 2)) == {"/n:a": "of_component", "/n:b": "code", "/child:a": "code"}
