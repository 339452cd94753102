# SPDX-License-Identifier: Apache-2.0
"""Objects and classes of the workspace that are given to libraries which are not here."""

from __future__ import annotations

import pytest
from follow_kit import cpp_files, ends, follow, main, names, node

from haros_ci.follow.libraries.given_away import is_known

MODULE = """#include <frame/module.h>
struct Arm : public frame::Module {
  %s
  void helper(std::string name) { ros::NodeHandle nh; ADV(name, 1); }
};
"""
BODY = '{ ros::NodeHandle nh; ADV("a", 1); }'


def ros1(method: str, call: str) -> list[tuple[str, bool]]:
    """The names that are published, and whether it is not known that they are."""
    found = node(follow(cpp_files(main(call, MODULE % method))))
    return sorted((end.name, any(each.field == "conditions" for each in end.unknowns)) for end in ends(found))


@pytest.mark.parametrize(
    ("method", "call"),
    [
        (f"void initialize() {BODY}", "Arm arm; frame::Host host; host.add(&arm);"),
        (f"void initialize(int rate) {BODY}", "auto arm = new Arm; frame::Host host; host.add((frame::Module*)arm);"),
        (f"void process() override {BODY}", "Arm arm; frame::run(arm);"),
        (f"virtual void process() {BODY}", "auto arm = std::make_shared<Arm>(); frame::run(arm);"),
    ],
)
def test_a_library_may_call_an_object_by_a_base_class_that_is_not_here(method: str, call: str) -> None:
    assert ros1(method, call) == [("/a", True)]


@pytest.mark.parametrize(
    ("method", "call"),
    [
        (f"void initialize() {BODY}", "Arm arm;"),  # given to nobody
        (f"void own() {BODY}", "Arm arm; frame::run(arm);"),  # no method of the base class, as far as is known
        (f"void process() override {BODY}", 'Arm arm; puts("");'),
        (f"void process() override {BODY}", "Arm arm; std::vector<Arm> all; all.push_back(arm);"),
        ("void process() override {}", "Arm arm; frame::run(arm);"),
    ],
)
def test_nothing_is_called_of_an_object_otherwise(method: str, call: str) -> None:
    assert ros1(method, call) == []


def test_an_object_without_a_base_class_is_called_by_nobody() -> None:
    text = 'struct Arm { virtual void process() { ros::NodeHandle nh; ADV("a", 1); } };'
    found = follow(cpp_files(main("Arm arm; frame::run(arm);", text)))
    assert names(node(found)) == []


@pytest.mark.parametrize(
    ("make", "expected"),
    [
        ("utils::make_impl<Arm>(nh)", ["/a"]),
        ("utils::make_unique_impl<Arm>(nh)", ["/a"]),
        ("utils::find<Arm>(nh)", []),
        ("utils::make_impl<Leg>(nh)", []),
    ],
)
def test_a_maker_of_a_library_makes_an_object_of_the_class_that_it_names(make: str, expected: list[str]) -> None:
    text = 'struct Arm { Arm(ros::NodeHandle& nh) { ADV("a", 1); } };'
    assert names(node(follow(cpp_files(main(f"auto arm = {make};", text))))) == expected


SETUP = "from setuptools import setup\nsetup(name='p', packages=['p'], entry_points={'console_scripts': ['n = p.n:main']})\n"
DRIVER = """import rclpy
from rclpy.node import Node
from std_msgs.msg import String
import host
class Driver(Node):
    def __init__(self, **others):
        super().__init__('driver', **others)
        self.create_publisher(String, 'a', 1)
class Plain:
    def __init__(self):
        rclpy.create_node('plain').create_publisher(String, 'b', 1)
"""


@pytest.mark.parametrize(
    ("code", "expected"),
    [
        ("def main():\n    host.process.spin(Driver)\n", [("/driver", "/a", True)]),
        ("@host.main(prebaked=False)\ndef main(args=None):\n    host.spin(Driver)\n", [("/driver", "/a", True)]),
        ("def main():\n    host.spin(Driver)\n    host.spin(Driver)\n", [("/driver", "/a", True)]),
        ("def main():\n    host.spin(Plain)\n", []),
        ("def main():\n    print(Driver)\n", []),
        ("def main():\n    isinstance(1, Driver)\n", []),
        ("def main():\n    host.spin()\n", []),
    ],
)
def test_a_library_that_is_given_a_node_s_class_may_make_it(code: str, expected: list[tuple[str, str, bool]]) -> None:
    found = follow({"p/setup.py": SETUP, "p/p/__init__.py": "", "p/p/n.py": DRIVER + code}, 2)
    assert [
        (each.name, end.name, any(why.field == "conditions" for why in end.unknowns))
        for configuration in found.configurations
        if configuration.name == "p/n"
        for each in configuration.nodes
        for end in ends(each)
        if not end.implicit
    ] == expected


@pytest.mark.parametrize(
    ("base", "expected"),
    [
        ("import tools.node as t\nclass Driver(t.Node):", ["/a"]),
        ("from tools.node import Node\nclass Driver(Node):", ["/a"]),
        ("from tools.node import Window\nclass Driver(Window):", ["/a"]),  # it is spun
        ("class Node:\n    pass\nclass Driver(Node):", []),
    ],
)
def test_a_node_of_a_library_that_is_not_known_is_one_of_rclpy(base: str, expected: list[str]) -> None:
    text = f"import rclpy\nfrom std_msgs.msg import String\n{base}\n    def __init__(self):\n        super().__init__('driver')\n"
    text += "        self.create_publisher(String, 'a', 1)\ndef main():\n    rclpy.spin(Driver())\n"
    found = follow({"p/setup.py": SETUP, "p/p/__init__.py": "", "p/p/n.py": text}, 2)
    nodes = [each for configuration in found.configurations for each in configuration.nodes]
    assert [end.name for each in nodes for end in ends(each) if not end.implicit] == expected
    assert all(any("is not in the workspace" in why.reason for why in each.unknowns) for each in nodes if expected)


TWICE = '<launch><node pkg="p" type="n" name="one"/><node pkg="p" type="n" name="two"/></launch>'


def test_the_one_object_of_a_class_is_made_by_every_node() -> None:
    """Not by the first that is followed alone: two nodes of one program are two processes."""
    text = 'struct Arm : public tools::Singleton<Arm> { Arm() { ros::NodeHandle nh; ADV("a", 1); } void go() {} };'
    files = cpp_files(main("Arm::instance().go(); Arm::instance().go();", text)) | {"p/launch/a.launch": TWICE}
    (configuration,) = follow(files).configurations
    assert [(each.name, names(each)) for each in configuration.nodes] == [("/one", ["/a"]), ("/two", ["/a"])]


def test_a_class_that_a_library_may_make_is_made_for_every_node() -> None:
    launch = (
        "from launch import LaunchDescription\nfrom launch_ros.actions import Node\ndef generate_launch_description():\n"
        "    return LaunchDescription([Node(package='p', executable='n', arguments=[word]) for word in ('-a', '-b')])\n"
    )
    text = DRIVER + "def main():\n    host.process.spin(Driver)\n"
    files = {"p/setup.py": SETUP, "p/p/__init__.py": "", "p/p/n.py": text, "p/launch/a.launch.py": launch}
    found = follow(files, 2).configurations
    made = [end.name for each in found for node in each.nodes for end in ends(node) if not end.implicit]
    assert made == ["/a", "/a"]


@pytest.mark.parametrize(
    "base",
    ["std::thread", "ros::NodeHandle", "rviz::Display", "rviz_common::Tool", "rclcpp::Node", "rclcpp_action::Client"]
    + ["rqt_gui_cpp::Plugin", "rqt_gui_py.plugin.Plugin", "rclpy.node.Node", "object", "Exception"]
    + ["QObject", "QMainWindow", "QSGNode", "Qt::Key", "QtWidgets.QWidget"],
)
def test_libraries_that_call_nothing_are_known(base: str) -> None:
    assert is_known(base)


@pytest.mark.parametrize(
    "base",
    ["Queue", "Queue::Item", "Quadrotor", "Q", "QR::Reader", "Qtable", "rvizier::Tool", "rospyx.Node", "rclcppx::Node"]
    + [
        "objects.Base",
        "Exceptional",
        "ExceptionHandler::Base",
        "stdx::thing",
        "rosx::Node",
        "nodelets::Base",
        "frame::Q",
    ],
)
def test_a_name_that_only_begins_so_is_of_another_library(base: str) -> None:
    assert not is_known(base)


def test_a_class_whose_base_begins_like_one_of_qt_is_called() -> None:
    text = 'struct Arm : public Queue::Item { void process() override { ros::NodeHandle nh; ADV("a", 1); } };'
    assert names(node(follow(cpp_files(main("Arm arm; frame::run(arm);", text))))) == ["/a"]
