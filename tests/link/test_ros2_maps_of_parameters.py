# SPDX-License-Identifier: Apache-2.0
"""``declare_parameters`` of rclcpp: a map of names and defaults, each perhaps with a descriptor, below a namespace (rclcpp/node.hpp)."""

from __future__ import annotations

from typing import Any

import pytest
from follow_kit import explicit
from ros2_cpp_kit import component, only

D = "rcl_interfaces::msg::ParameterDescriptor"
PAIRS = f"std::map<std::string, std::pair<double, {D}>>"
BEFORE = 'const int COUNT = 5;\nconst std::string NAME = "k";\n'


def declared(body: str) -> list[tuple[Any, ...]]:
    """Names, types and defaults of the parameters that the body declares."""
    return [
        (end.name.removeprefix("/n:"), end.type, end.value)
        for end in explicit(component(body, before=BEFORE), "parameters")
    ]


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ('declare_parameters<int>("p", {{"a", 1}, {"b", 2}});', [("p.a", "int", 1), ("p.b", "int", 2)]),
        ('declare_parameters<int>("", {{"a", 1}});', [("a", "int", 1)]),
        ('declare_parameters<std::string>("p", {{"a", ""}, {"b", "x"}});', [("p.a", "str", ""), ("p.b", "str", "x")]),
        ('declare_parameters<bool>("p", {{"a", true}});', [("p.a", "bool", True)]),
        ('declare_parameters<float>("p", {{"a", 0.5f}, {"b", 2}});', [("p.a", "double", 0.5), ("p.b", "double", 2.0)]),
        ('declare_parameters<int64_t>("p", {{"a", COUNT}, {NAME, -2}});', [("p.a", "int", 5), ("p.k", "int", -2)]),
        ('declare_parameters<std::vector<double>>("p", {{"a", {1, 2}}});', [("p.a", "double[]", [1.0, 2.0])]),
        ('declare_parameters<std::vector<double>>("p", {{"a", {}}});', [("p.a", "double[]", [])]),
        ('declare_parameters<int>("p", {{"a", {}}});', [("p.a", "int", 0)]),
        (
            'declare_parameters("p", std::map<std::string, int>{{"a", 1}, {"b", 2}});',
            [("p.a", "int", 1), ("p.b", "int", 2)],
        ),
        ('declare_parameters("p", std::map<std::string, int>({{"a", 1}}));', [("p.a", "int", 1)]),
        ('std::map<std::string, double> m{{"a", 1}}; declare_parameters("p", m);', [("p.a", "double", 1.0)]),
        ('std::map<std::string, double> m({{"a", 1}}); declare_parameters("p", m);', [("p.a", "double", 1.0)]),
        ('std::map<std::string, int> m; m["a"] = 1; declare_parameters<int>("p", m);', [("p.a", "int", 1)]),
        (
            'std::map<std::string, int> m{std::make_pair("a", 1), std::make_pair("b", 2)}; declare_parameters("p", m);',
            [("p.a", "int", 1), ("p.b", "int", 2)],
        ),
        (f'declare_parameters<double>("p", {{{{"a", {{1, {D}()}}}}}});', [("p.a", "double", 1.0)]),
        (f'{PAIRS} m; m["a"] = {{1, {D}()}}; declare_parameters("p", m);', [("p.a", "double", 1.0)]),
        (f'{PAIRS} m; m["a"] = std::make_pair(2, {D}()); declare_parameters("p", m);', [("p.a", "double", 2.0)]),
        (f'{PAIRS} m{{{{"a", {{1.5, {D}()}}}}}}; declare_parameters<double>("p", m);', [("p.a", "double", 1.5)]),
        ('declare_parameters<double>("p", {{"a", {2, described()}}});', [("p.a", "double", 2.0)]),
        (
            'declare_parameters<std::vector<double>>("p", {{"a", {{1, 2}, described()}}});',
            [("p.a", "double[]", [1.0, 2.0])],
        ),
        ('declare_parameters<int>("p", {});', []),
        # what is not known
        ('declare_parameters<int>(f(), {{"a", 1}});', [("?.a", "int", 1)]),
        ('declare_parameters<int>("p", {{f(), 1}, {"b", 2}});', [("p.?", "int", 1), ("p.b", "int", 2)]),
        ('declare_parameters<int>("p", {{"a", f()}});', [("p.a", "int", None)]),
        ('std::map<std::string, double> m = f(); declare_parameters("p", m);', []),
        ('std::map<std::string, double> m{{f(), 1}}; declare_parameters("p", m);', []),
        ('declare_parameters("p", std::map<std::string, int>(from(), to()));', []),
        ('declare_parameters("p", std::map<std::string, int, Less>{{{"a", 1}}, less()});', []),
    ],
)
def test_maps_of_parameters(body: str, expected: list[tuple[Any, ...]]) -> None:
    assert declared(body) == expected


def test_descriptors_of_a_map() -> None:
    body = f'{D} d; d.read_only = true; declare_parameters<int>("p", {{{{"a", {{1, d}}}}}});'
    assert only(component(body), "parameters").read_only


@pytest.mark.parametrize(
    "body",
    [
        'declare_parameters<double>("p", {{"a", {2, described()}}});',
        'declare_parameters<std::vector<double>>("p", {{"a", {{1, 2}, described()}}});',
        f'{PAIRS} m; m["a"] = std::make_pair(2, described()); declare_parameters("p", m);',
    ],
)
def test_a_descriptor_that_is_not_known(body: str) -> None:
    assert only(component(body), "parameters").read_only is None


def test_what_is_read_of_a_map() -> None:
    body = 'declare_parameters<std::string>("p", {{"a", "scan"}}); create_publisher<String>(get_parameter("p.a").as_string(), 1);'
    assert only(component(body)).name == "/scan"


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ('std::map<std::string, double> m = f(); declare_parameters("p", m);', True),
        ('std::map<std::string, double> m{{f(), 1}}; declare_parameters("p", m);', True),
        ('declare_parameters<int>("p", {{"a", 1}});', False),
        ('declare_parameters<int>("p", {});', False),
        ('std::map<std::string, double> m; declare_parameters("p", m);', False),
    ],
)
def test_a_map_that_is_not_known_is_named(body: str, expected: bool) -> None:
    reasons = [why.reason for why in component(body).unknowns]
    assert any("a map of parameters is not known" in reason for reason in reasons) is expected
