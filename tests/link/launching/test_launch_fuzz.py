# SPDX-License-Identifier: Apache-2.0
"""Launch files of any kind are launched without an error, within bounds, and the same each time."""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import replace

import pytest
from launching_kit import MAIN, loader, workspace

from haros_ci.extract.launch.ros2_yaml import read_ros2_yaml
from haros_ci.launch.ros2.entry import entry_files
from haros_ci.launch.ros2.evaluate import launch_system
from haros_ci.launch.ros2.expression import expression_value
from haros_ci.launch.ros2.places import Places
from haros_ci.model.launch import LaunchedNode, LaunchedSystem
from haros_ci.model.launch_phrases import read_phrase
from haros_ci.substitutions.names import Text, literal
from haros_ci.substitutions.presence import OTHER

hypothesis = pytest.importorskip("hypothesis")
st = pytest.importorskip("hypothesis.strategies")

PIECES = (
    *(
        "",
        "a",
        "b",
        "/a",
        "~/a",
        "a/b",
        "1",
        "1.5",
        "true",
        "false",
        " ",
        "?",
        "\ue000",
        "\ua66e",
        "é",
        "__x",
        "'",
        '"',
        "\\",
    ),
    *("$(var a)", "$(var b c)", "$(env X)", "$(anon a)", "$(dirname)", "$(find-pkg-share bot)", "$(find-pkg-share x)"),
    *(
        "$(eval '1 + 1')",
        "$(eval \"'$(var a)' == 'b'\")",
        "$(not $(var a))",
        "$(if true a b)",
        "$(command x)",
        "$(param p)",
    ),
    *(
        "$(file-content $(dirname)/main.launch.xml)",
        "$(",
        ")",
        "$",
        "/launch/main.launch.xml",
        "/p.yaml",
        "[1, 2.0]",
        "{a: ",
    ),
    *("--ros-args", " -r a:=b", " -- ", "list(set('a'))", "[*a]", "&a ", "!!binary x", "- a\n", "ros2 run p e"),
)
TAGS = (
    *("group", "node", "include", "arg", "let", "param", "remap", "env", "node_container", "load_composable_node"),
    *("composable_node", "push-ros-namespace", "set_remap", "set_parameter", "set_parameters_from_file", "timer"),
    *("executable", "set_env", "unset_env", "append_env", "reset_env", "reset", "keep", "log", "shutdown", "other"),
)
ATTRIBUTES = (
    *("name", "value", "default", "file", "namespace", "if", "unless", "pkg", "exec", "args", "ros_args", "from", "to"),
    *("type", "plugin", "target", "scoped", "forwarding", "allow_substs", "filename", "cmd", "period", "value-sep"),
)
NEEDED = {
    "node": ("pkg", "exec", "name"),
    "node_container": ("pkg", "exec", "name"),
    "composable_node": ("pkg", "plugin", "name"),
    "load_composable_node": ("target",),
    "include": ("file",),
    "arg": ("name", "default"),
    "let": ("name", "value"),
    "param": ("name", "value"),
    "set_parameter": ("name", "value"),
    "remap": ("from", "to"),
    "set_remap": ("from", "to"),
    "push-ros-namespace": ("namespace",),
    "set_env": ("name", "value"),
    "executable": ("cmd",),
}
TEXTS = st.lists(st.sampled_from(PIECES), max_size=4).map("".join)


def escaped(text: str) -> str:
    return text.replace("&", "&amp;").replace('"', "&quot;").replace("<", "&lt;").replace("\n", "&#10;")


def tag(parts: tuple[str, dict[str, str], list[str], list[str]]) -> str:
    name, more, children, needed = parts
    attributes = dict(zip(NEEDED.get(name, ()), needed, strict=False)) | more
    written = "".join(f' {key}="{escaped(value)}"' for key, value in attributes.items())
    return f"<{name}{written}>{''.join(children)}</{name}>"


def element(children: object) -> object:
    attributes = st.dictionaries(st.sampled_from(ATTRIBUTES), TEXTS, max_size=3)
    return st.tuples(st.sampled_from(TAGS), attributes, children, st.lists(TEXTS, max_size=4)).map(tag)


TREES = st.recursive(element(st.just([])), lambda inner: element(st.lists(inner, max_size=5)), max_leaves=12)


def run(files: dict[str, str]) -> LaunchedSystem:
    places = Places(workspace(files))
    return launch_system((MAIN,), places.workspace, loader(files), {"a": "1"}, {"X": "x"}, places)


def without_presence(nodes: Iterable[LaunchedNode]) -> list[LaunchedNode]:
    return [
        replace(each, presence=(), parameters=tuple(replace(rule, presence=()) for rule in each.parameters))
        for each in nodes
    ]


def check_alternatives(files: dict[str, str], system: LaunchedSystem) -> None:
    """What is there with the given arguments is the same where others are asked for."""
    places = Places(workspace(files))
    varied = launch_system((MAIN,), places.workspace, loader(files), {"a": "1"}, {"X": "x"}, places, alternatives=True)
    assert without_presence(varied.nodes) == list(system.nodes)
    assert (varied.arguments, varied.files, varied.includes) == (system.arguments, system.files, system.includes)
    assert varied.problems[: len(system.problems)] == system.problems
    for started in varied.alternatives:
        assert started.presence
        assert OTHER not in repr(started)


def check(files: dict[str, str]) -> None:
    system = run(files)
    assert system == run(files)
    check_alternatives(files, system)
    assert all(problem.path in files and problem.message for problem in system.problems)
    for started in system.nodes:
        assert "\ue000" not in repr(started)
        assert started.namespace is None or started.namespace.startswith("/")
        for rule in started.parameters:
            assert rule.node.startswith("/")
            assert rule.value is not None or rule.unknowns
            json.dumps(rule.value, allow_nan=False)
    places = Places(workspace(files))
    entry_files(places.workspace, loader(files), places, lambda path: True)


@hypothesis.settings(max_examples=60, deadline=None, derandomize=True, database=None)
@hypothesis.given(st.lists(TREES, max_size=6), TEXTS)
def test_any_tree_of_known_words(trees: list[str], yaml: str) -> None:
    check({MAIN: f"<launch>{''.join(trees)}</launch>", "bot/p.yaml": "/**: {ros__parameters: {x: " + yaml + "}}"})


GOOD = """<launch>
  <arg name="m" default="mpc"/>
  <let name="p" value="$(find-pkg-share bot)/p.yaml" if="$(eval &quot;'$(var m)' == 'mpc'&quot;)"/>
  <group><push-ros-namespace namespace="control"/>
    <node_container pkg="r" exec="c" name="k" namespace=""><composable_node pkg="p" plugin="n::C" name="c">
      <remap from="a" to="/b"/><param from="$(var p)" allow_substs="true"/><param name="x" value="$(var m)"/>
    </composable_node></node_container>
  </group>
</launch>
"""


@hypothesis.settings(max_examples=60, deadline=None, derandomize=True, database=None)
@hypothesis.given(st.integers(0, len(GOOD)), st.integers(0, 20), TEXTS, TEXTS)
def test_a_good_file_with_a_piece_replaced(start: int, length: int, text: str, yaml: str) -> None:
    broken = GOOD[:start] + text + GOOD[start + length :]
    check({MAIN: broken, "bot/p.yaml": "/**:\n  ros__parameters:\n    a: $(var m)\n" + yaml})


PLAIN = st.recursive(
    st.one_of(st.none(), st.booleans(), st.integers(), st.floats(), TEXTS),
    lambda inner: st.one_of(
        st.lists(inner, max_size=4),
        st.dictionaries(st.sampled_from((*TAGS, *ATTRIBUTES, "children")), inner, max_size=4),
    ),
    max_leaves=20,
)


@hypothesis.settings(max_examples=60, deadline=None, derandomize=True, database=None)
@hypothesis.given(st.one_of(PLAIN.map(lambda data: json.dumps({"launch": data})), st.text(max_size=60), TEXTS))
def test_any_yaml(text: str) -> None:
    assert read_ros2_yaml(text, "bot/a.launch.yaml") == read_ros2_yaml(text, "bot/a.launch.yaml")
    files = {MAIN: '<launch><include file="$(dirname)/a.launch.yaml"/></launch>', "bot/launch/a.launch.yaml": text}
    run(files)


@hypothesis.settings(max_examples=120, deadline=None, derandomize=True, database=None)
@hypothesis.given(st.one_of(TEXTS, st.text(max_size=40)))
def test_any_text(text: str) -> None:
    phrase, problem = read_phrase(text)
    assert isinstance(phrase, tuple)
    assert isinstance(problem, str)
    for made in (
        expression_value(literal(text)),
        expression_value(Text(text.replace("a", "\ue000"), ("why",) * text.count("a"))),
    ):
        assert len(made.reasons) == made.raw.count("\ue000")
