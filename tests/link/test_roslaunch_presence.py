# SPDX-License-Identifier: Apache-2.0
"""``if`` and ``unless`` of ROS 1 launch files as presence conditions over the args of the top level."""

from __future__ import annotations

from collections.abc import Mapping

import pytest
from roslaunch_kit import MAIN, loader, workspace

from haros_ci.launch.ros1.roslaunch import evaluate
from haros_ci.model.launch import Launched
from haros_ci.model.presence import Presence, assignment, in_words

BOOL = '<arg name="x" default="true"/><arg name="y" default="false"/>'


def varied(
    body: str,
    files: Mapping[str, str] | None = None,
    args: Mapping[str, str] | None = None,
    alternatives: bool = True,
) -> Launched:
    everything = {MAIN: f"<launch>{body}</launch>", **(files or {})}
    return evaluate([MAIN], workspace(everything), loader(everything), args or {}, {}, alternatives)


def node(name: str, more: str = "", inner: str = "") -> str:
    return f'<node pkg="p" type="t" name="{name}" {more}>{inner}</node>'


def when(name: str) -> str:
    return f'if="$(arg {name})"'


def unless(name: str) -> str:
    return f'unless="$(arg {name})"'


def words(presence: Presence) -> str:
    return " ".join(f"{each.argument}{'=' if each.equal else '!='}{each.value}" for each in presence)


def there(launched: Launched) -> dict[str, str]:
    return {each.name: words(each.presence) for each in launched.nodes}


def others(launched: Launched) -> dict[str, str]:
    return {each.name: words(each.presence) for each in launched.alternatives}


def set_there(launched: Launched) -> dict[str, tuple[object, str]]:
    return {each.name: (each.value, words(each.presence)) for each in launched.parameters}


def set_elsewhere(launched: Launched) -> dict[str, tuple[object, str]]:
    return {each.name: (each.value, words(each.presence)) for each in launched.alternative_parameters}


@pytest.mark.parametrize(
    ("body", "default", "alternative"),
    [
        (BOOL + node("a", when("x")) + node("b", unless("x")), {"/a": "x=true"}, {"/b": "x=false"}),
        (BOOL + f"<group if='$(arg y)' ns='g'>{node('a')}</group>", {}, {"/g/a": "y=true"}),
        (BOOL + f"<group unless='$(arg y)'>{node('a')}</group>", {"/a": "y=false"}, {}),
        (BOOL + f"<group if='$(arg y)'>{node('a', unless('x'))}</group>", {}, {"/a": "x=false y=true"}),
        (BOOL + node("a", "if=\"$(eval x and not y)\""), {"/a": "x=true y=false"}, {}),
        (BOOL + node("a", "if=\"$(eval arg('x') and arg('y'))\""), {}, {"/a": "x=true y=true"}),
        (BOOL + node("a", "if=\"$(eval x or y)\""), {"/a": "x=true"}, {}),
        (
            '<arg name="m" default="slow"/>' + node("a", "if=\"$(eval m == 'fast')\"") + node("b", "unless=\"$(eval m == 'fast')\""),
            {"/b": "m!=fast"},
            {"/a": "m=fast"},
        ),
        ('<arg name="m" default="a"/>' + node("a", "if=\"$(eval m in ('b', 'c'))\""), {}, {"/a": "m=b"}),
        ('<arg name="n" default="0"/>' + node("a", when("n")), {}, {"/a": "n=true"}),
        # an arg without a default must be given anyway
        ('<arg name="x"/>' + node("a", when("x")) + node("b", unless("x")), {"/a": "x=true", "/b": "x=false"}, {}),
        # an arg that depends on another one
        (
            BOOL + '<arg name="m" value="p" if="$(arg x)"/><arg name="m" value="q" unless="$(arg x)"/>'
            + node("a", "if=\"$(eval m == 'p')\"") + node("b", "if=\"$(eval m == 'q')\""),
            {"/a": "x=true"},
            {"/b": "x=false"},
        ),
        (
            BOOL + '<arg name="m" value="p" if="$(arg y)"/><arg name="m" value="q" unless="$(arg y)"/>'
            + node("a", "if=\"$(eval m == 'p')\""),
            {},
            {"/a": "y=true"},
        ),
        (
            BOOL + '<arg name="m" default="p" if="$(arg y)"/><arg name="m" default="q" unless="$(arg y)"/>'
            + node("a", "if=\"$(eval m == 'p')\""),
            {},
            {"/a": "m=p"},
        ),
    ],
)  # fmt: skip
def test_what_is_under_a_condition_has_its_presence(
    body: str, default: dict[str, str], alternative: dict[str, str]
) -> None:
    launched = varied(body)
    assert (there(launched), others(launched)) == (default, alternative)


INNER = f'<launch><arg name="flag" default="false"/>{node("in", when("flag"))}</launch>'
INCLUDE = '<include file="$(find bot)/launch/inner.launch" {}>{}</include>'


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        (INCLUDE.format("", '<arg name="flag" value="$(arg y)"/>'), {"/in": "y=true"}),
        (INCLUDE.format("", '<arg name="flag" value="$(eval not x)"/>'), {"/in": "x=false"}),
        (INCLUDE.format('if="$(arg y)" ns="g"', '<arg name="flag" value="true"/>'), {"/g/in": "y=true"}),
        ('<arg name="flag" default="false"/>' + INCLUDE.format('pass_all_args="true"', ""), {"/in": "flag=true"}),
        # what is not passed has its own default
        (INCLUDE.format("", ""), {}),
        ('<arg name="flag" default="false"/>' + INCLUDE.format("", ""), {}),
        (INCLUDE.format("", '<arg name="flag" value="false"/>'), {}),
    ],
)
def test_includes(body: str, expected: dict[str, str]) -> None:
    launched = varied(BOOL + body, {"bot/launch/inner.launch": INNER})
    assert (there(launched), others(launched)) == ({}, expected)
    assert not launched.problems


def test_parameters() -> None:
    body = (
        BOOL
        + '<param name="p" value="1" if="$(arg x)"/><param name="p" value="2" unless="$(arg x)"/><param name="always" value="3"/>'
        + '<rosparam if="$(arg y)">{deep: {r: 4}}</rosparam>'
        + node("a", "", '<param name="q" value="5" if="$(arg y)"/><param name="q" value="6" unless="$(arg y)"/>')
    )
    launched = varied(body)
    assert set_there(launched) == {"/p": (1, "x=true"), "/always": (3, ""), "/a/q": (6, "y=false")}
    assert set_elsewhere(launched) == {"/p": (2, "x=false"), "/deep/r": (4, "y=true"), "/a/q": (5, "y=true")}


def test_a_private_parameter_of_a_scope() -> None:
    body = BOOL + '<param name="~p" value="1" if="$(arg x)"/>' + node("a") + node("b", when("y"))
    launched = varied(body)
    assert set_there(launched) == {"/a/p": (1, "x=true")}
    assert set_elsewhere(launched) == {"/b/p": (1, "x=true y=true")}


def test_what_is_done_under_an_assumption_changes_nothing_else() -> None:
    body = (
        BOOL + "<group if='$(arg y)'><remap from='a' to='b'/><env name='E' value='1'/><param name='~p' value='1'/>"
        + node("in") + "</group>" + INCLUDE.format("if='$(arg y)'", "") + node("out")
    )  # fmt: skip
    files = {"bot/launch/inner.launch": INNER}
    launched, plain = varied(body, files), varied(body, files, alternatives=False)
    assert (launched.nodes, launched.parameters) == (plain.nodes, plain.parameters)
    assert (launched.files, launched.includes, launched.arguments) == (plain.files, plain.includes, plain.arguments)
    only = launched.alternatives[0]
    assert (only.name, only.remaps[0][:2], only.environment) == ("/in", ("a", "b"), (("E", "1"),))


def test_the_nearest_assignment_from_what_is_given() -> None:
    body = BOOL + node("a", when("y")) + node("b", unless("y"))
    launched = varied(body, args={"y": "1"})
    assert (there(launched), others(launched)) == ({"/a": "y=true"}, {"/b": "y=false"})
    assert in_words(assignment(launched.alternatives[0].presence, dict(launched.arguments)) or ()) == "y:=0"


@pytest.mark.parametrize(
    "body",
    [
        node("a"),
        '<arg name="x" value="false"/>' + node("a", when("x")),
        node("a", 'if="$(optenv X false)"'),
        node("a", 'if="false"'),
        BOOL + node("a", 'if="$(eval x and not x)"'),
        BOOL + f"<group unless='$(arg x)'>{node('a', when('x'))}</group>",
        BOOL + "<remap from='a' to='b' if='$(arg y)'/><env name='E' value='1' if='$(arg y)'/>",
        BOOL + "<machine name='m' address='a' if='$(arg y)'/>",
        '<arg name="m" default="a"/>' + node("a", 'if="$(eval len(m) > 3)"'),
        BOOL + node("a", 'if="$(arg y)" unless="$(arg x)"'),
    ],
)
def test_no_alternatives(body: str) -> None:
    launched = varied(body)
    plain = varied(body, alternatives=False)
    assert not launched.alternatives and not launched.alternative_parameters
    assert launched.problems == plain.problems


def test_a_file_that_is_missing_under_an_assumption_is_told_once_with_it() -> None:
    include = "<include file='$(find bot)/launch/missing.launch' if='$(arg y)'/>"
    said = [each.message for each in varied(BOOL + include).problems]
    assert said == [
        "includes bot/launch/missing.launch, which is no launch file of the workspace; correct the path (with y:=true)"
    ]


def test_what_is_not_known_under_an_assumption_is_not_told() -> None:
    assert not varied(BOOL + "<include file='$(env X)/missing.launch' if='$(arg y)'/>").problems


def test_many_conditions_inside_one_another_come_to_an_end() -> None:
    args = "".join(f'<arg name="a{n}" default="false"/>' for n in range(12))
    body = args + "".join(f'<group if="$(arg a{n})">' + node(f"n{n}") for n in range(12)) + "</group>" * 12
    assert len(varied(body).alternatives) == 3
