# SPDX-License-Identifier: Apache-2.0
"""Gazebo Classic in ROS 2: which nodes the plug-ins of a robot and of a world make in the simulator's process, and which they do not."""

from __future__ import annotations

from pathlib import Path

import pytest
from follow_kit import ROS2_CMAKE, Nothing, only, workspace

from haros_ci.analysis.architecture import architecture
from haros_ci.config.settings import Settings
from haros_ci.model.architecture import Node

EMPTY = '<include file="$(find-pkg-share gazebo_ros)/launch/gazebo.launch.py">{}</include>'
WORLD = EMPTY.format('<arg name="world" value="$(find-pkg-share p)/worlds/w.world"/>')
FILE = '<node pkg="gazebo_ros" exec="spawn_entity.py" name="spawn" args="-entity rover -file $(find-pkg-share p)/m/model.sdf {}"/>'
TOPIC = '<node pkg="gazebo_ros" exec="spawn_entity.py" name="spawn" args="-entity rover -topic robot_description"/>'
STATES = '<node pkg="robot_state_publisher" exec="robot_state_publisher"><param name="robot_description" value="$(command \'xacro $(find-pkg-share p)/urdf/r.xacro\')"/></node>'
ALL = EMPTY.format("") + FILE.format("")
MODEL = '<sdf version="1.6"><model name="bot">{}</model></sdf>'


def sensor(plugin: str, kind: str = "ray", inner: str = "") -> str:
    return f'<link name="l"><sensor name="eye" type="{kind}">{inner}{plugin}</sensor></link>'


def started(launch: str, model: str = "", files: dict[str, str] | None = None) -> dict[str, Node]:
    """The nodes of the simulator's process by name, where a launch file starts this, and the model has *model* in it."""
    texts = {
        "p/CMakeLists.txt": ROS2_CMAKE.format("p")
        + "install(DIRECTORY launch m urdf worlds DESTINATION share/${PROJECT_NAME})\n",
        "p/launch/l.launch.xml": f"<launch>{launch}</launch>",
        "p/m/model.sdf": MODEL.format(model),
        **(files or {}),
    }
    found = architecture(
        workspace(texts, 2), Settings(root=Path("/nowhere")), Nothing(), environment={}, known_nodes=True
    )
    return {node.name: node for node in only(found).nodes if node.process == "/gazebo"}


def made(node: Node, kind: str = "publishers") -> list[tuple[str, str | None]]:
    return [(end.name, end.type) for end in node.endpoints if end.kind == kind and not end.implicit]


def lost(nodes: dict[str, Node]) -> list[str]:
    return [each.reason for each in nodes["/gazebo"].unknowns if each.field == "endpoints"]


RAY = '<plugin name="scanner" filename="libgazebo_ros_ray_sensor.so">{}</plugin>'
SCAN = "<output_type>sensor_msgs/LaserScan</output_type>"


@pytest.mark.parametrize(
    ("model", "name", "expected"),
    [
        (sensor(RAY.format("")), "/scanner", [("/scanner/out", "sensor_msgs/msg/PointCloud2")]),
        (sensor(RAY.format(SCAN)), "/scanner", [("/scanner/out", "sensor_msgs/msg/LaserScan")]),
        (sensor(RAY.format(f"<ros><remapping>~/out:=scan</remapping></ros>{SCAN}")), "/scanner", [("/scan", "sensor_msgs/msg/LaserScan")]),
        (sensor(RAY.format(f"<ros><argument>~/out:=scan</argument></ros>{SCAN}")), "/scanner", [("/scan", "sensor_msgs/msg/LaserScan")]),
        (sensor(RAY.format(f"<ros><argument>--ros-args</argument><argument>~/out:=scan</argument></ros>{SCAN}")), "/scanner", [("/scanner/out", "sensor_msgs/msg/LaserScan")]),
        (sensor(RAY.format(f"<ros><namespace>a/b</namespace><remapping>~/out:=scan</remapping></ros>{SCAN}")), "/a/b/scanner", [("/a/b/scan", "sensor_msgs/msg/LaserScan")]),
        (sensor('<plugin name="c" filename="libgazebo_ros_camera.so"/>', "camera"), "/c", [("/eye/image_raw", "sensor_msgs/msg/Image"), ("/eye/camera_info", "sensor_msgs/msg/CameraInfo")]),
        (sensor('<plugin name="c" filename="libgazebo_ros_camera.so"><camera_name>m</camera_name></plugin>', "multicamera", '<camera name="l"/>'), "/c", [("/m/l/image_raw", "sensor_msgs/msg/Image"), ("/m/l/camera_info", "sensor_msgs/msg/CameraInfo")]),
        ('<plugin name="d" filename="libgazebo_ros_diff_drive.so"><publish_odom>true</publish_odom></plugin>', "/d", [("/odom", "nav_msgs/msg/Odometry")]),
        ('<plugin name="d" filename="libgazebo_ros_diff_drive.so"/>', "/d", []),
    ],
)  # fmt: skip
def test_plugins_of_a_spawned_model(model: str, name: str, expected: list[tuple[str, str]]) -> None:
    nodes = started(ALL, model)
    assert sorted(nodes) == sorted(["/gazebo", name])
    assert made(nodes[name]) == expected
    assert lost(nodes) == []
    assert ("/spawn_entity", "gazebo_msgs/srv/SpawnEntity") in made(nodes["/gazebo"], "servers")


def test_what_a_plugin_is_given_of_ros() -> None:
    plugin = '<plugin name="c" filename="libgazebo_ros_camera.so"><ros>{}</ros></plugin>'
    inner = '<parameter name="update_rate" type="double">5</parameter><qos><publisher topic="x"/></qos>'
    node = started(ALL, sensor(plugin.format(inner), "camera"))["/c"]
    assert [end.effective for end in node.endpoints if end.name == "/c:update_rate"] == [5.0]
    assert {end.qos for end in node.endpoints if end.kind == "publishers" and not end.implicit} == {None}
    (plain,) = {
        end.qos is None
        for end in started(ALL, sensor(plugin.format(""), "camera"))["/c"].endpoints
        if end.kind == "publishers" and not end.implicit
    }
    assert not plain


def test_rules_of_the_server_hold_in_its_process() -> None:
    server = '<executable cmd="gzserver -s libgazebo_ros_factory.so --ros-args -r scan:=/seen"/>'
    plugin = sensor(
        '<plugin name="c" filename="libgazebo_ros_camera.so"><camera_name>m</camera_name></plugin>', "camera"
    )
    launch = server.replace("scan", "m/image_raw") + FILE.format("")
    assert ("/seen", "sensor_msgs/msg/Image") in made(started(launch, plugin)["/c"])


def test_the_namespace_of_the_spawner_counts() -> None:
    model = sensor(RAY.format("<ros><namespace>own</namespace></ros>"))
    assert sorted(started(EMPTY.format("") + FILE.format("-robot_namespace r1"), model)) == ["/gazebo", "/r1/scanner"]


def test_the_description_that_is_published_is_spawned() -> None:
    robot = f'<robot name="r"><link name="l"/><gazebo reference="l"><sensor name="e" type="ray">{RAY.format(SCAN)}</sensor></gazebo></robot>'
    nodes = started(EMPTY.format("") + STATES + TOPIC, files={"p/urdf/r.xacro": robot})
    assert sorted(nodes) == ["/gazebo", "/scanner"]
    assert lost(nodes) == []


def test_a_command_line_is_read() -> None:
    launch = '<executable cmd="gzserver --verbose -s libgazebo_ros_init.so $(find-pkg-share p)/worlds/w.world"/>'
    world = '<sdf version="1.6"><world name="w"><plugin name="state" filename="libgazebo_ros_state.so"/></world></sdf>'
    nodes = started(launch, files={"p/worlds/w.world": world})
    assert sorted(nodes) == ["/gazebo", "/state"]
    assert ("/model_states", "gazebo_msgs/msg/ModelStates") in made(nodes["/state"])
    assert "/clock" in [end.name for end in nodes["/gazebo"].endpoints if end.kind == "subscribers"]
    assert ("/pause_physics", "std_srvs/srv/Empty") in made(nodes["/gazebo"], "servers")
    assert ("/spawn_entity", "gazebo_msgs/srv/SpawnEntity") not in made(nodes["/gazebo"], "servers")


def test_an_argument_leaves_a_plugin_out() -> None:
    nodes = started(EMPTY.format('<arg name="factory" value="false"/>'))
    assert ("/spawn_entity", "gazebo_msgs/srv/SpawnEntity") not in made(nodes["/gazebo"], "servers")
    assert ("/clock", "rosgraph_msgs/msg/Clock") in made(nodes["/gazebo"])


def test_a_controller_manager_is_in_the_simulator() -> None:
    nodes = started(ALL, '<plugin name="control" filename="libgazebo_ros2_control.so"/>')
    assert sorted(nodes) == ["/control", "/controller_manager", "/gazebo"]
    assert ("/controller_manager/list_controllers", "controller_manager_msgs/srv/ListControllers") in made(
        nodes["/controller_manager"], "servers"
    )


@pytest.mark.parametrize(
    ("launch", "model"),
    [
        (EMPTY.format(""), sensor(RAY.format(""))),  # nobody spawns it
        (ALL, f"<!--{sensor(RAY.format(''))}-->"),
        (ALL, RAY.format("")),  # a plug-in for sensors in a model
        (ALL, f'<link name="l">{RAY.format("")}</link>'),
        (ALL, '<plugin name="f" filename="libgazebo_ros_force.so"/>'),  # no <link_name>
        (ALL, '<plugin name="l" filename="libLiftDragPlugin.so"/>'),
        (ALL, ""),
    ],
)  # fmt: skip
def test_what_brings_nothing(launch: str, model: str) -> None:
    nodes = started(launch, model)
    assert sorted(nodes) == ["/gazebo"]
    assert lost(nodes) == []
    assert "/?" not in [end.name for end in nodes["/gazebo"].endpoints]


def test_a_simulator_that_is_not_started() -> None:
    assert started(EMPTY.format('<arg name="server" value="false"/>') + FILE.format(""), sensor(RAY.format(""))) == {}
    assert started('<include file="$(find-pkg-share ros_gz_sim)/launch/gz_sim.launch.py"/>') == {}
    assert started('<executable cmd="gzserver w.world"/>') == {}


@pytest.mark.parametrize(
    ("launch", "model", "reason"),
    [
        (ALL, '<plugin name="x" filename="libacme.so"/>', "what the plug-in libacme.so makes is not known"),
        (WORLD, "", "$(find-pkg-share p)/worlds/w.world is not in the workspace"),
        (EMPTY.format("") + TOPIC, "", "no node is known to publish the description that spawn spawns on /robot_description"),
        (EMPTY.format("") + STATES + STATES + TOPIC, "", "several nodes publish the description that spawn spawns on /robot_description"),
        (EMPTY.format("") + TOPIC.replace("-topic robot_description", "-stdin"), "", "what spawn spawns is not known"),
        (EMPTY.format('<arg name="extra_gazebo_args" value="-s libacme.so"/>'), "", "what the plug-in acme makes is not known"),
        (ALL, "<include><uri>model://elsewhere</uri></include>", "the model elsewhere is not in the workspace"),
    ],
)  # fmt: skip
def test_what_is_not_known_is_named(launch: str, model: str, reason: str) -> None:
    nodes = started(launch, model)
    assert lost(nodes) == [reason]
    assert "/?" in [end.name for end in nodes["/gazebo"].endpoints]
