# SPDX-License-Identifier: Apache-2.0
"""Two nodes of one name that a process has at the same time, and what looks like them."""

from __future__ import annotations

import pytest
from follow_kit import ros2_cpp, ros2_main

CLASS = (
    "class A : public rclcpp::Node {\npublic:\nexplicit A(const std::string & name, const std::string & space = std::string(),\n"
    "const rclcpp::NodeOptions & options = rclcpp::NodeOptions()) : Node(name, space, options) {}\n};\n"
    'class Fixed : public rclcpp::Node {\npublic:\nFixed() : Node("a") { t_ = rclcpp::Node::make_shared("t"); }\nrclcpp::Node::SharedPtr t_;\n};\n'
    'void ask() {\nauto node = rclcpp::Node::make_shared("a");\nrclcpp::spin_some(node);\n}\n'
    'rclcpp::Node::SharedPtr make() {\nreturn rclcpp::Node::make_shared("a");\n}\n'
)
FIRST = 'auto one = std::make_shared<A>("a");\n'
SECOND = 'auto two = std::make_shared<A>("a");\n'


@pytest.mark.parametrize(
    ("body", "names"),
    [
        (FIRST + SECOND, ["/a"]),
        (FIRST + 'auto two = rclcpp::Node::make_shared("a");\n', ["/a"]),
        (FIRST + 'rclcpp::Node two("a");\n', ["/a"]),
        (
            "auto one = std::make_shared<Fixed>();\nauto two = std::make_shared<Fixed>();\n",
            ["/a"],
        ),  # of the helpers one place is known
        (FIRST + "auto two = std::make_shared<Fixed>();\n", ["/a"]),
        (FIRST + "ask();\n", ["/a"]),
        (FIRST + SECOND + "rclcpp::shutdown();\n", ["/a"]),
        ('auto t = rclcpp::Node::make_shared("t");\nauto two = std::make_shared<Fixed>();\n', ["/t"]),
    ],
)
def test_two_nodes_of_one_name(body: str, names: list[str]) -> None:
    found = ros2_main(body, CLASS)
    assert sorted(node.name for node in found.nodes if node.twins) == names


@pytest.mark.parametrize(
    "body",
    [
        FIRST,
        FIRST + 'auto two = std::make_shared<A>("b");\n',
        FIRST + 'auto two = std::make_shared<A>("a", "other");\n',
        FIRST + "auto two = std::make_shared<A>(argv[1]);\n",
        FIRST + "one.reset();\n" + SECOND,
        FIRST + "rclcpp::shutdown();\nrclcpp::init(argc, argv);\n" + SECOND,
        "{\n" + FIRST + "}\n" + SECOND,
        "if (argc > 1) {\n" + FIRST + "}\n" + SECOND,
        FIRST + "if (argc > 1) {\n" + SECOND + "}\n",
        "for (int i = 0; i < argc; ++i) {\n" + FIRST + "}\n" + SECOND,
        "ask();\n" + SECOND,
        "ask();\nask();\n",
        "auto one = make();\nauto two = std::make_shared<Fixed>();\n",
        FIRST
        + 'auto two = std::make_shared<A>("a", "", rclcpp::NodeOptions().arguments({"--ros-args", "-r", "__node:=b"}));\n',
        FIRST + 'auto below = one->create_sub_node("a");\n',
        FIRST + "tf2_ros::Buffer buffer(one->get_clock());\ntf2_ros::TransformListener listener(buffer);\n",
    ],
)
def test_nodes_of_other_names_or_times(body: str) -> None:
    found = ros2_main(body, CLASS)
    assert [node.name for node in found.nodes if node.twins] == []


def test_a_component_and_its_helper() -> None:
    found = ros2_cpp('helper_ = rclcpp::Node::make_shared("n");', "rclcpp::Node::SharedPtr helper_;")
    assert [node.name for node in found.nodes if node.twins] == ["/n"]
    found = ros2_cpp('helper_ = rclcpp::Node::make_shared("m");', "rclcpp::Node::SharedPtr helper_;")
    assert [node.name for node in found.nodes if node.twins] == []
