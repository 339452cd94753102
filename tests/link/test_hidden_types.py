# SPDX-License-Identifier: Apache-2.0
"""Parameters of a type that is another name of one which nothing tells: neither a literal nor what it holds decides."""

from __future__ import annotations

import pytest
from follow_kit import cpp
from ros2_cpp_kit import component, explicit

BEFORE = """using Own = double; typedef std::string Text;
template <class T> void get(ros::NodeHandle nh) { T t; nh.param<T>("x", t, 3); }
template <class T> void take(ros::NodeHandle nh, T d) { T t; nh.param<T>("x", t, d); }
"""
HIDDEN = (
    'nh.param<Scalar>("x", v, 4);',
    'nh.param<lib::Scalar>("x", v, 4);',
    'nh.param<Matrix::Scalar>("x", m[0], 4789373);',
    'nh.param<Scalar>("x", v, std::string("a"));',
    'auto y = nh.param<Scalar>("x", 4);',
    'ros::param::param<Scalar>("x", v, 4);',
    'Scalar s = 3; nh.getParam("x", s);',
    'Scalar s; nh.getParam("x", s);',
    'const Scalar s = 3; nh.setParam("x", s);',
)
TOLD = {
    'double w; nh.param<double>("x", w, 4);': "double",
    'nh.param<float>("x", v, 4);': "double",
    'nh.param<Own>("x", v, 4);': "double",
    'nh.param<Text>("x", v, "4");': "str",
    'nh.param<std::size_t>("x", v, 4);': "int",
    'nh.param<long int>("x", v, 4);': "int",
    'nh.param<decltype(v)>("x", v, 4);': "int",
    'nh.param<std::vector<Scalar>>("x", v, {4});': "yaml",
    'int v; nh.param("x", v, 4);': "int",
    'auto z = 3; nh.param("x", z, 3);': "int",
    'Scalar s; nh.param("x", s, 4.5);': "double",
    'nh.param("x", list[0], 4);': "int",
    "get<int>(nh);": "int",
    "take(nh, 3);": "int",
}
HIDDEN_2 = (
    'declare_parameter<Scalar>("x", 4);',
    'declare_parameter<lib::Scalar>("x", 4.5);',
    'declare_parameter<std::vector<Scalar>>("x", {1, 2});',
    'const Scalar s = 3; declare_parameter("x", s);',
)
TOLD_2 = {
    'declare_parameter<double>("x", 4);': "double",
    'declare_parameter<std::vector<double>>("x", {1, 2});': "double[]",
    'declare_parameter<std::vector<uint8_t>>("x", {1, 2});': "bytes",
    'declare_parameter("x", rclcpp::ParameterValue(4));': "int",
    'declare_parameter<rclcpp::ParameterValue>("x", rclcpp::ParameterValue(4));': "int",
    'const auto s = 3; declare_parameter("x", s);': "int",
}


@pytest.mark.parametrize(("call", "kind"), [*((call, None) for call in HIDDEN), *TOLD.items()])
def test_ros1(call: str, kind: str | None) -> None:
    (found,) = (end for end in cpp(call, BEFORE).endpoints if end.name == "/x")
    assert found.type == kind
    assert ("type" in {unknown.field for unknown in found.unknowns}) == (kind is None)


@pytest.mark.parametrize(("call", "kind"), [*((call, None) for call in HIDDEN_2), *TOLD_2.items()])
def test_ros2(call: str, kind: str | None) -> None:
    (found,) = explicit(component(call), "parameters")
    assert found.type == kind
    assert ("type" in {unknown.field for unknown in found.unknowns}) == (kind is None)


def test_what_a_variable_of_such_a_type_reads() -> None:
    body = 'Scalar s = 4; get_parameter_or<Scalar>("x", s, 4); get_parameter("x", s);'
    found = explicit(component(body), "getters")
    assert {end.type for end in found} == {None}
