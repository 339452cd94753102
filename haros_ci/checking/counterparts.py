# SPDX-License-Identifier: Apache-2.0
"""Which package of one ROS takes the place of which of the other (the migration guide of ROS 2)."""

from __future__ import annotations

#: Packages that are the other ROS itself, so that nobody has a port of that name, by the ROS of who depends on them, with what takes their place ("" for none).
COUNTERPARTS = {
    2: {
        "roscpp": "rclcpp",
        "rospy": "rclpy",
        "roslib": "ament_index_cpp",
        "rosconsole": "rcutils",
        "message_generation": "rosidl_default_generators",
        "message_runtime": "rosidl_default_runtime",
        "nodelet": "rclcpp_components",
        "roslaunch": "launch_ros",
        "rostest": "launch_testing_ros",
        "rosunit": "ament_cmake_gtest",
        "dynamic_reconfigure": "",
        "tf": "tf2_ros",
        "actionlib": "rclcpp_action",
        "rosbag": "rosbag2",
        "roslint": "ament_lint_auto",
    },
    1: {
        "rclcpp": "roscpp",
        "rclpy": "rospy",
        "rclcpp_action": "actionlib",
        "rclcpp_components": "nodelet",
        "rclcpp_lifecycle": "",
        "rosidl_default_generators": "message_generation",
        "rosidl_default_runtime": "message_runtime",
        "launch_ros": "roslaunch",
        "ament_index_cpp": "roslib",
        "ament_index_python": "rospkg",
        "builtin_interfaces": "std_msgs",
    },
}
