# SPDX-License-Identifier: Apache-2.0
"""All tables of ROS API calls, checked and parsed, by language and ROS version."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from importlib import import_module
from typing import Any

from haros_ci.model.api import Row, load_row

#: Modules of this package, by language and ROS version; each has ``ROWS`` in the form of ``haros_ci.model.api``.
TABLES: tuple[tuple[str, int, tuple[str, ...]], ...] = (
    (
        "cpp",
        1,
        (
            "roscpp",
            "nodelet",
            "transports",
            "filters",
            "tf",
            "actions",
            "reconfigure",
            "diagnostics",
            "tools",
            "threads",
            "shared_pointers",
            "gazebo",
            "behavior_trees",
        ),
    ),
    ("python", 1, ("rospy", "python_threads")),
    (
        "cpp",
        2,
        (
            "ros2_node",
            "ros2_endpoints",
            "ros2_parameters",
            "ros2_qos",
            "ros2_filters",
            "ros2_tf",
            "ros2_transports",
            "ros2_tools",
            "ros2_nav2",
            "ros2_autoware",
            "threads",
            "shared_pointers",
            "gazebo",
            "ros2_gazebo",
            "ros2_rviz",
            "behavior_trees",
            "ros2_control",
        ),
    ),
    (
        "python",
        2,
        (
            "ros2_rclpy",
            "ros2_rclpy_libraries",
            "ros2_rclpy_navigator",
            "ros2_rclpy_qos",
            "ros2_rclpy_smach",
            "python_threads",
        ),
    ),
)


#: Calls that advertise an image or a cloud: which argument is its topic, and what the plug-ins publish below it
#: (image_transport_plugins, point_cloud_transport_plugins).
IMAGES_1 = (
    ("compressed", "sensor_msgs/CompressedImage"),
    ("compressedDepth", "sensor_msgs/CompressedImage"),
    ("theora", "theora_image_transport/Packet"),
)
IMAGES_2 = (
    ("compressed", "sensor_msgs/msg/CompressedImage"),
    ("compressedDepth", "sensor_msgs/msg/CompressedImage"),
    ("theora", "theora_image_transport/msg/Packet"),
    ("zstd", "sensor_msgs/msg/CompressedImage"),
)
CLOUDS_2 = tuple((name, "point_cloud_interfaces/msg/CompressedPointCloud2") for name in ("draco", "zlib", "zstd"))
TRANSPORTS: Mapping[tuple[int, str], tuple[int, tuple[tuple[str, str], ...]]] = {
    (1, "image_transport::ImageTransport::advertise"): (0, IMAGES_1),
    (1, "image_transport::ImageTransport::advertiseCamera"): (0, IMAGES_1),
    (2, "image_transport::ImageTransport::advertise"): (0, IMAGES_2),
    (2, "image_transport::ImageTransport::advertiseCamera"): (0, IMAGES_2),
    (2, "image_transport::create_publisher"): (1, IMAGES_2),
    (2, "image_transport::create_camera_publisher"): (1, IMAGES_2),
    (2, "point_cloud_transport::PointCloudTransport::advertise"): (0, CLOUDS_2),
    (2, "point_cloud_transport::create_publisher"): (1, CLOUDS_2),
}
UNSURE = "the plug-in of this transport may not be installed"


@cache
def rows(language: str, ros: int) -> tuple[Row, ...]:
    """The rows for ``cpp`` or ``python`` under ROS 1 or 2, in the order of the tables; () where there are none."""
    return tuple(
        load_row(_with_transports(row, ros))
        for table_language, version, modules in TABLES
        if (table_language, version) == (language, ros)
        for module in modules
        for row in import_module(f"{__package__}.{module}").ROWS
    )


def _with_transports(row: Mapping[str, Any], ros: int) -> Mapping[str, Any]:
    """*row* with the topics of the transports, beside the image or cloud that it makes first."""
    topic, transports = TRANSPORTS.get((ros, str(row.get("call"))), (0, ()))
    if not transports:
        return row
    below = {"implicit": True, "unsure": UNSURE}
    topics = (
        {**row["makes"][0], **below, "name": f"{{resolve({topic})}}/{name}", "type": kind} for name, kind in transports
    )
    return {**row, "makes": [*row["makes"], *topics]}
