# SPDX-License-Identifier: Apache-2.0
"""Lists that have other elements on other paths: what was added last, what may be in them."""

from __future__ import annotations

from follow_kit import ROS2_CMAKE, ROS2_HEAD, ends, follow

BEFORE = """
struct One { explicit One(std::string n) : name(n) {} virtual ~One() {}
  virtual void start(rclcpp::Node & node) { node.create_publisher<std_msgs::msg::String>(name, 1); }
  std::string name; };
struct Two : One { explicit Two(std::string n) : One(n) {}
  void start(rclcpp::Node & node) override { node.create_publisher<std_msgs::msg::Bool>(name + "2", 1); } };
"""
FILL = 'if (std::rand()) all.push_back(std::make_shared<One>("o")); else all.push_back(std::make_shared<Two>("t"));'
LIST = "std::vector<std::shared_ptr<One>> all;\n"
START = "for (const auto & each : all) each->start(node);"


def names(body: str) -> list[tuple[str, list[str]]]:
    """The names of a program's publishers whose ``main`` has this body, and what is not known of each."""
    cmake = ROS2_CMAKE.format("p") + "ament_auto_add_executable(n src/n.cpp)\nament_auto_package()\n"
    main = 'int main(int argc, char ** argv) { rclcpp::init(argc, argv); rclcpp::Node node("n");\n'
    found = follow({"p/CMakeLists.txt": cmake, "p/src/n.cpp": f"{ROS2_HEAD}{BEFORE}{main}{body}}}"}, 2)
    nodes = [node for each in found.configurations for node in each.nodes]
    every = [end for node in nodes for end in ends(node, "publishers") if not end.implicit]
    return sorted((end.name, [unknown.field for unknown in end.unknowns]) for end in every)


def test_an_element_that_is_one_or_the_other() -> None:
    both = [("/o", ["conditions"]), ("/t2", ["conditions"])]
    assert names(LIST + FILL + "all.back()->start(node);") == both
    assert names(LIST + FILL + START) == both
    assert names(LIST + FILL + "all[0]->start(node);") == both


def test_what_a_branch_has_written_into_its_element_counts() -> None:
    texts = "std::vector<std::string> all;\n"
    body = 'if (std::rand()) { all.push_back("a"); all[0] = "b"; } else { all.push_back("b"); }'
    publish = "node.create_publisher<std_msgs::msg::String>(all[0], 1);"
    assert names(texts + body + publish) == [("/b", [])]


def test_the_last_element_of_a_list_that_is_not_known() -> None:
    loop = "while (std::rand()) {{ {} all.back()->start(node); }}"
    both = [("/o", ["conditions"]), ("/t2", ["conditions"])]
    assert names(LIST + loop.format(FILL)) == both


def test_what_may_be_in_a_list() -> None:
    loop = 'while (std::rand()) all.push_back(std::make_shared<Two>("t"));'
    assert ("/t2", ["conditions"]) in names(LIST + loop + START)
    assert names(LIST + loop + "all.clear();" + START) == []


def test_texts_that_may_be_in_a_list_are_not_told() -> None:
    loop = 'while (std::rand()) all.push_back(line == "x" ? std::string("a") : line);'
    each = "for (const auto & name : all) node.create_publisher<std_msgs::msg::String>(name, 1);"
    assert names("std::vector<std::string> all; std::string line(argv[1]);" + loop + each) == [("/?", ["name"])]
