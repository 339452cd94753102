# SPDX-License-Identifier: Apache-2.0
"""ROS 2 C++: what a node says of its own options, and where packages are."""

from __future__ import annotations

import pytest
from follow_kit import explicit, ros2_main

HOST = 'auto node = std::make_shared<rclcpp::Node>("host"%s);\n'
OPTIONS = ", rclcpp::NodeOptions().use_intra_process_comms(true)"
WORDS = """
  auto words = node->get_node_options().arguments();
  words.push_back("--ros-args");
  words.push_back("-r");
  words.push_back(std::string("__node:=") + node->get_name() + "_client");
  auto options = node->get_node_options();
  options = options.arguments(words);
  auto client = std::make_shared<rclcpp::Node>("_", options);
"""
TWIN = 'auto twin = std::make_shared<rclcpp::Node>("twin", node->get_node_options());\n'


def test_names_of_nodes_that_options_give() -> None:
    nodes = ros2_main(HOST % OPTIONS + WORDS + TWIN).nodes
    assert [node.name for node in nodes] == ["/host", "/host_client", "/twin"]  # the host's own options stay


def test_options_that_are_not_given() -> None:
    assert [node.name for node in ros2_main(HOST % "" + WORDS).nodes] == ["/host", "/host_client"]


def test_options_that_are_not_known() -> None:
    nodes = ros2_main(HOST % ", elsewhere::options()" + WORDS).nodes
    assert [node.name for node in nodes] == ["/?/host", "/?/_"]
    assert [unknown.field for unknown in nodes[1].unknowns] == ["name"]


@pytest.mark.parametrize(
    ("path", "name"),
    (
        ('ament_index_cpp::get_package_share_directory("p") + "/src/names.yaml"', "/said"),
        ('(ament_index_cpp::get_package_share_path("p") / "src/names.yaml").string()', "/said"),
        ('ament_index_cpp::get_package_share_directory("q") + "/src/names.yaml"', "/?"),
        ('ament_index_cpp::get_package_share_directory(argv[1]) + "/src/names.yaml"', "/?"),
    ),
)
def test_files_of_packages(path: str, name: str) -> None:
    body = f"""
  auto node = std::make_shared<rclcpp::Node>("host");
  std::string path = {path};
  auto names = YAML::LoadFile(path);
  auto pub = node->create_publisher<std_msgs::msg::String>(names["topic"].as<std::string>(), 1);
"""
    made = ros2_main(body, names__yaml="topic: said\n")
    assert [end.name for end in explicit(made.nodes[0])] == [name]
