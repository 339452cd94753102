# SPDX-License-Identifier: Apache-2.0
"""ROS 1: controllers of the workspace that a spawner asks for are on the node of their manager, with the names that they have there."""

from __future__ import annotations

from pathlib import Path

import pytest
from follow_kit import CPP_HEAD, Nothing, workspace

from haros_ci.analysis.architecture import architecture
from haros_ci.config.settings import Settings
from haros_ci.model.architecture import Architecture, Node

CMAKE = (
    "cmake_minimum_required(VERSION 3.0)\nproject(arm)\nfind_package(catkin REQUIRED)\ncatkin_package()\n"
    "add_library(arm_lib src/lift.cpp)\nadd_executable(hw src/hw.cpp)\n"
)
PACKAGE = '<package><name>arm</name><export><controller_interface plugin="${prefix}/plugins.xml"/></export></package>'
BASE = "controller_interface::ControllerBase"
DESCRIBED = (
    f'<library path="lib/libarm_lib"><class name="arm/Lift" type="arm::Lift" base_class_type="{BASE}"/></library>'
)
LIFT = (
    CPP_HEAD
    + """#include <controller_interface/controller.h>
namespace arm {
class Lift : public controller_interface::Controller<hardware_interface::EffortJointInterface> {
public:
  bool init(hardware_interface::EffortJointInterface* hw, ros::NodeHandle& root, ros::NodeHandle& nh) {
    std::string topic;
    nh.param<std::string>("topic", topic, "state");
    a_ = nh.advertise<std_msgs::String>(topic, 1);
    b_ = root.advertise<std_msgs::String>("all", 1);
    return true;
  }
  ros::Publisher a_, b_;
};
}
"""
)
MANAGER = (
    CPP_HEAD
    + """#include <controller_manager/controller_manager.h>
class Robot : public hardware_interface::RobotHW {};
int main(int argc, char** argv) {
  ros::init(argc, argv, "hw");
  ros::NodeHandle nh;
  Robot robot;
  controller_manager::ControllerManager manager(&robot, nh);
  ros::spin();
}
"""
)
HARDWARE = '<node pkg="arm" type="hw" name="hw"/>'
TYPED = "<rosparam>{lift: {type: arm/Lift}, other: {type: arm/Lift, topic: mine}, drive: {type: diff_drive_controller/DiffDriveController}}</rosparam>"


def spawner(words: str, more: str = "") -> str:
    return f'<node pkg="controller_manager" type="spawner" name="s" args="{words}" {more}/>'


def system(launch: str, lift: str = LIFT, known: bool = False, **files: str) -> Architecture:
    texts = {
        "arm/CMakeLists.txt": CMAKE,
        "arm/package.xml": PACKAGE,
        "arm/plugins.xml": DESCRIBED,
        "arm/src/lift.cpp": lift,
        "arm/src/hw.cpp": MANAGER,
        "arm/launch/l.launch": f"<launch>{launch}</launch>",
        **{path.replace("__", "/"): text for path, text in files.items()},
    }
    return architecture(workspace(texts), Settings(root=Path("/nowhere")), Nothing(), environment={}, known_nodes=known)


def published(nodes: tuple[Node, ...]) -> dict[str, list[str]]:
    """The publishers of each node that has some."""
    found = {
        node.name: sorted(end.name for end in node.endpoints if end.kind == "publishers" and not end.implicit)
        for node in nodes
    }
    return {name: ends for name, ends in found.items() if ends}


ONE = {"/hw": ["/all", "/lift/state"]}
IN_BOT = {"/bot/hw": ["/bot/all", "/bot/lift/state"]}


@pytest.mark.parametrize(
    ("launch", "expected"),
    [
        (HARDWARE + TYPED + spawner("lift"), ONE),
        (HARDWARE + TYPED + spawner("--stopped lift"), ONE),
        (HARDWARE + TYPED + spawner("lift drive nothing"), ONE),
        (f'<group ns="bot">{HARDWARE}{TYPED}{spawner("lift")}</group>', IN_BOT),
        (f'<group ns="bot">{HARDWARE}{TYPED}</group>{spawner("--namespace=/bot lift")}', IN_BOT),
        (f'<group ns="bot">{HARDWARE}{TYPED}</group>' + spawner("lift", 'ns="bot"'), IN_BOT),
        (HARDWARE + TYPED + spawner("lift other"), {"/hw": ["/all", "/all", "/lift/state", "/other/mine"]}),
        (
            HARDWARE.replace("/>", '><remap from="lift/state" to="up"/></node>') + TYPED + spawner("lift"),
            {"/hw": ["/all", "/up"]},
        ),
    ],
)
def test_a_controller_is_on_its_managers_node(launch: str, expected: dict[str, list[str]]) -> None:
    (configuration,) = system(launch).configurations
    assert published(configuration.nodes) == expected


@pytest.mark.parametrize(
    "launch",
    [
        HARDWARE + TYPED,
        HARDWARE + TYPED + spawner(""),
        HARDWARE + TYPED + spawner("drive"),
        HARDWARE + spawner("lift"),
        HARDWARE + "<rosparam>{lift: {type: arm/Other}}</rosparam>" + spawner("lift"),
        HARDWARE + "<rosparam>{lift: {type: 3}}</rosparam>" + spawner("lift"),
        HARDWARE + TYPED + spawner("$(env WHICH)"),
        HARDWARE + TYPED + '<node pkg="other" type="spawner" name="s" args="lift"/>',
    ],
)
def test_one_that_nobody_asks_for_stands_alone(launch: str) -> None:
    """Of which controllers there are, their types or names nothing is known."""
    names = {configuration.name: configuration.nodes for configuration in system(launch).configurations}
    assert published(names["arm/launch/l.launch"]) == {}
    assert published(names["arm/Lift (plug-ins)"]) == {"/?": ["/?", "/all"]}


@pytest.mark.parametrize(
    "launch",
    [
        TYPED + spawner("lift"),
        f'<group ns="bot">{HARDWARE}</group>{TYPED}{spawner("lift")}',
        HARDWARE + HARDWARE.replace('"hw"/', '"two"/') + TYPED + spawner("lift"),
    ],
)
def test_a_manager_that_is_not_seen(launch: str) -> None:
    """Its namespace and that of the controller are those of the spawner, and the node is not known."""
    configuration = next(one for one in system(launch).configurations if one.name == "arm/launch/l.launch")
    (node,) = (node for node in configuration.nodes if node.name == "/?")
    assert published((node,)) == {"/?": ["/all", "/lift/state"]}
    assert "name" in {unknown.field for unknown in node.unknowns}


def test_conditions_of_the_spawner() -> None:
    launch = f'<arg name="sim" default="true"/>{HARDWARE}{TYPED}' + spawner("lift", 'if="$(arg sim)"')
    (configuration,) = system(launch).configurations
    assert published(configuration.nodes) == ONE
    off = system(launch.replace('default="true"', 'default="false"'))
    names = {configuration.name: configuration.nodes for configuration in off.configurations}
    assert published(names["arm/launch/l.launch"]) == {}


def test_a_file_of_the_spawner() -> None:
    launch = HARDWARE + spawner("$(find arm)/config/c.yaml")
    files = {"arm__config__c.yaml": "lift: {type: arm/Lift, topic: filed}\n"}
    (configuration,) = system(launch, **files).configurations
    assert published(configuration.nodes) == {"/hw": ["/all", "/lift/filed"]}


#: A robot that a launch file spawns in Gazebo, with the plug-in that has a controller manager.
GAZEBO = (
    '<include file="$(find gazebo_ros)/launch/empty_world.launch"/>'
    '<param name="robot_description" command="$(find xacro)/xacro $(find arm)/urdf/r.xacro"/>'
    '<node pkg="gazebo_ros" type="spawn_model" name="spawn" args="-urdf -param robot_description -model arm"/>'
)
ROBOT = '<robot name="arm"><link name="a"/><gazebo><plugin name="c" filename="libgazebo_ros_control.so"><robotNamespace>{}</robotNamespace></plugin></gazebo></robot>'


@pytest.mark.parametrize(
    ("space", "launch", "expected"),
    [
        ("/", TYPED + spawner("lift"), ["/all", "/lift/state"]),
        ("/bot", f'<group ns="bot">{TYPED}{spawner("lift")}</group>', ["/bot/all", "/bot/lift/state"]),
        ("/bot", TYPED + spawner("lift"), []),
    ],
)
def test_a_simulator_with_a_manager(space: str, launch: str, expected: list[str]) -> None:
    found = system(GAZEBO + launch, known=True, **{"arm__urdf__r.xacro": ROBOT.format(space)})
    nodes = {node.name: node for node in found.configurations[0].nodes}
    ours = [
        end.name
        for end in nodes["/gazebo"].endpoints
        if end.location is not None and end.location.path == "arm/src/lift.cpp" and end.kind == "publishers"
    ]
    assert sorted(ours) == expected
    lost = [unknown.reason for unknown in nodes["/gazebo"].unknowns if "arm/Lift" in unknown.reason]
    assert lost == []


@pytest.mark.parametrize(
    ("handle", "source", "target", "expected"),
    [
        ('ros::NodeHandle h("sub");', "sub", "b/sub", "/b/sub/x"),
        ("h = nh;", "lift", "b", "/b/x"),
        ('h = ros::NodeHandle(nh, "deep");', "lift/deep", "b", "/b/x"),
        # a namespace around that of the handle: it may be a handle's, or only a part of a name
        ('h = ros::NodeHandle(nh, "deep");', "lift", "b", "/?"),
        ('ros::NodeHandle h("sub/deep");', "sub", "b", "/?"),
        # neither
        ('ros::NodeHandle h("sub");', "subs", "b", "/sub/x"),
        ('ros::NodeHandle h("sub");', "x", "b", "/sub/x"),
        ('ros::NodeHandle h("sub");', "sub/x", "b", "/b"),
        ("h = root;", "sub", "b", "/x"),
    ],
)
def test_the_manager_remaps_the_namespaces_of_handles(handle: str, source: str, target: str, expected: str) -> None:
    begin = handle if handle.startswith("ros") else f"ros::NodeHandle h; {handle}"
    made = f'{begin} a_ = h.advertise<std_msgs::String>("x", 1);\n    b_ = root'
    lift = LIFT.replace("    b_ = root", f"    {made}")
    launch = HARDWARE.replace("/>", f'><remap from="{source}" to="{target}"/></node>') + TYPED + spawner("lift")
    (configuration,) = system(launch, lift).configurations
    found = published(configuration.nodes)["/hw"]
    assert expected in found
