# SPDX-License-Identifier: Apache-2.0
"""Qualities of service by name: profiles of rmw, rcl and rclpy, classes of C++ libraries, policies and their words."""

from __future__ import annotations

from dataclasses import replace

from haros_ci.model.architecture import Qos
from haros_ci.regex import regex

#: rmw/qos_profiles.h: rmw_qos_profile_default, and what a number stands for.
DEFAULT = Qos(history="keep_last", depth=10, reliability="reliable", durability="volatile")
SENSOR_DATA = replace(DEFAULT, depth=5, reliability="best_effort")
LATCHED = replace(DEFAULT, depth=1, durability="transient_local")
#: The middleware decides all of it.
SYSTEM_DEFAULT = Qos()
UNTOLD = Qos(history="?", depth="?", reliability="?", durability="?")
BEST_AVAILABLE = replace(
    DEFAULT,
    reliability="best_available",
    durability="best_available",
    deadline="best_available",
    liveliness="best_available",
    lease="best_available",
)
ROSOUT = replace(DEFAULT, depth=1000, durability="transient_local", lifespan=10.0)

#: Profiles by the name of rmw/qos_profiles.h, rcl/logging_rosout.h and rcl_action/default_qos.h.
PROFILES = {
    "rmw_qos_profile_default": DEFAULT,
    "rmw_qos_profile_sensor_data": SENSOR_DATA,
    "rmw_qos_profile_services_default": DEFAULT,
    "rmw_qos_profile_parameters": replace(DEFAULT, depth=1000),
    "rmw_qos_profile_parameter_events": replace(DEFAULT, depth=1000),
    "rmw_qos_profile_system_default": SYSTEM_DEFAULT,
    "rmw_qos_profile_best_available": BEST_AVAILABLE,
    "rmw_qos_profile_unknown": UNTOLD,
    "rmw_qos_profile_rosout_default": ROSOUT,
    "rmw_qos_profile_action_status_default": LATCHED,
}
#: Other names of the same profiles.
ALIASES = {
    "rcl_qos_profile_rosout_default": "rmw_qos_profile_rosout_default",
    "rcl_action_qos_profile_status_default": "rmw_qos_profile_action_status_default",
    "rmw_qos_profile_action_status": "rmw_qos_profile_action_status_default",
}
#: Classes, with what their constructors without arguments give (rclcpp/qos.hpp, tf2_ros/qos.hpp, rclpy/qos.py,
#: nav2_ros_common/qos_profiles.hpp).
CLASSES = {
    "rclcpp::QoS": DEFAULT,
    "rmw_qos_profile_t": UNTOLD,
    "rclcpp::QoSInitialization": DEFAULT,
    "rclcpp::KeepLast": DEFAULT,
    "rclcpp::KeepAll": replace(DEFAULT, history="keep_all", depth=None),
    "rclcpp::SensorDataQoS": SENSOR_DATA,
    "rclcpp::ServicesQoS": DEFAULT,
    "rclcpp::ParametersQoS": replace(DEFAULT, depth=1000),
    "rclcpp::ParameterEventsQoS": replace(DEFAULT, depth=1000),
    "rclcpp::ClockQoS": replace(SENSOR_DATA, depth=1),
    "rclcpp::RosoutQoS": ROSOUT,
    "rclcpp::SystemDefaultsQoS": SYSTEM_DEFAULT,
    "rclcpp::BestAvailableQoS": BEST_AVAILABLE,
    "tf2_ros::DynamicListenerQoS": replace(DEFAULT, depth=100),
    "tf2_ros::DynamicBroadcasterQoS": replace(DEFAULT, depth=100),
    "tf2_ros::StaticListenerQoS": replace(LATCHED, depth=100),
    "tf2_ros::StaticBroadcasterQoS": LATCHED,
    "nav2::qos::StandardTopicQoS": DEFAULT,
    "nav2::qos::LatchedPublisherQoS": LATCHED,
    "nav2::qos::LatchedSubscriptionQoS": replace(LATCHED, depth=10),
    "nav2::qos::SensorDataQoS": replace(SENSOR_DATA, depth=10),
    "rclpy.qos.QoSProfile": DEFAULT,
}
#: Methods that change one policy and give the object itself (rclcpp/qos.hpp).
CHAINED = frozenset(
    (
        "history",
        "keep_last",
        "keep_all",
        "reliability",
        "reliable",
        "best_effort",
        "reliability_best_available",
        "durability",
        "durability_volatile",
        "transient_local",
        "durability_best_available",
        "deadline",
        "lifespan",
        "liveliness",
        "liveliness_lease_duration",
        "avoid_ros_namespace_conventions",
    )
)

_ANY = {"system_default": None, "default": None, "best_available": "best_available"}
#: What is written for a policy, and what it is; all else is not known.
WORDS: dict[str, dict[str, str | None]] = {
    "history": {"system_default": None, "default": None, "keep_last": "keep_last", "keep_all": "keep_all"},
    "reliability": {**_ANY, "reliable": "reliable", "best_effort": "best_effort"},
    "durability": {**_ANY, "volatile": "volatile", "transient_local": "transient_local"},
    "liveliness": {**_ANY, "automatic": "automatic", "manual_by_topic": "manual_by_topic"},
}
#: The same as numbers (rmw/types.h).
NUMBERS: dict[str, dict[int, str | None]] = {
    "history": {0: None, 1: "keep_last", 2: "keep_all"},
    "reliability": {0: None, 1: "reliable", 2: "best_effort", 4: "best_available"},
    "durability": {0: None, 1: "transient_local", 2: "volatile", 4: "best_available"},
    "liveliness": {0: None, 1: "automatic", 3: "manual_by_topic", 5: "best_available"},
}
#: Members of durations, in seconds.
UNITS = {
    "hours": 3600.0,
    "minutes": 60.0,
    "seconds": 1.0,
    "sec": 1.0,
    "milliseconds": 1e-3,
    "microseconds": 1e-6,
    "nanoseconds": 1e-9,
    "nanosec": 1e-9,
    "nsec": 1e-9,
}
#: Names of times that are no limit.
CONSTANTS = regex(
    r"RMW_(DURATION_(INFINITE|UNSPECIFIED)|QOS_(DEADLINE|LIFESPAN|LIVELINESS_LEASE_DURATION)_DEFAULT)$|\bInfinite$"
)
