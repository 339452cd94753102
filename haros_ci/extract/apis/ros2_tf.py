# SPDX-License-Identifier: Apache-2.0
"""Transforms (ROS 2, C++): broadcasters, listeners, buffers and the action in front of one.

tf2_ros/qos.hpp says the qualities of service; their policies may be overridden by parameters.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

TF = {"name": "/tf", "type": "tf2_msgs/msg/TFMessage"}
STATIC = {"name": "/tf_static", "type": "tf2_msgs/msg/TFMessage"}
OVERRIDES = "depth,durability,history,reliability"
STATIC_OVERRIDES = "depth,history,reliability"


def _listener(owner: str, args: list[int], qos: int, when: dict[str, str], both: bool) -> dict[str, object]:
    """A listener on the node that is argument 1, with the qualities of service from argument *qos* on."""
    static = qos + both
    makes: list[dict[str, Any]] = [
        {
            **STATIC,
            "kind": "subscribers",
            "qos": f"{{{static}?tf2_ros::StaticListenerQoS}}",
            "options": f"{{{static + 1 + both}?{STATIC_OVERRIDES}}}",
            "namespace": "{1}",
        }
    ]
    if both:
        dynamic = {"qos": f"{{{qos}?tf2_ros::DynamicListenerQoS}}", "options": f"{{{qos + 2}?{OVERRIDES}}}"}
        makes.insert(0, {**TF, "kind": "subscribers", **dynamic, "namespace": "{1}"})
    row: dict[str, object] = {"call": owner, "args": args, "makes": makes}
    return {**row, "when": when} if when else row


def _broadcaster(owner: str, topic: dict[str, str], profile: str, overrides: str) -> tuple[dict[str, object], ...]:
    """A broadcaster on a node, or on its interfaces for parameters and topics."""

    def row(args: list[int], qos: int, when: dict[str, str]) -> dict[str, object]:
        keys = {"qos": f"{{{qos}?{profile}}}", "options": f"{{{qos + 1}?{overrides}}}", "namespace": "{0}"}
        made: dict[str, object] = {"call": owner, "args": args, "makes": [{**topic, "kind": "publishers", **keys}]}
        return {**made, "when": when} if when else made

    return (row([2, 3, 4], 2, {"1": "rclcpp::Node"}), row([1, 2, 3], 1, {}), row([4], 2, {}))


#: Without a node the object makes one, called ``transform_listener_impl_`` and its address, without parameter services.
HIDDEN = {"kind": "node", "name": "transform_listener_impl_?", "options": "hidden"}
# fmt: off
ROWS: tuple[Mapping[str, object], ...] = (
    # tf2_ros/transform_broadcaster.h, static_transform_broadcaster.h
    *_broadcaster("tf2_ros::TransformBroadcaster", TF, "tf2_ros::DynamicBroadcasterQoS", OVERRIDES),
    *_broadcaster("tf2_ros::StaticTransformBroadcaster", STATIC, "tf2_ros::StaticBroadcasterQoS", STATIC_OVERRIDES),

    # tf2_ros/transform_listener.h: a buffer and whether to spin; a node; or five of its interfaces.
    {"call": "tf2_ros::TransformListener", "args": [2, 3], "when": {"1": "bool"},
     "makes": [HIDDEN,
               {**TF, "kind": "subscribers", "qos": "tf2_ros::DynamicListenerQoS", "namespace": "{this}"},
               {**STATIC, "kind": "subscribers", "qos": "tf2_ros::StaticListenerQoS", "namespace": "{this}"}]},
    {"call": "tf2_ros::TransformListener", "args": [1],
     "makes": [HIDDEN,
               {**TF, "kind": "subscribers", "qos": "tf2_ros::DynamicListenerQoS", "namespace": "{this}"},
               {**STATIC, "kind": "subscribers", "qos": "tf2_ros::StaticListenerQoS", "namespace": "{this}"}]},
    _listener("tf2_ros::TransformListener", [3, 4, 5, 6, 7, 8], 3, {"2": "bool"}, True),
    _listener("tf2_ros::TransformListener", [2, 3, 4], 3, {}, True),
    _listener("tf2_ros::TransformListener", [5, 6, 7, 8, 9, 10, 11], 6, {}, True),
    {"call": "tf2_ros::StaticTransformListener", "args": [2], "when": {"1": "bool"},
     "makes": [HIDDEN, {**STATIC, "kind": "subscribers", "qos": "tf2_ros::StaticListenerQoS", "namespace": "{this}"}]},
    {"call": "tf2_ros::StaticTransformListener", "args": [1],
     "makes": [HIDDEN, {**STATIC, "kind": "subscribers", "qos": "tf2_ros::StaticListenerQoS", "namespace": "{this}"}]},
    _listener("tf2_ros::StaticTransformListener", [3, 4, 5], 3, {"2": "bool"}, False),
    _listener("tf2_ros::StaticTransformListener", [2], 3, {}, False),
    _listener("tf2_ros::StaticTransformListener", [5, 6, 7, 8], 6, {}, False),

    # tf2_ros/buffer.h: offers its frames where it is given a node.
    {"call": "tf2_ros::Buffer", "args": [1, 2]},
    {"call": "tf2_ros::Buffer", "args": [3, 4],
     "makes": [{"kind": "servers", "name": "tf2_frames", "type": "tf2_msgs/srv/FrameGraph",
                "qos": "{3?rmw_qos_profile_services_default}", "namespace": "{2}"}]},
    {"call": "tf2_ros::Buffer::waitForTransform", "args": [5], "calls": ["4"]},
    *({"call": f"tf2_ros::Buffer::{name}", "args": [1]}
      for name in ("setCreateTimerInterface", "setUsingDedicatedThread")),
    {"call": "tf2_ros::CreateTimerROS", "args": [2, 3]},

    # tf2_ros/buffer_server.h, buffer_client.h
    {"call": "tf2_ros::BufferServer", "args": [3, 4],
     "makes": [{"kind": "action_servers", "name": "{2}", "type": "tf2_msgs/action/LookupTransform",
                "namespace": "{1}"}]},
    {"call": "tf2_ros::BufferClient", "args": [2, 3, 4],
     "makes": [{"kind": "action_clients", "name": "{1}", "type": "tf2_msgs/action/LookupTransform",
                "namespace": "{0}"}]},
)
