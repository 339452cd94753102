# SPDX-License-Identifier: Apache-2.0
"""Quality of service (ROS 2, C++): QoS objects and their chains of methods, overriding options, durations.

The members are described in ``haros_ci.follow.ros.qos``; ``default`` is the middleware's default.
"""

from __future__ import annotations

from collections.abc import Mapping

#: What a row fills.
Fields = dict[str, object]
#: Members of rmw_qos_profile_t, which stand for the policies.
MEMBERS = (
    "history",
    "depth",
    "reliability",
    "durability",
    "deadline",
    "lifespan",
    "liveliness",
    "liveliness_lease_duration",
)
UNSET: Fields = dict.fromkeys(MEMBERS, "default")
RELIABLE: Fields = {**UNSET, "history": "keep_last", "depth": "10", "reliability": "reliable", "durability": "volatile"}
BEST_EFFORT: Fields = {**RELIABLE, "reliability": "best_effort"}
LATCHED: Fields = {**RELIABLE, "durability": "transient_local"}
BEST_AVAILABLE: Fields = {
    **RELIABLE,
    **dict.fromkeys(
        ("reliability", "durability", "deadline", "liveliness", "liveliness_lease_duration"), "best_available"
    ),
}
#: rclcpp/qos.hpp: classes with profiles of their own.
PROFILES: tuple[tuple[str, Fields], ...] = (
    ("rclcpp::ClockQoS", {**BEST_EFFORT, "depth": "1"}),
    ("rclcpp::SensorDataQoS", {**BEST_EFFORT, "depth": "5"}),
    ("rclcpp::ParametersQoS", {**RELIABLE, "depth": "1000"}),
    ("rclcpp::ServicesQoS", RELIABLE),
    ("rclcpp::ParameterEventsQoS", {**RELIABLE, "depth": "1000"}),
    ("rclcpp::RosoutQoS", {**LATCHED, "depth": "1000", "lifespan": "10000000000"}),
    ("rclcpp::SystemDefaultsQoS", UNSET),
    ("rclcpp::BestAvailableQoS", BEST_AVAILABLE),
)
#: tf2_ros/qos.hpp, nav2_ros_common/qos_profiles.hpp: classes that are given a depth, or have one.
DEPTHS: tuple[tuple[str, Fields], ...] = (
    ("tf2_ros::DynamicListenerQoS", {**RELIABLE, "depth": "100"}),
    ("tf2_ros::DynamicBroadcasterQoS", {**RELIABLE, "depth": "100"}),
    ("tf2_ros::StaticListenerQoS", {**LATCHED, "depth": "100"}),
    ("tf2_ros::StaticBroadcasterQoS", {**LATCHED, "depth": "1"}),
    ("nav2::qos::StandardTopicQoS", RELIABLE),
    ("nav2::qos::LatchedPublisherQoS", {**LATCHED, "depth": "1"}),
    ("nav2::qos::LatchedSubscriptionQoS", LATCHED),
    ("nav2::qos::SensorDataQoS", BEST_EFFORT),
)
#: rclcpp/qos.hpp: methods that set policies to words, and return the object.
CHAIN = (
    ("keep_all", {"history": "keep_all", "depth": "default"}),
    ("reliable", {"reliability": "reliable"}),
    ("best_effort", {"reliability": "best_effort"}),
    ("reliability_best_available", {"reliability": "best_available"}),
    ("transient_local", {"durability": "transient_local"}),
    ("durability_volatile", {"durability": "volatile"}),
    ("durability_best_available", {"durability": "best_available"}),
)
SET = ("history", "reliability", "durability", "deadline", "lifespan", "liveliness", "liveliness_lease_duration")
#: <chrono>: units of time and their literals.
UNITS = (
    ("hours", "h"),
    ("minutes", "min"),
    ("seconds", "s"),
    ("milliseconds", "ms"),
    ("microseconds", "us"),
    ("nanoseconds", "ns"),
)

# fmt: off
ROWS: tuple[Mapping[str, object], ...] = (
    # rclcpp/qos.hpp: the history and depth of an initialisation, the rest of the profile, by default that of a number.
    {"class": "rclcpp::KeepLast", "bases": ["rclcpp::QoSInitialization"]},
    {"class": "rclcpp::KeepAll", "bases": ["rclcpp::QoSInitialization"]},
    {"call": "rclcpp::KeepLast", "args": [1, 2], "fills": {"history": "keep_last", "depth": "{0}"}},
    {"call": "rclcpp::KeepAll", "args": [0], "fills": {"history": "keep_all", "depth": "default"}},
    {"call": "rclcpp::QoSInitialization", "args": [2, 3], "fills": {"history": "{0}", "depth": "{1}"}},
    {"call": "rclcpp::QoSInitialization::from_rmw", "args": [1],
     "fills": {"history": "{0.history|0}", "depth": "{0.depth|0}"}, "returns": "rclcpp::QoSInitialization"},
    {"call": "rclcpp::QoS", "args": [1], "when": {"0": "int"}, "fills": {**RELIABLE, "depth": "{0}"}},
    {"call": "rclcpp::QoS", "args": [1], "when": {"0": "rclcpp::QoSInitialization"},
     "fills": {**RELIABLE, "history": "{0.history}", "depth": "{0.depth}"}},
    {"call": "rclcpp::QoS", "args": [1], "fills": {member: f"{{0.{member}|0}}" for member in MEMBERS}},
    {"call": "rclcpp::QoS", "args": [2],
     "fills": {**{member: f"{{1.{member}|1}}" for member in MEMBERS},
               "history": "{0.history|0}", "depth": "{0.depth|0}"}},
    *({"class": name, "bases": ["rclcpp::QoS"]} for name, _ in (*PROFILES, *DEPTHS)),
    *({"call": name, "args": [0], "fills": fills} for name, fills in (*PROFILES, *DEPTHS)),
    *({"call": name, "args": [1], "fills": fills | {"history": "{0.history|0}", "depth": "{0.depth|0}"}}
      for name, fills in PROFILES),
    *({"call": name, "args": [1], "fills": fills | {"depth": "{0}"}} for name, fills in DEPTHS),
    *({"call": f"rclcpp::QoS::{name}", "args": [0], "fills": fills, "transparent": "{this}"} for name, fills in CHAIN),
    {"call": "rclcpp::QoS::keep_last", "args": [1], "fills": {"history": "keep_last", "depth": "{0}"},
     "transparent": "{this}"},
    *({"call": f"rclcpp::QoS::{name}", "args": [1], "fills": {name: "{0}"}, "transparent": "{this}"} for name in SET),
    {"call": "rclcpp::QoS::avoid_ros_namespace_conventions", "args": [1], "transparent": "{this}"},
    {"call": "rclcpp::QoS::get_rmw_qos_profile", "args": [0], "transparent": "{this}"},
    *({"call": f"rclcpp::QoS::{name}", "args": [0], "returns": f"{{this.{name}}}"} for name in (*SET, "depth")),

    # rclcpp/qos_overriding_options.hpp
    {"call": "rclcpp::QosOverridingOptions", "args": [0], "fills": {"policies": "", "id": ""}},
    {"call": "rclcpp::QosOverridingOptions", "args": [1, 2, 3], "fills": {"policies": "{0}", "id": "{2?}"},
     "calls": ["1"]},
    {"call": "rclcpp::QosOverridingOptions::with_default_policies", "args": [0, 1, 2],
     "fills": {"policies": "history,depth,reliability", "id": "{1?}"}, "calls": ["0"],
     "returns": "rclcpp::QosOverridingOptions"},

    # rclcpp/duration.hpp, <chrono>
    {"call": "rclcpp::Duration", "args": [2], "fills": {"seconds": "{0}", "nanoseconds": "{1}"}},
    {"call": "rclcpp::Duration", "args": [1], "fills": {"nanoseconds": "{0}"}},
    {"call": "rclcpp::Duration::from_seconds", "args": [1], "fills": {"seconds": "{0}"}, "returns": "rclcpp::Duration"},
    {"call": "rclcpp::Duration::from_nanoseconds", "args": [1], "fills": {"nanoseconds": "{0}"},
     "returns": "rclcpp::Duration"},
    {"call": "rclcpp::Duration::from_rmw_time", "args": [1], "fills": {"nanoseconds": "{0}"},
     "returns": "rclcpp::Duration"},
    {"call": "rclcpp::Duration::max", "args": [0], "fills": {"infinite": "true"}, "returns": "rclcpp::Duration"},
    {"call": "rclcpp::Duration::seconds", "args": [0], "returns": "{this.seconds}"},
    {"call": "rclcpp::Duration::to_chrono", "args": [0], "transparent": "{this}"},
    {"call": "rclcpp::Duration::to_rmw_time", "args": [0], "transparent": "{this}"},
    *({"call": f"std::chrono::{unit}", "args": [1], "fills": {unit: "{0}"}} for unit, _ in UNITS),
    *({"call": f'operator""{suffix}', "args": [1], "fills": {unit: "{0}"}, "returns": f"std::chrono::{unit}"}
      for unit, suffix in UNITS),
    # Of a duration in the abstract the unit is in the template arguments, seconds where there is one.
    {"call": "std::chrono::duration", "args": [1], "fills": {"count": "{0}"}},
    {"call": "std::chrono::duration_cast", "args": [1], "transparent": "{0}"},
)
