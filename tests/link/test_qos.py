# SPDX-License-Identifier: Apache-2.0
"""Quality of service from values: numbers, profiles by name, constants, objects, durations, overrides by parameters."""

from __future__ import annotations

from typing import Any

import pytest

from haros_ci.follow.ros.qos import SEVERAL, UNKNOWN, overridden, override_id, override_policies, preset, qos_of
from haros_ci.follow.ros.qos_profiles import DEFAULT, PROFILES
from haros_ci.model.architecture import Qos
from haros_ci.model.location import Location
from haros_ci.values.abstract import Cell, Choice, Known, Library, Object, Opaque, Pointer, Sequence, Text, Value

HERE = Location("p/src/n.cpp", 7)
UNTOLD = Opaque("it is read from a file", HERE)


def thing(name: str, **fields: Any) -> Object:
    """An object of a library's class; plain data stands for itself."""
    kinds = (Known, Opaque, Text, Choice, Library, Object, Pointer, Sequence)
    return Object(
        name, fields={key: Cell(each if isinstance(each, kinds) else Known(each)) for key, each in fields.items()}
    )


def qos(**policies: Any) -> Qos:
    """The default profile with other policies."""
    plain = {"history": "keep_last", "depth": 10, "reliability": "reliable", "durability": "volatile"}
    return Qos(**{**plain, **policies})


def made(**fields: Any) -> Object:
    """A QoS as its constructor from a depth of 10 fills it, with other members."""
    members = {"history": "keep_last", "depth": 10, "reliability": "reliable", "durability": "volatile"}
    others = dict.fromkeys(("deadline", "lifespan", "liveliness", "liveliness_lease_duration"), "default")
    return thing("rclcpp::QoS", **{**members, **others, **fields})


SYSTEM = Qos()
KNOWN: tuple[tuple[str, Value, Qos], ...] = (
    ("number", Known(3), qos(depth=3)),
    ("zero", Known(0), qos(depth=0)),
    ("number with a point", Known(4.0), qos(depth=4)),
    ("behind a pointer", Pointer(Cell(Known(3))), qos(depth=3)),
    ("braces", Sequence(Cell((Cell(Known(3)),))), qos(depth=3)),
    ("rmw default", Library("rmw_qos_profile_default"), qos()),
    ("rmw default, global", Library("::rmw_qos_profile_default"), qos()),
    ("rmw sensor data", Library("rmw_qos_profile_sensor_data"), qos(depth=5, reliability="best_effort")),
    ("rmw services", Library("rmw_qos_profile_services_default"), qos()),
    ("rmw parameters", Library("rmw_qos_profile_parameters"), qos(depth=1000)),
    ("rmw parameter events", Library("rmw_qos_profile_parameter_events"), qos(depth=1000)),
    ("rmw system default", Library("rmw_qos_profile_system_default"), SYSTEM),
    (
        "rosout",
        Library("rcl_qos_profile_rosout_default"),
        qos(depth=1000, durability="transient_local", lifespan=10.0),
    ),
    ("by name", Known("rmw_qos_profile_sensor_data"), qos(depth=5, reliability="best_effort")),
    ("by name and depth", Known("rmw_qos_profile_sensor_data:2"), qos(depth=2, reliability="best_effort")),
    ("class by name", Known("tf2_ros::StaticListenerQoS"), qos(depth=100, durability="transient_local")),
    ("rclpy sensor data", Library("rclpy.qos.qos_profile_sensor_data"), qos(depth=5, reliability="best_effort")),
    ("rclpy system default", Library("rclpy.qos.qos_profile_system_default"), SYSTEM),
    ("rclpy services", Library("rclpy.qos.qos_profile_services_default"), qos()),
    ("rclpy parameters", Library("rclpy.qos.qos_profile_parameters"), qos(depth=1000)),
    (
        "rclpy action status",
        Library("rclpy.qos.qos_profile_action_status_default"),
        qos(depth=1, durability="transient_local"),
    ),
    ("rclpy preset", Library("rclpy.qos.QoSPresetProfiles.SENSOR_DATA.value"), qos(depth=5, reliability="best_effort")),
    ("rclpy preset, member", Library("rclpy.qos.QoSPresetProfiles.PARAMETERS"), qos(depth=1000)),
    ("rclpy preset, system", Library("rclpy.qos.QoSPresetProfiles.SYSTEM_DEFAULT.value"), SYSTEM),
    ("class", Object("rclcpp::SensorDataQoS"), qos(depth=5, reliability="best_effort")),
    ("class of the clock", Object("rclcpp::ClockQoS"), qos(depth=1, reliability="best_effort")),
    ("class of system defaults", Object("rclcpp::SystemDefaultsQoS"), SYSTEM),
    ("class of nav2", Object("nav2::qos::SensorDataQoS"), qos(reliability="best_effort")),
    ("object", made(depth=2, reliability="best_effort"), qos(depth=2, reliability="best_effort")),
    ("all of history", made(history="keep_all", depth="default"), qos(history="keep_all", depth=None)),
    ("all of history, depth kept", made(history="keep_all"), qos(history="keep_all", depth=None)),
    (
        "system defaults of ten",
        made(**dict.fromkeys(("reliability", "durability"), "default")),
        qos(reliability=None, durability=None),
    ),
    ("best available", made(reliability="best_available"), qos(reliability="best_available")),
    ("rclpy depth", thing("rclpy.qos.QoSProfile", depth=1), qos(depth=1)),
    (
        "rclpy words",
        thing(
            "rclpy.qos.QoSProfile",
            depth=1,
            reliability=Library("rclpy.qos.ReliabilityPolicy.BEST_EFFORT"),
            durability=Library("rclpy.qos.QoSDurabilityPolicy.TRANSIENT_LOCAL"),
            history=Library("rclpy.qos.HistoryPolicy.KEEP_LAST"),
        ),
        qos(depth=1, reliability="best_effort", durability="transient_local"),
    ),
    (
        "rclpy lease",
        thing("rclpy.qos.QoSProfile", depth=1, lease=thing("rclpy.duration.Duration", seconds=2, nanosec=500_000_000)),
        qos(depth=1, lease=2.5),
    ),
    ("one of two that are alike", Choice((Known(10), Library("rmw_qos_profile_default"))), qos()),
)


@pytest.mark.parametrize(("value", "expected"), [case[1:] for case in KNOWN], ids=[case[0] for case in KNOWN])
def test_known(value: Value, expected: Qos) -> None:
    assert qos_of(value) == (expected, None)


WORDS: tuple[tuple[str, Value, str | None], ...] = (
    ("reliability", Library("RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT"), "best_effort"),
    ("reliability", Library("rclcpp::ReliabilityPolicy::BestEffort"), "best_effort"),
    ("reliability", Library("rclcpp::ReliabilityPolicy::SystemDefault"), None),
    ("reliability", Library("rclcpp::ReliabilityPolicy::BestAvailable"), "best_available"),
    ("reliability", Library("QoSReliabilityPolicy.RELIABLE"), "reliable"),
    ("reliability", Library("rclpy.qos.QoSReliabilityPolicy.RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT"), "best_effort"),
    ("reliability", Library("rmw_qos_profile_sensor_data"), "best_effort"),
    ("reliability", Known(2), "best_effort"),
    ("reliability", Known("BEST_EFFORT"), "best_effort"),
    ("durability", Library("RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL"), "transient_local"),
    ("durability", Library("rclcpp::DurabilityPolicy::Volatile"), "volatile"),
    ("durability", Library("RMW_QOS_POLICY_DURABILITY_SYSTEM_DEFAULT"), None),
    ("durability", Known(1), "transient_local"),
    ("history", Library("rclcpp::HistoryPolicy::KeepLast"), "keep_last"),
    ("history", Library("rclcpp::HistoryPolicy::SystemDefault"), None),
    ("liveliness", Library("RMW_QOS_POLICY_LIVELINESS_MANUAL_BY_TOPIC"), "manual_by_topic"),
    ("liveliness", Library("rclcpp::LivelinessPolicy::Automatic"), "automatic"),
    ("liveliness", Library("rclpy.qos.LivelinessPolicy.MANUAL_BY_TOPIC"), "manual_by_topic"),
)


@pytest.mark.parametrize(("policy", "value", "expected"), WORDS)
def test_words(policy: str, value: Value, expected: str | None) -> None:
    assert qos_of(made(**{policy: value})) == (qos(**{policy: expected}), None)


DURATIONS: tuple[tuple[str, Value, float | None], ...] = (
    ("milliseconds", thing("std::chrono::milliseconds", milliseconds=250), 0.25),
    ("minutes", thing("std::chrono::minutes", minutes=2), 120.0),
    ("duration of milliseconds", thing("rclcpp::Duration", nanoseconds=thing("", milliseconds=100)), 0.1),
    ("seconds and nanoseconds", thing("rclcpp::Duration", seconds=1, nanoseconds=500_000_000), 1.5),
    ("from seconds", thing("rclcpp::Duration", seconds=0.5), 0.5),
    ("number of nanoseconds", Known(100_000_000), 0.1),
    ("struct", thing("rmw_time_t", sec=1, nsec=5_000_000), 1.005),
    ("braces", Sequence(Cell((Cell(Known(1)), Cell(Known(0))))), 1.0),
    ("nothing", Known(0), None),
    ("no time at all", thing("rmw_time_t", sec=0, nsec=0), None),
    ("endless", thing("rclcpp::Duration", infinite=True), None),
    ("largest", Known(9223372036854775807), None),
    ("constant", Library("RMW_DURATION_INFINITE"), None),
    ("constant of the default", Library("RMW_QOS_DEADLINE_DEFAULT"), None),
)


@pytest.mark.parametrize(("value", "expected"), [case[1:] for case in DURATIONS], ids=[case[0] for case in DURATIONS])
@pytest.mark.parametrize(
    ("field", "policy"), (("deadline", "deadline"), ("lifespan", "lifespan"), ("liveliness_lease_duration", "lease"))
)
def test_durations(field: str, policy: str, value: Value, expected: float | None) -> None:
    assert qos_of(made(**{field: value})) == (qos(**{policy: expected}), None)


OPEN: tuple[tuple[str, Value, Qos, tuple[str, Location | None]], ...] = (
    ("opaque", UNTOLD, UNKNOWN, ("it is read from a file", HERE)),
    ("text", Text(("rmw_", UNTOLD)), UNKNOWN, ("it is read from a file", HERE)),
    ("none", Known(None), UNKNOWN, ("it is no quality of service", None)),
    ("flag", Known(True), UNKNOWN, ("it is no quality of service", None)),
    ("word", Known("latched"), UNKNOWN, ("it is no quality of service", None)),
    ("other profile", Library("my_qos_profile"), UNKNOWN, ("my_qos_profile is not in the workspace", None)),
    (
        "preset that is none",
        Library("rclpy.qos.QoSPresetProfiles.LATCHED.value"),
        UNKNOWN,
        ("rclpy.qos.QoSPresetProfiles.LATCHED.value is not in the workspace", None),
    ),
    (
        "other class",
        Object("my::QoS", location=HERE),
        UNKNOWN,
        ("what quality of service a my::QoS is, is not known", HERE),
    ),
    ("two numbers", Sequence(Cell((Cell(Known(1)), Cell(Known(2))))), UNKNOWN, ("it is not plain data", None)),
    ("depth", made(depth=UNTOLD), qos(depth="?"), ("it is read from a file", HERE)),
    ("reliability", made(reliability=UNTOLD), qos(reliability="?"), ("it is read from a file", HERE)),
    (
        "the first reason counts",
        made(durability=Opaque("b"), reliability=Opaque("a")),
        qos(reliability="?", durability="?"),
        ("a", None),
    ),
    ("deadline", made(deadline=UNTOLD), qos(deadline="?"), ("it is read from a file", HERE)),
    (
        "part of a deadline",
        made(deadline=thing("rclcpp::Duration", seconds=1, nanoseconds=UNTOLD)),
        qos(deadline="?"),
        ("it is not plain data", None),
    ),
    (
        "constant of another policy",
        made(reliability=Library("rclcpp::DurabilityPolicy::Volatile")),
        qos(reliability="?"),
        ("rclcpp::DurabilityPolicy::Volatile is not in the workspace", None),
    ),
    (
        "unknown to rmw",
        made(durability=Library("RMW_QOS_POLICY_DURABILITY_UNKNOWN")),
        qos(durability="?"),
        ("RMW_QOS_POLICY_DURABILITY_UNKNOWN is not in the workspace", None),
    ),
    (
        "number of another policy",
        made(durability=Known(17)),
        qos(durability="?"),
        ("it is no quality of service that is known", None),
    ),
    ("one of two depths", Choice((Known(1), Known(2))), qos(depth="?"), (SEVERAL, None)),
    (
        "one of two profiles",
        Choice((Known(5), Library("rmw_qos_profile_sensor_data"))),
        qos(depth=5, reliability="?"),
        (SEVERAL, None),
    ),
    (
        "one of two words",
        made(reliability=Choice((Known("reliable"), Known("best_effort")))),
        qos(reliability="?"),
        (SEVERAL, None),
    ),
    (
        "one may be anything",
        Choice((Known(1), UNTOLD)),
        qos(history="?", depth="?", reliability="?", durability="?"),
        ("it is read from a file", HERE),
    ),
    (
        "depth of a profile",
        Text(("rmw_qos_profile_sensor_data:", UNTOLD)),
        qos(depth="?", reliability="best_effort"),
        ("it is read from a file", HERE),
    ),
    (
        "members of another class",
        thing("my::Profile", depth=3),
        Qos(history="?", depth=3, reliability="?", durability="?"),
        ("the code does not tell it", None),
    ),
    ("a struct that nothing is written to", Object("rmw_qos_profile_t"), UNKNOWN, ("the code does not tell it", None)),
    ("unknown profile", Library("rmw_qos_profile_unknown"), UNKNOWN, ("the profile leaves it unknown", None)),
)


@pytest.mark.parametrize(("value", "expected", "why"), [case[1:] for case in OPEN], ids=[case[0] for case in OPEN])
def test_unknown(value: Value, expected: Qos, why: tuple[str, Location | None]) -> None:
    assert qos_of(value) == (expected, why)


@pytest.mark.parametrize("name", PROFILES)
def test_presets_are_fresh_and_stand_for_their_profile(name: str) -> None:
    one, other = preset(name), preset(name)
    assert one is not None and other is not None and one is not other
    assert qos_of(one)[0] == PROFILES[name]
    one.fields["depth"].value = Known(77)
    assert qos_of(one)[0].depth == 77
    assert qos_of(other)[0] == PROFILES[name]


@pytest.mark.parametrize("name", ("rmw_qos_profile_mine", "qos_profile_sensor_data", "rclcpp::QoS", "", "default"))
def test_no_presets(name: str) -> None:
    assert preset(name) is None


OVERRIDES: tuple[tuple[dict[str, Any], Qos], ...] = (
    ({}, DEFAULT),
    ({"depth": 3}, qos(depth=3)),
    ({"depth": Known(3)}, qos(depth=3)),
    (
        {"reliability": "best_effort", "durability": "transient_local"},
        qos(reliability="best_effort", durability="transient_local"),
    ),
    ({"history": "keep_all"}, qos(history="keep_all", depth=None)),
    ({"reliability": "system_default"}, qos(reliability=None)),
    ({"deadline": 100_000_000}, qos(deadline=0.1)),
    ({"liveliness_lease_duration": 1_000_000_000}, qos(lease=1.0)),
    ({"reliability": UNTOLD}, qos(reliability="?")),
    ({"reliability": "often"}, qos(reliability="?")),
    ({"depth": "many"}, qos(depth="?")),
    ({"avoid_ros_namespace_conventions": True}, DEFAULT),
)


@pytest.mark.parametrize(("rules", "expected"), OVERRIDES)
def test_overridden(rules: dict[str, Any], expected: Qos) -> None:
    assert overridden(DEFAULT, rules) == expected


KIND = "rclcpp::QosPolicyKind::"


def _kinds(*names: str) -> Sequence:
    return Sequence(Cell(tuple(Cell(Library(KIND + name)) for name in names)))


POLICIES: tuple[tuple[str, Value | None, tuple[str, ...] | None], ...] = (
    ("no options", None, ()),
    ("none", Known(None), ()),
    ("options without", Object("rclcpp::PublisherOptions"), ()),
    ("names", Known("depth,history"), ("depth", "history")),
    ("list", thing("rclcpp::QosOverridingOptions", policies=_kinds("Depth", "Reliability")), ("depth", "reliability")),
    (
        "lease",
        thing("rclcpp::QosOverridingOptions", policies=_kinds("LivelinessLeaseDuration")),
        ("liveliness_lease_duration",),
    ),
    (
        "inside of options",
        thing("rclcpp::SubscriptionOptions", qos_overriding_options=thing("", policies="history,depth,reliability")),
        ("history", "depth", "reliability"),
    ),
    ("options that are not known", UNTOLD, None),
    ("list that is not known", thing("rclcpp::QosOverridingOptions", policies=UNTOLD), None),
    ("other object", Object("my::Thing"), None),
)


@pytest.mark.parametrize(("value", "expected"), [case[1:] for case in POLICIES], ids=[case[0] for case in POLICIES])
def test_policies_that_may_be_overridden(value: Value | None, expected: tuple[str, ...] | None) -> None:
    assert override_policies(value) == expected


def test_id_of_overriding_options() -> None:
    assert override_id(None) == ""
    assert override_id(thing("rclcpp::QosOverridingOptions", id="left")) == "left"
    assert override_id(thing("rclcpp::PublisherOptions", qos_overriding_options=thing("", id="left"))) == "left"
    assert override_id(thing("rclcpp::QosOverridingOptions", id=UNTOLD)) is None
