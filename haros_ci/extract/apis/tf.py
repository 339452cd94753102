# SPDX-License-Identifier: Apache-2.0
"""Transforms (ROS 1, C++): broadcasters, listeners, buffers, and the buffer behind an action."""

from __future__ import annotations

# fmt: off
ROWS: tuple[dict[str, object], ...] = (
    # tf/transform_broadcaster.h, tf/transform_listener.h: wrappers of tf2_ros since Hydro.
    {"call": "tf::TransformBroadcaster", "args": [0],
     "makes": [{"kind": "publishers", "name": "/tf", "type": "tf2_msgs/TFMessage", "queue_size": 100,
                "latched": False}]},
    {"call": "tf::TransformListener", "args": [0, 1, 2, 3],
     "makes": [{"kind": "subscribers", "name": "/tf", "type": "tf2_msgs/TFMessage", "queue_size": 100},
               {"kind": "subscribers", "name": "/tf_static", "type": "tf2_msgs/TFMessage", "queue_size": 100}]},

    # tf2_ros/src/transform_broadcaster.cpp, static_transform_broadcaster.cpp, transform_listener.cpp
    {"call": "tf2_ros::TransformBroadcaster", "args": [0],
     "makes": [{"kind": "publishers", "name": "/tf", "type": "tf2_msgs/TFMessage", "queue_size": 100,
                "latched": False}]},
    {"call": "tf2_ros::StaticTransformBroadcaster", "args": [0],
     "makes": [{"kind": "publishers", "name": "/tf_static", "type": "tf2_msgs/TFMessage", "queue_size": 100,
                "latched": True}]},
    {"call": "tf2_ros::TransformListener", "args": [1, 2, 3, 4],
     "makes": [{"kind": "subscribers", "name": "/tf", "type": "tf2_msgs/TFMessage", "queue_size": 100},
               {"kind": "subscribers", "name": "/tf_static", "type": "tf2_msgs/TFMessage", "queue_size": 100}]},

    # tf2_ros/src/buffer.cpp: its frames are offered with the second argument, debug, which is false by default.
    {"call": "tf2_ros::Buffer", "args": [2], "when": {"1": "true"},
     "makes": [{"kind": "servers", "name": "tf2_frames", "type": "tf2_msgs/FrameGraph", "namespace": "~"}]},
    {"call": "tf2_ros::Buffer", "args": [2], "when": {"1": "false"}},
    {"call": "tf2_ros::Buffer", "args": [2],
     "makes": [{"kind": "servers", "name": "tf2_frames", "type": "tf2_msgs/FrameGraph", "namespace": "~",
                "unsure": "the argument debug of the buffer is not known"}]},

    # tf2_ros/buffer_server.h, buffer_client.h
    {"call": "tf2_ros::BufferServer", "args": [2, 3, 4],
     "makes": [{"kind": "action_servers", "name": "{1}", "type": "tf2_msgs/LookupTransform"}]},
    {"call": "tf2_ros::BufferClient", "args": [1, 2, 3],
     "makes": [{"kind": "action_clients", "name": "{0}", "type": "tf2_msgs/LookupTransform"}]},
)
