# SPDX-License-Identifier: Apache-2.0
"""C++: what ``if constexpr`` asks of types is decided where they are known ([stmt.if], <type_traits>)."""

from __future__ import annotations

import pytest

from tests.link.follow_kit import cpp

BODY = 'if constexpr (%s) { ADV(std::string("yes"), 1); } else { ADV(std::string("no"), 1); }'
BEFORE = (
    "namespace inner { struct A {}; struct B {}; }\ntemplate <class T, class U = int> void f(ros::NodeHandle & nh) { "
    + BODY
    + " }\n"
)


def ruled_out(test: str, call: str) -> list[str]:
    """The names of what is not made."""
    return [end.name for end in cpp(call, BEFORE % test).endpoints if end.is_ruled_out]


@pytest.mark.parametrize(
    ("test", "types", "answer"),
    [
        ("std::is_same_v<T, int>", "int", True),
        ("std::is_same_v<T, int>", "float", False),
        ("std::is_same<T, float>::value", "float", True),
        ("std::is_same<T, float>::value", "std::string", False),
        ("std::is_same_v<std::decay_t<T>, inner::A>", "inner::A", True),
        ("std::is_same_v<T, inner::A>", "inner::B", False),
        ("std::is_same_v<T, sensor_msgs::Image>", "sensor_msgs::Imu", False),
        ("std::is_same_v<T, U>", "bool, bool", True),
        ("!std::is_same_v<T, int>", "int", False),
        ("std::is_same_v<T, int> || std::is_same_v<T, bool>", "bool", True),
        ("std::is_integral_v<T>", "int", True),
        ("std::is_floating_point_v<T>", "int", False),
        ("std::is_arithmetic<T>::value", "std::string", False),
        ("std::is_integral_v<T>", "sensor_msgs::msg::Image", False),
    ],
)
def test_it_is_decided(test: str, types: str, answer: bool) -> None:
    assert ruled_out(test, f"f<{types}>(nh);") == ["/no" if answer else "/yes"]


@pytest.mark.parametrize(
    ("test", "types"),
    [
        ("std::is_same_v<T, int>", "int32_t"),
        ("std::is_same_v<T, long>", "int"),
        ("std::is_same_v<T, Unknown>", "int"),
        ("std::is_same_v<T, int>", "Unknown"),
        ("std::is_same_v<T, int>", "decltype(nh)"),
        ("std::is_same_v<T, std::vector<int>>", "std::vector<float>"),
        ("std::is_base_of_v<T, inner::A>", "inner::B"),
        ("other::is_same_v<T, int>", "float"),
        ("std::is_integral_v<T>", "Unknown"),
        ("std::is_same_v<T, int *>", "int"),
        ("std::is_integral_v<T>", "Eigen::Index"),
        ("std::is_same_v<T, long>", "Eigen::Index"),
        ("std::is_same_v<T, other::A>", "another::A"),
    ],
)
def test_it_is_not_decided(test: str, types: str) -> None:
    assert ruled_out(test, f"f<{types}>(nh);") == []
