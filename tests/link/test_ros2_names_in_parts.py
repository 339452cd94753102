# SPDX-License-Identifier: Apache-2.0
"""ROS 2 C++: parameters of which the name is known in parts, types of parameters, names that are one of several."""

from __future__ import annotations

from typing import Any

import pytest
from follow_kit import ROS2_CMAKE, ROS2_HEAD, explicit, follow, ros2_cpp

from haros_ci.model.architecture import Endpoint


def found(body: str, launch: str = "", before: str = "") -> list[Endpoint]:
    """What a program makes whose ``main`` has a *node* and this body; started alone, or with the parameters in *launch*."""
    cmake = ROS2_CMAKE.format("p") + (
        "ament_auto_add_executable(n src/n.cpp)\nament_auto_package(INSTALL_TO_SHARE launch)\n"
    )
    main = 'int main(int argc, char ** argv) { rclcpp::init(argc, argv); rclcpp::Node node("n");\n'
    files = {"p/CMakeLists.txt": cmake, "p/src/n.cpp": f"{ROS2_HEAD}{before}{main}{body}}}"}
    if launch:
        node = f'<node pkg="p" exec="n">{launch}</node>'
        files["p/launch/x.launch.xml"] = f"<launch>{node}</launch>"
    nodes = [node for each in follow(files, 2).configurations for node in each.nodes]
    return [end for node in nodes for end in node.endpoints if not end.implicit]


def publishers(*args: Any) -> list[tuple[str, list[str]]]:
    made = [each for each in found(*args) if each.kind == "publishers"]
    return sorted((each.name, [unknown.field for unknown in each.unknowns]) for each in made)


PUBLISH = (
    'node.create_publisher<std_msgs::msg::String>(node.declare_parameter(std::string(argv[1]) + ".topic", "x"), 1);'
)


def test_what_nobody_can_set_has_its_default() -> None:
    assert publishers(PUBLISH) == [("/x", [])]
    assert publishers(PUBLISH, '<param name="other" value="y"/>') == [("/x", [])]


def test_what_somebody_may_set_is_not_known() -> None:
    assert publishers(PUBLISH, '<param name="a.topic" value="y"/>') == [("/?", ["name"])]
    declared = 'node.declare_parameter("a.topic", "z");' + PUBLISH.replace("declare_parameter(", "declare_parameter(")
    assert publishers(declared) == [("/?", ["name"])]
    of_any_name = 'node.create_publisher<std_msgs::msg::String>(node.declare_parameter(std::string(argv[1]), "x"), 1);'
    assert publishers(of_any_name) == [("/?", ["name"])]


def test_has_parameter_of_a_name_that_is_known_in_parts() -> None:
    body = (
        'std::string name = std::string(argv[1]) + ".topic"; std::string topic;\n'
        'if (!node.has_parameter(name)) node.declare_parameter(name, "x");\n'
        "node.get_parameter(name, topic); node.create_publisher<std_msgs::msg::String>(topic, 1);"
    )
    assert publishers(body) == [("/x", [])]
    assert publishers('node.declare_parameter("own.topic", "y");' + body) == [("/?", ["name"])]


GET = """
template<typename T> T obtain(rclcpp::Node & node, const std::string & name) {
  auto kind = rclcpp::ParameterValue{T{}}.get_type();
  auto parameter = node.declare_parameter(name, kind);
  if (parameter.get_type() == rclcpp::ParameterType::PARAMETER_NOT_SET) { throw std::runtime_error(name); }
  return parameter.template get<T>();
}
"""


def test_types_that_values_tell() -> None:
    body = 'obtain<double>(node, "d"); obtain<std::vector<std::string>>(node, "l"); obtain<bool>(node, "b");'
    body += 'node.create_publisher<std_msgs::msg::String>(obtain<std::string>(node, "s"), 1);'
    made = found(body, '<param name="s" value="given"/>', GET)
    types = {each.name.partition(":")[2]: each.type for each in made if each.kind == "parameters"}
    assert types == {"d": "double", "l": "str[]", "b": "bool", "s": "str"}
    assert [each.name for each in made if each.kind == "publishers"] == ["/given"]


def test_names_that_are_one_of_several() -> None:
    several = 'std::string name; if (std::rand()) name = "a"; else if (std::rand()) name = "b";'
    publish = "if (!name.empty()) node.create_publisher<std_msgs::msg::String>(name, 1);"
    assert publishers(several + publish) == [("/a", ["conditions"]), ("/b", ["conditions"])]
    some = 'std::string name = "a"; if (std::rand()) name = std::string(argv[1]) + "/b";'
    assert publishers(some + publish) == [("/?/b", ["name", "conditions"]), ("/a", ["conditions"])]


#: What is declared for each element of a list that is not known, then for each of another list; and what of it is made, ``never`` where it is ruled out.
ELEMENTS = (
    ('auto t = declare_parameter(s + ".type", "scan");', 't == "scan"', "first, never second"),
    ('declare_parameter(s + ".type", "scan"); auto t = declare_parameter(o + ".type", "zone");', 't == "zone"', "first, never second"),
    ('auto t = dog(this, s + ".type", "scan"); t = dog(this, o + ".type", "zone");', 't == "zone"', "first, never second"),
    ('declare_parameter(s + ".type", "scan"); auto t = dog(this, o + ".type", "zone");', 't == "none"', "never first, second"),
    (
        'declare_parameter(s + ".type", "scan"); declare_parameter(o + ".type", "zone"); auto t = get_parameter(s + ".type").as_string();',
        't == "scan"',
        "first, second",
    ),
    ('declare_parameter(s + ".type", "scan"); auto t = get_parameter(s + ".type").as_string();', 't == "scan"', "first, never second"),
)  # fmt: skip


@pytest.mark.parametrize(("body", "test", "expected"), ELEMENTS)
def test_two_names_of_which_the_same_parts_are_known_are_two(body: str, test: str, expected: str) -> None:
    ends = f'if ({test}) create_publisher<String>("first", 1); else create_publisher<String>("second", 1);'
    before = (
        "std::vector<std::string> names();\nstd::string dog(rclcpp::Node * node, const std::string & n, const std::string & d) {\n"
        "if (node->has_parameter(n)) { return node->get_parameter(n).as_string(); }\nreturn node->declare_parameter(n, d); }\n"
    )
    (found,) = ros2_cpp(f"for (auto s : names()) for (auto o : names()) {{ {body} {ends} }}", before=before).nodes
    made = sorted(explicit(found), key=lambda end: end.name)
    assert ", ".join("never " * end.is_ruled_out + end.name.strip("/") for end in made) == expected
