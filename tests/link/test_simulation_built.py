# SPDX-License-Identifier: Apache-2.0
"""Plug-ins of Gazebo that the workspace builds: followed in the simulator's node with their description, else each by itself."""

from __future__ import annotations

from pathlib import Path

import pytest
from follow_kit import CPP_HEAD, ROS2_CMAKE, Nothing, explicit, follow, workspace

from haros_ci.analysis.architecture import architecture
from haros_ci.config.settings import Settings
from haros_ci.model.architecture import Configuration, Node

CMAKE = "cmake_minimum_required(VERSION 3.0)\nproject(p)\nfind_package(catkin REQUIRED)\ncatkin_package()\nadd_library(eye src/eye.cpp)\n"
LAUNCH = (
    '<launch><include file="$(find gazebo_ros)/launch/empty_world.launch"/>{}'
    '<param name="robot_description" command="$(find xacro)/xacro $(find p)/urdf/r.xacro"/>'
    '<node pkg="gazebo_ros" type="spawn_model" name="spawn" args="-urdf -param robot_description -model rover {}"/></launch>'
)
ROBOT = '<robot name="rover" xmlns:xacro="http://ros.org/xacro"><link name="head"/>{}</robot>'
USE = '<gazebo><plugin name="e" filename="libeye.so">{}</plugin></gazebo>'
IN_SENSOR = '<gazebo reference="head"><sensor type="ray" name="ray"><plugin name="e" filename="libeye.so">{}</plugin></sensor></gazebo>'
PUB = "advertise<std_msgs::String>({}, 1);"


def plugin(
    load: str, more: str = "", register: str = "GZ_REGISTER_MODEL_PLUGIN(Eye)", base: str = "ModelPlugin"
) -> str:
    """The class ``gazebo::Eye`` with this in its ``Load``."""
    kind = "sensors::SensorPtr" if "SENSOR" in register else "physics::ModelPtr"
    return (
        f"{CPP_HEAD}#include <gazebo/gazebo.hh>\nnamespace gazebo {{\nclass Eye : public {base} {{\npublic:\n"
        f"void Load({kind} _parent, sdf::ElementPtr _sdf) {{ {load} }}\n{more}\n"
        f"boost::shared_ptr<ros::NodeHandle> nh_;\nros::Publisher pub_;\nint a_;\n}};\n{register}\n}}\n"
    )


def texts(code: str, inner: str, words: str = "", cmake: str = CMAKE, launch: str = "") -> dict[str, str]:
    return {
        "p/CMakeLists.txt": cmake,
        "p/launch/l.launch": LAUNCH.format(launch, words),
        "p/urdf/r.xacro": ROBOT.format(inner),
        "p/src/eye.cpp": code,
    }


def configurations(
    code: str, inner: str, words: str = "", cmake: str = CMAKE, launch: str = ""
) -> dict[str, Configuration]:
    found = architecture(
        workspace(texts(code, inner, words, cmake, launch)),
        Settings(root=Path("/nowhere")),
        Nothing(),
        environment={},
        known_nodes=True,
    )
    return {each.name: each for each in found.configurations}


def simulator(code: str, inner: str, words: str = "", launch: str = "") -> Node:
    """The node of the simulator; nothing of the plug-in stands alone, nor is there a node of its own."""
    found = configurations(code, inner, words, launch=launch)
    assert list(found) == ["p/launch/l.launch"]
    (node,) = (each for each in found["p/launch/l.launch"].nodes if each.name == "/gazebo")
    assert "plugin" not in [each.kind for each in found["p/launch/l.launch"].nodes]
    return node


def of_code(node: Node, kind: str = "publishers") -> list[str]:
    """The names of what the plug-in's code makes."""
    return [e.name for e in node.endpoints if e.kind == kind and e.location and e.location.path.endswith(".cpp")]


def lost(node: Node) -> list[str]:
    return [each.reason for each in node.unknowns if each.field == "endpoints"]


GLOBAL = 'ros::NodeHandle nh(_sdf->Get<std::string>("robotNamespace")); '
TOPIC = (
    'std::string topic = "scan"; if (_sdf->HasElement("topic")) topic = _sdf->GetElement("topic")->Get<std::string>(); '
)
HELPER = 'boost::shared_ptr<GazeboRos> ros = GazeboRosPtr(new GazeboRos(_parent, _sdf, "Eye")); ros->node()->'


@pytest.mark.parametrize(
    ("load", "inner", "words", "expected"),
    [
        ("ros::NodeHandle nh; nh." + PUB.format('"fixed"'), "", "", "/fixed"),
        (TOPIC + "ros::NodeHandle nh; nh." + PUB.format("topic"), "", "", "/scan"),
        (TOPIC + "ros::NodeHandle nh; nh." + PUB.format("topic"), "<topic> front </topic>", "", "/front"),
        ('ros::NodeHandle nh; nh.' + PUB.format('_sdf->Get<std::string>("topic")'), "<topic>front</topic>", "", "/front"),
        ('ros::NodeHandle nh; nh.' + PUB.format('_sdf->Get<std::string>("topic", "near").first'), "", "", "/near"),
        ('ros::NodeHandle nh; nh.' + PUB.format('_sdf->Get<std::string>("name")'), "", "", "/e"),
        ('ros::NodeHandle nh; nh.' + PUB.format('_sdf->GetAttribute("name")->GetAsString()'), "", "", "/e"),
        ('ros::NodeHandle nh; nh.' + PUB.format('_sdf->GetElement("topic")->GetValue()->GetAsString()'), "<topic>v</topic>", "", "/v"),
        ('ros::NodeHandle nh; if (_sdf->Get<bool>("on")) nh.' + PUB.format('"on"'), "<on>1</on>", "", "/on"),
        (GLOBAL + "nh." + PUB.format('"t"'), "<robotNamespace>own</robotNamespace>", "", "/own/t"),
        (GLOBAL + "nh." + PUB.format('"t"'), "", "-robot_namespace r1", "/r1/t"),
        ("nh_.reset(new ros::NodeHandle(_parent->GetName())); nh_->" + PUB.format('"t"'), "", "", "/rover/t"),
        (HELPER + PUB.format('"t"'), "<robotNamespace>own</robotNamespace>", "", "/own/t"),
        (HELPER + PUB.format('"t"'), "<robotNamespace/>", "", "/rover/t"),
        (HELPER + PUB.format('"t"'), "", "", "/t"),  # the spawner gives it /
    ],
)  # fmt: skip
def test_a_plugin_in_a_started_simulator(load: str, inner: str, words: str, expected: str) -> None:
    node = simulator(plugin(load), USE.format(inner), words)
    assert of_code(node) == [expected]
    assert lost(node) == []


def test_what_is_called_back_and_parameters_of_the_server() -> None:
    code = plugin(
        'ros::NodeHandle nh; std::string t; nh.param("topic", t, std::string("x")); nh.subscribe(t, 1, &Eye::take, this);'
        "c_ = event::Events::ConnectWorldUpdateBegin(boost::bind(&Eye::OnUpdate, this));",
        "void take(const std_msgs::String::ConstPtr & m) {}\nevent::ConnectionPtr c_;\n"
        "void OnUpdate() { ros::NodeHandle nh; nh." + PUB.format('"late"') + " }",
    )
    node = simulator(code, USE.format(""), launch='<param name="topic" value="front"/>')
    assert of_code(node, "subscribers") == ["/front"]
    assert of_code(node) == ["/late"]


def test_a_plugin_for_sensors() -> None:
    load = "ros::NodeHandle nh; nh." + PUB.format("_parent->Name()")
    code = plugin(load, register="GZ_REGISTER_SENSOR_PLUGIN(Eye)", base="SensorPlugin")
    assert of_code(simulator(code, IN_SENSOR.format(""))) == ["/ray"]


def test_what_a_function_template_reads() -> None:
    reader = (
        "template <class T> void read(sdf::ElementPtr sdf, const std::string& name, T& value, const T& otherwise) {\n"
        "  if (sdf->HasElement(name)) value = sdf->GetElement(name)->Get<T>(); else value = otherwise; }\n"
    )
    load = 'std::string space; std::string topic; read<std::string>(_sdf, "robotNamespace", space, space); read(_sdf, "topic", topic, std::string("scan"));'
    code = plugin(load + "ros::NodeHandle nh(space); nh." + PUB.format("topic")).replace(
        "namespace gazebo {\n", "namespace gazebo {\n" + reader
    )
    assert of_code(simulator(code, USE.format("<robotNamespace>own</robotNamespace>"))) == ["/own/scan"]
    assert of_code(simulator(code, USE.format("<topic>front</topic>"))) == ["/front"]


def test_two_uses_of_one_plugin() -> None:
    load = "ros::NodeHandle nh; nh." + PUB.format('_sdf->Get<std::string>("topic")')
    uses = USE.format("<topic>a</topic>") + USE.format("<topic>b</topic>")
    assert of_code(simulator(plugin(load), uses)) == ["/a", "/b"]


def test_a_condition_of_the_description_that_is_not_known() -> None:
    load = "ros::NodeHandle nh; nh." + PUB.format('"t"')
    inner = f'<xacro:include filename="/elsewhere.xacro"/><xacro:if value="${{gone}}">{USE.format("")}</xacro:if>'
    (end,) = (e for e in simulator(plugin(load), inner).endpoints if e.name == "/t")
    assert [u.reason for u in end.unknowns] == ["it stands in the description under a condition that is not known"]


def test_a_value_of_the_description_that_is_not_known() -> None:
    load = "ros::NodeHandle nh; nh." + PUB.format('_sdf->Get<std::string>("topic")')
    inner = '<xacro:include filename="/elsewhere.xacro"/>' + USE.format("<topic>${gone}</topic>")
    (end,) = (e for e in simulator(plugin(load), inner).endpoints if e.location and e.location.path.endswith(".cpp"))
    assert (end.name, [u.reason for u in end.unknowns]) == ("/?", ["its value in the description is not known"])


ALONE = "p/eye (plug-ins)"


@pytest.mark.parametrize(
    "register",
    ["GZ_REGISTER_MODEL_PLUGIN(Eye)", "GZ_REGISTER_MODEL_PLUGIN(gazebo::Eye)", "GZ_REGISTER_WORLD_PLUGIN(Eye)", "GZ_REGISTER_SYSTEM_PLUGIN(Eye)"],
)  # fmt: skip
def test_what_nothing_starts_is_followed_alone(register: str) -> None:
    load = (
        TOPIC + "ros::NodeHandle nh; nh." + PUB.format('"t"') + "nh." + PUB.format("topic") + HELPER + PUB.format('"h"')
    )
    found = configurations(plugin(load, register=register), "")
    assert list(found) == ["p/launch/l.launch", ALONE]
    (node,) = found[ALONE].nodes
    assert (node.name, node.package, node.class_name) == ("/?", "p", "gazebo::Eye")
    assert [u.reason for u in node.unknowns] == ["it is the node of the simulator that loads it"]
    assert sorted(e.name for e in explicit(node)) == ["/?", "/?/h", "/t"]


@pytest.mark.parametrize(
    ("inner", "cmake"),
    [
        (USE.format("").replace("libeye", "libnose"), CMAKE),  # another library
        (f"<!--{USE.format('')}-->", CMAKE),
        (IN_SENSOR.format(""), CMAKE),  # a plug-in for models in a sensor
        (USE.format("").replace("<gazebo>", '<gazebo reference="head">'), CMAKE),
    ],
)
def test_what_no_started_simulator_loads(inner: str, cmake: str) -> None:
    found = configurations(plugin("ros::NodeHandle nh; nh." + PUB.format('"t"')), inner, cmake=cmake)
    assert list(found) == ["p/launch/l.launch", ALONE]
    (node,) = (each for each in found["p/launch/l.launch"].nodes if each.name == "/gazebo")
    assert of_code(node) == []


@pytest.mark.parametrize(
    "code",
    [
        plugin("int a = 1;"),  # it makes nothing
        plugin("ros::NodeHandle nh; nh." + PUB.format('"t"'), register=""),
        plugin("ros::NodeHandle nh; nh." + PUB.format('"t"'), register="GZ_REGISTER_GUI_PLUGIN(Eye)"),
        plugin("ros::NodeHandle nh; nh." + PUB.format('"t"'), register="GZ_REGISTER_MODEL_PLUGIN(Nose)"),
    ],
)
def test_what_has_no_configuration(code: str) -> None:
    assert list(configurations(code, "")) == ["p/launch/l.launch"]


def test_a_class_that_another_library_registers_too() -> None:
    cmake = CMAKE + "add_library(both src/eye.cpp)\n"
    found = configurations(plugin("ros::NodeHandle nh; nh." + PUB.format('"t"')), USE.format(""), cmake=cmake)
    assert list(found) == ["p/launch/l.launch"]


GZ_CODE = (
    "#include <rclcpp/rclcpp.hpp>\n#include <std_msgs/msg/string.hpp>\n#include <gz/sim/System.hh>\nnamespace p {\n"
    "class Eye : public gz::sim::System, public gz::sim::ISystemConfigure {\npublic:\n"
    "void Configure(const gz::sim::Entity & e, const std::shared_ptr<const sdf::Element> & s, gz::sim::EntityComponentManager & m, gz::sim::EventManager & v) {\n"
    '  node_ = rclcpp::Node::make_shared("eye");\n  pub_ = node_->create_publisher<std_msgs::msg::String>("seen", 1);\n}\n'
    "rclcpp::Node::SharedPtr node_;\nrclcpp::Publisher<std_msgs::msg::String>::SharedPtr pub_;\n};\n}\n{}\n"
)


@pytest.mark.parametrize("macro", ["GZ_ADD_PLUGIN", "IGNITION_ADD_PLUGIN"])
def test_a_system_of_the_new_gazebo(macro: str) -> None:
    registered = f"{macro}(p::Eye, gz::sim::System, p::Eye::ISystemConfigure)"
    cmake = ROS2_CMAKE.format("p") + "add_library(eye SHARED src/eye.cpp)\n"
    found = follow({"p/CMakeLists.txt": cmake, "p/src/eye.cpp": GZ_CODE.replace("{}", registered)}, ros=2)
    (made,) = found.configurations
    assert made.name == ALONE
    assert [(node.name, [e.name for e in explicit(node)]) for node in made.nodes] == [("/eye", ["/seen"])]


def test_a_registration_in_a_header() -> None:
    code = plugin("ros::NodeHandle nh; nh." + PUB.format('"t"'))
    files = texts('#include "eye.h"\nnamespace gazebo { void Eye::OnUpdate() {} }\n', USE.format(""))
    files["p/src/eye.h"] = code.replace("int a_;", "void OnUpdate();")
    found = follow(files)
    assert [each.name for each in found.configurations] == ["p/launch/l.launch"]


def test_a_helper_of_the_workspace_is_followed() -> None:
    helper = (
        "class GazeboRos {\npublic:\nGazeboRos(physics::ModelPtr p, sdf::ElementPtr s, const std::string & n) "
        '{ nh_.reset(new ros::NodeHandle("mine")); }\nboost::shared_ptr<ros::NodeHandle> & node() { return nh_; }\n'
        "boost::shared_ptr<ros::NodeHandle> nh_;\n};\ntypedef boost::shared_ptr<GazeboRos> GazeboRosPtr;\n"
    )
    code = plugin(
        'ros_ = GazeboRosPtr(new GazeboRos(_parent, _sdf, "Eye")); ros_->node()->' + PUB.format('"t"'),
        "GazeboRosPtr ros_;",
    )
    code = code.replace("namespace gazebo {\n", "namespace gazebo {\n" + helper)
    assert of_code(simulator(code, USE.format(""))) == ["/mine/t"]


CLASSIC2 = (
    "#include <gazebo_ros/node.hpp>\n#include <std_msgs/msg/string.hpp>\nnamespace g {\nclass Eye : public gazebo::ModelPlugin {\npublic:\n"
    "void Load(gazebo::physics::ModelPtr model, sdf::ElementPtr sdf) override {\n  ros_node_ = gazebo_ros::Node::Get(%s);\n"
    '  pub_ = ros_node_->create_publisher<std_msgs::msg::String>("~/out", 1);\n}\n'
    "gazebo_ros::Node::SharedPtr ros_node_;\nrclcpp::Publisher<std_msgs::msg::String>::SharedPtr pub_;\n};\nGZ_REGISTER_MODEL_PLUGIN(Eye)\n}\n"
)


@pytest.mark.parametrize(
    ("given", "expected"),
    [
        ("sdf", ("/?", ["/?/out"])),
        ("", ("/gazebo", ["/gazebo/out"])),
        ('sdf, "eye_node"', ("/eye_node", ["/eye_node/out"])),
    ],
)
def test_the_node_of_a_plugin_in_ros2(given: str, expected: tuple[str, list[str]]) -> None:
    cmake = ROS2_CMAKE.format("p") + "add_library(eye SHARED src/eye.cpp)\n"
    (made,) = follow({"p/CMakeLists.txt": cmake, "p/src/eye.cpp": CLASSIC2 % given}, ros=2).configurations
    assert made.name == ALONE
    assert [(node.name, [e.name for e in explicit(node)]) for node in made.nodes] == [expected]


WRITTEN = CMAKE + (
    'set(TOPIC front)\nset(USES "<xacro:eye/>\\n")\n'
    "configure_file(urdf/eyes.in.xacro ${PROJECT_SOURCE_DIR}/urdf/eyes.xacro @ONLY)\n"
)
EYES = '<robot xmlns:xacro="http://ros.org/xacro"><xacro:macro name="eye">' + USE + "</xacro:macro>\n@USES@\n</robot>"


def written(inner: str, cmake: str = WRITTEN) -> dict[str, Configuration]:
    """With a description that CMake writes, included by the robot's."""
    code = plugin(TOPIC + "ros::NodeHandle nh; nh." + PUB.format("topic"))
    files = texts(code, '<xacro:include filename="$(find p)/urdf/eyes.xacro"/>', cmake=cmake)
    found = architecture(
        workspace({**files, "p/urdf/eyes.in.xacro": EYES.format(inner)}),
        Settings(root=Path("/nowhere")),
        Nothing(),
        environment={},
        known_nodes=True,
    )
    return {each.name: each for each in found.configurations}


def test_a_description_that_cmake_writes() -> None:
    for inner, name in (("", "/scan"), ("<topic>@TOPIC@</topic>", "/front"), ("<topic>${TOPIC}</topic>", "/?")):
        (node,) = (each for each in written(inner)["p/launch/l.launch"].nodes if each.name == "/gazebo")
        assert of_code(node) == [name]


def test_what_of_a_written_description_is_not_known() -> None:
    found = written("<topic>@OTHER@</topic>")["p/launch/l.launch"]
    assert [of_code(node) for node in found.nodes if node.name == "/gazebo"] == [["/?"]]
    for cmake in (CMAKE, f"{CMAKE}if(X_FOUND)\n{WRITTEN.removeprefix(CMAKE)}endif()\n"):  # not written, or not surely
        alone = written("", cmake)
        assert [of_code(node) for node in alone["p/launch/l.launch"].nodes if node.name == "/gazebo"] == [[]]
        assert "p/eye (plug-ins)" in alone


@pytest.mark.parametrize(
    ("inner", "expected"),
    [
        ("<topic>front</topic>", "/front"),
        ('<xacro:if value="${1 > 0}"><topic>front</topic></xacro:if>', "/front"),
        ('<xacro:if value="$(optenv SIDE)"><topic>front</topic></xacro:if>', "/?"),
        ('<xacro:unless value="$(optenv SIDE)"><topic>front</topic></xacro:unless>', "/?"),
        ("<topic>$(optenv SIDE)</topic>", "/?"),
    ],
)
def test_what_stands_in_a_plugin_under_an_unknown_condition(inner: str, expected: str) -> None:
    load = "ros::NodeHandle nh; nh." + PUB.format('_sdf->Get<std::string>("topic")')
    node = simulator(plugin(load), f'<xacro:if value="$(optenv EYES)">{USE.format(inner)}</xacro:if>')
    (end,) = (e for e in node.endpoints if e.location and e.location.path.endswith(".cpp"))
    assert end.name == expected
    assert "conditions" in [unknown.field for unknown in end.unknowns]
