# SPDX-License-Identifier: Apache-2.0
"""Nodes that other launch arguments start: followed like the others, and as they are under exactly these arguments."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import pytest
from follow_kit import ROS2_HEAD, ROS2_NODE, Nothing, cpp_files, main, names, ros2_files, workspace

from haros_ci.analysis.architecture import architecture, varied
from haros_ci.config.settings import Settings
from haros_ci.model.architecture import Configuration, Node
from haros_ci.model.presence import Choice, assignment, together
from haros_ci.report.model_json import render
from haros_ci.systems.link import Linked

BODY = 'auto t = declare_parameter<std::string>("topic", "plain");\npub_ = create_publisher<String>(t, 1);'
TEXT = ROS2_HEAD + ROS2_NODE % (BODY, "rclcpp::Publisher<String>::SharedPtr pub_;")
NODE = '<node pkg="p" exec="n" name="{}" namespace="/" {}>{}</node>'
PARAM = '<param name="topic" value="{}"/>'
ARGS = '<arg name="x" default="false"/><arg name="m" default="a"/>'
SETTINGS = Settings(root=Path("/nowhere"))


def ros2(body: str, launch: Mapping[str, str] | None = None) -> Linked:
    files = ros2_files(TEXT, {"l.launch.xml": f"<launch>{ARGS}{body}</launch>", **(launch or {})})
    return varied(workspace(files, 2), SETTINGS, Nothing(), environment={}, known_nodes=True)


def ros1(body: str) -> Linked:
    code = main('std::string t;\nros::param::param<std::string>("~topic", t, "plain");\nstatic auto p = ADV(t, 1);')
    files = cpp_files(code, f'<launch><arg name="x" default="false"/>{body}</launch>')
    return varied(workspace(files, 1), SETTINGS, Nothing(), environment={}, known_nodes=True)


def only(found: Linked) -> Configuration:
    return next(each for each in found.architecture.configurations if each.launch)


def topics(nodes: tuple[Node, ...]) -> dict[str, list[str]]:
    return {
        each.name: [name for name in names(each) if "/rosout" not in name and "event" not in name] for each in nodes
    }


def test_an_alternative_is_followed_with_its_own_parameters() -> None:
    found = ros2(NODE.format("a", "", PARAM.format("one")) + NODE.format("b", 'if="$(var x)"', PARAM.format("two")))
    made = only(found)
    assert topics(made.nodes) == {"/a": ["/one"]}
    assert topics(made.alternatives) == {"/b": ["/two"]}
    assert made.alternatives[0].presence == (Choice("x", "true"),)
    assert [(each.name, each.value, each.presence) for each in made.alternative_parameters] == [
        ("/b:topic", "two", (Choice("x", "true"),))
    ]
    assert "/b:topic" not in [each.name for each in made.parameters]


def test_a_component_is_in_the_container_that_can_be_there_with_it() -> None:
    container = '<node_container pkg="rclcpp_components" exec="component_container" name="c" namespace="/" {}>{}</node_container>'
    component = '<composable_node pkg="p" plugin="N" name="{}" namespace="/"/>'
    found = ros2(
        container.format('if="$(var x)"', component.format("a"))
        + container.format('unless="$(var x)"', component.format("b"))
    )
    made = only(found)
    assert {each.name: each.container for each in made.nodes} == {"/c": None, "/b": "/c"}
    assert {each.name: each.container for each in made.alternatives} == {"/c": None, "/a": "/c"}
    assert all(together(one.presence, other.presence) is None for one in made.nodes for other in made.alternatives)


def test_a_configuration_under_an_assignment_is_what_launch_starts_then() -> None:
    body = NODE.format("a", 'unless="$(var x)"', "") + NODE.format("b", 'if="$(var x)"', PARAM.format("$(var m)"))
    found = ros2(body)
    name = only(found).name
    chosen = assignment(only(found).alternatives[0].presence, dict(only(found).arguments))
    assert chosen == (("x", "true"),)
    other = found.under(name, dict(chosen))
    assert other is not None
    assert topics(other.nodes) == {"/b": ["/a"]}
    assert dict(other.arguments) == {"x": "true", "m": "a"}
    assert not other.alternatives
    more = found.under(name, {"x": "1", "m": "deep/er"})
    assert more is not None and topics(more.nodes) == {"/b": ["/deep/er"]}
    same = found.under(name, {})
    assert same is not None and same.nodes == tuple(plain(each) for each in only(found).nodes)


def plain(node: Node) -> Node:
    return replace(node, presence=())


def test_what_no_launch_file_starts_is_under_nothing() -> None:
    assert ros2(NODE.format("a", "", "")).under("nothing", {}) is None


def test_ros1() -> None:
    node = '<node pkg="p" type="n" name="{}" {}>{}</node>'
    found = ros1(
        node.format("a", "", '<param name="topic" value="one"/>')
        + node.format("b", 'if="$(arg x)"', '<param name="topic" value="two"/>')
    )
    made = only(found)
    assert topics(made.nodes) == {"/a": ["/one"]}
    assert topics(made.alternatives) == {"/b": ["/two"]}
    assert [(each.name, each.presence) for each in made.alternative_parameters] == [
        ("/b/topic", (Choice("x", "true"),))
    ]
    other = found.under(made.name, {"x": "true"})
    assert other is not None and topics(other.nodes) == {"/a": ["/one"], "/b": ["/two"]}


def test_ros1_parameters_of_an_alternative_are_those_that_can_be_set_with_it() -> None:
    node = '<node pkg="p" type="n" name="b" if="$(arg x)"/>'
    found = ros1(
        '<param name="/b/topic" value="off" unless="$(arg x)"/><param name="/b/topic" value="on" if="$(arg x)"/>' + node
    )
    assert topics(only(found).alternatives) == {"/b": ["/on"]}


@pytest.mark.parametrize(
    "body",
    [
        NODE.format("a", "", ""),
        NODE.format("a", 'if="$(var x)"', ""),
        NODE.format("a", "", "") + NODE.format("b", 'if="$(var x)"', PARAM.format("two")),
    ],
)
def test_the_model_of_the_default_arguments_is_the_same(body: str) -> None:
    files = ros2_files(TEXT, {"l.launch.xml": f"<launch>{ARGS}{body}</launch>"})
    plain_one = architecture(workspace(files, 2), SETTINGS, Nothing(), environment={}, known_nodes=True)
    assert json.loads(render(plain_one)) == json.loads(render(ros2(body).architecture))
    assert not any(each.alternatives for each in plain_one.configurations)
