# SPDX-License-Identifier: Apache-2.0
"""Controllers in simulators, and the new Gazebo, which is no node itself: what a spawned description brings, and what it does not."""

from __future__ import annotations

from pathlib import Path

import pytest
from follow_kit import CMAKE, ROS2_CMAKE, Nothing, only, workspace

from haros_ci.analysis.architecture import architecture
from haros_ci.config.settings import Settings
from haros_ci.model.architecture import Node

EMPTY = '<include file="$(find gazebo_ros)/launch/empty_world.launch"/>'
PARAM = '<param name="robot_description" command="$(find xacro)/xacro $(find p)/urdf/r.xacro"/>'
SPAWN = '<node pkg="gazebo_ros" type="spawn_model" name="spawn" args="-urdf -param robot_description -model rover"/>'
TYPES = "<rosparam>{states: {type: joint_state_controller/JointStateController}, drive: {type: diff_drive_controller/DiffDriveController, publish_cmd: true}, mine: {type: p/Mine}}</rosparam>"
CONTROL = '<gazebo><plugin name="control" filename="libgazebo_ros_control.so">{}</plugin></gazebo>'
ROBOT = '<robot name="rover" xmlns:xacro="http://ros.org/xacro"><link name="head"/>{}</robot>'


def spawner(words: str, ns: str = "") -> str:
    where = f'ns="{ns}"' if ns else ""
    return f'<node pkg="controller_manager" type="spawner" name="c" {where} args="{words}"/>'


def simulator(
    launch: str,
    inner: str = CONTROL.format("<robotNamespace>/</robotNamespace>"),
    files: dict[str, str] | None = None,
) -> Node:
    """The simulator of ROS 1, to which a robot is spawned that has the extensions *inner*."""
    texts = {
        "p/CMakeLists.txt": CMAKE.format("p"),
        "p/launch/l.launch": f"<launch>{EMPTY}{PARAM}{SPAWN}{TYPES}{launch}</launch>",
        "p/urdf/r.xacro": ROBOT.format(inner),
        **(files or {}),
    }
    found = architecture(workspace(texts), Settings(root=Path("/nowhere")), Nothing(), environment={}, known_nodes=True)
    return next(each for each in only(found).nodes if each.name == "/gazebo")


def topics(node: Node) -> list[str]:
    """What is not of the simulator itself nor of the controller manager."""
    kinds = ("publishers", "subscribers")
    return [end.name for end in node.endpoints if end.kind in kinds and end.location is not None]


def lost(node: Node) -> list[str]:
    return [each.reason for each in node.unknowns if each.field == "endpoints"]


DRIVE = [
    "/drive/odom",
    "/tf",
    "/drive/cmd_vel_out",
    "/drive/parameter_descriptions",
    "/drive/parameter_updates",
    "/drive/cmd_vel",
]


@pytest.mark.parametrize(
    ("launch", "expected"),
    [
        (spawner("states"), ["/joint_states"]),
        (spawner("states drive"), ["/joint_states", *DRIVE]),
        (spawner("--stopped --timeout 5 states"), ["/joint_states"]),
        (spawner("states --namespace=/", "a"), ["/joint_states"]),
        ('<node pkg="controller_manager" type="controller_manager" name="c" args="spawn states"/>', ["/joint_states"]),
    ],
)  # fmt: skip
def test_controllers_of_a_simulated_manager(launch: str, expected: list[str]) -> None:
    node = simulator(launch)
    assert topics(node) == expected
    assert lost(node) == []


@pytest.mark.parametrize(
    ("kind", "more", "expected"),
    [
        ("effort_controllers/JointTrajectoryController", "joints: [a, b]", ["gains/a", "gains/b"]),
        ("velocity_controllers/JointTrajectoryController", "joints: [a]", ["gains/a"]),
        ("effort_controllers/JointPositionController", "joint: a", ["pid"]),
        ("effort_controllers/JointGroupPositionController", "joints: [a, b]", ["a/pid", "b/pid"]),
        ("effort_controllers/GripperActionController", "joint: a", ["gains/a"]),
        ("position_controllers/JointTrajectoryController", "joints: [a, b]", []),
        ("velocity_controllers/JointVelocityController", "joint: a", []),
        ("effort_controllers/JointEffortController", "joint: a", []),
    ],
)
def test_gains_that_can_be_reconfigured(kind: str, more: str, expected: list[str]) -> None:
    node = simulator(f"<rosparam>{{arm: {{type: {kind}, {more}}}}}</rosparam>" + spawner("arm"))
    made = [
        end.name for end in node.endpoints if end.type == "dynamic_reconfigure/Reconfigure" and end.location is not None
    ]
    assert made == [f"/arm/{space}/set_parameters" for space in expected]
    assert "?" not in "".join(end.name for end in node.endpoints)


def test_the_state_of_a_controller_of_gains_is_published_where_that_is_set() -> None:
    inner = "<rosparam>{{arm: {{type: effort_controllers/JointPositionController, joint: a, pid: {{p: 1.0, publish_state: {}}}}}}}</rosparam>"
    found = [topics(simulator(inner.format(value) + spawner("arm"))) for value in ("true", "false")]
    assert ["/arm/pid/state" in names for names in found] == [True, False]


@pytest.mark.parametrize(
    "launch",
    [
        "",
        spawner("states", "elsewhere"),  # of another manager
        spawner("states --namespace /other"),
        spawner("--shutdown-timeout 3"),
        '<node pkg="controller_manager" type="unspawner" name="c" args="states"/>',
        '<node pkg="controller_manager" type="controller_manager" name="c" args="list states"/>',
        '<node pkg="mine" type="spawner" name="c" args="states"/>',
    ],
)
def test_what_no_simulated_manager_is_asked_for(launch: str) -> None:
    node = simulator(launch)
    assert topics(node) == []
    assert lost(node) == []


FILED = "arm: {type: effort_controllers/JointTrajectoryController, joints: [a]}\nleft: {type: p/Mine}\n"


@pytest.mark.parametrize(
    ("text", "words", "expected", "reasons"),
    [
        (FILED, "{} states", ["/arm/state", "/arm/gains/a/parameter_descriptions", "/arm/gains/a/parameter_updates", "/arm/command", "/joint_states"], ["what the controller left makes is not known: it is a p/Mine"]),
        ("states: {type: position_controllers/JointPositionController}", "{}", ["/states/command"], []),  # it is set again
        ("{}", "{}", [], []),
        ("- arm\n", "{}", [], ["what the controller $(find p)/config/c.yaml makes is not known"]),
        ("1: {type: p/Mine}", "{}", [], ["what the controller $(find p)/config/c.yaml makes is not known"]),
        ("a: [", "{}", [], ["what the controller $(find p)/config/c.yaml makes is not known"]),
        (FILED, "$(find p)/config/other.yaml", [], ["what the controller $(find p)/config/other.yaml makes is not known"]),
        (FILED, "/etc/passwd", [], ["what the controller /etc/passwd makes is not known"]),
    ],
)  # fmt: skip
def test_a_file_of_controllers(text: str, words: str, expected: list[str], reasons: list[str]) -> None:
    node = simulator(spawner(words.format("$(find p)/config/c.yaml")), files={"p/config/c.yaml": text})
    assert topics(node) == expected
    assert lost(node) == reasons


def test_without_the_plugin_there_is_no_manager() -> None:
    assert topics(simulator(spawner("states"), "")) == []


@pytest.mark.parametrize(
    ("name", "reason"),
    [
        ("mine", "what the controller mine makes is not known: it is a p/Mine"),
        ("other", "what the controller other makes is not known"),
    ],
)
def test_what_is_not_known_of_a_controller_is_said(name: str, reason: str) -> None:
    assert lost(simulator(spawner(name))) == [reason]


GZ = '<gazebo><plugin filename="gz_ros2_control-system" name="gz_ros2_control::GazeboSimROS2ControlPlugin">{}</plugin></gazebo>'
FILE = "<parameters>$(find p)/config/c.yaml</parameters>"
GIVEN = "<parameters>$(arg controllers)</parameters>"
YAML = "controller_manager:\n  ros__parameters:\n    states: {type: joint_state_broadcaster/JointStateBroadcaster}\n"
COMMAND = "$(command 'xacro $(find-pkg-share p)/urdf/r.xacro controllers:=$(find-pkg-share p)/config/c.yaml')"
STATES = f'<node pkg="robot_state_publisher" exec="robot_state_publisher"><param name="robot_description" value="{COMMAND}"/></node>'
CREATE = '<node pkg="ros_gz_sim" exec="create" name="create" args="-name rover {}"/>'
TOPIC = STATES + CREATE.format("-topic robot_description")
ASK = '<node pkg="controller_manager" exec="spawner" name="ask" args="states"/>'


def started(launch: str, inner: str, files: dict[str, str] | None = None) -> dict[str, Node]:
    """The nodes by name of a ROS 2 launch file, where a robot has the extensions *inner*."""
    texts = {
        "p/CMakeLists.txt": ROS2_CMAKE.format("p")
        + "install(DIRECTORY launch urdf config DESTINATION share/${PROJECT_NAME})\n",
        "p/launch/l.launch.xml": f"<launch>{launch}</launch>",
        "p/urdf/r.xacro": ROBOT.format('<xacro:arg name="controllers" default=""/>' + inner),
        "p/config/c.yaml": YAML,
        **(files or {}),
    }
    found = architecture(
        workspace(texts, 2), Settings(root=Path("/nowhere")), Nothing(), environment={}, known_nodes=True
    )
    return {node.name: node for node in only(found).nodes}


def own(nodes: dict[str, Node]) -> list[str]:
    return sorted(set(nodes) - {"/create", "/robot_state_publisher", "/ask"})


@pytest.mark.parametrize(
    ("launch", "inner", "expected"),
    [
        (TOPIC, GZ.format(FILE), ["/controller_manager", "/gz_ros_control"]),
        (TOPIC, GZ.format(GIVEN), ["/controller_manager", "/gz_ros_control"]),
        (CREATE.format("-file $(find-pkg-share p)/urdf/r.xacro"), GZ.format(FILE), ["/controller_manager", "/gz_ros_control"]),
        (TOPIC, GZ.format(f"<ros><namespace>a</namespace></ros>{FILE}"), ["/a/controller_manager", "/a/gz_ros_control"]),
        (TOPIC, GZ.format(f"<controller_manager_name>cm</controller_manager_name>{FILE}"), ["/cm", "/gz_ros_control"]),
        (TOPIC.replace("ros_gz_sim", "ros_ign_gazebo"), GZ.format(FILE).replace("gz_ros2_control-", "libign_ros2_control-"), ["/controller_manager", "/gz_ros2_control"]),
    ],
)  # fmt: skip
def test_a_plugin_of_the_new_gazebo_makes_a_manager(launch: str, inner: str, expected: list[str]) -> None:
    nodes = started(launch, inner)
    assert own(nodes) == expected
    assert {nodes[name].process for name in expected} == {"/" + expected[-1].rpartition("/")[2]}


@pytest.mark.parametrize("inner", [GZ.format(FILE), GZ.format(GIVEN)])
def test_a_spawner_finds_the_simulated_manager(inner: str) -> None:
    nodes = started(TOPIC + ASK, inner)
    assert own(nodes) == ["/controller_manager", "/gz_ros_control", "/states"]
    assert nodes["/states"].type == "joint_state_broadcaster/JointStateBroadcaster"
    assert nodes["/states"].container == "/controller_manager"
    assert "/joint_states" in [end.name for end in nodes["/states"].endpoints if end.kind == "publishers"]


def test_the_text_of_a_command_is_spawned() -> None:
    description = (
        "from launch import LaunchDescription\nfrom launch.substitutions import Command, PathJoinSubstitution\n"
        "from launch_ros.actions import Node\nfrom launch_ros.substitutions import FindPackageShare\n"
        "def generate_launch_description():\n"
        "    text = Command(['xacro ', PathJoinSubstitution([FindPackageShare('p'), 'urdf', 'r.xacro'])])\n"
        "    return LaunchDescription([Node(package='ros_gz_sim', executable='create', name='create', arguments=['-string', text])])\n"
    )
    nodes = started("", GZ.format(FILE), {"p/launch/l.launch.xml": "", "p/launch/l.launch.py": description})
    assert own(nodes) == ["/controller_manager", "/gz_ros_control"]


@pytest.mark.parametrize(
    ("launch", "inner"),
    [
        (STATES, GZ.format(FILE)),  # nobody spawns it
        (TOPIC, ""),
        (TOPIC, GZ.format("")),  # it fails without <parameters>
        (TOPIC, f"<!--{GZ.format(FILE)}-->"),
        (TOPIC, GZ.format(FILE).replace("<gazebo>", '<gazebo reference="head">')),
        (TOPIC, '<gazebo><plugin filename="gz-sim-diff-drive-system" name="gz::sim::systems::DiffDrive"><topic>cmd_vel</topic></plugin></gazebo>'),
        (TOPIC, '<gazebo reference="head"><sensor name="eye" type="gpu_lidar"><topic>scan</topic></sensor></gazebo>'),
        (STATES + CREATE.format("-topic elsewhere"), GZ.format(FILE)),
        (CREATE.format("-file /opt/ros/r.urdf"), GZ.format(FILE)),
        (CREATE.format(""), GZ.format(FILE)),
    ],
)  # fmt: skip
def test_what_brings_no_node(launch: str, inner: str) -> None:
    assert own(started(launch, inner)) == []
