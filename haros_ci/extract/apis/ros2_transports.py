# SPDX-License-Identifier: Apache-2.0
"""Transports (ROS 2, C++): image_transport, camera_info_manager, point_cloud_transport.

The topics below a base topic (``image/compressed``) are added by ``tables``. A queue's size stands for the default
profile of that depth, for point clouds for the sensors' one.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from haros_ci.extract.apis.ros2_endpoints import events

IMAGE, INFO, CLOUD = "sensor_msgs/msg/Image", "sensor_msgs/msg/CameraInfo", "sensor_msgs/msg/PointCloud2"
DEFAULT = "rmw_qos_profile_default"


def _ends(kind: str, name: int, qos: str, node: str, camera: bool, options: str = "") -> list[dict[str, Any]]:
    """An image's end, with that of its camera_info beside it as it is remapped (camera_common.cpp)."""
    more: dict[str, Any] = {"qos": qos, "namespace": node, **({"options": options} if options else {})}
    ends: list[dict[str, Any]] = [{"kind": kind, "name": f"{{{name}}}", "type": IMAGE, **more}]
    if camera:
        ends.append({"kind": kind, "name": f"{{parent({name})}}camera_info", "type": INFO, **more})
    return ends


def _transport(node: str, name: str = "{2?image_transport}", value: str = "{1?raw}") -> dict[str, Any]:
    return {"kind": "getters", "name": name, "type": "str", "value": value, "namespace": node}


OWN = "{this.node}"
#: Without hints the transport is what the parameter says (image_transport.cpp).
BY_PARAMETER = _transport(OWN, "image_transport", "raw")
# fmt: off
ROWS: tuple[Mapping[str, object], ...] = (
    # image_transport/image_transport.hpp: functions that are given a node, a topic, for subscriptions a callback and a
    # transport; then a quality of service and options.
    {"call": "image_transport::create_publisher", "args": [2, 3, 4],
     "makes": _ends("publishers", 1, f"{{2?{DEFAULT}}}", "{0}", False, "{3}"), "calls": events(3),
     "returns": "image_transport::Publisher", "fills": {"node": "{0}", "topic": "{resolve(1)}"}},
    {"call": "image_transport::create_camera_publisher", "args": [2, 3, 4],
     "makes": _ends("publishers", 1, f"{{2?{DEFAULT}}}", "{0}", True, "{3}"), "calls": events(3),
     "returns": "image_transport::CameraPublisher", "fills": {"node": "{0}", "topic": "{resolve(1)}"}},
    {"call": "image_transport::create_subscription", "args": [4, 5, 6],
     "makes": _ends("subscribers", 1, f"{{4?{DEFAULT}}}", "{0}", False, "{5}"), "calls": ["2", *events(5)],
     "returns": "image_transport::Subscriber", "fills": {"node": "{0}", "topic": "{resolve(1)}"}},
    {"call": "image_transport::create_camera_subscription", "args": [4, 5],
     "makes": _ends("subscribers", 1, f"{{4?{DEFAULT}}}", "{0}", True), "calls": ["2"],
     "returns": "image_transport::CameraSubscriber", "fills": {"node": "{0}", "topic": "{resolve(1)}"}},

    # image_transport/image_transport.hpp: the class, which keeps its node. A latch counts for nothing.
    {"call": "image_transport::ImageTransport", "args": [1], "fills": {"node": "{0}"}},
    {"call": "image_transport::ImageTransport::advertise", "args": [2, 3],
     "makes": _ends("publishers", 0, "{1}", OWN, False), "returns": "image_transport::Publisher",
     "fills": {"topic": "{resolve(0)}"}},
    {"call": "image_transport::ImageTransport::advertiseCamera", "args": [2, 3],
     "makes": _ends("publishers", 0, "{1}", OWN, True), "returns": "image_transport::CameraPublisher",
     "fills": {"topic": "{resolve(0)}"}},
    {"call": "image_transport::ImageTransport::subscribe", "args": [3],
     "makes": [*_ends("subscribers", 0, "{1}", OWN, False), BY_PARAMETER], "calls": ["2"],
     "returns": "image_transport::Subscriber", "fills": {"topic": "{resolve(0)}"}},
    {"call": "image_transport::ImageTransport::subscribe", "args": [4, 5, 6],
     "makes": _ends("subscribers", 0, "{1}", OWN, False), "calls": ["2"],
     "returns": "image_transport::Subscriber", "fills": {"topic": "{resolve(0)}"}},
    {"call": "image_transport::ImageTransport::subscribeCamera", "args": [3],
     "makes": [*_ends("subscribers", 0, "{1}", OWN, True), BY_PARAMETER], "calls": ["2"],
     "returns": "image_transport::CameraSubscriber", "fills": {"topic": "{resolve(0)}"}},
    {"call": "image_transport::ImageTransport::subscribeCamera", "args": [4, 5],
     "makes": _ends("subscribers", 0, "{1}", OWN, True), "calls": ["2"],
     "returns": "image_transport::CameraSubscriber", "fills": {"topic": "{resolve(0)}"}},
    *({"call": f"image_transport::{owner}::getTopic", "args": [0], "returns": "{this.topic}"}
      for owner in ("Publisher", "CameraPublisher", "Subscriber", "CameraSubscriber")),

    # image_transport/camera_common.hpp: the given name counts as resolved.
    {"call": "image_transport::getCameraInfoTopic", "args": [1], "returns": "{above(0)}camera_info"},

    # image_transport/transport_hints.hpp, subscriber_filter.hpp
    {"call": "image_transport::TransportHints", "args": [1, 2, 3], "makes": [_transport("{0}")],
     "fills": {"transport": "{parameter|1?raw}"}},
    {"call": "image_transport::TransportHints::getTransport", "args": [0], "returns": "{this.transport}"},
    {"class": "image_transport::SubscriberFilter", "bases": ["message_filters::SimpleFilter"]},
    *({"call": name, "args": [3, 4, 5], "makes": _ends("subscribers", 1, f"{{3?{DEFAULT}}}", "{0}", False, "{4}"),
       "calls": events(4)}
      for name in ("image_transport::SubscriberFilter", "image_transport::SubscriberFilter::subscribe")),

    # camera_info_manager/camera_info_manager.hpp: a node, or its interfaces for itself, services and logging.
    {"call": "camera_info_manager::CameraInfoManager", "args": [2, 3, 4], "when": {"1": "string"},
     "makes": [{"kind": "servers", "name": "{3?~}/set_camera_info", "type": "sensor_msgs/srv/SetCameraInfo",
                "qos": "rmw_qos_profile_services_default", "namespace": "{0}"}]},
    {"call": "camera_info_manager::CameraInfoManager", "args": [1],
     "makes": [{"kind": "servers", "name": "~/set_camera_info", "type": "sensor_msgs/srv/SetCameraInfo",
                "qos": "rmw_qos_profile_services_default", "namespace": "{0}"}]},
    {"call": "camera_info_manager::CameraInfoManager", "args": [3, 4, 5, 6, 7],
     "makes": [{"kind": "servers", "name": "{6?~}/set_camera_info", "type": "sensor_msgs/srv/SetCameraInfo",
                "qos": f"{{5?{DEFAULT}}}", "namespace": "{0}"}]},

    # point_cloud_transport/point_cloud_transport.hpp
    {"call": "point_cloud_transport::create_publisher", "args": [2, 3, 4],
     "makes": [{"kind": "publishers", "name": "{1}", "type": CLOUD, "qos": f"{{2?{DEFAULT}}}", "options": "{3}",
                "namespace": "{0}"}],
     "calls": events(3), "returns": "point_cloud_transport::Publisher", "fills": {"node": "{0}"}},
    {"call": "point_cloud_transport::create_subscription", "args": [4, 5, 6],
     "makes": [{"kind": "subscribers", "name": "{1}", "type": CLOUD, "qos": f"{{4?{DEFAULT}}}", "options": "{5}",
                "namespace": "{0}"}],
     "calls": ["2", *events(5)], "returns": "point_cloud_transport::Subscriber", "fills": {"node": "{0}"}},
    {"call": "point_cloud_transport::PointCloudTransport", "args": [1], "fills": {"node": "{0}"}},
    *({"call": "point_cloud_transport::PointCloudTransport::advertise", "args": [2, 3], **when,
       "makes": [{"kind": "publishers", "name": "{0}", "type": CLOUD, "qos": qos, "options": "{2}",
                  "namespace": OWN}],
       "calls": events(2), "returns": "point_cloud_transport::Publisher"}
      for when, qos in (({"when": {"1": "int"}}, "rmw_qos_profile_sensor_data:{1}"), ({}, "{1}"))),
    *({"call": "point_cloud_transport::PointCloudTransport::subscribe", "args": [3, 4, 5], **when,
       "makes": [{"kind": "subscribers", "name": "{0}", "type": CLOUD, "qos": qos, "namespace": OWN}],
       "calls": ["2"], "returns": "point_cloud_transport::Subscriber"}
      for when, qos in (({"when": {"1": "int"}}, "rmw_qos_profile_sensor_data:{1}"), ({}, "{1}"))),
    {"call": "point_cloud_transport::TransportHints", "args": [1, 2, 3],
     "makes": [_transport("{0}", "{2?point_cloud_transport}")]},
)
