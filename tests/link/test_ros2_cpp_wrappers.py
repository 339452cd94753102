# SPDX-License-Identifier: Apache-2.0
"""ROS 2 C++: node classes of the workspace that wrap the client library's functions."""

from __future__ import annotations

import pytest
from follow_kit import ROS2_HEAD, ends, explicit, ros2_main

BASE = """
namespace own {
class Node : public rclcpp::Node {
public:
  Node(const std::string & name) : rclcpp::Node(name) {}
  template<typename T> typename rclcpp::Publisher<T>::SharedPtr create_publisher(const std::string & topic) {
    return rclcpp::create_publisher<T>(*this, "own/" + topic, rclcpp::QoS(7));
  }
};
}
namespace app {
class N : public own::Node {
public:
  N() : own::Node("n") { %s }
};
}
"""


@pytest.mark.parametrize(
    "call",
    (
        'create_publisher<std_msgs::msg::String>("out");',
        'this->create_publisher<std_msgs::msg::String>("out");',
        'own::Node::create_publisher<std_msgs::msg::String>("out");',
    ),
)
def test_a_base_class_of_the_workspace_is_called_before_that_of_the_library(call: str) -> None:
    (node,) = ros2_main("rclcpp::spin(std::make_shared<app::N>());", BASE % call).nodes
    (end,) = (end for end in ends(node, "publishers") if not end.implicit)
    assert (end.name, end.qos and end.qos.depth) == ("/own/out", 7)


ARGUMENTS = """
inline void put(std::vector<std::string> & words, const std::string & name, const std::string & word) {
  auto found = std::find_if(words.begin(), words.end(),
    [name](const std::string & each) { return each.find(name) != std::string::npos; });
  if (found != words.end()) { *found = word; }
  else { words.push_back("--ros-args"); words.push_back("-r"); words.push_back(word); }
}
class Child : public rclcpp::Node {
public:
  static rclcpp::NodeOptions options_of(const rclcpp::NodeOptions & parent) {
    std::vector<std::string> words = parent.arguments();
    put(words, "__ns", "__ns:=/below");
    put(words, "__node", std::string("child:") + "__node:=child");
    return rclcpp::NodeOptions().arguments(words);
  }
  Child(const std::string & name, const rclcpp::NodeOptions & parent) : rclcpp::Node(name, "", options_of(parent)) {}
};
"""


@pytest.mark.parametrize(
    "options",
    (
        "rclcpp::NodeOptions()",
        'rclcpp::NodeOptions().arguments({"--ros-args", "-r", "__ns:=/else"})',
        'rclcpp::NodeOptions().arguments({"--ros-args", "-r", "__node:=else", "-r", "__ns:=/else"})',
    ),
)
def test_arguments_that_are_put_together_for_another_node(options: str) -> None:
    (node,) = ros2_main(f'rclcpp::spin(std::make_shared<Child>("child", {options}));', ARGUMENTS).nodes
    assert node.name == "/below/child"


def test_arguments_that_are_not_known() -> None:
    body = 'rclcpp::spin(std::make_shared<Child>("child", rclcpp::NodeOptions().arguments(words_from_file())));'
    (node,) = ros2_main(body, ARGUMENTS).nodes
    assert node.name == "/?"


def test_a_list_that_is_given_its_length_and_then_its_elements() -> None:
    text = """
    class N : public rclcpp::Node {
    public:
      N() : rclcpp::Node("n"), ids_{"a", "b"} {
        create_wall_timer(1s, [this]() { names_.clear(); });
        create_wall_timer(1s, [this]() { start(); });
      }
      void start() {
        names_.resize(ids_.size());
        for (size_t i = 0; i < ids_.size(); ++i) { names_[i] = "of_" + ids_[i]; }
        for (const auto & name : names_) { create_publisher<std_msgs::msg::String>(name, 1); }
      }
      std::vector<std::string> ids_;
      std::vector<std::string> names_;
    };
    """
    (node,) = ros2_main("rclcpp::spin(std::make_shared<N>());", text).nodes
    assert [end.name for end in ends(node, "publishers") if not end.implicit] == ["/of_a", "/of_b"]


ASKING = """
template<typename T> T declare_or_get_parameter(rclcpp::Node * node, const std::string & name, const T & value) {
  if (!node->has_parameter(name)) {
    return node->declare_parameter<T>(name, value);
  }
  return node->get_parameter(name).get_value<T>();
}
class N : public rclcpp::Node {
public:
  N() : rclcpp::Node("n") { %s }
};
"""


@pytest.mark.parametrize(
    ("body", "told"),
    (
        ('declare_or_get_parameter<int>(this, "a", 1);', [("parameters", "/n:a", False)]),
        (
            'declare_or_get_parameter<int>(this, "a", 1); declare_or_get_parameter<int>(this, "a", 2);',
            [("parameters", "/n:a", False), ("getters", "/n:a", False)],
        ),
        (
            'if (flag()) { declare_or_get_parameter<int>(this, "a", 1); } declare_or_get_parameter<int>(this, "a", 2);',
            [("parameters", "/n:a", True), ("parameters", "/n:a", True), ("getters", "/n:a", False)],
        ),
        (
            'if (has_parameter("a")) { get_parameter("a"); } else { declare_parameter("a", 1); }',
            [("parameters", "/n:a", True), ("getters", "/n:a", True)],
        ),
    ),
)
def test_what_a_wrapper_does_not_do_as_things_are_is_not_told(body: str, told: list[tuple[str, str, bool]]) -> None:
    (node,) = ros2_main("rclcpp::spin(std::make_shared<N>());", ASKING % body).nodes
    found = [
        (kind, end.name, bool(end.conditions))
        for kind in ("parameters", "getters")
        for end in ends(node, kind)
        if not end.implicit
    ]
    assert found == told


OF_A_MACRO = (
    "#define PLAIN 1\n#define LIFECYCLE 2\n#define KIND %s\n#if KIND == PLAIN\n#define BASE rclcpp::Node\n"
    "#elif KIND == LIFECYCLE\n#define BASE rclcpp_lifecycle::LifecycleNode\n#endif\n"
    "class B : public BASE {\npublic:\nexplicit B(const std::string & name) : BASE(name) {}\n"
    "template <typename T> T getParameter(const std::string & name, const T & value) {\n"
    "if (!this->has_parameter(name)) { this->declare_parameter<T>(name, value); }\nreturn this->get_parameter(name).template get_value<T>();\n}\n};\n"
    'class N : public B {\npublic:\nN() : B("n") { t_ = this->getParameter<std::string>("t", "a"); }\nstd::string t_;\n};\n'
)


@pytest.mark.parametrize("kind", ("PLAIN", "LIFECYCLE"))
def test_the_base_of_a_node_is_a_macro(kind: str) -> None:
    """The parameter stands where the method that declares it is called."""
    before = "#include <rclcpp_lifecycle/lifecycle_node.hpp>\n" + OF_A_MACRO % kind
    (found,) = ros2_main("rclcpp::spin(std::make_shared<N>()->get_node_base_interface());", before).nodes
    (end,) = [each for each in explicit(found, "parameters") if each.original_name.endswith(":t")]
    line = (ROS2_HEAD + before).split("\n").index(
        'N() : B("n") { t_ = this->getParameter<std::string>("t", "a"); }'
    ) + 1
    assert (found.name, end.name, end.value, end.location.line) == ("/n", "/n:t", "a", line)
