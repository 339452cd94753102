# SPDX-License-Identifier: Apache-2.0
"""Parameters of ROS 1 launch files: ``<param>`` and ``<rosparam>``, their names, types, values and lines."""

from __future__ import annotations

import math
from typing import Any

import pytest
from roslaunch_kit import MAIN, launch, messages, node, run, told, values

from haros_ci.model.architecture import Condition, Parameter, Unknown
from haros_ci.model.location import Location

YAML = "bot/config/p.yaml"
LOAD = '<rosparam file="$(find bot)/config/p.yaml"/>'


def param(value: str, kind: str = "", name: str = "p") -> str:
    return f'<param name="{name}" value="{value}"' + (f' type="{kind}"/>' if kind else "/>")


def only(body: str, files: dict[str, str] | None = None, **more: Any) -> Parameter:
    launched = launch(body, files, **more)
    assert told(launched) == []
    (parameter,) = launched.parameters
    return parameter


# <param>


@pytest.mark.parametrize(
    ("value", "kind", "type_", "made"),
    [
        ("1", "", "int", 1),
        (" -7 ", "", "int", -7),
        ("1_000", "", "str", "1_000"),
        ("1.5", "", "double", 1.5),
        ("1.", "auto", "double", 1.0),
        ("1.0e3", "", "double", 1000.0),
        ("1e3", "", "str", "1e3"),
        ("0x10", "", "str", "0x10"),
        ("1.2.3", "", "str", "1.2.3"),
        ("TRUE", "", "bool", True),
        ("false", "", "bool", False),
        ("yes", "", "str", "yes"),
        ("", "", "str", ""),
        ("nan", "", "str", "nan"),
        (" a  b ", "", "str", "a  b"),
        ("1", "str", "str", "1"),
        ("true", "string", "str", "true"),
        ("1", "double", "double", 1.0),
        ("12", "INT", "int", 12),
        ("1", "bool", "bool", True),
        ("False", "boolean", "bool", False),
        ("[1, a, {b: 2}]", "yaml", "yaml", [1, "a", {"b": 2}]),
        ("{}", "yaml", "yaml", {}),
        ("2.5", "yaml", "double", 2.5),
        ("{a: 1}", "", "str", "{a: 1}"),
        ("$(find elsewhere)/x.yaml", "", "str", "$(find elsewhere)/x.yaml"),
        ("9" * 200, "", "str", "9" * 200),
    ],
)
def test_types_and_values(value: str, kind: str, type_: str, made: object) -> None:
    assert only(param(value, kind)) == Parameter(name="/p", type=type_, value=made, location=Location(MAIN, 1, 9))


def test_a_map_becomes_its_leaves() -> None:
    launched = launch(param("{a: 1, b: {c: [2], d: {}}}", "yaml"))
    assert (told(launched), values(launched)) == ([], {"/p/a": 1, "/p/b/c": [2], "/p/b/d": {}})


@pytest.mark.parametrize(
    ("tag", "message"),
    [
        ('<param value="1"/>', "<param> lacks the attribute 'name'; add it"),
        ('<param name=" " value="1"/>', "<param> has an empty name; give it one. The tag is left out"),
        ('<param name="p"/>', "<param name='p'> needs one of value, textfile, binfile, command, and only one"),
        (
            '<param name="p" value="1" command="ls"/>',
            "<param name='p'> needs one of value, textfile, binfile, command, and only one",
        ),
        (
            param("1", "float"),
            "<param name='p' type='float'>: write one of auto, str, string, int, double, bool, boolean, yaml",
        ),
        (param("1.5", "int"), "<param name='p'>: '1.5' is no int; correct it"),
        (param("x", "double"), "<param name='p'>: 'x' is no double; correct it"),
        (param("yes", "bool"), "<param name='p'>: 'yes' is no bool; correct it"),
        (
            param("[1", "yaml"),
            "<param name='p'>: not valid YAML: did not find expected ',' or ']' (a bracket is not closed, or a comma is missing); correct it",
        ),
        (param("", "yaml"), "'p' has no value (null): roslaunch cannot set it; give it one"),
        (
            param("{/a: 1}", "yaml"),
            (
                "'p': no node can read the key '/a' of a map in a <param>; keys are texts without a leading / or ~, or use"
                " <rosparam>"
            ),
        ),
    ],
)
def test_params_that_roslaunch_refuses_are_left_out(tag: str, message: str) -> None:
    launched = launch(tag + param("1", name="rest"))
    assert (told(launched), values(launched)) == ([message], {"/rest": 1})


@pytest.mark.parametrize(
    ("tag", "message"),
    [
        (
            "<rosparam>a: [</rosparam>",
            "YAML of <rosparam>: not valid YAML: did not find expected node content; correct it",
        ),
        ("<rosparam>a: !x 1</rosparam>", "YAML of <rosparam>: tag '!x' is not known to roslaunch; write plain data"),
        (
            "<rosparam>a: !!python/object/apply:os.system [ls]</rosparam>",
            (
                "YAML of <rosparam>: tag 'tag:yaml.org,2002:python/object/apply:os.system' is not allowed; write plain"
                " lists and maps"
            ),
        ),
        ("<rosparam>a: deg(x)</rosparam>", "YAML of <rosparam>: 'deg(x)' is no angle; write deg(90) or rad(pi/2)"),
        (
            "<rosparam>{a: 1}\n---\n{b: 1}</rosparam>",
            f"{MAIN}:2: YAML of <rosparam>: a second document begins here; keep one",
        ),
        ("<rosparam>a: *b</rosparam>", "YAML of <rosparam>: alias 'b' is not defined above; write the value out"),
        ("<rosparam>a: &amp;b [*b]</rosparam>", "YAML of <rosparam>: alias 'b' contains itself; write the value out"),
        ("<rosparam>[a]: 1</rosparam>", "YAML of <rosparam>: a list or map cannot be a key; use text"),
        (
            '<rosparam file="$(find arm)/p.yaml"/>',
            "<rosparam> loads '$(find arm)/p.yaml': package 'arm' is not in the workspace; what it sets is unknown",
        ),
        (
            '<rosparam file="$(find bot)/q.yaml"/>',
            "<rosparam> loads '$(find bot)/q.yaml': bot/q.yaml is no text file of the workspace",
        ),
        (
            '<rosparam file="$(env X)"/>',
            "<rosparam> loads '?': environment variable 'X' is not given; what it sets is unknown",
        ),
    ],
)
def test_a_rosparam_that_cannot_be_read_may_set_anything(tag: str, message: str) -> None:
    launched = launch(tag + param("1", name="rest"))
    assert (told(launched), values(launched)) == ([message], {"/?": None, "/rest": 1})
    unknowns = launched.parameters[0].unknowns
    assert [entry.field for entry in unknowns] == ["name", "value", "type"]
    assert all(entry.reason.startswith(("<rosparam>", "the YAML of <rosparam>")) for entry in unknowns)


def test_an_unknown_attribute_and_a_number_too_large() -> None:
    launched = launch('<param name="p" value="1" default="2"/>' + param("4294967296", name="q"))
    assert values(launched) == {"/p": 1, "/q": 4294967296}
    assert told(launched) == [
        "<param> has no attribute 'default'; remove it or correct its name",
        "an integer of more than 32 bits: roslaunch cannot set it; make it smaller",
    ]


def test_names_in_scopes() -> None:
    launched = launch(
        param("1", name="a")
        + f'<group ns="g">{param("2", name="b")}{param("3", name="/c")}{param("4", name="h/d/")}</group>'
        + node('ns="s"', param("5", name="e") + param("6", name="~f") + param("7", name="/g"))
    )
    assert told(launched) == []
    assert values(launched) == {"/a": 1, "/g/b": 2, "/c": 3, "/g/h/d": 4, "/s/n/e": 5, "/s/n/f": 6, "/s/n/g": 7}


def test_private_params_of_a_scope_are_for_the_nodes_after_them() -> None:
    launched = launch(
        node(name="before")
        + param("1", name="~a")
        + param("0", name="~b")
        + param("2", name="~b")
        + node(name="one", inner=param("3", name="a"))
        + f'<group ns="g">{param("4", name="~c")}{node(name="two")}</group>'
        + node(name="three")
    )
    assert told(launched) == []
    assert values(launched) == {
        "/one/a": 3,
        "/one/b": 2,
        "/g/two/a": 1,
        "/g/two/b": 2,
        "/g/two/c": 4,
        "/three/a": 1,
        "/three/b": 2,
    }
    assert next(p.location for p in launched.parameters if p.name == "/three/a") == next(
        p.location for p in launched.parameters if p.name == "/g/two/a"
    )


@pytest.mark.parametrize(("before", "leaks"), [("", False), (param("1", name="~a"), True)])
def test_private_params_leave_an_included_file_only_as_roslaunch_lets_them(before: str, leaks: bool) -> None:
    """roslaunch shares the list with an included file once there is something in it."""
    launched = launch(
        before + '<include file="$(dirname)/sub.launch"/>' + node(),
        {"bot/launch/sub.launch": f"<launch>{param('2', name='~b')}</launch>"},
    )
    assert ("/n/b" in values(launched)) == leaks


def test_the_last_one_wins() -> None:
    launched = launch(param("1") + "\n" + param("2") + "<rosparam>p: 3</rosparam>")
    assert values(launched) == {"/p": 3}
    assert launched.parameters[0].location == Location(MAIN, 2, 28)


def test_in_a_node_param_wins_over_rosparam_wherever_it_stands() -> None:
    launched = launch(param("1", name="~a") + node(inner=param("2", name="b") + "<rosparam>{a: 3, b: 4}</rosparam>"))
    assert values(launched) == {"/n/a": 1, "/n/b": 2}


def test_an_undecided_one_does_not_replace_what_was_before() -> None:
    launched = launch(
        param("1") + '<group if="$(env X)">' + param("2") + param("3") + "</group>" + param("4", name="q") + param("5")
    )
    assert [(p.name, p.value) for p in launched.parameters] == [("/p", 5), ("/q", 4)]
    launched = launch(param("1") + '<group if="$(env X)">' + param("2") + param("3") + "</group>")
    condition = Condition("if", "$(env X)", Location(MAIN, 1, 36))
    assert [(p.value, p.conditions) for p in launched.parameters] == [(1, ()), (3, (condition,))]


def test_conditions_of_private_params_and_their_nodes() -> None:
    launched = launch('<param name="~a" value="1" if="$(env X)"/>' + node('unless="$(env Y)"'))
    assert [condition.condition for condition in launched.parameters[0].conditions] == ["$(env Y)", "$(env X)"]


@pytest.mark.parametrize(
    ("tag", "type_", "value", "fields"),
    [
        (param("$(env X)"), None, None, ["value", "type"]),
        (param("$(env X)_1"), None, None, ["value", "type"]),
        (param("$(env X)/map.yaml"), "str", "?/map.yaml", ["value"]),
        (param("$(env X)", "str"), "str", "?", ["value"]),
        (param("$(env X)", "int"), "int", None, ["value"]),
        (param("$(env X)", "bool"), "bool", None, ["value"]),
        (param("$(env X)", "yaml"), None, None, ["value", "type"]),
        (param("[1, $(env X)]", "yaml"), "yaml", None, ["value"]),
    ],
)
def test_unknown_values(tag: str, type_: str | None, value: object, fields: list[str]) -> None:
    parameter = only(tag)
    assert (parameter.type, parameter.value) == (type_, value)
    reason = "environment variable 'X' is not given"
    assert parameter.unknowns == tuple(Unknown(field, reason, Location(MAIN, 1, 9)) for field in fields)


def test_an_unknown_name() -> None:
    launched = launch(param("1", name="a/$(env X)") + param("2", name="a/$(env X)"))
    assert [(p.name, p.value) for p in launched.parameters] == [("/a/?", 1), ("/a/?", 2)]
    assert launched.parameters[0].unknowns == (
        Unknown("name", "environment variable 'X' is not given", Location(MAIN, 1, 9)),
    )


@pytest.mark.parametrize(
    ("text", "kind", "type_", "value"),
    [
        ("<robot/>\r\n", "", "str", "<robot/>\n"),
        ("5", "", "int", 5),
        ("5", "str", "str", "5"),
        ("[1]", "yaml", "yaml", [1]),
        ("$(arg x)", "", "str", "$(arg x)"),
    ],
)
def test_textfile(text: str, kind: str, type_: str, value: object) -> None:
    tag = '<param name="p" textfile="$(find bot)/config/p.yaml"' + (f' type="{kind}"/>' if kind else "/>")
    launched = launch(tag, {YAML: text})
    assert [(p.type, p.value) for p in launched.parameters] == [(type_, value)]
    assert launched.files == (YAML, MAIN)


@pytest.mark.parametrize(
    ("attribute", "type_", "fields", "reason", "problems"),
    [
        (
            'textfile="$(find arm)/a.urdf"',
            None,
            ["value", "type"],
            "text of '$(find arm)/a.urdf': package 'arm' is not in the workspace",
            [],
        ),
        (
            'textfile="$(find bot)/a.urdf" type="str"',
            "str",
            ["value"],
            "text of '$(find bot)/a.urdf': bot/a.urdf is no text file of the workspace",
            ["<param name='p' textfile='$(find bot)/a.urdf'>: bot/a.urdf is no text file of the workspace"],
        ),
        (
            'binfile="$(find bot)/a.bin"',
            None,
            ["value", "type"],
            "binary content (base64) of '$(find bot)/a.bin', which is none of the plain types",
            [],
        ),
        (
            "command=\"$(find xacro)/xacro --inorder '$(find bot)/a.xacro' arm:=left\"",
            "str",
            ["value"],
            "xacro makes it of '$(find bot)/a.xacro'",
            [],
        ),
        ('command="python /x/xacro.py $(env X)/a"', "str", ["value"], "xacro makes it of '?/a'", []),
        (
            'command="rosrun xacro xacro a"',
            None,
            ["value", "type"],
            "printed by the command 'rosrun xacro xacro a'",
            [],
        ),
        ('command="date" type="int"', "int", ["value"], "printed by the command 'date'", []),
        ('command="echo \'a"', None, ["value", "type"], "printed by the command 'echo 'a'", []),
        ('command="xacro"', None, ["value", "type"], "printed by the command 'xacro'", []),
    ],
)
def test_files_and_commands_that_are_not_read(
    attribute: str, type_: str | None, fields: list[str], reason: str, problems: list[str]
) -> None:
    launched = launch(f'<param name="p" {attribute}/>')
    (parameter,) = launched.parameters
    assert (parameter.type, parameter.value, told(launched)) == (type_, None, problems)
    assert [(unknown.field, unknown.reason) for unknown in parameter.unknowns] == [(f, reason) for f in fields]


def test_a_value_above_others() -> None:
    launched = launch(param("1", name="a") + "\n" + param("2", name="a/b/c") + param("2", name="ab"))
    assert messages(launched) == [
        f"{MAIN}:2: parameter '/a/b/c' lies below '/a', which has a value ({MAIN}:1); rename one"
    ]


# <rosparam>


def test_names_by_ns_and_param_at_the_top_and_in_a_node() -> None:
    """Each tag sets one letter; the names are those that ``roslaunch --dump-params`` prints."""
    launched = launch(
        """
  <rosparam ns="~in" param="at">{a: 1}</rosparam>
  <rosparam ns="in" param="~at">{b: 1}</rosparam>
  <rosparam ns="in" param="/c">1</rosparam>
  <rosparam ns="in" param="~d">1</rosparam>
  <rosparam ns="in">{e: 1, /f: 1, ~g: 1}</rosparam>
  <rosparam param="in/">{h: 1}</rosparam>
  <group ns="G"><rosparam param="at">{i: 1, /j: 1}</rosparam></group>
  <node pkg="p" type="t" name="N" ns="S">
    <rosparam ns="in" param="at">{k: 1, /l: 1, ~m: 1}</rosparam>
    <rosparam>{n: 1, /o: 1, ~p: 1}</rosparam>
    <rosparam ns="in">{q: 1}</rosparam>
    <rosparam ns="in" param="/at">{r: 1, ~s: 1}</rosparam>
    <rosparam ns="/in" param="at">{t: 1}</rosparam>
    <rosparam ns="~in" param="at">{u: 1}</rosparam>
  </node>"""
    )
    listed = (
        "~in/at/a ~at/b /c ~d /in/e /f ~g /in/h /G/at/i /j /S/N/in/at/k /l ~m /S/N/n /o ~p /S/N/in/q /at/r ~s /in/at/t"
        " ~in/at/u"
    )
    assert sorted(values(launched)) == sorted(listed.split())
    text = (
        "<rosparam> sets names that begin with '~': they are private to roslaunch itself and no node sees them; use"
        " <param>, or a <rosparam> inside the <node> with names that do not begin with '~'"
    )
    assert messages(launched) == [f"{MAIN}:{line}: {text}" for line in (2, 3, 5, 6, 10, 11, 13, 15)]


@pytest.mark.parametrize(
    ("text", "type_", "value"),
    [
        ("1", "int", 1),
        ("017", "int", 15),
        ("0x1F", "int", 31),
        ("1:30", "int", 90),
        ("1.5", "double", 1.5),
        ("1e3", "str", "1e3"),
        ("1.0e+3", "double", 1000.0),
        (".inf", "double", math.inf),
        ("on", "bool", True),
        ("No", "bool", False),
        ("'on'", "str", "on"),
        ("''", "str", ""),
        ("a: b", "str", "b"),
        ("!!str 5", "str", "5"),
        ("!!float 5", "double", 5.0),
        ("[1, [2.5, x], {y: z}]", "yaml", [1, [2.5, "x"], {"y": "z"}]),
        ("[]", "yaml", []),
        ("deg(180)", "double", math.pi),
        ("deg( -90.0 )", "double", -math.pi / 2),
        ("rad(pi/2)", "double", math.pi / 2),
        ("!degrees 180.0", "double", math.pi),
        ("!radians 2*pi", "double", 2 * math.pi),
        ("'deg(180)'", "str", "deg(180)"),
        ("deg(180) or so", "str", "deg(180) or so"),
        ("rad(atan2(1, 1))", "str", "rad(atan2(1, 1))"),
    ],
)
def test_yaml_values(text: str, type_: str, value: object) -> None:
    parameter = only(f"<rosparam param='p'>{text}</rosparam>")
    name = "/p/a" if text == "a: b" else "/p"
    assert (parameter.name, parameter.type, parameter.value) == (name, type_, value)


def test_lines_of_a_file_and_of_a_body() -> None:
    launched = launch(
        f"\n {LOAD}\n<rosparam param='b'>x: 1\n<!-- a\n comment -->\ny:\n  z:\n  - 1\n</rosparam>",
        {YAML: "# head\na: 1\nm:\n  n: {o: 2,\n    q: 3}\nl:\n- 1\n"},
    )
    assert told(launched) == []
    assert {p.name: (p.location, p.origin) for p in launched.parameters} == {
        "/a": (Location(MAIN, 2, 2), Location(YAML, 2)),
        "/m/n/o": (Location(MAIN, 2, 2), Location(YAML, 4)),
        "/m/n/q": (Location(MAIN, 2, 2), Location(YAML, 5)),
        "/l": (Location(MAIN, 2, 2), Location(YAML, 6)),
        "/b/x": (Location(MAIN, 3, 1), Location(MAIN, 3)),
        "/b/y/z": (Location(MAIN, 3, 1), Location(MAIN, 7)),
    }
    assert launched.files == (YAML, MAIN)


@pytest.mark.parametrize(
    "body",
    [
        "<rosparam/>",
        "<rosparam>\n# nothing\n</rosparam>",
        "<rosparam>{}</rosparam>",
        "<rosparam>a: {b: {}}</rosparam>",
        '<rosparam command="delete" param="/a"/>',
        '<rosparam command="dump" file="/tmp/x"/>',
        '<rosparam command="load" if="false">a: 1</rosparam>',
        LOAD,
    ],
)
def test_what_sets_nothing(body: str) -> None:
    launched = launch(body, {YAML: ""})
    assert (told(launched), launched.parameters) == ([], ())


def test_delete_comes_before_anything_is_set() -> None:
    assert values(launch(param("1") + '<rosparam command="delete" param="p"/>')) == {"/p": 1}


def test_anchors_merges_and_repeated_keys() -> None:
    launched = launch(LOAD, {YAML: "base: &b {x: 1, y: 2}\none: {<<: *b, y: 3}\ntwo: *b\ntwice: 1\ntwice: 2\n"})
    assert told(launched) == []
    assert values(launched) == {
        "/base/x": 1,
        "/base/y": 2,
        "/one/x": 1,
        "/one/y": 3,
        "/two/x": 1,
        "/two/y": 2,
        "/twice": 2,
    }


def test_substitution_in_yaml_only_where_it_is_asked_for() -> None:
    text = "a: $(arg x)\nb: $(find bot)/m\n# c\n$(arg k): 1\nd: '$(env X)'\ne: $(env X)\nf: [$(env Y)]\n$(env Y): 2\n"
    files = {YAML: text}
    args = '<arg name="x" value="7"/><arg name="k" value="key"/>'
    launched = launch(args + LOAD.replace("/>", ' subst_value="true"/>'), files)
    assert told(launched) == []
    x, y = ("environment variable 'X' is not given", "environment variable 'Y' is not given")
    assert [(p.name, p.type, p.value, [u.reason for u in p.unknowns]) for p in launched.parameters] == [
        ("/?", "int", 2, [y]),
        ("/a", "int", 7, []),
        ("/b", "str", "$(find bot)/m", []),
        ("/d", "str", "?", [x]),
        ("/e", None, None, [x, x]),
        ("/f", "yaml", None, [y]),
        ("/key", "int", 1, []),
    ]
    assert values(launch("<rosparam>a: $(arg x)</rosparam>")) == {"/a": "$(arg x)"}


@pytest.mark.parametrize(
    ("text", "reason", "type_"),
    [
        ("!!binary aGVsbG8=", "binary data (base64), which is none of the plain types", None),
        ("2020-01-01", "a date, which is none of the plain types; quote it if it is text", None),
        ("!radians factorial(3)", "'factorial(3)' calls factorial(), which is not interpreted", "double"),
    ],
)
def test_yaml_values_that_are_not_known(text: str, reason: str, type_: str | None) -> None:
    parameter = only(f"<rosparam>p: {text}</rosparam>")
    assert (parameter.type, parameter.value, parameter.unknowns[0].reason) == (type_, None, reason)


@pytest.mark.parametrize(
    ("tag", "message"),
    [
        ("<rosparam>5</rosparam>", "<rosparam> sets a single value and needs a 'param'; add it"),
        ("<rosparam>a</rosparam>", "<rosparam> sets a single value and needs a 'param'; add it"),
        ("<rosparam>on: 1</rosparam>", "YAML of <rosparam>: key 'True' is no text; quote it. It is left out"),
        ("<rosparam>1: 1</rosparam>", "YAML of <rosparam>: key '1' is no text; quote it. It is left out"),
        ("<rosparam>a:</rosparam>", "'/a' has no value (null): roslaunch cannot set it; give it one"),
        (
            '<rosparam command="set"/>',
            "<rosparam command='set'>: write load, dump or delete. The tag is left out",
        ),
        ('<rosparam command="dump"/>', "<rosparam command='dump'> needs a 'file'; add it"),
        (
            '<rosparam command="delete" file="x"/>',
            "<rosparam command='delete'> takes no 'file'; remove it",
        ),
    ],
)
def test_rosparam_that_roslaunch_refuses(tag: str, message: str) -> None:
    launched = launch(tag + param("1", name="rest"))
    assert (told(launched), values(launched)) == ([message], {"/rest": 1})


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("[" * 60 + "]" * 60, "nested deeper than 50 levels; flatten it"),
        (
            "a: &a [1,1,1,1,1,1,1,1,1,1]\n"
            + "".join(f"{y}: &{y} [{','.join([f'*{x}'] * 10)}]\n" for x, y in zip("abcde", "bcdef", strict=True)),
            "more than 50000 values, aliases counted; split it",
        ),
        ("a: " + "1" * 200, "number too long; quote it if it is text"),
        ("a: '" + "x" * 1_000_000 + "'", "more than 1000000 characters; split it"),
        ("a: \x07", "not valid YAML: it holds a control character; remove it"),
    ],
)
def test_yaml_is_bounded(text: str, message: str) -> None:
    launched = launch(LOAD, {YAML: text})
    assert [problem.message for problem in launched.problems] == [f"YAML of <rosparam>: {message}"]
    assert values(launched) == {"/?": None}


UNREAD = '<rosparam file="$(find arm)/p.yaml"%s/>'


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        (UNREAD % "", {"/?": None}),
        (UNREAD % ' ns="in"', {"/in/?": None}),
        (UNREAD % ' param="p"', {"/p/?": None}),
        (UNREAD % ' ns="in" param="p"', {"/in/p/?": None}),
        (UNREAD % ' ns="/in"', {"/in/?": None}),
        (UNREAD % ' ns="~in"', {}),
        (UNREAD % ' command="delete" param="p"', {}),
        (UNREAD % ' if="false"', {}),
        (f'<group ns="g">{UNREAD % ""}</group>', {"/g/?": None}),
        (node(inner=UNREAD % ""), {"/n/?": None}),
        (node(inner=UNREAD % ' ns="in"'), {"/n/in/?": None}),
        ('<rosparam command="$(env X)">a: 1</rosparam>', {"/?": None}),
        ('<rosparam ns="in" subst_value="$(env X)">a: 1</rosparam>', {"/in/?": None}),
        (UNREAD % "" + param("1"), {"/?": None, "/p": 1}),
        (param("1") + UNREAD % "", {"/?": None, "/p": None}),
        (param("1") + UNREAD % ' param="p"', {"/p": None, "/p/?": None}),
        (param("1") + UNREAD % ' ns="q"', {"/p": 1, "/q/?": None}),
        (param("1", name="qq") + UNREAD % ' ns="q"', {"/qq": 1, "/q/?": None}),
        (UNREAD % "" + UNREAD % "", None),
        (node(inner=param("1") + UNREAD % ""), {"/n/?": None, "/n/p": 1}),
        (param("1") + UNREAD % "" + param("2"), {"/?": None, "/p": 2}),
    ],
)
def test_what_an_unreadable_file_may_set(body: str, expected: dict[str, object] | None) -> None:
    launched = launch(body)
    if expected is None:
        assert [parameter.name for parameter in launched.parameters] == ["/?", "/?"]
    else:
        assert values(launched) == expected


def test_what_was_set_before_may_be_set_anew() -> None:
    (_, before) = launch(param("1") + "\n" + UNREAD % "").parameters
    reason = "it may be set anew: <rosparam> loads '$(find arm)/p.yaml': package 'arm' is not in the workspace"
    place = Location(MAIN, 2, 1)
    assert (before.name, before.type, before.location) == ("/p", None, Location(MAIN, 1, 9))
    assert before.unknowns == (Unknown("value", reason, place), Unknown("type", reason, place))


def test_a_file_loaded_twice_is_the_same_twice() -> None:
    launched = launch(f'<group ns="a">{LOAD}</group><group ns="b">{LOAD}</group>', {YAML: "x: 1"})
    assert values(launched) == {"/a/x": 1, "/b/x": 1}


def test_unknown_subst_value_and_wrong_attributes() -> None:
    assert told(launch('<rosparam subst_value="$(env X)" value="1">a: 1</rosparam>')) == [
        "<rosparam> has no attribute 'value'; remove it or correct its name",
        "<rosparam>: whether 'subst_value' holds is unknown. The tag is left out",
    ]


def test_conditions_of_a_tag_are_on_each_of_its_leaves() -> None:
    launched = launch('<rosparam if="$(env X)">{a: 1, b: 2}</rosparam>')
    condition = Condition("if", "$(env X)", Location(MAIN, 1, 9))
    assert [p.conditions for p in launched.parameters] == [(condition,), (condition,)]


def test_parameters_are_sorted_by_name_and_repeatable() -> None:
    files = {MAIN: f"<launch>{param('1', name='b')}{param('2', name='a')}<rosparam>{{c: 1, ab: 2}}</rosparam></launch>"}
    assert list(values(run([MAIN], files))) == ["/a", "/ab", "/b", "/c"]
    assert run([MAIN], files) == run([MAIN], files)


# Private parameters on a node's command line


@pytest.mark.parametrize(
    ("args", "expected"),
    [
        ("_a:=1", {"/n/a": 1}),
        ("_a:=1.5 _b:=true _c:=text _d:=1_0", {"/n/a": 1.5, "/n/b": True, "/n/c": "text", "/n/d": "1_0"}),
        ("_a/b:='two words'", {"/n/a/b": "two words"}),
        ("_a:=", {"/n/a": ""}),
        ("_a:=inf", {"/n/a": "inf"}),
        ("_a:=$(env X)", {"/n/a": None}),
        ("_$(env X):=1", {}),
        ("_a:=1 $(env X)", {"/n/a": 1}),
        ("__name:=m __ns:=x a:=b --_a=1 _a", {}),
        ("", {}),
    ],
)
def test_private_parameters_among_the_arguments(args: str, expected: dict[str, object]) -> None:
    launched = launch(node(f'args="{args}"'))
    assert values(launched) == expected
    assert all(bool(entry.unknowns) == (entry.value is None) for entry in launched.parameters)
    assert all(entry.location == Location(MAIN, 1, 9) for entry in launched.parameters)


def test_an_argument_wins_over_the_nodes_own_param() -> None:
    assert values(launch(node('args="_p:=2"', param("1")))) == {"/n/p": 2}
