# SPDX-License-Identifier: Apache-2.0
"""ROS 2 C++: quality of service in all the forms that code has for it."""

from __future__ import annotations

from typing import Any

import pytest
from follow_kit import explicit, ros2_cpp
from ros2_cpp_kit import BEST, KEPT, PUB, component, last, only, policies

from haros_ci.model.architecture import Qos

#: An expression, and what it stands for.
FORMS: tuple[tuple[str, tuple[Any, ...]], ...] = (
    ("10", last(10)),
    ("rclcpp::QoS(3)", last(3)),
    ("rclcpp::QoS{3}", last(3)),
    ("{3}", last(3)),
    ("rclcpp::KeepLast(4)", last(4)),
    ("rclcpp::QoS(rclcpp::KeepLast(4))", last(4)),
    ("rclcpp::QoS{rclcpp::KeepLast{4}}.best_effort()", last(4, BEST)),
    ("rclcpp::QoS(rclcpp::KeepAll())", ("keep_all", None, "reliable", "volatile")),
    ("rclcpp::QoS(1).keep_all().transient_local()", ("keep_all", None, "reliable", KEPT)),
    ("rclcpp::QoS(1).keep_last(6)", last(6)),
    ("rclcpp::QoS(1).best_effort().reliable()", last(1)),
    ("rclcpp::QoS(1).transient_local().durability_volatile()", last(1)),
    ("rclcpp::QoS(1).reliability(rclcpp::ReliabilityPolicy::BestEffort)", last(1, BEST)),
    ("rclcpp::QoS(1).reliability(RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT)", last(1, BEST)),
    ("rclcpp::QoS(1).durability(rclcpp::DurabilityPolicy::TransientLocal)", last(1, "reliable", KEPT)),
    ("rclcpp::QoS(1).history(rclcpp::HistoryPolicy::KeepAll)", ("keep_all", None, "reliable", "volatile")),
    ("rclcpp::QoS(1).reliability_best_available()", last(1, "best_available")),
    ("rclcpp::QoS(1).avoid_ros_namespace_conventions(true).best_effort()", last(1, BEST)),
    ("rclcpp::SensorDataQoS()", last(5, BEST)),
    ("rclcpp::SensorDataQoS().keep_last(1)", last(1, BEST)),
    ("rclcpp::SensorDataQoS(rclcpp::KeepLast(2))", last(2, BEST)),
    ("rclcpp::SystemDefaultsQoS()", (None, None, None, None)),
    ("rclcpp::SystemDefaultsQoS().keep_last(2)", ("keep_last", 2, None, None)),
    ("rclcpp::ParameterEventsQoS()", last(1000)),
    ("rclcpp::ServicesQoS()", last(10)),
    ("rclcpp::ClockQoS()", last(1, BEST)),
    ("rclcpp::RosoutQoS()", last(1000, "reliable", KEPT)),
    ("rclcpp::QoS(rclcpp::QoSInitialization::from_rmw(rmw_qos_profile_sensor_data))", last(5)),
    (
        "rclcpp::QoS(rclcpp::QoSInitialization::from_rmw(rmw_qos_profile_sensor_data), rmw_qos_profile_sensor_data)",
        last(5, BEST),
    ),
    ("rclcpp::QoS(rclcpp::QoSInitialization(RMW_QOS_POLICY_HISTORY_KEEP_LAST, 8))", last(8)),
    ("rclcpp::QoS(rclcpp::KeepLast(2), rmw_qos_profile_sensor_data)", last(2, BEST)),
    ("nav2::qos::LatchedPublisherQoS()", last(1, "reliable", KEPT)),
    ("nav2::qos::SensorDataQoS()", last(10, BEST)),
    ("tf2_ros::StaticListenerQoS()", last(100, "reliable", KEPT)),
    ('rclcpp::QoS(declare_parameter<int>("depth", 9))', last(9)),
)


@pytest.mark.parametrize(("expression", "expected"), FORMS)
def test_quality_of_service(expression: str, expected: tuple[Any, ...]) -> None:
    end = only(component(f'p_ = {PUB}("a", {expression});'))
    assert policies(end) == expected
    assert end.unknowns == ()


#: Statements that make ``q``, and what it stands for.
STATEMENTS: tuple[tuple[str, tuple[Any, ...]], ...] = (
    ("rclcpp::QoS q(1); q.transient_local();", last(1, "reliable", KEPT)),
    ("auto q = rclcpp::QoS(1); q.transient_local().best_effort();", last(1, BEST, KEPT)),
    ("rclcpp::QoS q = rclcpp::SensorDataQoS();", last(5, BEST)),
    ("rclcpp::QoS o(1); auto q = o; o.best_effort();", last(1)),
    ("auto o = rclcpp::QoS(1); auto q = o; o.best_effort();", last(1)),
    ("auto o = rclcpp::QoS(1).best_effort(); auto q = o; o.transient_local();", last(1, BEST)),
    ("auto o = rclcpp::QoS(1); auto q = o.best_effort(); o.transient_local();", last(1, BEST)),
    ("auto q = rclcpp::QoS(1); auto o = q.keep_last(4); o.best_effort();", last(4)),
    ("auto o = rclcpp::QoS(1); auto & q = o; o.best_effort();", last(1, BEST)),
    ("auto o = std::make_shared<rclcpp::QoS>(1); auto p = o; p->best_effort(); rclcpp::QoS q(*o);", last(1, BEST)),
    ("rclcpp::QoS o(1); rclcpp::QoS q(o); o.best_effort();", last(1)),
    ("rclcpp::QoS o(1); auto & q = o; o.best_effort();", last(1, BEST)),
    ("rclcpp::QoS q(1); q.get_rmw_qos_profile().depth = 7;", last(7)),
    (
        (
            "rmw_qos_profile_t p = rmw_qos_profile_sensor_data; p.depth = 3;"
            "rclcpp::QoS q(rclcpp::QoSInitialization::from_rmw(p), p);"
        ),
        last(3, BEST),
    ),
    (
        (
            "rmw_qos_profile_t p = rmw_qos_profile_default; p.reliability = RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT;"
            "rmw_qos_profile_t o = rmw_qos_profile_default; rclcpp::QoS q(rclcpp::QoSInitialization::from_rmw(o), o);"
        ),
        last(10),
    ),
    ("rclcpp::QoS q(1); if (true) { q.best_effort(); }", last(1, BEST)),
)


@pytest.mark.parametrize(("statements", "expected"), STATEMENTS)
def test_quality_of_service_of_variables(statements: str, expected: tuple[Any, ...]) -> None:
    assert policies(only(component(f'{statements} p_ = {PUB}("a", q);'))) == expected


OPEN = (
    ("rclcpp::QoS q(1); if (get_clock()->now().seconds() > 1) { q.best_effort(); }", last(1, "?")),
    ("auto q = make_qos();", ("?", "?", "?", "?")),
    ("rclcpp::QoS q(depth_from_file());", ("?", "?", "?", "?")),
    ("rclcpp::QoS q(1); q.keep_last(depth_from_file());", last("?")),
    ("rclcpp::QoS q(1); q.reliability(policy_from_file());", last(1, "?")),
)


@pytest.mark.parametrize(("statements", "expected"), OPEN)
def test_unknown_policies(statements: str, expected: tuple[Any, ...]) -> None:
    end = only(component(f'{statements} p_ = {PUB}("a", q);'))
    assert policies(end) == expected
    assert [unknown.field for unknown in end.unknowns] == ["qos"]
    assert all(unknown.reason for unknown in end.unknowns)


@pytest.mark.parametrize(
    ("chain", "expected"),
    (
        ("deadline(100ms)", {"deadline": 0.1}),
        ("deadline(std::chrono::milliseconds(250))", {"deadline": 0.25}),
        ("deadline(rclcpp::Duration(1, 500000000))", {"deadline": 1.5}),
        ("deadline(rclcpp::Duration::from_seconds(0.5))", {"deadline": 0.5}),
        ("deadline(rclcpp::Duration(2s))", {"deadline": 2.0}),
        ("lifespan(std::chrono::seconds(3))", {"lifespan": 3.0}),
        ("liveliness(rclcpp::LivelinessPolicy::ManualByTopic)", {"liveliness": "manual_by_topic"}),
        (
            "liveliness(RMW_QOS_POLICY_LIVELINESS_AUTOMATIC).liveliness_lease_duration(1s)",
            {"liveliness": "automatic", "lease": 1.0},
        ),
    ),
)
def test_times(chain: str, expected: dict[str, Any]) -> None:
    end = only(component(f'p_ = {PUB}("a", rclcpp::QoS(1).{chain});'))
    assert end.qos == Qos(history="keep_last", depth=1, reliability="reliable", durability="volatile", **expected)
    assert end.unknowns == ()


CRYSTAL = (
    ('create_publisher<String>("a");', "publishers", "keep_last 10 reliable"),
    ('create_publisher<String>("a", rmw_qos_profile_sensor_data);', "publishers", "keep_last 5 best_effort"),
    ('create_subscription<String>("a", [this](String::SharedPtr m) { });', "subscribers", "keep_last 10 reliable"),
    (
        'create_subscription<String>("a", std::bind(&N::cb, this, std::placeholders::_1));',
        "subscribers",
        "keep_last 10 reliable",
    ),
    (
        'create_subscription<String>("a", std::bind(&N::cb, this, std::placeholders::_1), rmw_qos_profile_sensor_data);',
        "subscribers",
        "keep_last 5 best_effort",
    ),
    (
        'create_subscription<String>("a", 5, std::bind(&N::cb, this, std::placeholders::_1));',
        "subscribers",
        "keep_last 5 reliable",
    ),
    ('create_subscription<String>("a", f(), std::bind(&N::cb, this, std::placeholders::_1));', "subscribers", "? ? ?"),
)


@pytest.mark.parametrize(("code", "kind", "expected"), CRYSTAL)
def test_without_a_quality_of_service_or_with_it_last(code: str, kind: str, expected: str) -> None:
    """As rclcpp up to Crystal has it."""
    (made,) = ros2_cpp(code, "void cb(String::SharedPtr m) { }").nodes
    (end,) = explicit(made, kind)
    assert end.qos is not None
    assert (end.name, f"{end.qos.history} {end.qos.depth} {end.qos.reliability}") == ("/a", expected)
