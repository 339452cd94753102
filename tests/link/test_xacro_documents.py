# SPDX-License-Identifier: Apache-2.0
"""Descriptions that a launch file has the functions of xacro make: which plug-ins they have, and where that is not known."""

from __future__ import annotations

from pathlib import Path

import pytest
from follow_kit import ROS2_CMAKE, Nothing, only, workspace

from haros_ci.analysis.architecture import architecture
from haros_ci.config.settings import Settings
from haros_ci.model.architecture import Node

LAUNCH = """
import os, xacro
from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription, OpaqueFunction
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node
def made(context):
    path = os.path.join(get_package_share_directory('p'), 'urdf', 'r.xacro')
    argument = LaunchConfiguration('name').perform(context)
    {}
    gazebo = os.path.join(get_package_share_directory('gazebo_ros'), 'launch', 'gazebo.launch.py')
    return [IncludeLaunchDescription(PythonLaunchDescriptionSource(gazebo)),
        Node(package='robot_state_publisher', executable='robot_state_publisher', parameters=[{{'robot_description': text}}]),
        Node(package='gazebo_ros', executable='spawn_entity.py', arguments=['-entity', 'rover', '-topic', 'robot_description'])]
def generate_launch_description():
    return LaunchDescription([DeclareLaunchArgument('name', default_value='it is'), OpaqueFunction(function=made)])
"""
SENSOR = '<gazebo reference="l"><sensor name="e" type="ray"><plugin name="$(arg n)" filename="libgazebo_ros_ray_sensor.so"><ros><namespace>$(arg m)</namespace></ros></plugin></sensor></gazebo>'
ROBOT = f'<robot name="r" xmlns:xacro="http://ros.org/xacro"><xacro:arg name="n" default="scanner"/><xacro:arg name="m" default=""/><link name="l"/>{SENSOR}</robot>'


def started(code: str) -> dict[str, Node]:
    """The nodes of the simulator's process by name."""
    texts = {
        "p/CMakeLists.txt": ROS2_CMAKE.format("p")
        + "install(DIRECTORY launch urdf DESTINATION share/${PROJECT_NAME})\n",
        "p/launch/l.launch.py": LAUNCH.format(code),
        "p/urdf/r.xacro": ROBOT,
    }
    found = only(
        architecture(workspace(texts, 2), Settings(root=Path("/nowhere")), Nothing(), environment={}, known_nodes=True)
    )
    return {node.name: node for node in found.nodes if node.process == "/gazebo"}


def lost(nodes: dict[str, Node]) -> list[str]:
    return [each.reason for each in nodes["/gazebo"].unknowns if each.field == "endpoints"]


@pytest.mark.parametrize(
    ("code", "name"),
    [
        ("text = xacro.process_file(path).toxml()", "/scanner"),
        ("text = xacro.process_file(path, mappings={'n': 'eye'}).toprettyxml(indent='  ')", "/eye"),
        ("text = xacro.process(path, mappings={'n': 'eye'})", "/eye"),
        ("doc = xacro.parse(open(path)); xacro.process_doc(doc, mappings={'n': 'eye'}); text = doc.toxml()", "/eye"),
        ("text = xacro.process_file(path).documentElement.toxml()", "/scanner"),
        ("text = xacro.process_file(path, mappings={'n': 'eye', 'other': \"it's m:=a\"}).toxml()", "/eye"),
        ("text = xacro.process_file(path, mappings={'n': 'eye', 'other': argument}).toxml()", "/eye"),
        ("text = xacro.process_file(path, mappings={'m': os.environ['M']}).toxml()", "/?/scanner"),
    ],
)  # fmt: skip
def test_what_xacro_makes(code: str, name: str) -> None:
    nodes = started(code)
    assert sorted(nodes) == sorted(["/gazebo", name])
    assert lost(nodes) == []


@pytest.mark.parametrize(
    "code",
    [
        "text = xacro.process_file(path, mappings=given()).toxml()",
        "text = xacro.process_file(path, **given()).toxml()",
        "text = xacro.process_file(path, mappings={given(): 'eye'}).toxml()",
        "text = xacro.process_file('/opt/r.xacro').toxml()",
        "text = xacro.process_file(given()).toxml()",
        "text = xacro.process_file(path).childNodes",
        "text = xacro.process(path, just_deps=True)",
        "text = xacro.parse('<robot/>').toxml()",
        "text = xacro.process_doc(given())",
        "doc = xacro.parse(open(path)); text = doc.toxml()",
        "doc = xacro.parse(open(path)); xacro.process_doc(doc, mappings=given()); text = doc.toxml()",
        "doc = xacro.parse(open(path)); xacro.process_doc(doc); xacro.process_doc(doc); text = doc.toxml()",
    ],
)
def test_what_is_not_known_of_what_xacro_makes(code: str) -> None:
    nodes = started(code)
    assert sorted(nodes) == ["/gazebo"]
    assert lost(nodes) != []
