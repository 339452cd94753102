# SPDX-License-Identifier: Apache-2.0
"""ROS 1 launch files: tags and their attributes, scopes, conditions and includes."""

from __future__ import annotations

import pytest
from roslaunch_kit import MAIN, launch, messages, names, node, run, told, values

from haros_ci.launch.facts.memory import LEAST, LaunchMemory
from haros_ci.model.architecture import Condition, RemapRule, Unknown
from haros_ci.model.launch import Started
from haros_ci.model.location import Location

SUB = "bot/launch/sub.launch"
INCLUDE = 'file="$(find bot)/launch/sub.launch"'


def sub(body: str) -> dict[str, str]:
    return {SUB: f"<launch>{body}</launch>"}


def at(column: int, line: int = 1, path: str = MAIN) -> Location:
    return Location(path, line, column)


def pairs(started: Started) -> list[tuple[str, str]]:
    return [(source, target) for source, target, _ in started.remaps]


# Nodes


def test_a_node_with_everything() -> None:
    launched = launch(
        '\n\t<node pkg="cam" type="driver" name="left" ns="eyes" args="-f $(find cam)/x.yaml" machine="m"'
        ' respawn="true"'
        ' respawn_delay="2.5" output="screen" cwd="node" launch-prefix="nice" required="false" clear_params="true">\n'
        '  <remap from="image" to="raw"/><env name="A" value="1"/></node><machine name="m" address="a"/>'
    )
    assert told(launched) == []
    assert launched.nodes == (
        Started(
            name="/eyes/left",
            namespace="/eyes",
            package="cam",
            type="driver",
            location=at(2, 2),
            arguments="-f $(find cam)/x.yaml",
            remaps=(("image", "raw", at(3, 3)),),
            rules=(RemapRule(source="image", target="raw", location=at(3, 3)),),
            environment=(("A", "1"),),
            machine="m",
            respawn=True,
            launch_prefix="nice",
        ),
    )


def test_a_test() -> None:
    launched = launch(
        '<test test-name="trial" pkg="p" type="t.py" time-limit="9.5" retry="2"/>'
        '<test test-name="named" name="other" pkg="p" type="t.py"/>'
    )
    assert told(launched) == []
    assert [(started.name, started.is_test) for started in launched.nodes] == [("/trial", True), ("/other", True)]


@pytest.mark.parametrize(
    ("tag", "message"),
    [
        ('<node pkg="p" type="t"/>', "<node> lacks the attribute 'name'; add it"),
        ('<node name="n" type="t"/>', "<node> lacks the attribute 'pkg'; add it"),
        ('<node name="n" pkg="p"/>', "<node> lacks the attribute 'type'; add it"),
        ('<node name="" pkg="p" type="t"/>', "<node> has an empty 'name'; fill it in. The tag is left out"),
        ('<node name="n" pkg="" type="t"/>', "<node> has an empty 'pkg'; fill it in. The tag is left out"),
        ('<node name="n" pkg="p" type=" "/>', "<node> has an empty 'type'; fill it in. The tag is left out"),
        (node(name="a/b"), "node name 'a/b' holds a namespace; use ns=... The tag is left out"),
        (node(name="/a"), "node name '/a' holds a namespace; use ns=... The tag is left out"),
        (node('ns=""'), "<node> has an empty 'ns'; remove the attribute. The tag is left out"),
        (node('ns="~x"'), "<node ns='~x'>: a namespace cannot be private. The tag is left out"),
        (
            node('respawn="true" required="true"'),
            "<node> cannot be both respawn and required; keep one. The tag is left out",
        ),
        (node('output="file"'), "<node output='file'>: write log or screen. The tag is left out"),
        (node('cwd="/tmp"'), "<node cwd='/tmp'>: write ROS_HOME or node. The tag is left out"),
        ('<test pkg="p" type="t"/>', "<test> lacks the attribute 'test-name'; add it"),
        (
            '<test test-name="t" pkg="p" type="t" output="screen"/>',
            "<test> takes no 'output'; remove it. The tag is left out",
        ),
    ],
)
def test_nodes_that_roslaunch_refuses_are_left_out(tag: str, message: str) -> None:
    launched = launch(tag + node(name="rest"))
    assert (told(launched), names(launched)) == ([message], ["/rest"])


@pytest.mark.parametrize(
    ("tag", "message"),
    [
        (node('exec="t"'), "<node> has no attribute 'exec'; remove it or correct its name"),
        (node(name="9n"), "'9n' is no legal node name; use letters, digits and _"),
        (node('respawn="yes"'), "<node respawn='yes'> is neither true nor false; write one of them"),
        (node('respawn_delay="soon"'), "<node respawn_delay='soon'> is no number; correct it"),
        (node(inner="<node/>"), "<node> cannot stand in <node>; remove it"),
        (node('machine="m"'), "machine 'm' is not declared; add a <machine> for it"),
        (
            '<test test-name="t" pkg="p" type="t" time-limit="0"/>',
            "<test time-limit='0'> must be more than 0; correct it",
        ),
        ('<test test-name="t" pkg="p" type="t" retry="x"/>', "<test retry='x'> is no number; correct it"),
    ],
)
def test_nodes_with_flaws_stay(tag: str, message: str) -> None:
    launched = launch(tag)
    assert (told(launched), len(launched.nodes)) == ([message], 1)


def test_two_nodes_of_one_name() -> None:
    launched = launch(node() + "\n" + node())
    assert messages(launched) == [f"{MAIN}:2: a node named '/n' is already at {MAIN}:1; rename one of them"]
    assert names(launched) == ["/n", "/n"]


@pytest.mark.parametrize(
    "body",
    [
        node() + node('ns="other"'),
        node('if="$(env X)"') + node('unless="$(env X)"'),
        node(name="$(anon n)") + node(name="$(anon n)"),
        node('if="false"') + node(),
        node() + '<test test-name="n" pkg="p" type="t"/>',
    ],
)
def test_names_that_may_differ_or_exclude_each_other_are_no_problem(body: str) -> None:
    assert told(launch(body)) == []


def test_unknown_parts_of_a_node() -> None:
    launched = launch(node('args="$(env PORT) -v" ns="$(env NS)"', name="$(anon driver)"))
    (started,) = launched.nodes
    assert (started.name, started.namespace, started.arguments) == ("/?/driver_?", "/?", "? -v")
    assert started.unknowns == (
        Unknown(
            "name",
            "environment variable 'NS' is not given; $(anon driver) is chosen anew at each launch",
            at(9),
        ),
        Unknown("arguments", "environment variable 'PORT' is not given", at(9)),
    )


def test_machines() -> None:
    twice = '<machine name="m" address="a" default="true"/><machine name="m" address="a" default="false"/>'
    assert told(launch(twice + node('machine="m"'))) == []
    assert told(launch('<machine name="m" address="a"/><machine name="m" address="b" timeout="5"/>')) == [
        "machine 'm' is declared twice, in different ways; keep one"
    ]
    assert told(launch('<machine name="m"/>')) == ["<machine> lacks the attribute 'address'; add it"]
    assert told(launch('<machine name="m" address="a" default="yes" timeout="0" ros-root="/"><env/></machine>')) == [
        "<machine> has no attribute 'ros-root'; remove it or correct its name",
        "<env> cannot stand in <machine>; remove it",
        "<machine default='yes'>: write true, false or never",
        "<machine timeout='0'> must be more than 0; correct it",
    ]


# Scopes


def test_namespaces_of_groups_includes_and_nodes() -> None:
    launched = launch(
        f'<group ns="a"><group ns="b/">{node()}<group ns="/c">{node()}</group></group>'
        f'<include {INCLUDE} ns="d"/>' + node('ns="e"') + "</group>" + node('ns="/"'),
        sub(node(name="inner")),
    )
    assert names(launched) == ["/a/b/n", "/c/n", "/a/d/inner", "/a/e/n", "/n"]
    assert [started.namespace for started in launched.nodes] == ["/a/b", "/c", "/a/d", "/a/e", "/"]


def test_remaps_hold_for_later_nodes_of_the_scope_and_those_inside() -> None:
    remap = '<remap from="{}" to="{}"/>'.format
    launched = launch(
        node(name="before")
        + remap("a", "A")
        + node(name="one", inner=remap("b", "B") + remap("a", "A2"))
        + f"<group>{remap('c', 'C')}{node(name='two')}</group>"
        + f"<include {INCLUDE}>\n</include>"
        + remap("a", "last")
        + node(name="three"),
        sub(remap("d", "D") + node(name="inside")),
    )
    assert told(launched) == []
    assert {started.name: pairs(started) for started in launched.nodes} == {
        "/before": [],
        "/one": [("b", "B"), ("a", "A2")],
        "/two": [("a", "A"), ("c", "C")],
        "/inside": [("a", "A"), ("d", "D")],
        "/three": [("a", "last")],
    }


@pytest.mark.parametrize(
    ("remap", "made"),
    [
        ('<remap from="/a//b/" to="~c"/>', [("/a/b", "~c")]),
        ('<remap from="~a" to="/b"/>', [("~a", "/b")]),
        ('<remap from="a" to="$(optenv NONE x)"/>', [("a", "x")]),
        ('<remap from="a" to="$(env X)/b"/>', [("a", "?/b")]),
        ('<remap from="a" to="b" if="false"/>', []),
        ('<remap from="a" to="b" unless="$(env X)"/>', [("a", "?")]),
        ('<remap from="a" to="a" if="$(env X)"/>', []),
        ('<remap from="a" to="b"/><remap from="a" to="b" if="$(env X)"/>', [("a", "b")]),
        ('<remap from="a" to="b"/><remap from="a" to="c" if="$(env X)"/>', [("a", "?")]),
        ('<remap from="a" to="b" if="$(env X)"/><remap from="a" to="c"/>', [("a", "c")]),
    ],
)
def test_remaps(remap: str, made: list[tuple[str, str]]) -> None:
    launched = launch(remap + node())
    assert (told(launched), pairs(launched.nodes[0])) == ([], made)
    assert bool(launched.nodes[0].unknowns) == any("?" in target for _, target in made)


@pytest.mark.parametrize(
    ("remap", "message"),
    [
        ('<remap from="a"/>', "<remap> lacks the attribute 'to'; add it"),
        ('<remap from="" to="b"/>', "<remap>: 'from' and 'to' cannot be empty; correct it. The tag is left out"),
        ('<remap from="a b" to="b"/>', "<remap>: 'a b' is no legal name; correct it. The tag is left out"),
        ('<remap from="a" to="9"/>', "<remap>: '9' is no legal name; correct it. The tag is left out"),
    ],
)
def test_remaps_that_roslaunch_refuses(remap: str, message: str) -> None:
    launched = launch(remap + node())
    assert (told(launched), launched.nodes[0].remaps) == ([message], ())


def test_environment_of_nodes() -> None:
    env = '<env name="{}" value="{}"/>'.format
    launched = launch(
        env("A", 1) + f"<group>{env('B', 2)}{node(name='x')}</group>{node(name='y', inner=env('A', 3))}"
        f"<include {INCLUDE}>{env('C', 4)}</include><env name='D' value='5' if='$(env X)'/>{node(name='z')}",
        sub(node(name="inside")),
    )
    assert told(launched) == []
    assert {started.name: started.environment for started in launched.nodes} == {
        "/x": (("A", "1"), ("B", "2")),
        "/y": (("A", "1"), ("A", "3")),
        "/inside": (("A", "1"), ("C", "4")),
        "/z": (("A", "1"), ("D", "?")),
    }
    assert launched.nodes[-1].unknowns[0].field == "environment"
    assert told(launch('<env name="" value="1"/><env name="A"/>')) == [
        "<env> has an empty name; give it one. The tag is left out",
        "<env> lacks the attribute 'value'; add it",
    ]


def test_env_tags_do_not_feed_env_substitutions() -> None:
    launched = launch('<env name="A" value="1"/><param name="p" value="$(env A)"/>')
    assert launched.parameters[0].unknowns[0].reason == "environment variable 'A' is not given"


def test_clear_params_clears_nothing_that_is_set_here() -> None:
    launched = launch(
        '<param name="a/p" value="1"/><group ns="a" clear_params="true"><param name="q" value="2"/></group>'
        f"<group clear_params='true'>{node()}</group><include {INCLUDE} clear_params='true'/>",
        sub(""),
    )
    assert values(launched) == {"/a/p": 1, "/a/q": 2}
    assert told(launched) == [
        "<group> needs an 'ns' to use 'clear_params'; add it. The tag is left out",
        "<include> needs an 'ns' to use 'clear_params'; add it. The tag is left out",
    ]


# Conditions


@pytest.mark.parametrize("attribute", ['if="true"', 'if="1"', 'if=" TRUE "', 'unless="false"', 'unless="0"'])
def test_conditions_that_hold(attribute: str) -> None:
    launched = launch(node(attribute))
    assert (told(launched), launched.nodes[0].conditions) == ([], ())


@pytest.mark.parametrize("attribute", ['if="False"', 'if="0"', 'unless="true"', 'unless="1"', 'if="$(eval 1 > 2)"'])
def test_conditions_that_do_not_hold(attribute: str) -> None:
    launched = launch(f"{node(attribute)}<group {attribute}>{node()}</group><nonsense/>")
    assert (told(launched), names(launched)) == (
        ["roslaunch knows no <nonsense> here; remove it or correct its name"],
        [],
    )


def test_what_a_false_condition_leaves_out_is_not_looked_at() -> None:
    launched = launch('<group if="0"><nonsense/><param/></group><include if="0"/><node unless="1"/><arg if="0"/>')
    assert (told(launched), launched.nodes) == ([], ())


def test_undecided_conditions_are_kept_from_the_outermost_on() -> None:
    launched = launch(
        f'<group if="$(env A)"><include {INCLUDE} unless="$(arg b)"/></group>',
        sub('<group if="true"><node pkg="p" type="t" name="n" if="$(env C)"/><param name="q" value="1"/></group>'),
    )
    outer = (Condition("if", "$(env A)", at(9)), Condition("unless", "$(arg b)", at(30)))
    assert launched.nodes[0].conditions == (*outer, Condition("if", "$(env C)", at(26, path=SUB)))
    assert launched.parameters[0].conditions == outer
    assert told(launched) == [
        "<include>: argument 'b' is not declared; declare it above, with <arg name=... default=.../>"
    ]


@pytest.mark.parametrize(
    ("attributes", "message"),
    [
        ('if="true" unless="false"', "<node> has both 'if' and 'unless'; keep one. The tag is left out"),
        ('if="yes"', "<node if='yes'>: neither true nor false. The tag is left out"),
        ('unless=""', "<node unless=''>: neither true nor false. The tag is left out"),
        ('if="$(find bot)"', "<node if='$(find bot)'>: neither true nor false. The tag is left out"),
    ],
)
def test_conditions_that_roslaunch_refuses(attributes: str, message: str) -> None:
    launched = launch("\n" + node(attributes) + node(name="rest"))
    assert (messages(launched), names(launched)) == ([f"{MAIN}:2: {message}"], ["/rest"])


# Args


def test_args_of_the_top_level() -> None:
    body = (
        '<arg name="a" default="1" doc="first"/><arg name="b" value="$(arg a)2"/><arg name="c"/>'
        '<arg name="d" default="$(env X)!"/><param name="p" value="$(arg b)"/>'
    )
    launched = launch(body, args={"a": "7"})
    assert launched.arguments == (("a", "7"), ("b", "72"), ("c", "?"), ("d", "?!"))
    assert (told(launched), values(launched)) == ([], {"/p": 72})
    assert values(launch(body)) == {"/p": 12}


def test_a_needed_arg_that_nothing_sets_is_told_once_where_it_is_declared() -> None:
    launched = launch('<arg name="x"/>\n<param name="p" value="$(arg x)"/>\n<param name="q" value="$(arg x)"/>')
    assert told(launched) == [
        "argument 'x' has neither value nor default; what depends on it is unknown: set it in the configuration, or"
        " give it a default"
    ]
    assert [parameter.value for parameter in launched.parameters] == [None, None]


@pytest.mark.parametrize(
    ("body", "message"),
    [
        (
            '<arg name="a" value="1"/>',
            "argument 'a' has a fixed value here, but is also set from outside; write 'default' instead of 'value', or"
            " do not set it",
        ),
        ('<arg name="a" default="1"/><arg name="a"/>', "argument 'a' is already declared on line 1; remove one"),
        (
            '<arg name="a"/><arg name="b" value="1" default="2"/>',
            "argument 'b' has both 'value' and 'default'; keep one. It is left out",
        ),
        ('<arg name="a"/><arg value="2"/>', "<arg> lacks the attribute 'name'; add it"),
        ('<arg name="a" help="x"/>', "<arg> has no attribute 'help'; remove it or correct its name"),
    ],
)
def test_args_that_roslaunch_refuses(body: str, message: str) -> None:
    assert told(launch(body, args={"a": "0"})) == [message]


def test_an_argument_that_no_file_declares() -> None:
    assert messages(launch("", args={"robot": "x"})) == [
        f"{MAIN}:None: argument 'robot' is set, but not declared; correct its name"
    ]
    files = {MAIN: "<launch/>", **sub('<arg name="robot"/>')}
    assert messages(run([MAIN, SUB], files, args={"robot": "x"})) == []


def test_args_set_in_a_group_stay_in_it() -> None:
    launched = launch(
        '<group><arg name="a" value="1"/><param name="p" value="$(arg a)"/></group>'
        '<group><arg name="a" value="2"/><param name="q" value="$(arg a)"/></group><param name="r" value="$(arg a)"/>'
    )
    assert values(launched) == {"/p": 1, "/q": 2, "/r": None}
    assert told(launched) == [
        "<param>: argument 'a' is not declared; declare it above, with <arg name=... default=.../>"
    ]


@pytest.mark.parametrize(
    ("body", "value"),
    [
        ('<arg name="a" value="1" if="1"/><arg name="a" value="2" unless="1"/>', 1),
        ('<arg name="a" value="1" if="$(env X)"/><arg name="a" value="1" unless="$(env X)"/>', None),
        ('<arg name="a" value="1" if="$(env X)"/><arg name="a" value="2" unless="$(env X)"/>', None),
        ('<arg name="a" default="1" if="$(env X)"/><arg name="a" default="2" unless="$(env X)"/>', None),
        ('<arg name="a" default="1" if="$(env X)"/><arg name="a" default="2"/>', None),
    ],
)
def test_args_under_conditions(body: str, value: object) -> None:
    launched = launch(body + '<param name="p" value="$(arg a)"/>')
    assert (told(launched), values(launched)) == ([], {"/p": value})


# Includes


def test_what_an_include_passes_and_what_it_does_not() -> None:
    body = '<arg name="x" default="d"/><arg name="y" default="e"/><param name="p" value="$(arg x)$(arg y)"/>'
    launched = launch(
        f'<arg name="x" value="X"/><arg name="y" value="Y"/><include {INCLUDE} ns="a"/>'
        f'<include {INCLUDE} ns="b"><arg name="x" value="$(arg x)x"/><arg name="y" default="f"/></include>'
        f'<include {INCLUDE} ns="c" pass_all_args="true"><arg name="y" value="z"/></include>',
        sub(body),
    )
    assert told(launched) == []
    assert values(launched) == {"/a/p": "de", "/b/p": "Xxf", "/c/p": "Xz"}
    assert (launched.files, launched.includes) == ((MAIN, SUB), (SUB,))


@pytest.mark.parametrize(
    ("include", "inner", "message"),
    [
        (
            f'<include {INCLUDE}><arg name="a" value="1"/></include>',
            "",
            f"passes 'a', which {SUB} does not declare; remove it, or declare it there",
        ),
        (
            f'<include {INCLUDE}><arg name="a" value="1"/></include>',
            '<group><arg name="a"/></group>',
            f"passes 'a', which {SUB} does not declare; remove it, or declare it there",
        ),
        (
            f'<include {INCLUDE}><arg name="a"/></include>',
            '<arg name="a" default="1"/>',
            "argument 'a' is passed without a value; add one",
        ),
        (
            f'<include {INCLUDE}><arg name="a" value="1"/><arg name="a" value="2"/></include>',
            '<arg name="a"/>',
            "argument 'a' is passed twice; keep one",
        ),
        (f"<include {INCLUDE}><param/></include>", "", "<param> cannot stand in <include>; remove it"),
        ("<include/>", "", "<include> lacks the attribute 'file'; add it"),
        (f'<include {INCLUDE} if="x"/>', "", "<include if='x'>: neither true nor false. The tag is left out"),
        (f'<include {INCLUDE} name="x"/>', "", "<include> has no attribute 'name'; remove it or correct its name"),
        (
            '<include file="$(find bot)/launch/none.launch"/>',
            "",
            "includes bot/launch/none.launch, which is no launch file of the workspace; correct the path",
        ),
        (
            '<include file="$(find arm)/launch/arm.launch"/>',
            "",
            "includes '$(find arm)/launch/arm.launch': package 'arm' is not in the workspace; what it starts"
            " is unknown",
        ),
        (
            '<include file="$(env X)/arm.launch"/>',
            "",
            "includes '?/arm.launch': environment variable 'X' is not given; what it starts is unknown",
        ),
        (
            '<include file="sub.launch"/>',
            "",
            "includes 'sub.launch': 'sub.launch' depends on where roslaunch is started; use $(find package)/...; what"
            " it starts is unknown",
        ),
        (
            '<include file="/opt/sub.launch"/>',
            "",
            "includes '/opt/sub.launch': '/opt/sub.launch' is an absolute path; use $(find package)/...; what it starts"
            " is unknown",
        ),
        (
            '<include file="$(find bot)/../../etc/passwd"/>',
            "",
            "includes '$(find bot)/../../etc/passwd': '$(find bot)/../../etc/passwd' leads out of the workspace; what"
            " it starts is unknown",
        ),
    ],
)
def test_includes_that_roslaunch_refuses(include: str, inner: str, message: str) -> None:
    launched = launch(include + node(name="rest"), sub(inner))
    assert (told(launched), names(launched)) == ([message], ["/rest"])


def test_what_an_included_file_lacks_is_told_with_the_place_of_the_include() -> None:
    launched = launch(f"\n<include {INCLUDE}/>", sub('\n<arg name="x"/><param name="p" value="$(arg x)"/>'))
    assert messages(launched) == [
        f"{SUB}:2: argument 'x' has neither value nor default; what depends on it is unknown: set it in the <include>"
        f" at {MAIN}:2, or give it a default"
    ]


def test_pass_all_args_passes_what_need_not_be_declared_and_may_be_fixed() -> None:
    launched = launch(
        f'<arg name="x" value="1"/><arg name="y" value="2"/><include {INCLUDE} pass_all_args="true"/>',
        sub('<arg name="x" value="3"/><param name="p" value="$(arg x)$(arg y)"/>'),
    )
    assert (told(launched), values(launched)) == ([], {"/p": 32})


def test_dirname_is_that_of_the_file_it_stands_in() -> None:
    launched = launch(
        '<include file="$(dirname)/more/deep.launch"><arg name="from" value="$(dirname)"/></include>',
        {"bot/launch/more/deep.launch": '<launch><arg name="from"/><include file="$(arg from)/sub.launch"/></launch>'}
        | sub('<param name="p" value="$(dirname)"/>'),
    )
    assert (told(launched), values(launched)) == ([], {"/p": "$(find bot)/launch"})


def test_a_file_outside_any_package() -> None:
    files = {"tools/a.launch": '<launch><include file="$(dirname)/b.launch"/></launch>', "tools/b.launch": "<launch/>"}
    from roslaunch_kit import loader, workspace

    from haros_ci.launch.ros1.roslaunch import evaluate

    launched = evaluate(["tools/a.launch"], workspace(files, {}), loader(files), {}, {})
    assert (told(launched), launched.includes) == ([], ("tools/b.launch",))


def test_cycles_end() -> None:
    launched = launch(f"{node()}<include {INCLUDE}/>", sub('<include file="$(find bot)/launch/main.launch"/>'))
    assert messages(launched) == [f"{SUB}:1: includes {MAIN}, which includes this again, without end; break the cycle"]
    assert names(launched) == ["/n"]


def test_a_recursion_that_counts_down_is_no_cycle() -> None:
    body = (
        '<arg name="n"/><node pkg="p" type="t" name="n$(arg n)"/>'
        f'<include {INCLUDE} if="$(eval n > 1)"><arg name="n" value="$(eval n - 1)"/></include>'
    )
    launched = launch(f'<include {INCLUDE}><arg name="n" value="3"/></include>', sub(body))
    assert (told(launched), names(launched)) == ([], ["/n3", "/n2", "/n1"])


def test_a_recursion_without_end_is_bounded() -> None:
    body = f'<arg name="n"/><include {INCLUDE}><arg name="n" value="$(eval n + 1)"/></include>'
    launched = launch(f'<include {INCLUDE}><arg name="n" value="0"/></include>', sub(body))
    assert messages(launched) == [f"{SUB}:1: groups and includes are nested deeper than 60; {SUB} is left out"]


def test_an_explosion_of_includes_is_bounded() -> None:
    include = '<include file="$(dirname)/{}.launch"/>'.format
    files = {f"bot/launch/{n}.launch": f"<launch>{include(n + 1) * 10}</launch>" for n in range(20)}
    files["bot/launch/20.launch"] = f"<launch>{node()}</launch>"
    launched = run(["bot/launch/0.launch"], files, memo=LaunchMemory(left=50_000))
    assert messages(launched)[-1] == (
        "bot/launch/0.launch:None: the launch files include and set more than can be evaluated; what is left is unknown"
    )


def test_deep_groups_are_bounded() -> None:
    launched = launch("<group>" * 70 + "</group>" * 70)
    assert told(launched) == ["groups and includes are nested deeper than 60; what is inside is left out"]


# Files


def test_several_files_are_one_configuration_with_scopes_of_their_own() -> None:
    files = {MAIN: f'<launch><remap from="a" to="b"/><param name="p" value="1"/>{node()}</launch>'}
    launched = run([MAIN, SUB], files | sub('<param name="p" value="2"/>' + node(name="m")))
    assert [(started.name, pairs(started)) for started in launched.nodes] == [("/n", [("a", "b")]), ("/m", [])]
    assert (values(launched), launched.files) == ({"/p": 2}, (MAIN, SUB))


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (
            "<launch>",
            f"{SUB}:1: the launch file is not well-formed XML: no element found, while <launch> of line 1 is open; correct it",
        ),
        ("\n<robot/>", f"{SUB}:2: not a launch file: its root is <robot>, not <launch>"),
    ],
)
def test_files_that_are_no_launch_files(text: str, message: str) -> None:
    assert messages(run([SUB], {SUB: text})) == [message]
    assert messages(launch(f"<include {INCLUDE}/>", {SUB: text})) == [message]
    assert messages(run([SUB], {})) == [f"{SUB}:None: no such launch file in the workspace; correct its path"]


def test_a_deprecated_file_is_told_where_it_is_included() -> None:
    launched = launch(f"<include {INCLUDE}/>", {SUB: '<launch deprecated="use new.launch"/>'})
    assert told(launched) == [f"includes {SUB}, which is deprecated: 'use new.launch'"]


def test_unknown_tags() -> None:
    launched = launch('<let name="x"/><Node/><master auto="start"/>' + node())
    assert names(launched) == ["/n"]
    assert told(launched) == [
        "roslaunch knows no <let> here; remove it or correct its name",
        "roslaunch knows no <Node> here; remove it or correct its name",
    ]


def test_no_file_at_all() -> None:
    assert run([], {}, args={"a": "1"}).problems == ()


@pytest.mark.parametrize(
    ("before", "count"),
    [
        ("", 1),
        ('<machine name="m" address="a"/>', 0),
        ('<include file="$(find arm)/m.machine"/>', 0),
        ('<include file="$(find bot)/launch/gone.machine"/>', 0),
        ('<include file="$(env X)"/>', 0),
        ('<include file="$(find bot)/launch/here.machine"/>', 1),
        ('<include if="false" file="$(find arm)/m.machine"/>', 1),
    ],
)
def test_a_machine_may_be_declared_where_nobody_can_look(before: str, count: int) -> None:
    launched = launch(before + node('machine="m"'), {"bot/launch/here.machine": "<launch/>"})
    assert [message for message in told(launched) if "machine 'm'" in message] == [
        "machine 'm' is not declared; add a <machine> for it"
    ] * count


def test_launch_files_of_a_workspace_share_their_steps() -> None:
    """What one takes is not left for the next; what was launched before takes nothing."""
    include = '<include file="$(dirname)/{}.launch"/>'.format
    files = {f"bot/launch/{n}.launch": f"<launch>{include(n + 1) * 10}</launch>" for n in range(20)}
    files["bot/launch/20.launch"] = f"<launch>{node()}</launch>"
    memory = LaunchMemory(left=20_000)
    for _ in range(2):
        launched = run(["bot/launch/0.launch"], files, memo=memory)
        assert messages(launched)[-1].endswith("more than can be evaluated; what is left is unknown")
        assert -LEAST < memory.left <= 0
    assert messages(run(["bot/launch/20.launch"], files, memo=memory)) == []
