# SPDX-License-Identifier: Apache-2.0
"""Parameters of nodes: values with their types, files with their patterns, and files that are rewritten."""

from __future__ import annotations

from typing import Any

import pytest
from launching_kit import HERE, launch, loader, node, only, perform, told, values, workspace

from haros_ci.launch.ros2.evaluate import launch_system
from haros_ci.launch.ros2.places import Places
from haros_ci.model.launch_actions import Action, Description, ParameterSource, Phrase, Substitution

FILE = "bot/config/p.yaml"
PATH = "$(find-pkg-share bot)/config/p.yaml"
SECTION = "/**:\n  ros__parameters:\n"


def typed(yaml: str, component: bool = False) -> tuple[str | None, Any, list[str]]:
    """Type, value and reasons of the parameter ``x`` that a file sets to *yaml*."""
    files = {FILE: SECTION + f"    x: {yaml}\n"}
    param = f'<param from="{PATH}"/>'
    if component:
        inner = f'<composable_node pkg="p" plugin="C" name="n">{param}</composable_node>'
        system = launch(f'<load_composable_node target="k">{inner}</load_composable_node>', files)
    else:
        system = launch(node("", param), files)
    rule = only(system).parameters[0]
    assert rule.origin is not None
    assert (rule.name, rule.origin.path, rule.origin.line, rule.location.path) == (
        "x",
        FILE,
        3,
        "bot/launch/main.launch.xml",
    )
    return rule.type, rule.value, [unknown.reason for unknown in rule.unknowns]


@pytest.mark.parametrize(
    ("yaml", "kind", "value"),
    [
        ("1", "int", 1),
        ("-1", "int", -1),
        ("0x10", "int", 16),
        ("010", "int", 8),
        ("09", "double", 9.0),
        ("1_000", "str", "1_000"),
        ("1.", "double", 1.0),
        ("1e3", "double", 1000.0),
        (".5", "double", 0.5),
        ("99999999999999999999", "double", 1e20),
        ("on", "bool", True),
        ("y", "bool", True),
        ("No", "bool", False),
        ("True", "bool", True),
        ("tRue", "str", "tRue"),
        ("null", "str", "null"),
        ("~", "str", "~"),
        ("'1'", "str", "1"),
        ('"on"', "str", "on"),
        ("1:30", "str", "1:30"),
        ("text", "str", "text"),
        ("[1, 2]", "int[]", [1, 2]),
        ("[1.0, 2.5]", "double[]", [1.0, 2.5]),
        ("[on, off]", "bool[]", [True, False]),
        ("[a, '1']", "str[]", ["a", "1"]),
    ],
)
def test_scalars_as_a_process_reads_them(yaml: str, kind: str, value: object) -> None:
    assert typed(yaml) == (kind, value, [])
    assert type(typed(yaml)[1]) is type(value)


@pytest.mark.parametrize(
    ("yaml", "kind", "value"),
    [
        ("1", "int", 1),
        ("1e3", "str", "1e3"),
        ("1.0e+3", "double", 1000.0),
        ("1_000", "int", 1000),
        ("on", "bool", True),
        ("y", "str", "y"),
        ("09", "str", "09"),
        ("1:30", "int", 90),
        ("[1, 2.5]", "double[]", [1.0, 2.5]),
    ],
)
def test_scalars_as_launch_reads_them_for_a_component(yaml: str, kind: str, value: object) -> None:
    assert typed(yaml, component=True) == (kind, value, [])


@pytest.mark.parametrize(
    ("yaml", "kind", "reason"),
    [
        (".nan", "double", "'.nan' is no number that can be shown"),
        ("-.inf", "double", "'-.inf' is no number that can be shown"),
        ("[1, 2.5]", None, "the list mixes double, int"),
        ("[[1]]", None, "a list of lists or maps is no parameter value"),
        ("[{a: 1}]", None, "a list of lists or maps is no parameter value"),
    ],
)
def test_values_that_are_left_unknown(yaml: str, kind: str | None, reason: str) -> None:
    assert typed(yaml) == (kind, None, [reason] * (1 if kind else 2))


def test_an_empty_list_has_no_type() -> None:
    assert typed("[]") == (None, [], ["an empty list has no type"] * 2)


def rules(yaml: str, substitutes: str = "", args: str = "") -> list[tuple[str, str, Any]]:
    return values(launch(args + node("", f'<param from="{PATH}" {substitutes}/>'), {FILE: yaml}))


@pytest.mark.parametrize(
    ("yaml", "expected"),
    [
        ("n: {ros__parameters: {x: 1}}", [("n", "x", 1)]),
        ("/a/n: {ros__parameters: {x: 1}}", [("/a/n", "x", 1)]),
        ("a: {b: {n: {ros__parameters: {x: 1}}}}", [("a/b/n", "x", 1)]),
        ("/**: {ros__parameters: {x: 1}}", [("/**", "x", 1)]),
        ("/**/n: {ros__parameters: {x: 1}}", [("/**/n", "x", 1)]),
        ("/*: {ros__parameters: {x: 1}}", [("/*", "x", 1)]),
        ("/**: {n: {ros__parameters: {x: 1}}}", [("/**/n", "x", 1)]),
        ("n: {ros__parameters: {a: {b: {c: 1}, d: 2}}}", [("n", "a.b.c", 1), ("n", "a.d", 2)]),
        ("n: {ros__parameters: {a.b: 1}}", [("n", "a.b", 1)]),
        ("n: {ros__parameters: {x: 1}}\nm: {ros__parameters: {x: 2}}", [("n", "x", 1), ("m", "x", 2)]),
        ("n: {ros__parameters: {x: 1}}\n---\nn: {ros__parameters: {x: 2}}", [("n", "x", 1), ("n", "x", 2)]),
        ("/: {n: {ros__parameters: {x: 1}}}", [("/n", "x", 1)]),
        ("/a/: {n: {ros__parameters: {x: 1}}}", [("/a/n", "x", 1)]),
        ("n: {x: 1}", []),
        ("n: {ros__parameters: }", []),
        ("", []),
    ],
)
def test_patterns_of_files(yaml: str, expected: object) -> None:
    if yaml:
        assert rules(yaml) == expected


def test_a_component_is_sent_its_own_section_and_that_for_all() -> None:
    yaml = "/**: {ros__parameters: {x: 1}}\n/s/c: {ros__parameters: {y: 2}}\n/**/c: {ros__parameters: {z: 3}}\n"
    inner = f'<composable_node pkg="p" plugin="C" name="c" namespace="s"><param from="{PATH}"/></composable_node>'
    body = f'<load_composable_node target="k">{inner}</load_composable_node>'
    assert values(launch(body, {FILE: yaml})) == [("/**", "x", 1), ("/**", "y", 2)]
    assert values(launch(body, {FILE: "a: {b: 1}\n"})) == [("/**", "a.b", 1)]


def test_substitutions_inside_files() -> None:
    yaml = SECTION + '    x: $(var a)\n    t: "$(var a)"\n    p: $(find-pkg-share q)/f\n    u: $(var none)\n'
    arg = '<arg name="a" default="1"/>'
    assert rules(yaml, 'allow_substs="true"', arg) == [
        ("/**", "x", 1),
        ("/**", "t", "1"),
        ("/**", "p", "$(find-pkg-share q)/f"),
        ("/**", "u", None),
    ]
    assert rules(yaml, "", arg)[0] == ("/**", "x", "$(var a)")


def test_files_that_are_not_known_are_one_rule_with_its_reason() -> None:
    for path, reason in (
        ("$(var f)", "parameter file '?': launch configuration 'f' is not set"),
        ("/etc/p.yaml", "parameter file '/etc/p.yaml': '/etc/p.yaml' is an absolute path outside of the workspace"),
        (
            "$(find-pkg-share q)/p.yaml",
            "parameter file '$(find-pkg-share q)/p.yaml': package 'q' is not in the workspace",
        ),
    ):
        system = launch(node("", f'<param from="{path}"/>'))
        assert values(system) == [("/**", "?", None)]
        assert [unknown.reason for unknown in only(system).parameters[0].unknowns] == [reason]
        assert told(system) == []
    missing = launch(node("", '<param from="$(find-pkg-share bot)/no.yaml"/>'))
    assert len(told(missing)) == 1
    broken = launch(node("", f'<param from="{PATH}"/>'), {FILE: "a: [}"})
    assert (broken.problems[0].path, broken.problems[0].line) == (FILE, 1)
    assert values(broken) == [("/**", "?", None)]


def test_deep_files_and_alias_bombs_are_refused() -> None:
    for yaml in (
        "a: " + "[" * 500,
        "a: &a [*a]",
        "\n".join(["a0: &a0 [1, 1]"] + [f"a{n}: &a{n} [{', '.join([f'*a{n - 1}'] * 9)}]" for n in range(1, 12)]),
    ):
        assert values(launch(node("", f'<param from="{PATH}"/>'), {FILE: yaml})) == [("/**", "?", None)]


@pytest.mark.parametrize(
    ("attributes", "kind", "value"),
    [
        ('value="1"', "int", 1),
        ('value="1.5"', "double", 1.5),
        ('value="true"', "bool", True),
        ('value="text"', "str", "text"),
        ('value="1" type="str"', "str", "1"),
        ('value="1e3"', "double", 1000.0),
        ('value="[1, 2]"', "int[]", [1, 2]),
        ('value="[1, 2.5]"', "double[]", [1.0, 2.5]),
        ('value="[a, b]"', "str[]", ["a", "b"]),
        ('value="$(var n)"', "int", 5),
        ('value="$(var n)" type="float"', "double", 5.0),
        ('value="$(var n)" type="str"', "str", "5"),
        ('value="$(var n)" type="bool"', "bool", None),
        ('value="$(var l)"', "int[]", [1, 2]),
        ('value="$(var u)"', None, None),
        ('value="$(var u)" type="int"', "int", None),
        ('value="$(dirname)/f"', "str", "$(workspace bot/launch)/f"),
    ],
)
def test_values_in_launch_files(attributes: str, kind: str | None, value: object) -> None:
    args = '<arg name="n" default="5"/><arg name="l" default="[1, 2]"/><arg name="u"/>'
    rule = only(launch(args + node("", f'<param name="x" {attributes}/>'))).parameters[0]
    assert (rule.node, rule.name, rule.type, rule.value, rule.origin) == ("/**", "x", kind, value, None)
    assert bool(rule.unknowns) == (value is None)


def test_parameters_of_all_nodes_precede_and_end_with_the_scope() -> None:
    files = {FILE: SECTION + "    f: 1\n"}
    own = node("", '<param name="x" value="2"/>')
    body = f'<group><set_parameter name="x" value="1"/><set_parameters_from_file filename="{PATH}"/>{own}</group>{own}'
    system = launch(body, files)
    assert values(system) == [("/**", "x", 1), ("/**", "f", 1), ("/**", "x", 2)]
    assert values(system, 1) == [("/**", "x", 2)]


def test_a_text_for_all_nodes_is_read_as_an_argument() -> None:
    system = launch('<set_parameter name="x" value="\'on\'"/>' + node())
    assert values(system) == [("/**", "x", True)]


def test_set_use_sim_time_is_about_the_node_of_launch_itself() -> None:
    assert values(launch('<set_use_sim_time value="true"/>' + node())) == []


def test_parameters_under_an_undecided_condition_keep_it() -> None:
    body = '<arg name="t"/><set_parameter name="x" value="1" if="$(var t)"/>' + node()
    assert [c.condition for c in only(launch(body)).parameters[0].conditions] == ["$(var t)"]


def rewritten(yaml: str, path: str = PATH, **data: Any) -> list[tuple[str, str, Any]]:
    made = {"source": (path,), "rewrites": (), "root_key": None, "key_rewrites": (), "convert_types": False, **data}
    file: Phrase = (Substitution("rewritten", data=made),)
    source = ParameterSource(kind="file", location=HERE, path=file)
    phrases = (("package", ("p",)), ("executable", ("e",)), ("name", ("n",)))
    action = Action(kind="node", location=HERE, phrases=phrases, parameters=(source,))
    return values(perform(action, files={FILE: yaml}))


NAV = "n:\n  ros__parameters:\n    x: 1\n    a: {x: 2, y: [1, 2]}\n    t: text\n"


@pytest.mark.parametrize(
    ("data", "expected"),
    [
        ({}, [1, 2, [1, 2], "text"]),
        ({"rewrites": ((("x",), ("5",)),)}, ["5", "5", [1, 2], "text"]),
        ({"rewrites": ((("x",), ("5",)),), "convert_types": True}, [5, 5, [1, 2], "text"]),
        ({"rewrites": ((("x",), ("5.0",)),), "convert_types": True}, [5.0, 5.0, [1, 2], "text"]),
        ({"rewrites": ((("x",), ("True",)),)}, [True, True, [1, 2], "text"]),
        ({"rewrites": ((("n.ros__parameters.a.x",), ("z",)),)}, [1, "z", [1, 2], "text"]),
        ({"rewrites": ((("n.ros__parameters.b.c",), ("z",)),)}, [1, 2, [1, 2], "text", "z"]),
        ({"rewrites": ((("none",), ("z",)),)}, [1, 2, [1, 2], "text"]),
        ({"rewrites": ((("t",), (Substitution("var", (("u",),)),)),)}, [1, 2, [1, 2], None]),
        ({"rewrites": ((("a",), ("z",)),)}, [1, "z", "text"]),
        ({"value_rewrites": ((("text",), ("new",)),)}, [1, 2, [1, 2], "new"]),
    ],
)
def test_rewritten_values(data: dict[str, Any], expected: object) -> None:
    assert [value for _, _, value in rewritten(NAV, **data)] == expected


def test_rewritten_keys_and_roots() -> None:
    yaml = "n: {ros__parameters: {x: 1}}"
    assert rewritten(yaml, root_key=("s",)) == [("s/n", "x", 1)]
    assert rewritten(yaml, root_key=()) == [("n", "x", 1)]
    assert rewritten(yaml, key_rewrites=((("n",), ("m",)),)) == [("m", "x", 1)]
    assert rewritten(yaml, path="$(find-pkg-share q)/p.yaml") == [("/**", "?", None)]


def test_a_file_that_is_rewritten_once_is_performed_for_each_node() -> None:
    yaml = (
        "n:\n  ros__parameters:\n    x: $(var v)\n    l: [$(var v), 0.50]\n    a: {y: 010, t: on}\n    u: '$(var v)'\n"
    )
    made = {"source": (PATH,), "rewrites": (), "root_key": None, "key_rewrites": (), "convert_types": False}
    file: Phrase = (Substitution("rewritten", data=made),)
    phrases = (("package", ("p",)), ("executable", ("e",)), ("name", ("n",)))

    def let(value: str) -> Action:
        return Action(kind="let", location=HERE, phrases=(("name", ("v",)), ("value", (value,))))

    def given(substitutes: bool) -> Action:
        source = ParameterSource(kind="file", location=HERE, path=file, substitutes=substitutes)
        return Action(kind="node", location=HERE, phrases=phrases, parameters=(source,))

    system = perform(
        let("1"), given(True), let("two"), given(True), given(False), let("1"), given(True), files={FILE: yaml}
    )
    found = [[value for _, _, value in values(system, index)] for index in range(4)]
    assert found[0] == found[3] == [1, None, 8, True, "1"]
    assert found[1] == ["two", None, 8, True, "two"]
    assert found[2] == ["$(var v)", None, 8, True, "$(var v)"]


def test_what_one_launch_file_makes_of_a_file_is_used_again_by_another_where_it_is_the_same() -> None:
    yaml = "n: {ros__parameters: {x: $(var v), y: 1}}\nm: {ros__parameters: {z: $(var v)}}\n"
    rewrites = ((("y",), (Substitution("var", (("w",),)),)),)
    made = {"source": (PATH,), "rewrites": rewrites, "root_key": None, "key_rewrites": (), "convert_types": True}
    source = ParameterSource(kind="file", location=HERE, path=(Substitution("rewritten", data=made),), substitutes=True)
    phrases = (("package", ("p",)), ("executable", ("e",)), ("name", ("n",)))
    started = Action(kind="node", location=HERE, phrases=phrases, parameters=(source,))
    files = {HERE.path: "#", FILE: yaml}

    def given(v: str, w: str, places: Places) -> list[tuple[str, str, Any]]:
        lets = [
            Action(kind="let", location=HERE, phrases=(("name", (name,)), ("value", (value,))))
            for name, value in (("v", v), ("w", w))
        ]
        load = loader(files, {HERE.path: Description(actions=(*lets, started))})
        return values(launch_system((HERE.path,), places.workspace, load, {}, {}, places))

    places = Places(workspace(files))
    for v, w in (("1", "2"), ("one", "2"), ("1", "two"), ("1", "2")):
        assert given(v, w, places) == given(v, w, Places(places.workspace))
    assert sum(key[0] == "rules" for key in places.made) == 3
    assert sum(key[0] == "rewritten" for key in places.made) == 2


def test_what_is_rewritten_must_be_known() -> None:
    unknown: Phrase = (Substitution("var", (("u",),)),)
    for data in ({"rewrites": ((unknown, ("1",)),)}, {"root_key": unknown}, {"key_rewrites": ((("n",), unknown),)}):
        assert rewritten(NAV, **data) == [("/**", "?", None)]


def test_sections_and_names_of_which_a_part_is_not_known() -> None:
    yaml = "$(var u)/n: {ros__parameters: {x: 1}}\nn: {ros__parameters: {$(var u)_y: 1}}\n"
    system = launch(node("", f'<param from="{PATH}" allow_substs="true"/>'), {FILE: yaml})
    assert values(system) == [("/**", "?", None), ("n", "?_y", 1)]
    assert [[unknown.field for unknown in rule.unknowns] for rule in only(system).parameters] == [["name"], ["name"]]


def test_sources_of_which_nothing_is_known() -> None:
    source = ParameterSource(kind="?", location=HERE, reason="made by a library")
    phrases = (("package", ("p",)), ("executable", ("e",)))
    system = perform(Action(kind="node", location=HERE, phrases=phrases, parameters=(source,)))
    assert [unknown.reason for unknown in only(system).parameters[0].unknowns] == ["made by a library"]


@pytest.mark.parametrize(
    ("value", "kind", "expected"),
    [
        (True, "bool", True),
        ("1", "str", "1"),
        (["a", "b"], "str[]", ["a", "b"]),
        ([1, 2.0], "double[]", [1.0, 2.0]),
        (("1",), "int", 1),
        ((("1",), ("2",)), "int[]", [1, 2]),
        ((), "str", ""),
        (None, None, None),
        ([["a"]], None, None),
        ({"a": 1}, "int", 1),
    ],
)
def test_values_of_python(value: Any, kind: str | None, expected: object) -> None:
    source = ParameterSource(kind="values", location=HERE, values=((("x",), value),))
    phrases = (("package", ("p",)), ("executable", ("e",)))
    rule = only(perform(Action(kind="node", location=HERE, phrases=phrases, parameters=(source,)))).parameters[0]
    assert (rule.type, rule.value) == (kind, expected)
    assert rule.name == ("x.a" if isinstance(value, dict) else "x")
