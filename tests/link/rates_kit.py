# SPDX-License-Identifier: Apache-2.0
"""The rates of small workspaces in memory."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from follow_kit import Nothing, cpp_files, main, python_files, script, workspace

from haros_ci.analysis.architecture import varied
from haros_ci.analysis.code_of import code_of
from haros_ci.analysis.rates import with_rates
from haros_ci.config.settings import Settings
from haros_ci.model.architecture import Architecture
from haros_ci.model.rates import Rates


def architecture(files: Mapping[str, str], ros: int | None = None) -> Architecture:
    whole = workspace(files, ros)
    settings = Settings(root=Path("/nowhere"))
    made = varied(whole, settings, Nothing(), environment={}, known_nodes=False)
    return with_rates(made.architecture, code_of(made, whole))


def rates(files: Mapping[str, str], ros: int | None = None) -> Rates:
    (configuration,) = architecture(files, ros).configurations
    assert configuration.rates is not None
    return configuration.rates


def by_topic(files: Mapping[str, str], ros: int | None = None) -> dict[str, str]:
    return {one.topic: str(one.rate) for one in rates(files, ros).published}


def cpp(body: str, before: str = "", launch: str = "") -> dict[str, str]:
    return by_topic(cpp_files(main(body, before), launch))


def python(body: str, launch: str = "") -> dict[str, str]:
    return by_topic(python_files(script(body), launch))


ROS2_CMAKE = "cmake_minimum_required(VERSION 3.8)\nproject(p)\nadd_executable(n src/main.cpp)\ninstall(TARGETS n DESTINATION lib/p)\n"
ROS2 = """#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>
using namespace std::chrono_literals;
class A : public rclcpp::Node {
 public:
  A() : Node("a") {
    pub_ = create_publisher<std_msgs::msg::String>("out", 1);
    %s
  }
 private:
  %s
  std_msgs::msg::String m_;
  rclcpp::Publisher<std_msgs::msg::String>::SharedPtr pub_;
  rclcpp::TimerBase::SharedPtr timer_;
};
int main(int argc, char ** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<A>());
}
"""


def ros2(body: str) -> str:
    tick = "void tick() { pub_->publish(m_); }" if "tick" in body else ""
    return by_topic({"p/CMakeLists.txt": ROS2_CMAKE, "p/src/main.cpp": ROS2 % (body, tick)}, 2)["/out"]
