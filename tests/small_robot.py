# SPDX-License-Identifier: Apache-2.0
"""The smallest workspace that has a node, a launch file and a finding."""

from __future__ import annotations

TALKER = """import rclpy
from rclpy.node import Node
from std_msgs.msg import String


def main():
    rclpy.init()
    node = Node("talker")
    node.create_publisher(String, "chatter", 10)
    rclpy.spin(node)
"""
FILES = {
    "robot/package.xml": '<package format="3"><name>robot</name><version>1.0.0</version><description>d</description>'
    '<maintainer email="a@example.org">A</maintainer><license>MIT</license><exec_depend>rclpy</exec_depend>'
    "<export><build_type>ament_python</build_type></export></package>\n",
    "robot/setup.py": "from setuptools import setup\nsetup(name='robot', packages=['robot'],\n"
    "    entry_points={'console_scripts': ['talker = robot.talker:main']})\n",
    "robot/robot/__init__.py": "",
    "robot/robot/talker.py": TALKER,
    "robot/launch/a.launch.py": "from launch import LaunchDescription\nfrom launch_ros.actions import Node\n\n\n"
    "def generate_launch_description():\n    return LaunchDescription([Node(package='robot', executable='talker', node_name='t')])\n",
}
