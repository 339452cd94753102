# SPDX-License-Identifier: Apache-2.0
"""Start the conveyor with its parameters."""

from ament_index_python.packages import get_package_share_path
from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    """Describe one conveyor."""
    config = get_package_share_path("conveyor_driver") / "config" / "conveyor.yaml"
    return LaunchDescription([
        Node(package="conveyor_driver", executable="conveyor_node", parameters=[str(config)]),
    ])
