# SPDX-License-Identifier: Apache-2.0
"""ROS 2 launch files in XML as actions, and what launch refuses of them."""

from __future__ import annotations

import pytest

from haros_ci.extract.launch.ros2_xml import read_ros2_xml
from haros_ci.extract.launch.xml import read_launch
from haros_ci.model.launch_actions import Action, Description, Phrase, Substitution
from haros_ci.model.launch_phrases import MAX_DEPTH, read_phrase

PATH = "bot/launch/a.launch.xml"


def read(body: str) -> Description:
    return read_ros2_xml(read_launch(f"<launch>{body}</launch>"), PATH)


def one(body: str) -> Action:
    description = read(body)
    assert description.problems == ()
    assert len(description.actions) == 1
    return description.actions[0]


def shown(phrase: Phrase | None) -> object:
    """A phrase as plain tuples without places."""
    if phrase is None:
        return None
    return tuple(
        part if isinstance(part, str) else (part.kind, *(shown(argument) for argument in part.arguments))
        for part in phrase
    )


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("", ()),
        ("plain text", ("plain text",)),
        ("$(var x)", (("var", ("x",)),)),
        ("a$(var x)b", ("a", ("var", ("x",)), "b")),
        ("$(var x d)", (("var", ("x",), ("d",)),)),
        ("$(var x '')", (("var", ("x",), ()),)),
        ("$(env $(var v)_X)", (("env", (("var", ("v",)), "_X")),)),
        ("$(find-pkg-share $(var m)_description)/x", (("find-pkg-share", (("var", ("m",)), "_description")), "/x")),
        ("$(find_pkg_share p)", (("find-pkg-share", ("p",)),)),
        ("$(dirname)/a", (("dirname",), "/a")),
        ("$(eval \"'$(var m)' == 'a b'\")", (("eval", ("'", ("var", ("m",)), "' == 'a b'")),)),
        ("$(eval '\"$(var m)\" + 1')", (("eval", ('"', ("var", ("m",)), '" + 1')),)),
        (r"\$(var x)", ("$(var x)",)),
        (r"a\\b", (r"a\b",)),
        (r"$(var a\(b\))", (("var", ("a(b)",)),)),
        ("$5 and ($)", ("$5 and ($)",)),
        ("$(or $(var a) $(not $(var b)))", (("or", (("var", ("a",)),), (("not", (("var", ("b",)),)),)),)),
    ],
)
def test_substitutions(text: str, expected: object) -> None:
    phrase, problem = read_phrase(text)
    assert problem == ""
    assert shown(phrase) == expected


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("$(var x", "the substitution '$(var' is not closed"),
        ("$()", "no name of a substitution stands behind '$('; escape it as '\\$(' if it is text"),
        ("$(arg x)", "launch knows no substitution '$(arg)'; correct its name"),
        ("$(var)", "'$(var)' has 0 arguments and needs 1 to 2; quote what holds a space"),
        ("$(eval 1 + 1)", "'$(eval 1 + 1)' has 3 arguments and needs 1 to 2; quote what holds a space"),
        ("$(eval 'a)", "a ' is not closed"),
        ("$(var a(b))", "a ( stands in an argument; quote the argument, or write \\("),
        ("$(not " * (MAX_DEPTH + 1), f"substitutions are nested deeper than {MAX_DEPTH}"),
    ],
)
def test_substitutions_that_cannot_be_read_are_unknown(text: str, message: str) -> None:
    phrase, problem = read_phrase(text)
    assert problem == message
    assert len(phrase) == 1
    assert isinstance(phrase[0], Substitution)
    assert (phrase[0].kind, phrase[0].reason) == ("?", message)


def test_a_node_with_everything() -> None:
    action = one(
        '<node pkg="p" exec="e" name="n" namespace="/a" args="-x" ros_args="-r a:=b" exec_name="z" respawn="true"'
        ' launch-prefix="gdb" if="$(var c)" output="screen">'
        '<env name="E" value="1"/><remap from="a" to="b"/><param name="i" value="1"/></node>'
    )
    assert (action.kind, action.location.line, action.location.column) == ("node", 1, 9)
    for name, expected in {
        "package": ("p",),
        "executable": ("e",),
        "name": ("n",),
        "namespace": ("/a",),
        "args": ("-x",),
        "ros_args": ("-r a:=b",),
        "exec_name": ("z",),
        "respawn": ("true",),
        "launch-prefix": ("gdb",),
    }.items():
        assert action.get(name) == expected
    assert [(test.kind, test.text) for test in action.tests] == [("if", "$(var c)")]
    assert action.environment == ((("E",), ("1",)),)
    assert [(source, target) for source, target, _ in action.remaps] == [(("a",), ("b",))]
    assert [source.values for source in action.parameters] == [((("i",), 1),)]


@pytest.mark.parametrize(
    ("attributes", "value", "types"),
    [
        ('value="1"', 1, ()),
        ('value="1.5"', 1.5, ()),
        ('value="true"', True, ()),
        ('value="on"', True, ()),
        ('value="text"', "text", ()),
        ("value=\"'1'\"", "1", ()),
        ('value=""', "", ()),
        ('value="[1, 2]"', [1, 2], ()),
        ('value="{a: 1}"', "{a: 1}", ()),
        ('value="1" type="str"', "1", (("x", "str"),)),
        ('value="1;2" value-sep=";"', [1, 2], ()),
        ('value="$(var a)" type="int"', (Substitution("var", (("a",),)),), (("x", "int"),)),
        ('value="1" type="list_of_int"', 1, (("x", "int_array"),)),
    ],
)
def test_values_of_parameters(attributes: str, value: object, types: object) -> None:
    source = one(f'<node pkg="p" exec="e"><param name="x" {attributes}/></node>').parameters[0]
    found = source.values[0][1]
    if isinstance(found, tuple):
        found = tuple(Substitution(p.kind, p.arguments) if isinstance(p, Substitution) else p for p in found)
    assert found == value
    assert type(found) is type(value)
    assert source.types == types


def test_nested_parameters_and_files() -> None:
    action = one(
        '<node pkg="p" exec="e"><param name="a"><param name="b" value="1"/><param name="c"><param name="d" value="x"/>'
        '</param></param><param from="$(dirname)/f.yaml" allow_substs="true"/></node>'
    )
    nested, file = action.parameters
    assert nested.values == ((("a", ".", "b"), 1), (("a", ".", "c", ".", "d"), "x"))
    assert (file.kind, file.substitutes, shown(file.path)) == ("file", True, (("dirname",), "/f.yaml"))


def test_containers_and_loads() -> None:
    inner = '<composable_node pkg="p" plugin="n::C" name="c" namespace="x" unless="false"><remap from="a" to="b"/>'
    inner += '<extra_arg name="use_intra_process_comms" value="true"/></composable_node>'
    container = one(
        f'<node_container pkg="r" exec="component_container" name="k" namespace="">{inner}</node_container>'
    )
    load = one(f'<load_composable_node target="/k">{inner}</load_composable_node>')
    assert (container.kind, load.kind) == ("container", "load")
    assert load.get("target") == ("/k",)
    for child in (container.children[0], load.children[0]):
        assert child.kind == "component"
        assert child.get("plugin") == ("n::C",)
        assert child.arguments == ((("use_intra_process_comms",), ("true",)),)
        assert [test.kind for test in child.tests] == ["unless"]


@pytest.mark.parametrize(
    ("body", "kind"),
    [
        ('<arg name="a" default="b" description="d"><choice value="b"/></arg>', "arg"),
        ('<let name="a" value="b"/>', "let"),
        ('<group scoped="false"><keep name="a" value="b"/></group>', "group"),
        ('<include file="f"><arg name="a" value="b"/></include>', "include"),
        ('<executable cmd="ls -l" cwd="/" shell="true"/>', "executable"),
        ('<push-ros-namespace namespace="a"/>', "push-namespace"),
        ('<push_ros_namespace namespace="a"/>', "push-namespace"),
        ('<set_remap from="a" to="b"/>', "set-remap"),
        ('<set_parameter name="a" value="1"/>', "set-parameter"),
        ('<set_parameters_from_file filename="f"/>', "set-parameters-from-file"),
        ('<set_use_sim_time value="true"/>', "set-use-sim-time"),
        ('<set_env name="a" value="b"/>', "set-env"),
        ('<unset_env name="a"/>', "unset-env"),
        ('<append_env name="a" value="b" prepend="true" separator=";"/>', "append-env"),
        ("<reset_env/>", "reset-env"),
        ('<reset><keep name="a" value="b"/></reset>', "reset"),
        ('<timer period="2.0"><log message="x"/></timer>', "event"),
        ('<ros_timer period="2.0"/>', "event"),
        ('<shutdown reason="x"/>', "shutdown"),
        ('<log message="x"/>', "log"),
    ],
)
def test_kinds(body: str, kind: str) -> None:
    assert one(body).kind == kind


@pytest.mark.parametrize(
    ("body", "message"),
    [
        ("<nodes/>", "launch knows no <nodes> here; did you mean <node>?"),
        ('<node pkg="p" type="e"/>', "<node> has no attribute 'type'; write exec"),
        (
            '<node pkg="p" exec="e"><arg name="a"/></node>',
            "<arg> cannot stand in <node>; remove it or correct its name",
        ),
        ('<let name="a"/>', "<let> needs the attribute 'value'; add it"),
        ('<log message="x" if="a" unless="b"/>', "<log> has both 'if' and 'unless'; keep one"),
        ('<node pkg="p" exec="e"><param value="1"/></node>', "<param> needs 'name' or 'from'; add one"),
        ('<node pkg="p" exec="e"><param name="x"/></node>', "<param> needs 'value' or <param>s in it; add one"),
        ('<let name="a" value="$(var"/>', "the substitution '$(var' is not closed"),
    ],
)
def test_what_is_refused_is_reported(body: str, message: str) -> None:
    assert (1, message) in read(body).problems


def test_what_is_no_launch_file() -> None:
    assert read_ros2_xml(read_launch("<robot/>"), PATH).problems == (
        (1, "not a launch file: its root is <robot>, not <launch>"),
    )
    assert read_ros2_xml(read_launch("<launch>"), PATH).actions == ()
