# SPDX-License-Identifier: Apache-2.0
"""Which of several values of a parameter counts for a node that a launch file starts, as launch_ros and rcl have it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import pytest
from launching_kit import HERE, launch, perform

from haros_ci.model.launch import LaunchedNode
from haros_ci.model.launch_actions import Action, ParameterSource
from haros_ci.systems.ros2_system import started_by

FILE = "bot/p.yaml"
PATH = "$(find-pkg-share bot)/p.yaml"
FROM = f'<param from="{PATH}"/>'
ONE, TWO = '<param name="x" value="1"/>', '<param name="x" value="2"/>'
N5 = {FILE: "n: {ros__parameters: {x: 5}}\n"}
SLASH5 = {FILE: "/n: {ros__parameters: {x: 5}}\n"}
ALL5 = {FILE: "/**: {ros__parameters: {x: 5}}\n"}


def given(node: LaunchedNode, name: str) -> Any:
    return {key: rule.value for key, rule in started_by(node).parameters.of(name).items()}


def process(attributes: str, inner: str, files: Mapping[str, str], around: str = "{}") -> LaunchedNode:
    (found,) = launch(around.format(f'<node pkg="p" exec="e" {attributes}>{inner}</node>'), files).nodes
    return found


PUSHED = '<group><push-ros-namespace namespace="s"/>{}</group>'


@pytest.mark.parametrize(
    ("attributes", "inner", "files", "around", "node", "expected"),
    [
        # Without a namespace launch writes /** for a dictionary: a section of its own, before or after the file's.
        ('name="n"', ONE + FROM + TWO, N5, "{}", "/n", 5),
        ('name="n"', FROM + TWO, N5, "{}", "/n", 2),
        ('name="n"', ONE + FROM, ALL5, "{}", "/n", 5),
        ('name="n"', FROM + ONE, ALL5, "{}", "/n", 1),
        # With both it writes the full name: that of the file's section, if that begins with a slash too.
        ('name="n" namespace=""', ONE + FROM + TWO, SLASH5, "{}", "/n", 2),
        ('name="n" namespace=""', ONE + FROM + TWO, N5, "{}", "/n", 5),
        ('name="n" namespace="/"', ONE + FROM, ALL5, "{}", "/n", 5),
        ('name="n" namespace="/"', FROM + ONE, ALL5, "{}", "/n", 1),
        ('name="n" namespace="/"', ONE + FROM + TWO, ALL5, "{}", "/n", 5),
        ('name="n" namespace="s"', ONE, {}, "{}", "/s/n", 1),
        ('name="n" namespace="s"', ONE, {}, "{}", "/s/m", None),
        ('name="n"', ONE, {}, "{}", "/m", 1),
        ('namespace="s"', ONE, {}, "{}", "/s/m", 1),
        # What a group pushes makes the name full as well.
        ('name="n"', ONE, {}, PUSHED, "/s/n", 1),
        ('name="n"', ONE, {}, PUSHED, "/s/m", None),
        ('name="n" namespace="t"', ONE, {}, PUSHED, "/s/t/n", 1),
        ('name="n" namespace="/t"', ONE, {}, PUSHED, "/t/n", 1),
        ('name="n"', ONE + FROM + TWO, ALL5, PUSHED, "/s/n", 5),
        # What is set for all nodes is an argument, before all else, for whatever node.
        ('name="n" namespace="s"', "", {}, '<set_parameter name="x" value="7"/>{}', "/s/m", 7),
        ('name="n" namespace="s"', ONE, {}, '<set_parameter name="x" value="7"/>{}', "/s/n", 1),
        ('name="n"', FROM, ALL5, '<set_parameter name="x" value="7"/>{}', "/n", 5),
        # The command line's own arguments stand before the launch file's.
        ('name="n" args="--ros-args -p x:=3"', "", {}, "{}", "/n", 3),
        ('name="n" args="--ros-args -p x:=3"', ONE, {}, "{}", "/n", 1),
        ('name="n" ros_args="-p x:=3 -p x:=4"', "", {}, "{}", "/n", 4),
        ('name="n" ros_args="-p x:=3"', FROM, N5, "{}", "/n", 5),
        (f'name="n" ros_args="--params-file {PATH} -p x:=3"', "", ALL5, "{}", "/n", 3),
        (f'name="n" ros_args="-p x:=3 --params-file {PATH}"', "", ALL5, "{}", "/n", 5),
        (f'name="n" ros_args="-p x:=3 --params-file {PATH}"', "", N5, "{}", "/n", 5),
        # A node's name in an argument is a key as in a file: of the root namespace alone.
        ('ros_args="-p n:x:=3"', "", {}, "{}", "/n", 3),
        ('ros_args="-p n:x:=3"', "", {}, "{}", "/s/n", None),
    ],
)
def test_which_value_counts(
    attributes: str, inner: str, files: dict[str, str], around: str, node: str, expected: int | None
) -> None:
    found = given(process(attributes, inner, files, around), node)
    assert found == ({} if expected is None else {"x": expected})


def test_sections_of_one_node_in_two_spellings_are_in_the_order_of_the_first() -> None:
    yaml = "n: {ros__parameters: {x: 1}}\n/n: {ros__parameters: {x: 2}}\n"
    other = "n: {ros__parameters: {x: 3}}\n"
    inner = FROM + '<param from="$(find-pkg-share bot)/q.yaml"/>'
    assert given(process('name="n"', inner, {FILE: yaml, "bot/q.yaml": other}), "/n") == {"x": 2}


@pytest.mark.parametrize(
    ("inner", "yaml", "expected"),
    [
        (ONE + FROM + TWO, "/s/c: {ros__parameters: {x: 5}}\n", {"x": 2}),
        (ONE + FROM, "/s/c: {ros__parameters: {x: 5}}\n", {"x": 5}),
        (ONE + FROM, "/other: {ros__parameters: {x: 5}}\n", {"x": 1}),
        (FROM, "/s/c: {ros__parameters: {x: 5}}\n/**: {ros__parameters: {x: 6, y: 7}}\n", {"x": 5, "y": 7}),
        (FROM, "/**: {ros__parameters: {a: {b: 1}}}\n/s/c: {ros__parameters: {a: {c: 2}}}\n", {"a.c": 2}),
        (FROM, "/**/c: {ros__parameters: {x: 5}}\n", {}),
    ],
)
def test_which_value_counts_for_a_component(inner: str, yaml: str, expected: object) -> None:
    body = f'<composable_node pkg="p" plugin="C" name="c" namespace="s">{inner}</composable_node>'
    (found,) = launch(f'<load_composable_node target="k">{body}</load_composable_node>', {FILE: yaml}).nodes
    assert given(found, "/s/c") == expected


def test_a_component_whose_name_is_not_known_is_sent_an_unknown_section() -> None:
    body = f'<composable_node pkg="p" plugin="C" name="$(var u)">{FROM}</composable_node>'
    (found,) = launch(f'<load_composable_node target="k">{body}</load_composable_node>', N5).nodes
    assert [(rule.name, rule.value) for rule in found.parameters] == [("?", None)]


def test_a_parameter_object_is_an_argument_for_any_node() -> None:
    source = ParameterSource(kind="values", location=HERE, values=((("x",), 1),), argument=True)
    phrases = (("package", ("p",)), ("executable", ("e",)), ("name", ("n",)), ("namespace", ("/s",)))
    (found,) = perform(Action(kind="node", location=HERE, phrases=phrases, parameters=(source,))).nodes
    assert given(found, "/s/m") == {"x": 1}


def test_a_parameter_file_in_an_argument_that_is_not_known() -> None:
    found = process('name="n" ros_args="--params-file $(var u)"', "", {})
    assert [(rule.name, rule.value) for rule in found.parameters] == [("?", None)]
