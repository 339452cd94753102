# SPDX-License-Identifier: Apache-2.0
"""Parameters of a container's process: for the nodes of its components that the components are not given them for."""

from __future__ import annotations

from pathlib import Path

import pytest
from follow_kit import ROS2_HEAD, Architecture, Nothing, explicit, follow, only, ros2_files, workspace

from haros_ci.analysis.architecture import architecture
from haros_ci.config.settings import Settings

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


def test_a_known_container_has_no_services_of_parameters() -> None:
    """component_manager.hpp, since Galactic: start_parameter_services(false) and start_parameter_event_publisher(false)."""
    files = ros2_files(ROS2_HEAD + CHILD, {"l.launch.xml": LAUNCH})
    settings = Settings(root=Path("/nowhere"))
    found = architecture(workspace(files, 2), settings, Nothing(), environment={})
    container = next(node for node in only(found).nodes if node.name == "/c")
    assert sorted(end.name for end in container.endpoints if end.kind == "servers") == [
        "/c/_container/list_nodes",
        "/c/_container/load_node",
        "/c/_container/unload_node",
        "/c/get_type_description",
    ]
    assert [end.name for end in container.endpoints if end.kind == "publishers"] == ["/rosout"]


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


@pytest.mark.parametrize(
    "options",
    (
        "options",
        "rclcpp::NodeOptions(options)",
        "rclcpp::NodeOptions{options}",
        "rclcpp::NodeOptions(options).allow_undeclared_parameters(false).start_parameter_services(true)",
        "rclcpp::NodeOptions(rclcpp::NodeOptions(options).enable_rosout(true))",
        "with_more(options)",
        "from_elsewhere(options)",
        "from_elsewhere(options).enable_rosout(true)",
    ),
)
def test_a_component_that_copies_its_options_has_the_name_that_it_is_given(options: str) -> None:
    code = (
        "rclcpp::NodeOptions with_more(const rclcpp::NodeOptions & given) { rclcpp::NodeOptions all(given); all.enable_rosout(true); return all; }\n"
        "class N : public rclcpp::Node {\npublic:\nexplicit N(const rclcpp::NodeOptions & options)\n"
        f': Node("of_code", {options}) {{ declare_parameter("a", 1); }}\n}};\n'
    )
    files = ros2_files(ROS2_HEAD + code, {"l.launch.xml": LAUNCH.replace('namespace=""', 'namespace="x"', 1)})
    assert sorted(node.name for node in only(follow(files, 2)).nodes) == ["/n", "/x/c"]


@pytest.mark.parametrize("options", ("", ", rclcpp::NodeOptions()", ", rclcpp::NodeOptions().enable_rosout(true)"))
def test_a_component_that_does_not_use_its_options_has_the_name_of_its_container(options: str) -> None:
    code = (
        "class N : public rclcpp::Node {\npublic:\nexplicit N(const rclcpp::NodeOptions & options)\n"
        f': Node("of_code"{options}) {{ declare_parameter("a", 1); }}\n}};\n'
    )
    files = ros2_files(ROS2_HEAD + code, {"l.launch.xml": LAUNCH})
    assert [node.name for node in only(follow(files, 2)).nodes] == ["/c", "/c"]


def test_what_a_copy_of_options_is_given_is_not_for_the_original() -> None:
    code = (
        "class N : public rclcpp::Node {\npublic:\nexplicit N(const rclcpp::NodeOptions & options)\n"
        ': Node("of_code", options), child_(std::make_shared<rclcpp::Node>("child", rclcpp::NodeOptions(options).arguments('
        '{"--ros-args", "-r", "__node:=child"}))), last_(std::make_shared<rclcpp::Node>("last", options)) {\n'
        "}\nstd::shared_ptr<rclcpp::Node> child_, last_;\n};\n"
    )
    files = ros2_files(ROS2_HEAD + code, {"l.launch.xml": LAUNCH})
    assert sorted({node.name for node in only(follow(files, 2)).nodes}) == ["/c", "/child", "/n"]
