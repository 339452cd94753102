# SPDX-License-Identifier: Apache-2.0
"""The gripper as a node: force in, state out, one service to let go."""

import math
import os

import rclpy
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import Trigger
from warehouse_msgs.msg import GripForce

from gripper_control.force_filter import ForceFilter, parse_reading


class GripperNode(Node):
    """Closes until the force is reached."""

    def __init__(self):
        super().__init__("gripper")
        window = self.declare_parameter("window", 8).value
        self.max_force = self.declare_parameter("max_force", 40.0).value
        self.left = ForceFilter(window)
        self.right = ForceFilter(window)
        self.holding = False
        self.force_pub = self.create_publisher(GripForce, "grip_force", 10)
        self.create_subscription(String, "gripper_line", self.on_line, 10)
        self.create_service(Trigger, "release", self.on_release)

    def on_line(self, message):
        """Take in one line of the controller."""
        reading = parse_reading(message.data)
        if reading is None:
            self.get_logger().warning(f"cannot read {mesage.data!r}")
            return
        force = GripForce()
        force.header.stamp = self.get_clock().now().to_msg()
        force.left = self.left.add(reading[0])
        force.right = self.right.add(reading[1])
        imbalance = abs(force.left - force.right)
        self.holding = math.hypot(force.left, force.right) > self.max_force
        self.force_pub.publish(force)

    def on_release(self, _request, response):
        """Let go."""
        self.holding = False
        response.success = True
        return response


def main():
    """Run until interrupted."""
    rclpy.init()
    node = GripperNode()
    try:
        rclpy.spin(node)
    finally:
        node.destroy_node()
        rclpy.shutdown()
