# SPDX-License-Identifier: Apache-2.0
"""ROS 2: plug-ins of RViz, each on the node of the program that loads it."""

from __future__ import annotations

import pytest
from follow_kit import ROS2_CMAKE, ROS2_HEAD, explicit, follow

from haros_ci.model.architecture import Configuration

PANEL = """
class Panel : public rviz_common::Panel {
public:
  explicit Panel(QWidget * parent = nullptr);
  void onInitialize() override {
    node_ = getDisplayContext()->getRosNodeAbstraction().lock()->get_raw_node();
    pub_ = node_->create_publisher<String>("/speed", 1);
    connect(button_, &QPushButton::clicked, this, &Panel::onClick);
    connect(other_, SIGNAL(clicked()), SLOT(onOther()));
  }
  void onClick() { cli_ = node_->create_client<std_srvs::srv::Empty>("clicked"); }
  void onOther() { other_cli_ = node_->create_client<std_srvs::srv::Empty>("~/other"); }
private:
  rclcpp::Node::SharedPtr node_;
  rclcpp::Publisher<String>::SharedPtr pub_;
};
Panel::Panel(QWidget * parent) : rviz_common::Panel(parent) {}
"""
DISPLAY = """
class Display : public rviz_common::Display {
public:
  Display() {
    topic_ = new rviz_common::properties::RosTopicProperty("Topic", "/state", "", "", this, SLOT(updateTopic()));
    frame_ = new rviz_common::properties::StringProperty("Frame", "map", "", this, SLOT(updateTopic()));
  }
  void onInitialize() override { rviz_common::Display::onInitialize(); }
  void updateTopic() {
    auto abstraction = context_->getRosNodeAbstraction().lock();
    sub_ = abstraction->get_raw_node()->create_subscription<String>(topic_->getTopicStd(), 5, [](String::SharedPtr) {});
  }
  rviz_common::properties::RosTopicProperty * topic_;
  rviz_common::properties::StringProperty * frame_;
  rclcpp::Subscription<String>::SharedPtr sub_;
};
"""
VIEW = "class View : public rviz_common::ViewController { void onInitialize() override {} int a_; };"
OTHER = """
class Other : public elsewhere::Base {
  void onInitialize() { node_->create_publisher<String>("/other", 1); }
  rclcpp::Node::SharedPtr node_;
};
"""


def plugins(code: str, *classes: tuple[str, str]) -> list[Configuration]:
    described = "".join(f'<class type="{kind}" base_class_type="{base}"/>' for kind, base in classes)
    cmake = ROS2_CMAKE.format("p") + (
        "ament_auto_add_library(p_lib SHARED src/n.cpp)\n"
        "pluginlib_export_plugin_description_file(rviz_common plugins.xml)\nament_auto_package()\n"
    )
    files = {
        "p/CMakeLists.txt": cmake,
        "p/plugins.xml": f'<library path="p_lib">{described}</library>',
        "p/src/n.cpp": ROS2_HEAD + code,
    }
    return list(follow(files, 2).configurations)


def test_a_panel_is_on_the_node_of_rviz() -> None:
    (found,) = plugins(PANEL, ("Panel", "rviz_common::Panel"))
    (node,) = found.nodes
    assert (found.name, node.name, node.package, node.class_name) == ("p/Panel", "/rviz", "p", "Panel")
    assert [(end.name, end.type) for end in explicit(node)] == [("/speed", "std_msgs/msg/String")]
    assert sorted(end.name for end in explicit(node, "clients")) == ["/clicked", "/rviz/other"]


def test_a_property_has_its_default() -> None:
    (found,) = plugins(DISPLAY, ("Display", "rviz_common::Display"))
    (node,) = found.nodes
    assert [(end.name, end.type) for end in explicit(node, "subscribers")] == [("/state", "std_msgs/msg/String")]


def test_what_makes_nothing_and_what_nothing_describes_is_no_configuration() -> None:
    assert plugins(VIEW, ("View", "rviz_common::ViewController")) == []
    assert plugins(PANEL) == []


def test_what_others_load_is_not_on_the_node_of_rviz() -> None:
    (found,) = plugins(OTHER, ("Other", "elsewhere::Base"))
    assert (found.name, [node.name for node in found.nodes]) == ("p/Other (plug-ins)", ["/?"])


CLIENT = """
int main(int argc, char ** argv) {
  auto client = std::make_unique<rviz_common::ros_integration::RosClientAbstraction>();
  auto node = client->init(argc, argv, "viewer", %s);
  node.lock()->get_raw_node()->create_publisher<String>("a", 1);
}
"""


@pytest.mark.parametrize(("flag", "name"), (("false", "/viewer"), ("true", "/?"), ("std::rand() > 1", "/?")))
def test_a_program_that_makes_its_node_as_rviz_does(flag: str, name: str) -> None:
    cmake = ROS2_CMAKE.format("p") + "ament_auto_add_executable(n src/n.cpp)\nament_auto_package()\n"
    files = {"p/CMakeLists.txt": cmake, "p/src/n.cpp": ROS2_HEAD + CLIENT % flag}
    found = follow(files, 2).configurations[0]
    assert [(node.name, [end.name for end in explicit(node)]) for node in found.nodes] == [(name, ["/a"])]
