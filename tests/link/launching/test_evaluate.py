# SPDX-License-Identifier: Apache-2.0
"""Launch descriptions performed: arguments, scopes, includes, conditions, names and remaps."""

from __future__ import annotations

import pytest
from launching_kit import HERE, MAIN, launch, loader, names, node, only, perform, remaps, told, workspace

from haros_ci.launch.ros2.evaluate import launch_system
from haros_ci.launch.ros2.places import Places
from haros_ci.model.build import Build
from haros_ci.model.launch_actions import Action, Description, LaunchContext, Performed, Substitution
from haros_ci.model.launch_actions import Test as Asked
from haros_ci.model.workspace import Problem

ARG = '<arg name="a" default="x"/>'


def test_a_node() -> None:
    started = only(launch(node('namespace="s" args="-a --ros-args -r b:=c -- d" ros_args="-p e:=1"')))
    assert (started.kind, started.package, started.type) == ("node", "p", "e")
    assert (started.name, started.namespace) == ("n", "/s")
    assert (started.arguments, started.ros_arguments) == ("-a d", "-r b:=c -p e:=1")
    assert started.unknowns == ()


def test_what_is_not_given_is_none() -> None:
    started = only(launch('<node pkg="p" exec="e"/>'))
    assert (started.name, started.namespace, started.container) == (None, None, None)


@pytest.mark.parametrize(
    ("pushed", "own", "expected"),
    [
        ("", 'namespace="a"', "/a"),
        ("a", "", "/a"),
        ("a", 'namespace=""', "/a"),
        ("a", 'namespace="b"', "/a/b"),
        ("a", 'namespace="/b"', "/b"),
        ("/a/", 'namespace="b/"', "/a/b"),
        ("/", 'namespace="b"', "/b"),
        ("", 'namespace=""', "/"),
    ],
)
def test_namespaces(pushed: str, own: str, expected: str) -> None:
    push = f'<push-ros-namespace namespace="{pushed}"/>' if pushed else ""
    assert only(launch(f"<group>{push}{node(own)}</group>")).namespace == expected


def test_pushed_namespaces_join_and_end_with_the_scope() -> None:
    body = '<group><push_ros_namespace namespace="a"/><group><push_ros_namespace namespace="b"/>'
    body += node() + "</group>" + node() + '</group><group scoped="false"><push_ros_namespace namespace="c"/></group>'
    assert names(launch(body + node())) == ["/a/b n", "/a n", "/c n"]


def test_arguments() -> None:
    body = ARG + '<arg name="b"/>' + node('args="$(var a) $(var b)"')
    system = launch(body)
    assert system.arguments == (("a", "x"), ("b", "?"))
    assert only(system).arguments == "x ?"
    assert [(u.field, u.reason) for u in only(system).unknowns] == [
        ("arguments", "launch argument 'b' has no default and is not given")
    ]
    assert only(launch(body, args={"a": "1", "b": "2"})).arguments == "1 2"
    assert told(launch(body, args={"c": "1"})) == ["argument 'c' is set, but not declared; correct its name"]


def test_the_first_declaration_counts_and_let_replaces() -> None:
    assert only(launch(ARG + '<arg name="a" default="y"/>' + node('args="$(var a)"'))).arguments == "x"
    assert only(launch(ARG + '<let name="a" value="$(var a)z"/>' + node('args="$(var a)"'))).arguments == "xz"


def test_scoped_groups_restore_configurations_and_environment() -> None:
    inner = '<let name="a" value="y"/><set_env name="E" value="1"/>' + node('args="$(var a) $(env E 0)"')
    after = node('args="$(var a) $(env E 0)"')
    system = launch(ARG + f"<group>{inner}</group>" + after)
    assert [n.arguments for n in system.nodes] == ["y 1", "x 0"]
    assert [n.environment for n in system.nodes] == [(("E", "1"),), ()]
    system = launch(ARG + f'<group scoped="false">{inner}</group>' + after)
    assert [n.arguments for n in system.nodes] == ["y 1", "y 1"]


def test_groups_that_do_not_forward_keep_only_what_they_say() -> None:
    body = '<push_ros_namespace namespace="s"/><group forwarding="false"><keep name="k" value="$(var a)"/>'
    started = only(launch(ARG + body + node('args="$(var k) $(var a none)"') + "</group>"))
    assert (started.arguments, started.namespace) == ("x none", None)


def test_reset_clears_configurations() -> None:
    body = ARG + '<push_ros_namespace namespace="s"/><reset><keep name="k" value="$(var a)"/></reset>'
    started = only(launch(body + node('args="$(var k) $(var a none)"')))
    assert (started.arguments, started.namespace) == ("x none", None)


@pytest.mark.parametrize(
    ("action", "expected"),
    [
        ('<append_env name="E" value="b"/>', "a:b"),
        ('<append_env name="E" value="b" prepend="true" separator=";"/>', "b;a"),
        ('<append_env name="F" value="b"/>', "a"),
        ('<unset_env name="E"/>', "none"),
        ('<set_env name="E" value="c"/><reset_env/>', "a"),
    ],
)
def test_environment(action: str, expected: str) -> None:
    assert only(launch(action + node('args="$(env E none)"'), env={"E": "a"})).arguments == expected


PART = "bot/launch/part.launch.xml"
INCLUDE = '<include file="$(dirname)/part.launch.xml">{}</include>'


def test_includes_leak_configurations_unless_in_a_group() -> None:
    part = {PART: '<launch><arg name="b" default="d"/><let name="a" value="y"/>' + node(name="i") + "</launch>"}
    after = node('args="$(var a) $(var b none)"')
    system = launch(ARG + INCLUDE.format("") + after, part)
    assert [n.arguments for n in system.nodes] == ["", "y d"]
    assert system.includes == (PART,)
    assert system.files == (MAIN, PART)
    assert system.arguments == (("a", "x"),)
    system = launch(ARG + f"<group>{INCLUDE.format('')}</group>" + after, part)
    assert [n.arguments for n in system.nodes] == ["", "x none"]


def test_arguments_of_includes_are_set_one_after_the_other() -> None:
    part = {PART: '<launch><arg name="b" default="d"/>' + node('args="$(var b) $(var c)"') + "</launch>"}
    given = '<arg name="b" value="1"/><arg name="c" value="$(var b)2"/>'
    assert only(launch(INCLUDE.format(given), part)).arguments == "1 12"


def test_an_include_without_a_needed_argument_is_reported() -> None:
    part = {PART: '<launch><arg name="a"/>' + node('args="$(var a)"') + "</launch>"}
    system = launch(ARG + INCLUDE.format(""), part)
    assert told(system) == [f"includes {PART} without its argument 'a', which has no default; pass it"]
    assert only(system).arguments == "x"


@pytest.mark.parametrize(
    ("file", "message"),
    [
        ("$(find-pkg-share other)/launch/a.xml", "package 'other' is not in the workspace; what it starts is unknown"),
        ("/opt/a.launch.xml", "'/opt/a.launch.xml' is an absolute path outside of the workspace"),
        ("a.launch.xml", "'a.launch.xml' depends on where launch is started"),
        ("$(find-pkg-share bot)/../../a.xml", "leads out of the workspace"),
        ("$(find-pkg-share bot)/no.launch.xml", "includes bot/no.launch.xml, which is not in the workspace"),
        (
            "$(var x)",
            "includes a launch file by a path that is not known: launch configuration 'x' is not set; what it starts is unknown",
        ),
        ("$(find-pkg-share bot)/$(var x)", "launch configuration 'x' is not set; what it starts is unknown"),
        ("$(find-pkg-share bot)/one.launch", "which is no ROS 2 launch file; correct the path"),
    ],
)
def test_includes_that_lead_nowhere_are_reported(file: str, message: str) -> None:
    files = {"bot/one.launch": '<launch><node pkg="p" type="t" name="n"/></launch>'}
    system = launch(f'<include file="{file}"/>' + node(), files)
    assert len(told(system)) == 1
    assert message in told(system)[0]
    assert names(system) == ["- n"]


def test_an_include_that_setup_py_may_install_from_elsewhere() -> None:
    build = Build(package="bot", problems=(Problem("bot/setup.py", "data_files is computed when setup.py runs", 3),))
    body = '<include file="$(find-pkg-share bot)/{}.launch.xml"/>' + node()
    (message,) = told(launch(body.format("part"), {PART: "<launch/>"}, builds={"bot": build}))
    assert message == (
        "includes bot/part.launch.xml, which setup.py may install, as it computes data_files when it runs; "
        "what it starts is unknown"
    )
    for name, builds in (("gone", {"bot": build}), ("part", {"bot": Build(package="bot")}), ("part", {})):
        (message,) = told(launch(body.format(name), {PART: "<launch/>"}, builds=builds))
        assert message == f"includes bot/{name}.launch.xml, which is not in the workspace; correct the path"


def test_endless_includes_end() -> None:
    system = launch('<include file="$(dirname)/main.launch.xml"/>' + node())
    assert told(system) == [f"includes {MAIN}, which includes this again, without end; break the cycle"]
    growing = '<let name="a" value="$(var a)x"/><include file="$(dirname)/main.launch.xml"/>'
    assert "are nested deeper than" in told(launch(ARG + growing))[0]


def test_many_includes_end() -> None:
    twice = "".join(
        f'<include file="$(dirname)/part.launch.xml"><arg name="a" value="$(var a){n}"/></include>' for n in "12"
    )
    system = launch('<arg name="a" default=""/>' + twice, {PART: f'<launch><arg name="a"/>{twice}</launch>'})
    assert told(system)[-1] == "the launch files start and include more than can be evaluated; what is left is unknown"


def test_conditions_that_are_known_decide() -> None:
    body = '<arg name="t" default="True"/><arg name="f" default="0"/>'
    for condition in (
        'if="$(var t)"',
        'unless="$(var f)"',
        "if=\"$(eval \"'$(var f)' == '0'\")\"".replace('"', "&quot;"),
    ):
        attribute = condition if "eval" not in condition else "if=\"$(eval &quot;'$(var f)' == '0'&quot;)\""
        assert only(launch(body + node(attribute))).conditions == ()
    assert names(launch(body + node('if="$(var f)"') + node('unless="$(var t)"'))) == []


def test_undecided_conditions_stay_with_what_they_are_about() -> None:
    body = (
        '<arg name="t"/><group if="$(var t)"><push_ros_namespace namespace="s"/>'
        + node('unless="$(var t)"')
        + "</group>"
    )
    started = only(launch(body))
    assert [(c.statement, c.condition) for c in started.conditions] == [("if", "$(var t)"), ("unless", "$(var t)")]
    assert started.namespace == "/s"


def test_what_is_set_under_an_undecided_condition_is_unknown_after_it() -> None:
    body = '<arg name="t"/>' + ARG + '<let name="a" value="y" if="$(var t)"/>' + node('args="$(var a)"')
    started = only(launch(body))
    assert started.arguments == "?"
    assert started.unknowns[0].reason == "it depends on the condition '$(var t)', which is not decided"
    same = '<arg name="t"/>' + ARG + '<let name="a" value="x" if="$(var t)"/>' + node('args="$(var a)"')
    assert only(launch(same)).arguments == "x"
    pushed = '<arg name="t"/><push_ros_namespace namespace="s" if="$(var t)"/>' + node()
    assert only(launch(pushed)).namespace == "/?"


def test_inside_a_condition_what_is_set_is_known() -> None:
    body = '<arg name="t"/><group if="$(var t)" scoped="false"><let name="a" value="y"/><set_remap from="b" to="c"/>'
    system = launch(body + node('args="$(var a)"') + "</group>" + node('args="$(var a)"'))
    assert [n.arguments for n in system.nodes] == ["y", "?"]
    assert (remaps(system), remaps(system, 1)) == ([("b", "c")], [("b", "?")])


def test_a_condition_that_is_no_boolean_is_reported() -> None:
    system = launch(ARG + node('if="$(var a)"'))
    assert told(system) == ["the condition '$(var a)' is 'x'; it must be true, false, 1 or 0"]
    assert [c.condition for c in only(system).conditions] == ["$(var a)"]


def test_remaps_of_the_scope_precede_those_of_the_node() -> None:
    own = '<remap from="a" to="$(var a)"/>'
    body = ARG + f'<group><set_remap from="a" to="b"/>{node("", own)}</group>{node("", own)}'
    system = launch(body)
    assert remaps(system) == [("a", "b"), ("a", "x")]
    assert remaps(system, 1) == [("a", "x")]


def test_a_list_of_remaps_begun_outside_of_a_group_is_changed_for_good() -> None:
    system = launch('<set_remap from="a" to="b"/><group><set_remap from="c" to="d"/></group>' + node())
    assert remaps(system) == [("a", "b"), ("c", "d")]


COMPONENT = '<composable_node pkg="q" plugin="q::C" name="c" {}><remap from="in" to="out"/></composable_node>'


def test_containers_and_their_components() -> None:
    body = '<group><push_ros_namespace namespace="s"/><set_remap from="x" to="y"/>'
    body += '<node_container pkg="r" exec="component_container" name="k" namespace="">'
    body += COMPONENT.format('namespace="t"') + COMPONENT.format('if="false"') + "</node_container></group>"
    container, component = launch(body).nodes
    assert (container.kind, container.namespace, container.name) == ("container", "/s", "k")
    assert (component.kind, component.package, component.type) == ("component", "q", "q::C")
    assert (component.namespace, component.container) == ("/s/t", "/s/k")
    assert [pair[:2] for pair in component.remaps] == [("x", "y"), ("in", "out")]


@pytest.mark.parametrize(("target", "container"), [("k", "/k"), ("/s/k", "/s/k"), ("$(var k)", "/?")])
def test_the_target_of_a_load_is_not_below_the_pushed_namespace(target: str, container: str) -> None:
    body = f'<push_ros_namespace namespace="s"/><load_composable_node target="{target}">{COMPONENT.format("")}'
    started = only(launch(body + "</load_composable_node>"))
    assert (started.namespace, started.container) == ("/s", container)
    assert [u.field for u in started.unknowns] == (["container"] if "$" in target else [])


def test_timers_are_conditions_and_come_after_all_scopes() -> None:
    body = ARG + '<group><push_ros_namespace namespace="s"/><timer period="2.0">' + node('args="$(var a)"')
    body += '</timer></group><let name="a" value="y"/>'
    started = only(launch(body))
    assert [(c.statement, c.condition) for c in started.conditions] == [("if", "after 2.0 s")]
    assert (started.namespace, started.arguments) == (None, "y")


@pytest.mark.parametrize(
    ("cmd", "expected"),
    [
        ("ros2 run p e a --ros-args -r b:=c", ("p", "e", "a", "-r b:=c")),
        ("ros2 run p $(var a)", ("p", "x", "", "")),
        ("ros2 topic list", None),
        ("ros2 run --prefix gdb p e", ("p", "e", "", "")),
        ("ros2 run --prefix=gdb p e a", ("p", "e", "a", "")),
        ("$(find-exec ros2) run p e", ("p", "e", "", "")),
        ("$(exec-in-pkg e p) a --ros-args -p x:=1", ("p", "e", "a", "-p x:=1")),
        ("python3 $(find-pkg-prefix p)/lib/p/e.py a", ("p", "e.py", "a", "")),
        ("$(find-pkg-prefix p)/lib/q/e", None),
        ("$(find-pkg-prefix p)/bin/e", None),
        ("ros2 run --prefix gdb", None),
        ("ros2 run p", None),
        ("$(find-exec gdb) run p e", None),
        ("gzserver", None),
        ("env ros2 run p e", ("p", "e", "", "")),
        ("env -i A=b ros2 run p e a", ("p", "e", "a", "")),
        ("bash -c 'ros2 run p e'", ("p", "e", "", "")),
        ("/bin/bash -lc 'sleep 1 &amp;&amp; exec ros2 run p e a'", ("p", "e", "a", "")),
        ("exec ros2 run p e", ("p", "e", "", "")),
        ("'sleep 1 &amp;&amp; ros2 run p e'", ("p", "e", "", "")),
        ("sleep 1; nice -n 5 ros2 run p e &amp;", ("p", "e", "", "")),
        ("sh -c 'env bash -c \\'ros2 run p e\\''", None),
        ("bash run.sh ros2 run p e", None),
        ("bash -c 'echo ros2 run p e'", None),
        ("echo ros2 run p e", None),
        ("echo 'sleep 1 &amp;&amp; ros2 run p e'", None),
        ("gnuplot -c 'ros2 run p e'", None),
        ("env", None),
        ("bash -c", None),
        ("ros2 topic pub /a x '{b: 1}; c'", ("ros2topic", "pub", "/a x '{b: 1}; c'", "")),
    ],
)
def test_executables(cmd: str, expected: tuple[str, ...] | None) -> None:
    found = launch(ARG + f'<executable cmd="{cmd}"/>').nodes
    assert [(n.package, n.type, n.arguments, n.ros_arguments) for n in found] == ([expected] if expected else [])


def test_several_executables_of_one_line() -> None:
    found = launch("""<executable cmd="ros2 run p a &amp; ros2 run p b; bash -c 'ros2 run p c | tee d'"/>""").nodes
    assert [n.type for n in found] == ["a", "b", "c"]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("$(not $(var t))", "false"),
        ("$(and true $(var u))", "?"),
        ("$(and false $(var u))", "false"),
        ("$(or 1 $(var u))", "true"),
        ("$(any)", "false"),
        ("$(all on yes)", "true"),
        ("$(equals 1 1.0)", "true"),
        ("$(equals True 1)", "true"),
        ("$(not-equals a b)", "true"),
        ("$(if $(var t) a b)", "a"),
        ("$(if $(var u) a a)", "a"),
        ("$(find-pkg-share q)/x", "$(find-pkg-share q)/x"),
        ("$(find-pkg-prefix q)/x", "$(find-pkg-prefix q)/x"),
        ("$(exec-in-pkg e q)", "$(find-pkg-prefix q)/lib/q/e"),
        ("$(dirname)/x", "$(workspace bot/launch)/x"),
        ("$(filename)", "$(workspace bot/launch)/main.launch.xml"),
        ("$(file-content $(dirname)/f.txt)", "content"),
        ("$(command 'ls')", "?"),
        ("$(anon n)", "n_?"),
        ("$(log_dir)", "?"),
        ("$(find-exec ls)", "?"),
        ("$(env HOME)", "?"),
        ("$(env HOME /h)", "/h"),
        ("$(param p)", "1"),
        ("$(param q none)", "none"),
    ],
)
def test_substitutions(text: str, expected: str) -> None:
    body = '<arg name="t" default="true"/><arg name="u"/><set_parameter name="p" value="1"/>'
    started = only(launch(body + node(f'launch-prefix="{text}"'), {"bot/launch/f.txt": "content"}))
    assert started.launch_prefix == expected
    assert [u.field for u in started.unknowns] == (["launch_prefix"] if "?" in expected else [])


def test_files_are_found_as_they_are_installed() -> None:
    files = {"bot/launch/robot/a.launch.xml": f"<launch>{node()}</launch>"}
    assert names(launch('<include file="$(find-pkg-share bot)/launch/robot/a.launch.xml"/>', files)) == ["- n"]
    prefix = '<include file="$(find-pkg-prefix bot)/share/bot/launch/robot/a.launch.xml"/>'
    assert names(launch(prefix, files)) == ["- n"]


def test_an_opaque_function_gets_the_context() -> None:
    def function(context: LaunchContext) -> tuple[Action, ...]:
        value = context.configuration("a")
        assert value is not None
        assert value == Performed("x")
        assert context.configuration("none") is None
        assert context.test(Asked(kind="equals", phrases=(("a",), ("x",)))) is True
        assert context.perform((Substitution("var", (("none",),)),)).text == "?"
        context.set_configuration("b", Performed("y?", "why"))
        phrases = (("package", ("p",)), ("executable", (value.text,)), ("args", (Substitution("var", (("b",),)),)))
        return (Action(kind="node", location=HERE, phrases=phrases),)

    let = Action(kind="let", location=HERE, phrases=(("name", ("a",)), ("value", ("x",))))
    started = only(perform(let, Action(kind="opaque", location=HERE, function=function)))
    assert (started.type, started.arguments) == ("x", "y?")
    assert [(u.field, u.reason) for u in started.unknowns] == [("arguments", "why")]


def test_an_opaque_function_that_fails_is_a_problem() -> None:
    def function(context: LaunchContext) -> tuple[Action, ...]:
        raise KeyError("x")

    system = perform(Action(kind="opaque", location=HERE, function=function))
    assert told(system) == ["what this function returns is not known: 'x'"]


def test_actions_of_which_nothing_is_known_are_problems() -> None:
    system = perform(Action(kind="?", location=HERE, reason="a loop without end"))
    assert told(system) == ["what this does is not known: a loop without end"]


def test_conditions_of_python() -> None:
    phrases = (("package", ("p",)), ("executable", ("e",)))
    tests = (
        Asked(kind="equals", phrases=(("a",), ("x",)), text="a == x"),
        Asked(kind="not-equals", phrases=(("a",), ("x",)), text="a != x"),
        Asked(kind="?", reason="a lambda"),
    )
    let = Action(kind="let", location=HERE, phrases=(("name", ("a",)), ("value", ("x",))))
    system = perform(let, *(Action(kind="lifecycle-node", location=HERE, phrases=phrases, tests=(t,)) for t in tests))
    assert [(n.kind, [c.condition for c in n.conditions]) for n in system.nodes] == [
        ("lifecycle", []),
        ("lifecycle", ["a lambda"]),
    ]


def test_a_memo_keeps_what_was_launched() -> None:
    files = {MAIN: f"<launch>{node()}</launch>"}
    places = Places(workspace(files))
    memo: dict[tuple[object, ...], object] = {}
    load = loader(files)
    first = launch_system((MAIN,), places.workspace, load, {}, {}, places, memo)  # type: ignore[arg-type]
    assert launch_system((MAIN,), places.workspace, load, {}, {}, places, memo) is first  # type: ignore[arg-type]


def test_python_files_are_included_like_others() -> None:
    phrases = (("package", ("p",)), ("executable", ("e",)), ("name", ("py",)))
    python = {"bot/launch/x.launch.py": Description(actions=(Action(kind="node", location=HERE, phrases=phrases),))}
    files = {"bot/launch/x.launch.py": "#"}
    assert names(launch('<include file="$(dirname)/x.launch.py"/>', files, python=python)) == ["- py"]
