# SPDX-License-Identifier: Apache-2.0
"""Factories of plug-ins in two steps: a loader gives a factory, and what its method gives makes the endpoints."""

from __future__ import annotations

import pytest
from follow_kit import CMAKE, CPP_HEAD, ROS2_CMAKE, ROS2_HEAD, ends, follow

from haros_ci.model.architecture import Architecture

#: A ROS 2 workspace: an interface with a factory template, two gadgets, and a host.
GADGETS = """
namespace crane {
class Cabin;
using CabinPtr = std::shared_ptr<Cabin>;
class Gadget {
public:
  RCLCPP_SMART_PTR_DEFINITIONS(Gadget)
  explicit Gadget(CabinPtr cabin) : cabin_(cabin), node_(std::dynamic_pointer_cast<rclcpp::Node>(cabin)) {}
  Gadget(CabinPtr cabin, const std::string & below)
  : cabin_(cabin), node_(rclcpp::Node::make_shared(below, std::dynamic_pointer_cast<rclcpp::Node>(cabin)->get_fully_qualified_name())) {}
  virtual ~Gadget() = default;
  virtual void lift() {}
  rclcpp::Node::SharedPtr get_node() const { return node_; }
protected:
  CabinPtr cabin_;
  rclcpp::Node::SharedPtr node_;
};
class Maker {
public:
  virtual ~Maker() = default;
  virtual Gadget::SharedPtr make(CabinPtr cabin) = 0;
};
template<typename T>
class MakerOf : public Maker {
public:
  Gadget::SharedPtr make(CabinPtr cabin) override { return std::make_shared<T>(cabin); }
};
class Hook : public Gadget {
public:
  explicit Hook(CabinPtr cabin) : Gadget(cabin, "hook") {
    load_ = node_->create_publisher<std_msgs::msg::String>("~/load", 1);
  }
  void lift() override { node_->create_publisher<std_msgs::msg::String>("~/lifted", 1); }
  rclcpp::Publisher<std_msgs::msg::String>::SharedPtr load_;
};
class Horn : public Gadget {
public:
  explicit Horn(CabinPtr cabin) : Gadget(cabin) {
    tone_ = node_->create_publisher<std_msgs::msg::String>("tone", 1);
  }
  rclcpp::Publisher<std_msgs::msg::String>::SharedPtr tone_;
};
class Unlisted : public Gadget {
public:
  explicit Unlisted(CabinPtr cabin) : Gadget(cabin) { node_->create_publisher<std_msgs::msg::String>("unlisted", 1); }
};
"""
CABIN = """
static bool matches(const std::string & pattern, const std::string & name)
{
  int found = fnmatch(pattern.c_str(), name.c_str(), FNM_CASEFOLD);
  return found == 0;
}
class Cabin : public rclcpp::Node {
public:
  Cabin() : rclcpp::Node("cabin"), makers_("p", "crane::Maker") {
    declare_parameter("deny", deny_);
    declare_parameter("allow", allow_);
    timer_ = create_wall_timer(std::chrono::seconds(1), [this]() { timer_->cancel(); begin(); });
  }
  bool allowed(const std::string & name) {
    for (auto & pattern : deny_) {
      if (matches(pattern, name)) {
        for (auto & other : allow_) {
          if (matches(other, name)) { return true; }
        }
        return false;
      }
    }
    return true;
  }
  Gadget::SharedPtr create(const std::string & name) {
    auto maker = makers_.createSharedInstance(name);
    return maker->make(std::static_pointer_cast<Cabin>(shared_from_this()));
  }
  void add(const std::string & name) {
    if (!allowed(name)) { return; }
    try {
      auto gadget = create(name);
      gadgets_.push_back(gadget);
    } catch (pluginlib::PluginlibException & error) { }
  }
  void begin() {
    get_parameter("deny", deny_);
    get_parameter("allow", allow_);
    if (deny_.empty() && !allow_.empty()) { deny_.emplace_back("*"); }
    %s
  }
  rclcpp::TimerBase::SharedPtr timer_;
  std::vector<std::string> deny_{%s};
  std::vector<std::string> allow_{%s};
  std::vector<Gadget::SharedPtr> gadgets_;
  pluginlib::ClassLoader<Maker> makers_;
};
}
int main(int argc, char ** argv) { rclcpp::init(argc, argv); rclcpp::spin(std::make_shared<crane::Cabin>()); }
"""
EVERY = "for (auto & name : makers_.getDeclaredClasses()) { add(name); }"
LAUNCH = """<launch><node pkg="p" exec="n"><param from="$(find-pkg-share p)/launch/deny.yaml"/></node></launch>"""
MAKERS = """<library path="n">
<class name="hook" type="crane::MakerOf&lt;crane::Hook&gt;" base_class_type="crane::Maker"/>
<class name="horn" type="crane::MakerOf&lt;crane::Horn&gt;" base_class_type="crane::Maker"/></library>"""


def cabin(deny: str = "", allow: str = "", begin: str = EVERY, gadgets: str = GADGETS, xml: str = MAKERS, yaml: str = "") -> Architecture:
    cmake = ROS2_CMAKE.format("p") + (
        "ament_auto_add_executable(n src/n.cpp)\npluginlib_export_plugin_description_file(p plugins.xml)\n"
        "ament_auto_package()\n"
    )
    text = ROS2_HEAD + gadgets + CABIN % (begin, deny, allow)
    files = {"p/CMakeLists.txt": cmake, "p/src/n.cpp": text, "p/plugins.xml": xml}
    if yaml:
        files |= {"p/launch/l.launch.xml": LAUNCH, "p/launch/deny.yaml": yaml}
    return follow(files, 2)


def publishers(found: Architecture, name: str = "p/n") -> list[str]:
    """The publishers that the code makes in the configuration *name*."""
    return sorted(
        end.name
        for each in found.configurations
        if each.name == name
        for node in each.nodes
        for end in ends(node)
        if not end.implicit
    )


def gaps(found: Architecture) -> list[str]:
    every = (node for each in found.configurations for node in each.nodes)
    return sorted({unknown.reason for node in every for unknown in node.unknowns if unknown.field == "endpoints"})


def test_what_the_factories_of_a_template_make_is_made() -> None:
    found = cabin()
    assert publishers(found) == ["/cabin/hook/load", "/tone"]
    assert not gaps(found)


def test_a_list_that_leaves_a_factory_out_leaves_out_what_it_makes() -> None:
    assert publishers(cabin('"ho?k"')) == ["/tone"]
    assert publishers(cabin('"*"')) == []
    assert publishers(cabin('"*"', '"hook"')) == ["/cabin/hook/load"]
    assert publishers(cabin("", '"hook"')) == ["/cabin/hook/load"]


def test_lists_of_a_launch_file() -> None:
    for names, made in (("deny: [hook]", ["/tone"]), ("allow: ['h*k']", ["/cabin/hook/load"])):
        found = cabin(yaml=f"/**:\n  ros__parameters:\n    {names}\n")
        assert publishers(found, "p/launch/l.launch.xml") == made
