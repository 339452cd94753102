# SPDX-License-Identifier: Apache-2.0
"""ROS 2: nodes whose class or base class is in a package that is not here: no such node is empty without a word."""

from __future__ import annotations

from typing import Any

import pytest
from follow_kit import ROS2_CMAKE, ROS2_HEAD, explicit, follow, only, ros2_files, ros2_main
from follow_kit import cpp as ros1_cpp
from follow_kit import python as ros1_python

from haros_ci.model.architecture import Configuration, Node

MODE = 'struct Mode { explicit Mode(rclcpp::Node & n) { p_ = n.create_publisher<String>("m", 1); } rclcpp::Publisher<String>::SharedPtr p_; };\n'
VIRTUAL = 'struct Mode : pkg::ModeBase { void on_start(rclcpp::Node::SharedPtr n) override { p_ = n->create_publisher<String>("m", 1); } };\n'
DERIVED = 'class D : public {} {{ public: D() : {}("d") {{ {} }} }};\n'
SPIN = "rclcpp::spin(std::make_shared<{}>());"


def the_node(found: Configuration) -> Node:
    assert len(found.nodes) == 1
    return found.nodes[0]


def reasons(node: Node, field: str = "endpoints") -> list[str]:
    return [unknown.reason for unknown in node.unknowns if unknown.field == field]


@pytest.mark.parametrize(
    "body",
    [
        SPIN.format("pkg::SomeNode"),
        SPIN.format("pkg::NodeWithMode<Mode>"),
        'rclcpp::spin(std::make_shared<pkg::NodeWithMode<Mode>>("a", true));',
        "auto n = std::make_shared<pkg::SomeNode>(rclcpp::NodeOptions()); rclcpp::spin(n);",
        "auto n = std::make_shared<pkg::SomeNode>(); rclcpp::spin(n->get_node_base_interface());",
        "rclcpp::executors::SingleThreadedExecutor e; e.add_node(std::make_shared<pkg::SomeNode>()); e.spin();",
        "auto n = new pkg::NodeWithMode<Mode>(); n->run();",
        "pkg::NodeWithMode<Mode> n; n.run();",
        "rclcpp::spin(pkg::make_node());",
        "return pkg::run(argc, argv);",
    ],
)
def test_a_node_of_a_class_from_outside(body: str) -> None:
    node = the_node(ros2_main(body, MODE))
    assert node.name == "/?"
    assert reasons(node, "name") and reasons(node)


@pytest.mark.parametrize("mode", [MODE, VIRTUAL])
def test_what_a_class_of_the_workspace_gives_that_a_template_from_outside_takes(mode: str) -> None:
    node = the_node(ros2_main(SPIN.format("pkg::NodeWithMode<Mode>"), mode))
    (end,) = explicit(node)
    assert (end.name, [unknown.field for unknown in end.unknowns]) == ("/m", ["conditions"])
    assert node.class_name == "pkg::NodeWithMode"


@pytest.mark.parametrize(
    "code",
    [
        'create_publisher<String>("x", 1);',
        'this->create_publisher<String>("x", 1);',
        'auto p = this->create_publisher<String>("x", rclcpp::QoS(1));',
    ],
)
@pytest.mark.parametrize("base", ["pkg::Base", "pkg::Base<Mode>"])
def test_methods_of_a_node_in_a_class_with_a_base_class_from_outside(code: str, base: str) -> None:
    before = "struct Mode {};\n" + DERIVED.format(base, "pkg::Base", code)
    node = the_node(ros2_main(SPIN.format("D"), before))
    assert [end.name for end in explicit(node)] == ["/x"]
    assert reasons(node) == ["the base class pkg::Base is not in the workspace: what it makes and calls is not known"]


def test_a_class_with_a_base_class_from_outside_that_makes_nothing_itself() -> None:
    node = the_node(ros2_main(SPIN.format("D"), DERIVED.format("pkg::Base", "pkg::Base", "")))
    assert reasons(node, "name") and reasons(node)


def test_a_component_with_a_base_class_from_outside() -> None:
    text = (
        ROS2_HEAD
        + "class N : public pkg::Base { public: explicit N(const rclcpp::NodeOptions & o) : pkg::Base(o) {} };\n"
    )
    node = the_node(only(follow(ros2_files(text), 2)))
    assert reasons(node) == ["the base class pkg::Base is not in the workspace: what it makes and calls is not known"]


def test_methods_of_a_node_of_a_class_from_outside() -> None:
    node = the_node(
        ros2_main('auto n = std::make_shared<pkg::N>(); auto p = n->create_publisher<String>("x", 1); rclcpp::spin(n);')
    )
    assert [end.name for end in explicit(node)] == ["/x"]
    assert reasons(node) == [
        "the class pkg::N, which the node is of, is not in the workspace: what it makes is not known"
    ]


LAUNCH = """from launch import LaunchDescription
from launch_ros.actions import Node
def generate_launch_description():
    return LaunchDescription([Node(package='p', executable='n'%s)])
"""
HEAD = "import rclpy\nfrom rclpy.node import Node\nfrom std_msgs.msg import String\n"
MAIN = "def main():\n    rclpy.init()\n    n = D()\n    rclpy.spin(n)\n"


def python(text: str, launch: str = "") -> Node:
    return the_node(only(follow({
        "p/setup.py": "from setuptools import setup\nsetup(name='p', packages=['p'], entry_points={'console_scripts': ['n = p.n:main']})\n",
        "p/setup.cfg": "[install]\ninstall_scripts=$base/lib/p\n",
        "p/p/__init__.py": "",
        "p/p/n.py": text,
        **({"p/launch/l.launch.py": LAUNCH % ""} if launch else {}),
    }, 2)))  # fmt: skip


@pytest.mark.parametrize(
    ("text", "made"),
    [
        (HEAD + "from pkg import D\n" + MAIN, []),
        (HEAD + "from pkg import B\nclass D(B):\n    pass\n" + MAIN, []),
        (HEAD + "from pkg import B\nclass D(B):\n    def __init__(self):\n        super().__init__('d')\n        self.create_publisher(String, 'x', 1)\n" + MAIN, ["/x"]),
        (HEAD + "from pkg import D\ndef main():\n    rclpy.init()\n    D().run()\n", []),
    ],
)  # fmt: skip
def test_python(text: str, made: list[str]) -> None:
    node = python(text)
    assert [end.name for end in explicit(node)] == made
    assert reasons(node, "name") and reasons(node)


def test_a_launched_program_without_a_node() -> None:
    node = python("def main():\n    print(3)\n", LAUNCH)
    assert reasons(node, "name") == reasons(node) == ["no node is seen in its program"]


#: Programs whose nodes are known as a whole.
KNOWN: list[Any] = [
    ('rclcpp::spin(std::make_shared<rclcpp::Node>("a"));', "", "/a"),
    ('auto n = std::make_shared<rclcpp::Node>("a"); auto v = std::vector<std::shared_ptr<pkg::Data<Mode>>>(); rclcpp::spin(n);', "struct Mode {};\n", "/a"),
    ('auto n = rclcpp::Node::make_shared("a"); rclcpp::executors::SingleThreadedExecutor e; e.add_node(n); e.spin();', "", "/a"),
    ('auto n = std::make_shared<rclcpp::Node>("a"); rclcpp::spin(n->get_node_base_interface());', "", "/a"),
    ('auto n = std::make_shared<rclcpp::Node>("a"); rclcpp::executors::SingleThreadedExecutor e; e.add_node(n); '
     'auto f = std::make_shared<pkg::srv::Trigger::Response>(); e.spin_until_future_complete(f);', "", "/a"),
    ('auto n = std::make_shared<rclcpp::Node>("a"); auto f = std::make_shared<pkg::Future>(); rclcpp::spin_until_future_complete(n, f);', "", "/a"),
    ('auto n = std::make_shared<rclcpp::Node>("a"); rclcpp::executors::SingleThreadedExecutor e; e.add_node(n); '
     'auto f = std::make_shared<pkg::Future>(); e.spin_until_future_complete(f);', "", "/a"),
    (SPIN.format("D"), DERIVED.format("rclcpp::Node", "rclcpp::Node", ""), "/d"),
    (SPIN.format("D<rclcpp::Node>"), 'template<class T> class D : public T { public: D() : T("d") { this->template create_publisher<String>("x", 1); } };\n', "/d"),
    (SPIN.format("D<B>"),
     'class B : public rclcpp::Node { public: B(const std::string & n) : rclcpp::Node(n) {} void make() { create_publisher<String>("x", 1); } };\n'
     'template<class T> class D : public T { public: D() : T("d") { this->make(); } };\n', "/d"),
]  # fmt: skip


@pytest.mark.parametrize(("body", "before", "name"), KNOWN)
def test_stays_quiet_where_all_is_known(body: str, before: str, name: str) -> None:
    node = the_node(ros2_main(body, before))
    assert (node.name, node.unknowns) == (name, ())
    assert [end.name for end in explicit(node)] == (["/x"] if "template" in before else [])


def test_stays_quiet_of_a_program_that_is_no_node() -> None:
    cmake = ROS2_CMAKE.format("p") + "ament_auto_add_executable(n src/n.cpp)\nament_auto_package()\n"
    found = follow({"p/CMakeLists.txt": cmake, "p/src/n.cpp": "int main() { pkg::Tool<int> t; return t.run(); }\n"}, 2)
    assert found.configurations == ()


def test_stays_quiet_of_a_template_that_is_given_no_class_that_makes_something() -> None:
    body = 'auto n = std::make_shared<rclcpp::Node>("a"); pkg::Buffer<Data> b; b.fill(); rclcpp::spin(n);'
    node = the_node(ros2_main(body, "struct Data { int a; };\n"))
    assert (node.name, node.unknowns, explicit(node)) == ("/a", (), [])


def test_stays_quiet_of_a_template_of_the_workspace_that_has_specialisations() -> None:
    slot = "template <class T, bool> class Slot {};\ntemplate <class T> class Slot<T, true> { T item; };\n"
    body = 'auto n = std::make_shared<rclcpp::Node>("a"); Slot<Mode, true> s(1); rclcpp::spin(n);'
    node = the_node(ros2_main(body, MODE + slot))
    assert (node.name, reasons(node)) == (
        "/a",
        ["the class template Slot has specialisations, and which one is meant is not followed"],
    )


@pytest.mark.parametrize(
    "body",
    [
        "rospy.sleep(pkg.pause())",
        "rospy.wait_for_service(pkg.name())",
        "rospy.wait_for_message('a', pkg.Data())",
        "rospy.spin(rospy.create_node('a'))",
    ],
)
def test_ros_1_has_none(body: str) -> None:
    """What a call that lets time pass is given is no node there."""
    assert ros1_python(f"import pkg\n{body}\n").unknowns == ()


def test_a_program_for_both_has_one_where_ros_1_initialises_it() -> None:
    assert ros1_cpp('#ifdef ROS2\nrclcpp::init(argc, argv);\n#endif\nADV("x", 1);').unknowns == ()
