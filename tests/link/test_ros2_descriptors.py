# SPDX-License-Identifier: Apache-2.0
"""Descriptors of declared parameters in the ways in which code writes them; parameters that are read undeclared."""

from __future__ import annotations

import pytest
from follow_kit import ROS2_HEAD, ROS2_NODE, explicit, follow, only, ros2_cpp, ros2_files

D = "rcl_interfaces::msg::ParameterDescriptor"
R = "rcl_interfaces::msg::IntegerRange r; r.from_value = 1; r.to_value = 5; r.step = 1;"
READ = 'std::string t; get_parameter_or("topic", t, std::string("alt")); create_publisher<String>(t, 1);'


@pytest.mark.parametrize(
    ("code", "read_only", "limits"),
    (
        (f'declare_parameter("p", 1, {D}());', False, None),
        (f'declare_parameter("p", 1, {D}{{}});', False, None),
        ('declare_parameter("p", 1, {});', False, None),
        ('declare_parameter("p", 1);', False, None),
        (f'auto d = {D}(); d.read_only = true; declare_parameter("p", 1, d);', True, None),
        (f'{D} d; d.set__read_only(true); declare_parameter("p", 1, d);', True, None),
        (f'auto d = {D}{{}}.set__read_only(true); declare_parameter<int>("p", d);', True, None),
        (f'{D} d; {R} d.integer_range.push_back(r); declare_parameter("p", 1, d);', False, (1.0, 5.0, 1.0)),
        (f'{D} d; {R} d.integer_range = {{r}}; declare_parameter("p", 1, d);', False, (1.0, 5.0, 1.0)),
    ),
)
def test_what_a_descriptor_says(code: str, read_only: bool, limits: object) -> None:
    (node,) = ros2_cpp(code).nodes
    (end,) = explicit(node, "parameters")
    assert (end.read_only, end.range, end.unknowns) == (read_only, limits, ())


@pytest.mark.parametrize(
    ("code", "fields"),
    (
        ('declare_parameter("p", 1, outside());', {"read_only", "range"}),
        (f'{D} d; if (outside()) d.read_only = true; declare_parameter("p", 1, d);', {"read_only"}),
        (f'{D} d; d.read_only = outside(); declare_parameter("p", 1, d);', {"read_only"}),
        (f'{D} d; d.integer_range = outside(); declare_parameter("p", 1, d);', {"range"}),
        (f'{D} d; d.integer_range.resize(1); declare_parameter("p", 1, d);', {"range"}),
    ),
)
def test_what_a_descriptor_may_say(code: str, fields: set[str]) -> None:
    (node,) = ros2_cpp(code).nodes
    (end,) = explicit(node, "parameters")
    assert {why.field for why in end.unknowns} == fields


def launched(body: str, inside: str) -> list[str]:
    launch = f'<launch><node pkg="p" exec="n">{inside}</node></launch>'
    files = ros2_files(ROS2_HEAD + ROS2_NODE % (body, ""), {"l.launch.xml": launch})
    (node,) = only(follow(files, 2)).nodes
    return [end.name for end in explicit(node)]


def test_a_parameter_that_is_read_undeclared_is_not_the_one_that_is_given() -> None:
    """rclcpp gives the alternative; whether code that is not seen has declared it is not known."""
    given = '<param name="topic" value="set"/>'
    assert launched(READ, "") == ["/alt"]
    assert launched(READ, given) == ["/?"]
    assert launched(f'declare_parameter("topic", "own"); {READ}', given) == ["/set"]
    assert launched(f'declare_parameter("topic", "own"); {READ}', "") == ["/own"]


def test_a_value_in_a_file_that_is_not_known_is_not_told() -> None:
    launch = '<launch><arg name="file"/><node pkg="p" exec="n"><param from="$(var file)"/></node></launch>'
    files = ros2_files(ROS2_HEAD + ROS2_NODE % ('declare_parameter("rate", 1);', ""), {"l.launch.xml": launch})
    (node,) = only(follow(files, 2)).nodes
    (end,) = explicit(node, "parameters")
    assert (end.value, end.effective, [why.field for why in end.unknowns]) == (1, None, ["effective"])
