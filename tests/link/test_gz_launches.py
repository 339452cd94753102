# SPDX-License-Identifier: Apache-2.0
"""The launch files and actions of ros_gz: which bridges, servers and spawners they start, and what these bring."""

from __future__ import annotations

from pathlib import Path

import pytest
from follow_kit import ROS2_CMAKE, Nothing, only, workspace

from haros_ci.analysis.architecture import architecture
from haros_ci.config.settings import Settings
from haros_ci.model.architecture import Node

CONFIG = (
    "- {ros_topic_name: scan, gz_topic_name: /lidar, ros_type_name: sensor_msgs/msg/LaserScan, gz_type_name: gz.msgs.LaserScan, direction: GZ_TO_ROS}\n"
    "- {topic_name: cmd_vel, ros_type_name: geometry_msgs/msg/Twist, gz_type_name: gz.msgs.Twist, direction: ROS_TO_GZ}\n"
)
PYTHON = (
    "from launch import LaunchDescription\nfrom launch.actions import DeclareLaunchArgument\n"
    "from launch.substitutions import LaunchConfiguration, PathJoinSubstitution\nfrom launch_ros.substitutions import FindPackageShare\n"
    "from ros_gz_bridge.actions import RosGzBridge\nfrom ros_gz_sim.actions import GzServer\n"
    "def generate_launch_description():\n"
    "    config = PathJoinSubstitution([FindPackageShare('p'), 'config', 'b.yaml'])\n"
    "    return LaunchDescription([{}])\n"
)
PLUGIN = '<gazebo><plugin filename="gz_ros2_control-system" name="c"><parameters>$(find p)/config/b.yaml</parameters></plugin></gazebo>'
BRIDGE = '<include file="$(find-pkg-share ros_gz_bridge)/launch/ros_gz_bridge.launch{}"><arg name="bridge_name" value="b"/><arg name="config_file" value="$(find-pkg-share p)/config/b.yaml"/>{}</include>'
OWN = '<arg name="use_composition" value="true"/><arg name="create_own_container" value="true"/>'
OTHER = '<arg name="use_composition" value="true"/><arg name="container_name" value="mine"/>'


def started(launch: str, name: str = "l.launch.xml") -> dict[str, Node]:
    """The nodes by name that a launch file starts."""
    text = f"<launch>{launch}</launch>" if name.endswith("xml") else PYTHON.format(launch)
    texts = {
        "p/CMakeLists.txt": ROS2_CMAKE.format("p")
        + "install(DIRECTORY launch config urdf DESTINATION share/${PROJECT_NAME})\n",
        f"p/launch/{name}": text,
        "p/config/b.yaml": CONFIG,
        "p/urdf/r.urdf": f'<robot name="r"><link name="l"/>{PLUGIN}</robot>',
    }
    found = architecture(
        workspace(texts, 2), Settings(root=Path("/nowhere")), Nothing(), environment={}, known_nodes=True
    )
    return {node.name: node for node in only(found).nodes}


def bridged(node: Node) -> list[tuple[str, str, str | None]]:
    kinds = ("publishers", "subscribers")
    return [(end.kind, end.name, end.type) for end in node.endpoints if end.kind in kinds and not end.implicit]


def both(space: str = "/") -> list[tuple[str, str, str]]:
    return [
        ("publishers", f"{space}scan", "sensor_msgs/msg/LaserScan"),
        ("subscribers", f"{space}cmd_vel", "geometry_msgs/msg/Twist"),
    ]


@pytest.mark.parametrize(
    ("launch", "name", "nodes", "space"),
    [
        (BRIDGE.format(".py", ""), "l.launch.xml", ["/b"], "/"),
        (BRIDGE.format("", ""), "l.launch.xml", ["/b"], "/"),
        (BRIDGE.format(".py", '<arg name="namespace" value="r1"/>'), "l.launch.xml", ["/r1/b"], "/r1/"),
        (BRIDGE.format(".py", OWN), "l.launch.xml", ["/b", "/ros_gz_container"], "/"),
        (BRIDGE.format(".py", OTHER), "l.launch.xml", ["/b"], "/"),
        ("RosGzBridge(bridge_name='b', config_file=config)", "l.launch.py", ["/b"], "/"),
        ("DeclareLaunchArgument('n', default_value='b'), RosGzBridge(bridge_name=LaunchConfiguration('n'), config_file=config, namespace='r1')", "l.launch.py", ["/r1/b"], "/r1/"),
        ("RosGzBridge(bridge_name='b', config_file=config, use_composition='True', create_own_container='True')", "l.launch.py", ["/b", "/ros_gz_container"], "/"),
        ('<ros_gz_bridge bridge_name="b" config_file="$(find-pkg-share p)/config/b.yaml"/>', "l.launch.xml", ["/b"], "/"),
    ],
)  # fmt: skip
def test_a_bridge(launch: str, name: str, nodes: list[str], space: str) -> None:
    found = started(launch, name)
    assert sorted(found) == nodes
    assert bridged(found[nodes[0]]) == both(space)


@pytest.mark.parametrize(
    ("launch", "name"),
    [
        ('<include file="$(find-pkg-share ros_gz_sim)/launch/gz_server.launch.py"/>', "l.launch.xml"),
        ('<gz_server world_sdf_file="empty.sdf"/>', "l.launch.xml"),
        ("GzServer(world_sdf_file='empty.sdf')", "l.launch.py"),
    ],
)
def test_a_server(launch: str, name: str) -> None:
    found = started(launch, name)
    assert list(found) == ["/gz_server"]
    assert (found["/gz_server"].package, found["/gz_server"].type) == ("ros_gz_sim", "gzserver")
    assert bridged(found["/gz_server"]) == []


def test_both_in_one() -> None:
    more = '<arg name="use_composition" value="True"/>'
    launch = BRIDGE.format(".py", more).replace("ros_gz_bridge)/launch/ros_gz_bridge", "ros_gz_sim)/launch/ros_gz_sim")
    found = started(launch)
    assert sorted(found) == ["/b", "/gz_server"]
    assert found["/gz_server"].container == "/ros_gz_container"
    assert bridged(found["/b"]) == both()


def test_a_spawned_model_has_its_plugins() -> None:
    launch = '<include file="$(find-pkg-share ros_gz_sim)/launch/gz_spawn_model.launch.py"><arg name="file" value="$(find-pkg-share p)/urdf/r.urdf"/></include>'
    assert sorted(started(launch)) == ["/?", "/controller_manager", "/gz_ros_control"]
    assert sorted(started('<gz_spawn_model file="$(find-pkg-share p)/urdf/r.urdf"/>')) == ["/?", "/controller_manager", "/gz_ros_control"]  # fmt: skip


@pytest.mark.parametrize(
    "launch",
    [
        '<include file="$(find-pkg-share ros_gz_sim)/launch/gz_sim.launch.py"/>',
        '<include file="$(find-pkg-share ros_ign_gazebo)/launch/ign_gazebo.launch.py"/>',
        '<include file="$(find-pkg-share ros_gz_bridge)/launch/other.launch.py"/>',
        '<executable cmd="gz sim -r empty.sdf"/>',
    ],
)
def test_what_starts_no_node(launch: str) -> None:
    assert started(launch) == {}
