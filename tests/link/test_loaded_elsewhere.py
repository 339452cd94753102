# SPDX-License-Identifier: Apache-2.0
"""Plug-ins that nothing in the workspace loads: each by itself, on the node of the program that loads it."""

from __future__ import annotations

import pytest
from follow_kit import CMAKE, CPP_HEAD, ROS2_CMAKE, explicit, follow

from haros_ci.model.architecture import Architecture, Endpoint, Node

ROS1_PACKAGE = '<package><name>p</name><export><tools plugin="${prefix}/plugins.xml"/></export></package>'
ROS2_PACKAGE = ROS1_PACKAGE.replace("<export>", "<depend>rclcpp</depend><export><build_type>ament_cmake</build_type>")
LIBRARY = "add_library(layer src/layer.cpp)\n"
ROS2_HEAD = "#include <rclcpp/rclcpp.hpp>\n#include <std_msgs/msg/string.hpp>\n"
ADVERTISE = 'nh.advertise<std_msgs::String>("a", 1);'


def described(base: str) -> str:
    return f'<library path="layer"><class name="p/Layer" type="p::Layer" base_class_type="{base}"/></library>'


def ros1(inside: str, base: str = "tools::Tool", more: str = "", extra: str = "") -> Architecture:
    """A plug-in with this inside of its class; *extra* are further targets of CMake."""
    code = f"namespace p {{\nclass Layer : public {base} {{\npublic:\n{inside}\nint a_;\n}};\n}}\n{more}"
    texts = {"p/package.xml": ROS1_PACKAGE, "p/plugins.xml": described(base), "p/src/layer.cpp": CPP_HEAD + code}
    return follow(texts | {"p/CMakeLists.txt": CMAKE.format("p") + LIBRARY + extra})


def ros2(inside: str, base: str = "tools::Tool", before: str = "") -> Architecture:
    code = f"{before}namespace p {{\nclass Layer : public {base} {{\npublic:\n{inside}\nint a_;\n}};\n}}\n"
    texts = {"p/package.xml": ROS2_PACKAGE, "p/plugins.xml": described(base), "p/src/layer.cpp": ROS2_HEAD + code}
    return follow(texts | {"p/CMakeLists.txt": ROS2_CMAKE.format("p") + LIBRARY}, 2)


def loaded(found: Architecture) -> Node:
    (configuration,) = found.configurations
    assert configuration.name in ("p/p::Layer (plug-ins)", "p/p.layer.Layer (plug-ins)")
    (node,) = configuration.nodes
    fields = {why.field for why in node.unknowns}
    assert node.name == "/?" and "endpoints" in fields
    return node


def made(found: Architecture, kind: str = "publishers") -> list[Endpoint]:
    return explicit(loaded(found), kind)


@pytest.mark.parametrize(
    ("inside", "names"),
    [
        (f"void initialize() {{ ros::NodeHandle nh; {ADVERTISE} }}", ["/a"]),
        (f"void initialize(std::string name, Map* map) {{ ros::NodeHandle nh; {ADVERTISE} }}", ["/a"]),
        (f"bool plan() override {{ ros::NodeHandle nh; {ADVERTISE} return true; }}", ["/a"]),
        (f"bool plan() {{ ros::NodeHandle nh; {ADVERTISE} return true; }}", ["/a"]),
        (f"void initialize() {{ go(); }} void go() {{ ros::NodeHandle nh; {ADVERTISE} }}", ["/a"]),
        (f'void initialize() {{ ros::NodeHandle nh("~"); {ADVERTISE} }}', ["/?/a"]),
        (f'void initialize(std::string name) {{ ros::NodeHandle nh("~/" + name); {ADVERTISE} }}', ["/?/?/a"]),
        (f"void load(ros::NodeHandle& nh) {{ {ADVERTISE} }}", ["/?/a"]),
    ],
)
def test_what_a_plugin_of_ros_1_overrides_is_called(inside: str, names: list[str]) -> None:
    assert [end.name for end in made(ros1(inside))] == names


@pytest.mark.parametrize(
    "inside",
    [
        'void onInitialize() override { auto n = node_.lock(); n->create_publisher<std_msgs::msg::String>("a", 1); }',
        'void onInitialize() { node_->create_publisher<std_msgs::msg::String>("a", 1); }',
        "void configure(const rclcpp_lifecycle::LifecycleNode::WeakPtr & parent, std::string name) override {"
        ' auto n = parent.lock(); n->create_publisher<std_msgs::msg::String>("a", 1); }',
        'void init(rclcpp::Node::SharedPtr n) { n->create_publisher<std_msgs::msg::String>("a", 1); }',
    ],
)
def test_a_plugin_of_ros_2_has_the_node_of_whoever_loads_it(inside: str) -> None:
    (end,) = made(ros2(inside))
    assert (end.name, end.type) == ("/a", "std_msgs/msg/String")


def initialized(code: str) -> str:
    return f"void init(rclcpp::Node::SharedPtr n) {{ {code} }}"


#: ROS 2: names made of a parameter that whoever loads the plug-in may set.
GIVEN = [
    'std::string t = n->declare_parameter("topic", "t"); n->create_publisher<std_msgs::msg::String>(t, 1);',
    'n->declare_parameter("topic", "t"); auto t = n->get_parameter("topic").as_string();'
    " n->create_publisher<std_msgs::msg::String>(t, 1);",
    'std::string t; n->get_parameter_or("topic", t, std::string("<undefined>"));'
    " n->create_publisher<std_msgs::msg::String>(t, 1);",
    'std::string t = "<undefined>"; n->get_parameter("topic", t); n->create_publisher<std_msgs::msg::String>(t, 1);',
]


@pytest.mark.parametrize("code", GIVEN)
def test_in_ros_2_a_parameter_that_whoever_loads_it_may_set_is_not_known(code: str) -> None:
    (end,) = made(ros2(initialized(code)))
    assert end.name == "/?"
    reasons = {"whoever loads it may set it", "it is given from outside, but the node is not seen to declare it"}
    assert reasons & {unknown.reason for unknown in end.unknowns if unknown.field == "name"}


@pytest.mark.parametrize(
    ("code", "expected"),
    [
        ('n->create_publisher<std_msgs::msg::String>("a", 1);', "/a"),
        ('std::string t = "b"; n->create_publisher<std_msgs::msg::String>(t, 1);', "/b"),
        ('n->declare_parameter("rate", 5); n->create_publisher<std_msgs::msg::String>("c", 1);', "/c"),
        (
            'n->declare_parameter("topic", "t"); n->set_parameter(rclcpp::Parameter("topic", "d"));'
            ' n->create_publisher<std_msgs::msg::String>(n->get_parameter("topic").as_string(), 1);',
            "/d",
        ),
        ('n->create_publisher<std_msgs::msg::String>("~/e", 1);', "/?/e"),
    ],
)
def test_in_ros_2_what_no_parameter_tells_is_known(code: str, expected: str) -> None:
    (end,) = made(ros2(initialized(code)))
    assert end.name == expected


def test_in_ros_2_a_declaration_keeps_its_default() -> None:
    (end,) = made(ros2(initialized('n->declare_parameter("rate", 5);')), "parameters")
    assert (end.name, end.value, end.effective) == ("/?:rate", 5, None)
    assert "whoever loads it may set it" in [why.reason for why in end.unknowns]


def test_a_base_class_of_the_workspace_holds_the_node() -> None:
    base = "namespace p { class Base { public: virtual void initialize() = 0; protected: rclcpp::Node::SharedPtr node_; }; }\n"
    (end,) = made(
        ros2('void initialize() override { node_->declare_parameter("rate", 5); }', "p::Base", base), "parameters"
    )
    assert (end.name, end.value) == ("/?:rate", 5)


def test_a_python_plugin_is_made() -> None:
    texts = {
        "p/package.xml": ROS1_PACKAGE,
        "p/plugins.xml": described("rqt_gui_py::Plugin").replace("p::Layer", "p.layer.Layer"),
        "p/CMakeLists.txt": CMAKE.format("p") + "catkin_python_setup()\n",
        "p/setup.py": "from distutils.core import setup\nsetup(packages=['p'], package_dir={'': 'src'})\n",
        "p/src/p/__init__.py": "",
        "p/src/p/layer.py": "import rospy\nfrom std_msgs.msg import String\nfrom rqt_gui_py.plugin import Plugin\n"
        "class Layer(Plugin):\n    def __init__(self, context):\n        rospy.Publisher('a', String, queue_size=1)\n",
    }
    assert [end.name for end in made(follow(texts))] == ["/a"]


BODY = f"void initialize() {{ ros::NodeHandle nh; {ADVERTISE} }}"
LOADER = (
    'int main(int argc, char** argv) { ros::init(argc, argv, "n"); pluginlib::ClassLoader<p::Base> loader("p", "p::Base");'
    ' auto layer = loader.createInstance("p/Layer"); layer->initialize(); }\n'
)


@pytest.mark.parametrize(
    ("inside", "base"),
    [
        ("void initialize() {}", "tools::Tool"),  # makes nothing
        ("private: void helper() {{ other(); }} void other() {{}}", "tools::Tool"),
        (BODY.replace("initialize", "onInit"), "nodelet::Nodelet"),
        (BODY, "controller_interface::ControllerBase"),
    ],
)
def test_other_plugins_have_no_configuration_of_this_kind(inside: str, base: str) -> None:
    found = ros1(inside, base)
    assert [each.name for each in found.configurations if "p::Layer" in each.name] == []


def test_a_plugin_that_a_program_loads_is_there_once() -> None:
    texts = {
        "p/package.xml": ROS1_PACKAGE,
        "p/plugins.xml": described("p::Base"),
        "p/include/p/base.h": "namespace p { struct Base { virtual void initialize() = 0; }; }\n",
        "p/src/layer.cpp": CPP_HEAD
        + f"#include <p/base.h>\nnamespace p {{ class Layer : public Base {{ public: {BODY} }}; }}\n",
        "p/src/main.cpp": CPP_HEAD + "#include <p/base.h>\n#include <pluginlib/class_loader.h>\n" + LOADER,
        "p/CMakeLists.txt": CMAKE.format("p") + LIBRARY + "add_executable(n src/main.cpp)\n",
    }
    assert [each.name for each in follow(texts).configurations] == ["p/n"]
