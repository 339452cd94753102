# SPDX-License-Identifier: Apache-2.0
"""ROS 2 Python: rclpy's quality of service and durations (rclpy/qos.py, qos_overriding_options.py, duration.py, time.py).

A profile's field is there only where its policy is given: all others are those of rmw's default profile. The named
profiles (``qos_profile_sensor_data``, ``QoSPresetProfiles.SENSOR_DATA.value``) are no calls and have no row.
"""

from __future__ import annotations

#: The policies' enumerations, of which the older names begin with ``QoS``. A short key is a name in lower case.
POLICIES = ("HistoryPolicy", "ReliabilityPolicy", "DurabilityPolicy", "LivelinessPolicy")

# fmt: off
ROWS: tuple[dict[str, object], ...] = (
    {"call": "rclpy.qos.QoSProfile",
     "fills": {"history": "{0|history}", "depth": "{1|depth}", "reliability": "{2|reliability}",
               "durability": "{3|durability}", "lifespan": "{4|lifespan}", "deadline": "{5|deadline}",
               "liveliness": "{6|liveliness}", "lease": "{7|liveliness_lease_duration}"}},

    {"call": "rclpy.qos.QoSPresetProfiles.get_from_short_key", "returns": "rclpy.qos.QoSPresetProfiles.{0|name}"},

    # What the parameters qos_overrides.<topic>.<publisher|subscription>[_<id>].<policy> are declared for.
    {"call": "rclpy.qos_overriding_options.QoSOverridingOptions",
     "fills": {"policies": "{0|policy_kinds}", "id": "{entity_id?}"}, "calls": ["callback"]},
    {"call": "rclpy.qos_overriding_options.QoSOverridingOptions.with_default_policies",
     "returns": "rclpy.qos_overriding_options.QoSOverridingOptions",
     "fills": {"policies": "history,depth,reliability", "id": "{entity_id?}"}, "calls": ["callback"]},

    # A duration's own attribute nanoseconds is the whole of it, seconds included: it is not modelled.
    {"call": "rclpy.duration.Duration", "fills": {"seconds": "{seconds?0}", "nanosec": "{nanoseconds?0}"}},
    {"call": "rclpy.duration.Duration.to_msg", "returns": "builtin_interfaces.msg.Duration"},
    {"call": "rclpy.time.Time"},
    {"call": "rclpy.time.Time.to_msg", "returns": "builtin_interfaces.msg.Time"},
)
# fmt: on

ROWS += tuple(
    {"call": f"rclpy.qos.{older}{name}.get_from_short_key", "returns": "{0|name}"}
    for name in POLICIES
    for older in ("", "QoS")
)
