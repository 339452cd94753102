# SPDX-License-Identifier: Apache-2.0
"""Webots in ROS 2: which nodes its actions start, and what a driver makes by its description, as far as that is known without the world."""

from __future__ import annotations

from pathlib import Path

import pytest
from follow_kit import ROS2_CMAKE, Nothing, only, workspace

from haros_ci.analysis.architecture import architecture
from haros_ci.config.settings import Settings
from haros_ci.model.architecture import Endpoint, Node
from haros_ci.systems.simulation import webots

LAUNCH = """
import os
from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch_ros.actions import Node
from webots_ros2_driver.wait_for_controller_connection import WaitForControllerConnection
from webots_ros2_driver.webots_controller import WebotsController
from webots_ros2_driver.webots_launcher import WebotsLauncher, Ros2SupervisorLauncher
def generate_launch_description():
    path = os.path.join(get_package_share_directory('p'), 'urdf', 'r.urdf')
    return LaunchDescription([{}])
"""
DRIVER = "WebotsController(robot_name='bot', parameters=[{'robot_description': path}])"
ROBOT = '<robot name="r" xmlns:xacro="http://ros.org/xacro"><webots>{}</webots></robot>'
DEVICE = '<device reference="{}" type="{}"><ros>{}</ros></device>'
UNREAD = "the devices of the robot in the world of Webots decide, which is not read"


def started(actions: str, inner: str = "", files: dict[str, str] | None = None) -> dict[str, Node]:
    """The nodes by name of a launch file with these actions, where ``<webots>`` of the description is *inner*."""
    texts = {
        "p/CMakeLists.txt": ROS2_CMAKE.format("p")
        + "install(DIRECTORY launch urdf DESTINATION share/${PROJECT_NAME})\n",
        "p/launch/l.launch.py": LAUNCH.format(actions),
        "p/urdf/r.urdf": ROBOT.format(inner),
        **(files or {}),
    }
    found = architecture(
        workspace(texts, 2), Settings(root=Path("/nowhere")), Nothing(), environment={}, known_nodes=True
    )
    return {node.name: node for node in only(found).nodes}


def own(node: Node) -> list[Endpoint]:
    """What the description of a driver makes."""
    kinds = ("publishers", "subscribers", "servers")
    return [end for end in node.endpoints if end.kind in kinds and end.location and end.location.path.endswith("urdf")]


def made(node: Node) -> list[tuple[str, str | None]]:
    return [(end.name, end.type) for end in own(node)]


def lost(node: Node) -> list[str]:
    return [each.reason for each in node.unknowns if each.field == "endpoints"]


def test_the_table_of_devices() -> None:
    assert webots.problems() == []
    assert len([row for row in webots.devices().values() if row.at == "sensor"]) == 12


@pytest.mark.parametrize(
    ("inner", "expected"),
    [
        (DEVICE.format("LDS-01", "Lidar", "<topicName>/scan</topicName>"), [("/scan", "sensor_msgs/msg/LaserScan"), ("/scan/point_cloud", "sensor_msgs/msg/PointCloud2")]),
        (DEVICE.format("LDS-01 (a)", "DistanceSensor", ""), [("/bot/LDS_01__a_", "sensor_msgs/msg/Range")]),
        (DEVICE.format("cam", "Camera", "<imageSuffix>/raw</imageSuffix>"), [("/bot/cam/raw", "sensor_msgs/msg/Image"), ("/bot/cam/camera_info", "sensor_msgs/msg/CameraInfo"), ("/bot/cam/recognitions", "vision_msgs/msg/Detection2DArray"), ("/bot/cam/recognitions/webots", "webots_ros2_msgs/msg/CameraRecognitionObjects")]),
        (DEVICE.format("g", "GPS", "<topicName>fix</topicName>"), [("/fix", None), ("/fix/speed", "std_msgs/msg/Float32"), ("/fix/speed_vector", "geometry_msgs/msg/Vector3")]),
        (DEVICE.format("led", "LED", ""), [("/bot/led", "std_msgs/msg/Int32")]),
        (DEVICE.format("e", "Emitter", "<enabled>true</enabled>"), [("/bot/e/send_string", "webots_ros2_msgs/srv/EmitterSendString")]),
        ('<device reference="l" type="LightSensor"/>', [("/bot/l", "sensor_msgs/msg/Illuminance")]),
        (DEVICE.format("l", "Lidar", "<enabled>false</enabled>"), []),
        (DEVICE.format("l", "Motor", ""), []),
        ('<device reference="l"><ros/></device>', []),
        ('<device type="Lidar"><ros/></device>', []),
        (DEVICE.format("l", "webots_ros2_driver::Ros2IMU", "<topicName>/imu</topicName>"), []),
        ("", []),
    ],
)  # fmt: skip
def test_devices(inner: str, expected: list[tuple[str, str | None]]) -> None:
    nodes = started(DRIVER, inner)
    assert list(nodes) == ["/bot"]
    assert made(nodes["/bot"]) == expected
    assert lost(nodes["/bot"]) == []
    for end in own(nodes["/bot"]):
        assert any("the robot in the world of Webots has the device" in each.reason for each in end.unknowns)
    assert UNREAD in {each.reason for end in nodes["/bot"].endpoints for each in end.unknowns}


@pytest.mark.parametrize(
    ("inner", "expected", "reasons"),
    [
        ('<plugin type="webots_ros2_driver::Ros2IMU"><topicName>/imu</topicName><gyroName>g</gyroName></plugin>', [("/imu", "sensor_msgs/msg/Imu")], []),
        ('<plugin type="webots_ros2_driver::Ros2IMU"><gyroName>g</gyroName></plugin>', [], []),
        ('<plugin type="p.mine.Mine"/>', [], ["what the plug-in p.mine.Mine makes is not known"]),
        ('<plugin type="Lidar"/>', [], ["what the plug-in Lidar makes is not known"]),
        ("<plugin/>", [], ["what a plug-in of the driver makes is not known"]),
    ],
)  # fmt: skip
def test_plugins(inner: str, expected: list[tuple[str, str]], reasons: list[str]) -> None:
    (node,) = started(DRIVER, inner).values()
    assert made(node) == expected
    assert lost(node) == reasons
    assert [each for end in own(node) for each in end.unknowns if each.field == "conditions"] == []


LED = DEVICE.format("led", "LED", "")


@pytest.mark.parametrize(
    ("given", "expected"),
    [
        ("robot_name='my-bot (1)'", "/my_bot__1_/led"),
        ("robot_name='bot', namespace='a'", "/a/bot/led"),
        ("robot_name='bot', remappings=[('~/led', '/light')]", "/light"),
        ("", "/?/led"),
        ("robot_name=unheard_of", "/?/led"),
    ],
)
def test_how_a_driver_is_called(given: str, expected: str) -> None:
    (node,) = started(
        f"WebotsController({given}{',' * bool(given)} parameters=[{{'robot_description': path}}])", LED
    ).values()
    assert [end.name for end in own(node)] == [expected]


XACRO = {
    "p/urdf/x.xacro": ROBOT.format(
        '<xacro:arg name="t" default="near"/>' + DEVICE.format("l", "LED", "<topicName>$(arg t)</topicName>")
    )
}


@pytest.mark.parametrize(
    ("parameters", "expected", "reasons"),
    [
        ("{'robot_description': path.replace('r.urdf', 'x.xacro')}", ["/near"], 0),
        ("{'robot_description': path.replace('r.urdf', 'x.xacro'), 'xacro_mappings': ['t:=far']}", ["/far"], 0),
        ("{'robot_description': path.replace('r.urdf', 'x.xacro'), 'xacro_mappings': unheard_of}", [], 1),
        ("{'robot_description': path.replace('r.urdf', 'none.urdf')}", [], 1),
        ("{'robot_description': '/opt/r.urdf'}", [], 1),
        ("{'robot_description': unheard_of}", [], 1),
        ("{'robot_description': ''}", [], 0),
        ("{}", [], 0),
    ],
)
def test_the_description_of_a_driver(parameters: str, expected: list[str], reasons: int) -> None:
    (node,) = started(f"WebotsController(robot_name='bot', parameters=[{parameters}])", files=XACRO).values()
    kinds = ("publishers", "subscribers")
    assert [
        e.name for e in node.endpoints if e.kind in kinds and e.location and e.location.path.endswith("xacro")
    ] == expected
    assert len(lost(node)) == reasons


@pytest.mark.parametrize(
    ("actions", "expected"),
    [
        ("WebotsLauncher(world='w.wbt')", []),
        ("WebotsLauncher(world='w.wbt', ros2_supervisor=True)._supervisor", ["/Ros2Supervisor"]),
        ("WebotsLauncher(world='w.wbt', ros2_supervisor=True)", []),
        ("WebotsLauncher(world='w.wbt')._supervisor", []),
        ("Ros2SupervisorLauncher()", ["/Ros2Supervisor"]),
        (
            "WaitForControllerConnection(target_driver=None, nodes_to_start=[Node(package='q', executable='n', name='later')])",
            ["/later"],
        ),
    ],
)
def test_the_other_actions(actions: str, expected: list[str]) -> None:
    assert sorted(started(actions)) == expected


def test_the_supervisor() -> None:
    node = started("Ros2SupervisorLauncher()")["/Ros2Supervisor"]
    assert ("/clock", "rosgraph_msgs/msg/Clock") in [
        (end.name, end.type) for end in node.endpoints if end.kind == "publishers"
    ]
