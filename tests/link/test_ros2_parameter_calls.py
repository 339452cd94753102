# SPDX-License-Identifier: Apache-2.0
"""ROS 2 parameters: calls that fail without a value or a declaration, types that may change, nodes that may have others."""

from __future__ import annotations

import pytest
from ros2_cpp_kit import component, explicit


@pytest.mark.parametrize(
    ("body", "kind"),
    (
        ('declare_parameter<double>("a");', "parameters"),
        ('declare_parameter<double>("a", rcl_interfaces::msg::ParameterDescriptor());', "parameters"),
        ('auto v = get_parameter("a").as_double();', "getters"),
    ),
)
def test_calls_that_fail(body: str, kind: str) -> None:
    assert [end.is_strict for end in explicit(component(body), kind)] == [True]


@pytest.mark.parametrize(
    ("body", "kind"),
    (
        ('declare_parameter("a", 1.0);', "parameters"),
        ('declare_parameter("a", rclcpp::PARAMETER_DOUBLE);', "parameters"),
        ('declare_parameter("a", rclcpp::ParameterValue(1));', "parameters"),
        ('double v; get_parameter("a", v);', "getters"),
        ('double v; get_parameter_or("a", v, 1.0);', "getters"),
        ('try { get_parameter("a"); } catch (const std::exception &) {}', "getters"),
        ('try { declare_parameter<double>("a"); } catch (...) {}', "parameters"),
        ('if (false) { get_parameter("a"); }', "getters"),
    ),
)
def test_calls_that_do_not_fail(body: str, kind: str) -> None:
    assert [end.is_strict for end in explicit(component(body), kind)] == [False]


@pytest.mark.parametrize(
    ("body", "expected"),
    (
        ("d.dynamic_typing = true;", True),
        ("d.dynamic_typing = unknown();", True),
        ("d.set__dynamic_typing(true);", True),
        ("", False),
        ("d.read_only = true;", False),
        ("d.dynamic_typing = false;", False),
    ),
)
def test_types_that_may_change(body: str, expected: bool) -> None:
    made = f'rcl_interfaces::msg::ParameterDescriptor d; {body} declare_parameter("a", 1.0, d);'
    assert [end.is_dynamic for end in explicit(component(made), "parameters")] == [expected]


@pytest.mark.parametrize(
    ("body", "expected"),
    (
        ("arm::Arm a(this);", True),
        ("arm::set_up(shared_from_this(), 1);", True),
        ("auto a = std::make_shared<arm::Arm>(this);", True),
        ("auto a = arm::Arm(*this).get();", True),
        ("", False),
        ("rclcpp::TimeSource s(shared_from_this());", False),
        ("tf2_ros::TransformBroadcaster b(this);", False),
        ("arm::Arm a(1);", False),
        ('auto p = create_publisher<std_msgs::msg::String>("a", 1); arm::Arm a(p);', False),
    ),
)
def test_nodes_that_are_handed_to_what_is_not_seen(body: str, expected: bool) -> None:
    assert component(body).takes_undeclared is expected


def test_constants_of_messages_that_are_names() -> None:
    (end,) = explicit(
        component("declare_parameter(bond::msg::Constants::DISABLE_HEARTBEAT_TIMEOUT_PARAM, true);"), "parameters"
    )
    assert end.name == "/n:bond_disable_heartbeat_timeout"


@pytest.mark.parametrize(
    ("body", "names"),
    (
        ('create_publisher<std_msgs::msg::String>(has_parameter("use_sim_time") ? "sim" : "real", 1);', ["/sim"]),
        (
            'bool sim = get_parameter("use_sim_time").as_bool(); if (!sim) { create_publisher<std_msgs::msg::String>("a", 1); }',
            ["/a"],
        ),
        ('if (has_parameter("use_sim_time")) { create_publisher<std_msgs::msg::String>("a", 1); }', ["/a"]),
    ),
)
def test_every_node_has_the_parameter_use_sim_time(body: str, names: list[str]) -> None:
    """TimeSource declares it in each node, with false where it is not given (rclcpp/time_source.cpp)."""
    ends = explicit(component(body), "publishers")
    assert [(end.name, end.is_ruled_out) for end in ends] == [(name, False) for name in names]


@pytest.mark.parametrize("name", ("qos_overrides./a.publisher.depth", "start_type_description_service"))
def test_parameters_that_a_node_may_have_by_itself(name: str) -> None:
    body = f'if (has_parameter("{name}")) {{ create_publisher<std_msgs::msg::String>("a", 1); }}'
    (end,) = explicit(component(body), "publishers")
    assert not end.is_ruled_out
