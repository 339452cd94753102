# SPDX-License-Identifier: Apache-2.0
"""Autoware's wrappers (ROS 2, C++), under the names of all their releases, where their code is not in the workspace."""

from __future__ import annotations

from collections.abc import Mapping

from haros_ci.extract.apis.ros2_qos import BEST_EFFORT

#: Namespaces in which the same classes are, or have been.
OLD = ("autoware_utils", "autoware::universe_utils", "autoware_universe_utils", "tier4_autoware_utils")
POLLING = (*OLD, "autoware_utils_rclcpp")
DEBUGGING = (*OLD, "autoware_utils_debug")
LOGGING = (*OLD, "autoware_utils_logging")
TRANSFORMS = (*OLD, "autoware_utils_tf")
DIAGNOSING = (*OLD, "autoware_utils_diagnostics")
ADAPTORS = ("component_interface_utils", "autoware::component_interface_utils")
SERVICES = "rmw_qos_profile_services_default"
TF = (
    {"kind": "node", "name": "transform_listener_impl_?", "options": "hidden"},
    {
        "kind": "subscribers",
        "name": "/tf",
        "type": "tf2_msgs/msg/TFMessage",
        "qos": "tf2_ros::DynamicListenerQoS",
        "namespace": "{this}",
    },
    {
        "kind": "subscribers",
        "name": "/tf_static",
        "type": "tf2_msgs/msg/TFMessage",
        "qos": "tf2_ros::StaticListenerQoS",
        "namespace": "{this}",
    },
)


def _adapted(space: str, name: str, args: list[int], kind: str, calls: list[str]) -> dict[str, object]:
    """component_interface_utils/rclcpp.hpp: the class of the first argument says name, type and quality of service."""
    qos = {"qos": SERVICES} if kind in ("servers", "clients") else {"qos": "?"}
    return {
        "call": f"{space}::NodeAdaptor::{name}",
        "args": args,
        "makes": [{"kind": kind, **qos, "namespace": "{this.node}"}],
        "calls": calls,
    }


# fmt: off
ROWS: tuple[Mapping[str, object], ...] = (
    # autoware_utils_rclcpp/polling_subscriber.hpp
    *({"call": f"{space}::InterProcessPollingSubscriber{maker}", "args": [2, 3],
       "makes": [{"kind": "subscribers", "name": "{1}", "type": "{<0>}", "qos": "{2?1}", "namespace": "{0}"}],
       **({"returns": f"{space}::InterProcessPollingSubscriber"} if maker else {})}
      for space in POLLING for maker in ("", "::create_subscription")),

    *({"call": f"{space}::single_depth_sensor_qos", "args": [0], "fills": dict(BEST_EFFORT, depth="1"),
       "returns": "rclcpp::SensorDataQoS"} for space in POLLING),
    *({"call": f"{space}::SingleDepthSensorQoS", "args": [0], "fills": dict(BEST_EFFORT, depth="1"),
       "returns": "rclcpp::SensorDataQoS"} for space in POLLING),

    # autoware_utils_debug/time_keeper.hpp
    *({"class": f"{space}::ProcessingTimeDetail", "alias": message}
      for space, message in (
          *((item, "autoware_internal_debug_msgs::msg::ProcessingTimeTree") for item in DEBUGGING[:1] + DEBUGGING[-1:]),
          *((item, "tier4_debug_msgs::msg::ProcessingTimeTree") for item in DEBUGGING[1:-1]),
      )),

    # autoware_utils_rclcpp/parameter.hpp
    *({"call": f"{space}::{name}", "args": [2],
       "makes": [{"kind": "parameters", "name": "{1}", "type": "{typeof(<0>)}", "namespace": "{0}"}],
       "returns": "{parameter}"}
      for space in POLLING for name in ("get_or_declare_parameter", "getOrDeclareParameter")),

    # autoware_utils_debug/published_time_publisher.hpp: a topic below that of the publisher that it is given.
    *({"call": f"{space}::{name}", "args": [1, 2, 3],
       "fills": {"node": "{0}", "suffix": "{1?/debug/published_time}", "qos": "{2?1}"}}
      for space in DEBUGGING for name in ("PublishedTimePublisher", "BasicPublishedTimePublisher")),
    *({"call": f"{space}::{name}::publish_if_subscribed", "args": [2],
       "makes": [{"kind": "publishers", "name": "{0.topic}{this.suffix}", "qos": "{this.qos}",
                  "type": "autoware_internal_msgs/msg/PublishedTime", "namespace": "{this.node}"}]}
      for space in DEBUGGING for name in ("PublishedTimePublisher", "BasicPublishedTimePublisher")),

    # autoware_utils_debug/debug_publisher.hpp, processing_time_publisher.hpp
    *({"call": f"{space}::{name}", "args": [2], "fills": {"node": "{0}", "prefix": "{1}"}}
      for space in DEBUGGING for name in ("DebugPublisher", "BasicDebugPublisher")),
    *({"call": f"{space}::{name}::publish", "args": [2, 3],
       "makes": [{"kind": "publishers", "name": "{this.prefix}/{0}", "type": "{<0>|typename(1)}", "qos": "{2?1}",
                  "namespace": "{this.node}"}]}
      for space in DEBUGGING for name in ("DebugPublisher", "BasicDebugPublisher")),
    *({"call": f"{space}::ProcessingTimePublisher", "args": [1, 2, 3],
       "makes": [{"kind": "publishers", "name": "{1?~/debug/processing_time_ms}",
                  "type": "diagnostic_msgs/msg/DiagnosticStatus", "qos": "{2?1}", "namespace": "{0}"}]}
      for space in DEBUGGING),

    # autoware_utils_logging/logger_level_configure.hpp
    *({"call": f"{space}::{name}", "args": [1],
       "makes": [{"kind": "servers", "name": "~/config_logger", "type": "logging_demo/srv/ConfigLogger",
                  "qos": SERVICES, "namespace": "{0}"}]}
      for space in LOGGING for name in ("LoggerLevelConfigure", "BasicLoggerLevelConfigure")),

    # autoware_utils_tf/transform_listener.hpp, self_pose_listener.hpp: listeners with a node of their own.
    *({"call": f"{space}::{name}", "args": [1], "makes": list(TF)}
      for space in TRANSFORMS for name in ("TransformListener", "SelfPoseListener")),

    # autoware_utils_diagnostics/diagnostics_interface.hpp
    *({"call": f"{space}::{name}", "args": [2],
       "makes": [{"kind": "publishers", "name": "/diagnostics", "type": "diagnostic_msgs/msg/DiagnosticArray",
                  "qos": 10, "namespace": "{0}"}]}
      for space in DIAGNOSING for name in ("DiagnosticsInterface", "BasicDiagnosticsInterface")),

    # component_interface_utils/rclcpp.hpp: interfaces by a class that stands for them.
    *({"call": f"{space}::NodeAdaptor", "args": [1], "fills": {"node": "{0}"}} for space in ADAPTORS),
    *(row for space in ADAPTORS for row in (
        _adapted(space, "init_pub", [1], "publishers", []),
        _adapted(space, "init_sub", [2, 3], "subscribers", ["1", "2"]),
        _adapted(space, "init_cli", [1, 2], "clients", []),
        _adapted(space, "init_srv", [2, 3, 4], "servers", ["1", "2"]),
    )),
)
