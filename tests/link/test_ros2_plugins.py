# SPDX-License-Identifier: Apache-2.0
"""ROS 2 C++: plug-ins that parameters choose, and those that no configuration loads."""

from __future__ import annotations

from typing import Any

from follow_kit import ROS2_CMAKE, ROS2_HEAD, ends, follow

from haros_ci.model.architecture import Architecture

HOST = """
namespace core { class Task { public: virtual void start(rclcpp::Node * node, const std::string & name) = 0; }; }
class Quick : public core::Task {
public:
  void start(rclcpp::Node * node, const std::string & name) override { node->create_publisher<std_msgs::msg::String>(name + "/quick", 1); }
};
class Slow : public core::Task {
public:
  void start(rclcpp::Node * node, const std::string &) override { node->create_publisher<std_msgs::msg::String>("slow", 1); }
};
class Host : public rclcpp::Node {
public:
  Host() : rclcpp::Node("host"), loader_("core", "core::Task") {
    for (const auto & name : declare_parameter("tasks", std::vector<std::string>{%s})) {
      auto task = loader_.createSharedInstance(declare_parameter<std::string>(name + ".plugin"%s));
      task->start(this, name);
    }
  }
  pluginlib::ClassLoader<core::Task> loader_;
};
int main(int argc, char ** argv) { rclcpp::init(argc, argv); rclcpp::spin(std::make_shared<Host>()); }
"""
XML = """<library path="n"><class name="own::Quick" type="Quick" base_class_type="core::Task"/>
<class name="own::Slow" type="Slow" base_class_type="core::Task"/></library>"""


def found(names: str, kind: str) -> Architecture:
    cmake = ROS2_CMAKE.format("p") + (
        "ament_auto_add_executable(n src/n.cpp)\npluginlib_export_plugin_description_file(p plugins.xml)\n"
        "ament_auto_package()\n"
    )
    text = ROS2_HEAD + HOST % (names, kind)
    return follow({"p/CMakeLists.txt": cmake, "p/src/n.cpp": text, "p/plugins.xml": XML}, 2)


def told(architecture: Architecture) -> dict[str, list[tuple[str, Any]]]:
    """By configuration: publishers that the code makes, with the fields that are not known of each."""
    return {
        each.name: sorted(
            (end.name, [unknown.field for unknown in end.unknowns])
            for node in each.nodes
            for end in ends(node)
            if not end.implicit
        )
        for each in architecture.configurations
    }


def test_plug_ins_that_no_configuration_loads_are_told_apart() -> None:
    one = found('"a"', ', "own::Quick"')
    assert told(one) == {
        "p/n": [("/a/quick", [])],
        "p/n (plug-ins)": [("/a/quick", ["conditions"]), ("/slow", ["conditions"])],
    }
    other = next(each for each in one.configurations if each.name == "p/n (plug-ins)").nodes[0]
    assert "endpoints" in [unknown.field for unknown in other.unknowns]


def test_a_plug_in_of_which_the_name_is_not_known() -> None:
    assert told(found('"a"', "")) == {
        "p/n": [],
        "p/n (plug-ins)": [("/a/quick", ["conditions"]), ("/slow", ["conditions"])],
    }


def test_each_plug_in_is_loaded_once_at_each_place() -> None:
    publishers = told(found('"a", "b"', ', "own::Quick"'))
    assert publishers["p/n"] == [("/a/quick", []), ("/b/quick", [])]
    assert [name for name, _ in publishers["p/n (plug-ins)"]] == ["/a/quick", "/b/quick", "/slow"]


def test_no_loader_no_configuration_of_plug_ins() -> None:
    text = ROS2_HEAD + 'int main(int argc, char ** argv) { rclcpp::init(argc, argv); rclcpp::Node node("n"); }'
    cmake = ROS2_CMAKE.format("p") + "ament_auto_add_executable(n src/n.cpp)\nament_auto_package()\n"
    assert list(told(follow({"p/CMakeLists.txt": cmake, "p/src/n.cpp": text}, 2))) == ["p/n"]


CONTEXT = """
struct Context { rclcpp::Node * node; };
namespace core { class Task { public: void give(Context * c) { context_ = c; } virtual void start() = 0; Context * context_; }; }
class Quick : public core::Task {
public:
  void start() override { context_->node->create_publisher<std_msgs::msg::String>("quick", 1); }
};
class Slow : public core::Task {
public:
  void start() override {
    std::string topic;
    context_->node->create_publisher<std_msgs::msg::String>("slow", 1);
    if (!topic.empty()) { context_->node->create_publisher<std_msgs::msg::String>(topic, 1); }
  }
};
class Host : public rclcpp::Node {
public:
  Host() : rclcpp::Node("host"), loader_("core", "core::Task") {
    context_.node = this;
    for (const auto & name : declare_parameter("tasks", std::vector<std::string>{})) {
      auto task = loader_.createSharedInstance(name);
      task->give(&context_);
      tasks_.push_back(task);
    }
    for (auto & task : tasks_) { task->start(); }
  }
  Context context_;
  std::vector<std::shared_ptr<core::Task>> tasks_;
  pluginlib::ClassLoader<core::Task> loader_;
};
int main(int argc, char ** argv) { rclcpp::init(argc, argv); rclcpp::spin(std::make_shared<Host>()); }
"""


def test_plug_ins_of_a_list_that_is_empty_have_what_their_host_gives_them() -> None:
    cmake = ROS2_CMAKE.format("p") + (
        "ament_auto_add_executable(n src/n.cpp)\nament_auto_add_executable(other src/n.cpp)\n"
        "pluginlib_export_plugin_description_file(p plugins.xml)\nament_auto_package()\n"
    )
    found = follow({"p/CMakeLists.txt": cmake, "p/src/n.cpp": ROS2_HEAD + CONTEXT, "p/plugins.xml": XML}, 2)
    publishers = told(found)
    assert publishers["p/n"] == []
    assert {"/?", "/quick", "/slow"} <= {name for name, _ in publishers["p/n (plug-ins)"]}
    assert "p/other (plug-ins)" not in publishers
