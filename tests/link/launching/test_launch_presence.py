# SPDX-License-Identifier: Apache-2.0
"""Launch conditions as presence conditions over launch arguments, in ROS 2 launch files of every dialect."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from pathlib import Path

import pytest
from launching_kit import MAIN, loader, node, workspace

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "launch_python"))

from launch_python_kit import describe

from haros_ci.launch.ros2.evaluate import launch_system
from haros_ci.launch.ros2.places import Places
from haros_ci.model.launch import LaunchedSystem
from haros_ci.model.presence import Choice, Presence, assignment, in_words, together

BOOL = '<arg name="x" default="true"/><arg name="y" default="false"/>'


def varied(
    body: str,
    files: Mapping[str, str] | None = None,
    args: Mapping[str, str] | None = None,
    python: Mapping[str, str] | None = None,
    main: str = MAIN,
    alternatives: bool = True,
) -> LaunchedSystem:
    everything = {MAIN: f"<launch>{body}</launch>", **(files or {}), **dict.fromkeys(python or {}, "#")}
    places = Places(workspace(everything), {})
    described = {path: describe(text) for path, text in (python or {}).items()}
    load = loader(everything, described)
    return launch_system((main,), places.workspace, load, args or {}, {}, places, alternatives=alternatives)


def words(presence: Presence) -> str:
    return " ".join(f"{each.argument}{'=' if each.equal else '!='}{each.value}" for each in presence)


def there(system: LaunchedSystem) -> dict[str, str]:
    return {each.name or "-": words(each.presence) for each in system.nodes}


def others(system: LaunchedSystem) -> dict[str, str]:
    return {each.name or "-": words(each.presence) for each in system.alternatives}


def commands(system: LaunchedSystem) -> dict[str, str]:
    defaults = dict(system.arguments)
    return {each.name or "-": in_words(assignment(each.presence, defaults) or ()) for each in system.alternatives}


@pytest.mark.parametrize(
    ("body", "default", "alternative"),
    [
        (
            BOOL + node('if="$(var x)"', name="a") + node('unless="$(var x)"', name="b"),
            {"a": "x=true"},
            {"b": "x=false"},
        ),
        (BOOL + node('if="$(var y)"', name="a"), {}, {"a": "y=true"}),
        (BOOL + node('unless="$(var y)"', name="a"), {"a": "y=false"}, {}),
        (
            '<arg name="m" default="slow"/>'
            + node("if=\"$(eval '\\'$(var m)\\' == \\'fast\\'')\"", name="a")
            + node("if=\"$(eval '\\'$(var m)\\' != \\'fast\\'')\"", name="b"),
            {"b": "m!=fast"},
            {"a": "m=fast"},
        ),
        (
            '<arg name="m" default="p"><choice value="p"/><choice value="q"/><choice value="r"/></arg>'
            + node('if="$(equals $(var m) p)"', name="a")
            + node('if="$(not-equals $(var m) r)"', name="b")
            + node('if="$(not-equals $(var m) p)"', name="c"),
            {"a": "m=p", "b": "m!=r"},
            {"c": "m=q"},
        ),
        (BOOL + node('if="$(and $(var x) $(var y))"', name="a"), {}, {"a": "x=true y=true"}),
        (BOOL + node('if="$(or $(var x) $(var y))"', name="a"), {"a": "x=true"}, {}),
        (BOOL + node('if="$(not $(var x))"', name="a"), {}, {"a": "x=false"}),
        (
            '<arg name="x" default="false"/><arg name="y" default="false"/>'
            + node('if="$(and $(var x) $(var y))"', name="a"),
            {},
            {"a": "x=true y=true"},
        ),
        (BOOL + "<group if='$(var y)'>" + node('if="$(var x)"', name="a") + "</group>", {}, {"a": "x=true y=true"}),
        (
            BOOL + "<group if='$(var y)'>" + node('unless="$(var x)"', name="a") + "</group>",
            {},
            {"a": "x=false y=true"},
        ),
        # an expression that takes booleans only as Python writes them
        (
            '<arg name="s" default="False"/>'
            + node("if=\"$(eval 'not $(var s)')\"", name="a")
            + node('if="$(var s)"', name="b"),
            {"a": "s=false"},
            {"b": "s=true"},
        ),
        # zero and one are booleans where they are used as such
        ('<arg name="n" default="0"/>' + node('if="$(var n)"', name="a"), {}, {"a": "n=true"}),
        # and numbers where they are not
        (
            '<arg name="n" default="1"/>'
            + node("if=\"$(eval '$(var n) > 0')\"", name="a")
            + node('if="$(equals $(var n) 2)"', name="b"),
            {"a": "n=1"},
            {"b": "n=2"},
        ),
        # one argument by another one's value
        (
            '<arg name="p" default="false"/><arg name="q" default="$(var p)"/>' + node('if="$(var q)"'),
            {},
            {"n": "q=true"},
        ),
        # a configuration that depends on a condition
        (
            BOOL
            + '<let name="m" value="p" if="$(var x)"/><let name="m" value="q" unless="$(var x)"/>'
            + node('if="$(equals $(var m) p)"', name="a")
            + node('if="$(equals $(var m) q)"', name="b"),
            {"a": "x=true"},
            {"b": "x=false"},
        ),
        (
            BOOL
            + '<let name="m" value="p" if="$(var y)"/><let name="m" value="q" unless="$(var y)"/>'
            + node('if="$(equals $(var m) p)"', name="a"),
            {},
            {"a": "y=true"},
        ),
    ],
)
def test_what_is_under_a_condition_has_its_presence(
    body: str, default: dict[str, str], alternative: dict[str, str]
) -> None:
    system = varied(body)
    assert (there(system), others(system)) == (default, alternative)


def test_the_assignment_is_as_the_default_is_written() -> None:
    system = varied(
        '<arg name="s" default="False"/><arg name="n" default="0"/>'
        + node('if="$(var s)"', name="a")
        + node('if="$(var n)"', name="b")
    )
    assert commands(system) == {"a": "s:=True", "b": "n:=1"}


def test_if_and_unless_contradict_each_other() -> None:
    system = varied(BOOL + node('if="$(var x)"', name="a") + node('unless="$(var x)"', name="b"))
    assert together(system.nodes[0].presence, system.alternatives[0].presence) is None


def test_an_argument_without_a_default_tells_nodes_apart() -> None:
    body = '<arg name="x"/>' + node('if="$(var x)"', name="a") + node('unless="$(var x)"', name="b")
    system = varied(body)
    assert there(system) == {"a": "x=true", "b": "x=false"}
    assert all(each.conditions for each in system.nodes)
    assert not system.alternatives


def test_an_argument_without_a_default_that_is_compared() -> None:
    body = (
        '<arg name="m"/>'
        + node('if="$(equals $(var m) p)"', name="a")
        + node("if=\"$(eval '\\'$(var m)\\' == \\'q\\'')\"", name="b")
    )
    assert there(varied(body)) == {"a": "m=p", "b": "m=q"}


INNER = "<launch><arg name='flag' default='false'/>" + node('if="$(var flag)"', name="in") + "</launch>"


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        # the include itself is under a condition
        (
            BOOL
            + "<include file='$(dirname)/inner.launch.xml' if='$(var y)'><arg name='flag' value='true'/></include>",
            {"in": "y=true"},
        ),
        # an argument is passed on under another name
        (
            BOOL + "<include file='$(dirname)/inner.launch.xml'><arg name='flag' value='$(var y)'/></include>",
            {"in": "y=true"},
        ),
        (
            BOOL + "<include file='$(dirname)/inner.launch.xml'><arg name='flag' value='$(not $(var x))'/></include>",
            {"in": "x=false"},
        ),
        # an argument that is given within by what is passed
        (
            BOOL + "<let name='z' value='$(var y)'/><include file='$(dirname)/inner.launch.xml'>"
            "<arg name='flag' value='$(var z)'/></include>",
            {"in": "y=true"},
        ),
        # the argument of an included file that is passed nothing is no argument of this one
        (BOOL + "<include file='$(dirname)/inner.launch.xml'/>", {}),
        # what is passed is fixed
        (BOOL + "<include file='$(dirname)/inner.launch.xml'><arg name='flag' value='false'/></include>", {}),
    ],
)
def test_includes(body: str, expected: dict[str, str]) -> None:
    system = varied(body, {"bot/launch/inner.launch.xml": INNER})
    assert (there(system), others(system)) == ({}, expected)
    assert not system.problems


def test_what_is_done_under_an_assumption_changes_nothing_else() -> None:
    body = (
        BOOL
        + "<group if='$(var y)' scoped='false'><let name='m' value='changed'/><push-ros-namespace namespace='other'/>"
        + "<set_remap from='a' to='b'/><set_parameter name='p' value='1'/><set_env name='E' value='1'/>"
        + node(name="in")
        + "</group>"
        + node(name="$(var m here)")
    )
    system = varied(body)
    plain = varied(body, alternatives=False)
    assert system.nodes == plain.nodes
    only = system.alternatives[0]
    assert (only.name, only.namespace, only.remaps[0][:2], only.environment) == (
        "in",
        "/other",
        ("a", "b"),
        (("E", "1"),),
    )
    assert (system.arguments, system.files, system.includes) == (plain.arguments, plain.files, plain.includes)


def test_a_list_that_was_begun_outside_is_not_changed_by_an_assumption() -> None:
    body = (
        BOOL
        + "<set_remap from='a' to='b'/><group if='$(var y)' scoped='false'><set_remap from='c' to='d'/>"
        + node(name="in")
        + "</group>"
        + node(name="out")
    )
    system = varied(body)
    assert [len(each.remaps) for each in (*system.nodes, *system.alternatives)] == [1, 2]


def test_a_value_in_what_is_assumed_is_the_assumed_one() -> None:
    body = (
        '<arg name="sim" default="false"/><arg name="ns" default="$(var sim)_robot"/><group if="$(var sim)">'
        + node('namespace="$(var ns)" args="$(var sim)"', '<param name="use_sim_time" value="$(var sim)"/>')
        + "</group>"
    )
    only = varied(body).alternatives[0]
    assert (only.namespace, only.arguments, only.parameters[0].value) == ("/true_robot", "true", True)


def test_a_namespace_that_is_pushed_under_an_assumption_holds_with_it() -> None:
    body = (
        '<arg name="spaced" default="false"/><arg name="y" default="false"/>'
        "<push-ros-namespace namespace='robot' if='$(var spaced)'/>"
        + node('if="$(var spaced)"', name="a")
        + node('if="$(var y)"', name="b")
    )
    assert [(each.name, each.namespace) for each in varied(body).alternatives] == [("a", "/robot"), ("b", None)]


def test_components_of_a_container() -> None:
    body = (
        BOOL + '<node_container pkg="rclcpp_components" exec="component_container" name="c" namespace="/">'
        '<composable_node pkg="p" plugin="p::A" name="a" if="$(var x)"/>'
        '<composable_node pkg="p" plugin="p::B" name="b" unless="$(var x)"/></node_container>'
    )
    system = varied(body)
    assert there(system) == {"c": "", "a": "x=true"}
    assert [(each.name, each.container) for each in system.alternatives] == [("b", "/c")]


def test_a_configuration_given_on_the_command_line_is_the_nearest() -> None:
    body = BOOL + node('if="$(var y)"', name="a") + node('unless="$(var y)"', name="b")
    system = varied(body, args={"y": "true"})
    assert (there(system), others(system)) == ({"a": "y=true"}, {"b": "y=false"})


PARAMETERS = "<set_parameter name='p' value='1' if='$(var x)'/>" + node(name="a")


def test_what_all_nodes_get_under_a_condition_has_its_presence() -> None:
    rule = varied(BOOL + PARAMETERS).nodes[0].parameters[0]
    assert (rule.name, words(rule.presence)) == ("p", "x=true")


@pytest.mark.parametrize(
    "body",
    [
        node(name="a"),
        '<let name="x" value="true"/>' + node('if="$(var x)"'),
        '<let name="x" value="false"/>' + node('if="$(var x)"'),
        node('if="true"') + node('if="false"', name="b"),
        node('if="$(env X false)"'),
        node('if="$(var x false)"'),
        # no value is known with which it would hold
        '<arg name="m" default="a"/>' + node('if="$(eval \'len(\\"$(var m)\\") > 3\')"'),
        # none of the choices makes it hold
        '<arg name="m" default="a"><choice value="a"/><choice value="b"/></arg>' + node('if="$(equals $(var m) c)"'),
        # it contradicts itself
        BOOL + node('if="$(and $(var x) $(not $(var x)))"'),
        BOOL + "<group unless='$(var x)'>" + node('if="$(var x)"') + "</group>",
        # nothing is started
        BOOL + "<set_env name='E' value='1' if='$(var y)'/>",
        # an argument that is declared under a condition is none of the configuration
        BOOL + "<group if='$(var y)'><arg name='z' default='false'/>" + node('if="$(var z)"') + "</group>",
    ],
)
def test_no_alternatives(body: str) -> None:
    system = varied(body)
    assert not system.alternatives
    assert not [each for each in system.problems if "(with" in each.message]


@pytest.mark.parametrize(
    "body",
    [
        BOOL + node('if="$(var x)"') + node('if="$(var y)"', name="b"),
        BOOL + "<include file='$(dirname)/inner.launch.xml' if='$(var y)'/>",
        BOOL + "<include file='$(dirname)/missing.launch.xml' if='$(var y)'/>",
        '<arg name="x"/>' + node('if="$(var x)"'),
    ],
)
def test_what_is_there_by_default_is_the_same(body: str) -> None:
    files = {"bot/launch/inner.launch.xml": INNER}
    with_, without = varied(body, files), varied(body, files, alternatives=False)
    assert [(each.name, each.namespace, each.conditions) for each in with_.nodes] == [
        (each.name, each.namespace, each.conditions) for each in without.nodes
    ]
    assert without.problems == with_.problems[: len(without.problems)]
    assert not any(each.presence for each in without.nodes) and not without.alternatives


def test_a_file_that_is_missing_under_an_assumption_is_told_once_with_it() -> None:
    include = "<include file='$(dirname)/missing.launch.xml' if='$(var y)'/>"
    said = [each.message for each in varied(BOOL + include + "<group>" + include + "</group>").problems]
    assert said == [
        "includes bot/launch/missing.launch.xml, which is not in the workspace; correct the path (with y:=true)"
    ]


def test_what_is_not_known_under_an_assumption_is_not_told() -> None:
    body = BOOL + "<include file='$(env NOWHERE)/x.launch.xml' if='$(var y)'/>"
    assert not varied(body).problems


def test_a_file_that_is_missing_anyway_is_told_without_an_assumption() -> None:
    include = "<include file='$(dirname)/missing.launch.xml'{}/>"
    body = BOOL + "<group>" + include.format("") + include.format(" if='$(var y)'") + "</group>"
    assert len([each for each in varied(body).problems if "missing" in each.message]) == 1


def test_many_conditions_inside_one_another_come_to_an_end() -> None:
    arguments = "".join(f'<arg name="a{n}" default="false"/>' for n in range(12))
    body = arguments + "".join(f'<group if="$(var a{n})">' + node(name=f"n{n}") for n in range(12)) + "</group>" * 12
    assert others(varied(body)) == {
        "n0": "a0=true",
        "n1": "a0=true a1=true",
        "n2": "a0=true a1=true a2=true",
    }


@pytest.mark.parametrize(("steps", "expected"), [(4, {"n": "y=true"}), (2_000, {})])
def test_what_comes_from_an_argument_in_too_many_steps_is_not_known_otherwise(
    steps: int, expected: dict[str, str]
) -> None:
    lets = "".join(f'<let name="z{n + 1}" value="$(not $(var z{n}))"/>' for n in range(steps))
    body = BOOL + '<let name="z0" value="$(var y)"/>' + lets + node(f'if="$(var z{steps})"')
    assert others(varied(body)) == expected


def test_arguments_that_are_each_made_of_the_one_before() -> None:
    chain = "".join(f'<arg name="b{n + 1}" default="$(var b{n})"/>' for n in range(200))
    body = '<arg name="b0" default="false"/>' + chain + node('if="$(var b200)"') + node('if="$(var b1)"', name="m")
    assert others(varied(body)) == {"n": "b200=true", "m": "b1=true"}


def test_groups_nested_as_deep_as_can_be() -> None:
    body = BOOL + "<group if='$(var x)'>" * 70 + node('if="$(var y)"') + "</group>" * 70
    assert others(varied(body)) == {"n": "x=true y=true"}


def test_conditions_of_many_arguments_are_asked_in_bounds() -> None:
    arguments = "".join(f'<arg name="c{n}" default="false"/>' for n in range(60))
    every = "$(and $(var c58) $(var c59))"
    for n in range(58):
        every = f"$(var c{n})" if not every else f"$(and $(var c{n}) {every})" if n < 30 else every
    assert not varied(arguments + node(f'if="{every}"')).alternatives


def test_a_file_that_includes_itself_under_conditions_comes_to_an_end() -> None:
    body = BOOL + node('if="$(var y)"') + f"<include file='$(dirname)/{Path(MAIN).name}' if='$(var y)'/>"
    assert len(varied(body).alternatives) <= 3


PYTHON = "bot/launch/main.launch.py"
HEAD = """
def generate_launch_description():
    x = LaunchConfiguration("x")
    y = LaunchConfiguration("y")
    declared = [DeclareLaunchArgument("x", default_value="True"), DeclareLaunchArgument("y", default_value="False"),
                DeclareLaunchArgument("m", default_value="a", choices=["a", "b"])]
    def node(name, condition=None):
        return Node(package="p", executable="e", name=name, condition=condition)
"""


@pytest.mark.parametrize(
    ("actions", "default", "alternative"),
    [
        ("node('a', IfCondition(x)), node('b', UnlessCondition(x))", {"a": "x=true"}, {"b": "x=false"}),
        ("node('a', IfCondition(y))", {}, {"a": "y=true"}),
        ("node('a', IfCondition(PythonExpression([x, ' and not ', y])))", {"a": "x=true y=false"}, {}),
        ("node('a', IfCondition(PythonExpression([x, ' and ', y])))", {}, {"a": "x=true y=true"}),
        ("node('a', IfCondition(PythonExpression(['\"', LaunchConfiguration('m'), '\" == \"b\"'])))", {}, {"a": "m=b"}),
        ("node('a', LaunchConfigurationEquals('m', 'b'))", {}, {"a": "m=b"}),
        ("node('a', LaunchConfigurationNotEquals('m', 'b'))", {"a": "m=a"}, {}),
        ("GroupAction([node('a')], condition=IfCondition(y))", {}, {"a": "y=true"}),
        ("node('a', IfCondition(NotSubstitution(x)))", {}, {"a": "x=false"}),
        ("node('a', IfCondition(OrSubstitution(y, NotSubstitution(x))))", {}, {"a": "y=true"}),
        # a function under a condition runs with what is assumed
        (
            "OpaqueFunction(function=lambda context: [node('is_' + y.perform(context))], condition=IfCondition(y))",
            {},
            {"is_True": "y=true"},
        ),
        # a function is run with the default values only
        (
            "OpaqueFunction(function=lambda context: [node('a')] if y.perform(context) == 'True' else [node('b')])",
            {"b": ""},
            {},
        ),
        # what is done later
        ("TimerAction(period=1.0, actions=[node('a', IfCondition(y))])", {}, {"a": "y=true"}),
        ("TimerAction(period=1.0, actions=[node('a')], condition=IfCondition(y))", {}, {"a": "y=true"}),
        ("TimerAction(period=1.0, actions=[node('a')], condition=IfCondition(x))", {"a": "x=true"}, {}),
    ],
)
def test_python(actions: str, default: dict[str, str], alternative: dict[str, str]) -> None:
    text = HEAD + f"    return LaunchDescription([*declared, {actions}])\n"
    system = varied("", python={PYTHON: text}, main=PYTHON)
    assert not system.problems
    assert (there(system), others(system)) == (default, alternative)


def test_choices_that_are_not_booleans_are_as_they_are_written() -> None:
    body = (
        '<arg name="m" default="auto"><choice value="auto"/><choice value="True"/><choice value="False"/></arg>'
        + node('if="$(equals $(var m) True)"')
    )
    assert varied(body).alternatives[0].presence == (Choice("m", "True"),)
