# SPDX-License-Identifier: Apache-2.0
"""Remapping rules keep the places they stand at, and have the full names of the node that they are for."""

from __future__ import annotations

import pytest
from follow_kit import ROS2_HEAD, ROS2_NODE, follow, ros2_files

from haros_ci.model.architecture import Configuration, RemapRule

PUB = 'auto p = create_publisher<String>("t", 1);'


def launched(text: str, name: str = "l.launch.xml", ros: int = 2) -> Configuration:
    files = ros2_files(ROS2_HEAD + ROS2_NODE % (PUB, ""), {name: text})
    return next(each for each in follow(files, ros).configurations if each.launch)


def rules(text: str, name: str = "l.launch.xml", number: int = 0) -> tuple[RemapRule, ...]:
    return launched(text, name).nodes[number].rules


def short(found: tuple[RemapRule, ...]) -> list[tuple[str | None, str | None, int | None, int | None]]:
    return [(each.source_name, each.target_name, each.location.line, each.location.column) for each in found]


def test_a_rule_stands_where_its_tag_does() -> None:
    text = (
        '<launch>\n<node pkg="p" exec="n" name="m" namespace="/r">\n <remap from="t" to="u"/>\n'
        ' <remap from="~/x" to="/y"/>\n</node></launch>'
    )
    found = rules(text)
    assert short(found) == [("/r/t", "/r/u", 3, 2), ("/r/m/x", "/y", 4, 2)]
    assert [(each.source, each.target, each.is_global) for each in found] == [
        ("t", "u", False),
        ("~/x", "/y", False),
    ]


def test_rules_of_python_stand_at_their_pairs() -> None:
    text = (
        "from launch import LaunchDescription\nfrom launch_ros.actions import Node, SetRemap\n"
        "def generate_launch_description():\n  return LaunchDescription([\n"
        "    SetRemap('t', 'v'),\n"
        "    Node(package='p', executable='n', name='m',\n      remappings=[('a', 'b'),\n        ('c', '/d')])])\n"
    )
    found = rules(text, "l.launch.py")
    assert short(found) == [("/t", "/v", 5, 5), ("/a", "/b", 7, 19), ("/c", "/d", 8, 9)]
    assert [each.is_global for each in found] == [True, False, False]


def test_rules_of_arguments_stand_at_the_node() -> None:
    text = (
        '<launch>\n<node pkg="p" exec="n" name="m" args="--ros-args -r t:=u -r __ns:=/q -r other:x:=y"/>\n'
        '<node pkg="p" exec="n" name="k" ros_args="-r k:x:=y"/></launch>'
    )
    found = launched(text)
    assert [short(each.rules) for each in found.nodes] == [[("/q/t", "/q/u", 2, 1)], [("/x", "/y", 3, 1)]]


def test_an_undecided_rule_says_what_is_written() -> None:
    text = (
        '<launch><arg name="a"/><group if="$(var a)"><set_remap from="t" to="u"/></group>'
        '<group scoped="false" if="$(var a)"><set_remap from="t" to="w"/></group>'
        '<node pkg="p" exec="n" name="m"/></launch>'
    )
    found = rules(text)
    assert [(each.target_name, [one.condition for one in each.conditions]) for each in found] == [("/w", ["$(var a)"])]


def test_unknown_parts_have_no_full_name() -> None:
    text = '<launch><arg name="a"/><node pkg="p" exec="n" name="m"><remap from="$(var a)" to="u"/></node></launch>'
    assert [(each.source, each.source_name, each.target_name) for each in rules(text)] == [("?", None, "/u")]
    assert rules('<launch><node pkg="p" exec="n" name="m"/></launch>') == ()


def test_a_node_of_elsewhere_has_rules_too() -> None:
    found = launched(
        '<launch><node pkg="else" exec="x" name="m" namespace="q"><remap from="t" to="u"/></node></launch>'
    )
    assert short(found.nodes[0].rules) == [("/q/t", "/q/u", 1, 58)]


def test_ros1_rules() -> None:
    text = (
        '<launch>\n<arg name="a"/><remap from="all" to="every"/>\n'
        '<node pkg="p" type="n" name="m" ns="r" args="x:=y _p:=1">\n'
        '  <remap from="~in" to="/out"/>\n  <remap from="c" to="d" if="$(arg a)"/></node></launch>'
    )
    found = launched(text, "l.launch", ros=1).nodes[0].rules
    assert short(found) == [
        ("/r/all", "/r/every", 2, 16),
        ("/r/m/in", "/out", 4, 3),
        ("/r/c", "/r/d", 5, 3),
        ("/r/x", "/r/y", 3, 1),
    ]
    assert [each.is_global for each in found] == [True, False, False, False]
    assert [bool(each.conditions) for each in found] == [False, False, True, False]
    assert found[2].target == "d"


def test_the_order_is_that_in_which_rules_apply() -> None:
    text = (
        '<launch><set_remap from="t" to="first"/><node pkg="p" exec="n" name="m"><remap from="t" to="second"/></node>'
        "</launch>"
    )
    found = launched(text)
    assert [each.target_name for each in found.nodes[0].rules] == ["/first", "/second"]
    assert dict(found.nodes[0].remaps) == {"/t": "/first"}


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        ("t:=u", "/u"),
        ("m:t:=u", "/u"),
        ("/t:=/a/u", "/a/u"),
        ("rostopic://t:=u", "/u"),
        ("-x t:=u --ros-args", "/u"),
        ("other:t:=u", "/t"),
        ("rosservice://t:=u", "/t"),
        ("t:=1u", "/t"),
        ("t:=", "/t"),
        ("-t:=u", "/t"),
        ("t:=a//u", "/t"),
        ("t:=u v:=2.5", "/u"),
        ("--ros-args t:=u", "/t"),
        ("--ros-args -p a:=1 -- t:=u", "/u"),
    ],
)
def test_a_rule_among_the_arguments_of_the_program(arguments: str, expected: str) -> None:
    """rcl takes it (rcl_parse_arguments: "its deprecated form")."""
    (node,) = launched(f'<launch><node pkg="p" exec="n" name="m" args="{arguments}"/></launch>').nodes
    assert [end.name for end in node.endpoints if end.kind == "publishers" and not end.implicit] == [expected]
