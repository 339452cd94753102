# SPDX-License-Identifier: Apache-2.0
"""Launch files of any kind are evaluated without an error, within bounds, and the same each time."""

from __future__ import annotations

import json
from dataclasses import replace

import pytest
from roslaunch_kit import MAIN, loader, run, workspace

from haros_ci.extract.launch.xml import from_json, read_launch, to_json
from haros_ci.launch.ros1.entry import entry_files
from haros_ci.launch.ros1.roslaunch import evaluate
from haros_ci.substitutions.presence import OTHER

hypothesis = pytest.importorskip("hypothesis")
st = pytest.importorskip("hypothesis.strategies")

PIECES = (
    *("", "a", "b", "/a", "~a", "a/b", "1", "1.5", "true", "false", " ", "?", "\ue000", "é", "__x"),
    *("$(arg a)", "$(arg b)", "$(env X)", "$(env Y)", "$(optenv X d)", "$(anon a)", "$(dirname)", "$(find bot)"),
    *("$(find x)", "$(eval a + 1)", "$(eval a == b)", "$(eval", "$(", ")", "$", "/launch/main.launch", "/p.yaml"),
    *("xacro", "load", "delete", "dump", "yaml", "int", "deg(1)", "{a: [1, {b: }]}", "&x [*x]", "!!binary x", "- a\n"),
)
TAGS = (
    *("launch", "group", "node", "test", "include", "arg", "param", "rosparam", "remap", "env", "machine"),
    *("Param", "let"),
)
ATTRIBUTES = (
    *("name", "value", "default", "file", "ns", "if", "unless", "pkg", "type", "args", "from", "to", "textfile"),
    *("command", "param", "subst_value", "pass_all_args", "clear_params", "test-name", "respawn", "machine"),
    *("address", "doc"),
)
#: What a tag needs, given most of the time.
NEEDED = {
    "node": ("name", "pkg", "type"),
    "test": ("test-name", "pkg", "type"),
    "include": ("file",),
    "arg": ("name", "default"),
    "param": ("name", "value"),
    "remap": ("from", "to"),
    "env": ("name", "value"),
    "machine": ("name", "address"),
}
TEXTS = st.lists(st.sampled_from(PIECES), max_size=4).map("".join)


def escaped(text: str) -> str:
    return text.replace("&", "&amp;").replace('"', "&quot;").replace("<", "&lt;")


def tag(parts: tuple[str, dict[str, str], list[str], str, list[str]]) -> str:
    name, more, children, text, needed = parts
    attributes = dict(zip(NEEDED.get(name, ()), needed, strict=False)) | more
    written = "".join(f' {key}="{escaped(value)}"' for key, value in attributes.items())
    return f"<{name}{written}>{escaped(text)}{''.join(children)}</{name}>"


def element(children: object) -> object:
    attributes = st.dictionaries(st.sampled_from(ATTRIBUTES), TEXTS, max_size=3)
    return st.tuples(st.sampled_from(TAGS), attributes, children, TEXTS, st.lists(TEXTS, max_size=6)).map(tag)


TREES = st.recursive(element(st.just([])), lambda inner: element(st.lists(inner, max_size=5)), max_leaves=12)


@hypothesis.settings(max_examples=40, deadline=None, derandomize=True, database=None)
@hypothesis.given(st.lists(TREES, max_size=6), TEXTS)
def test_any_tree_of_known_words(trees: list[str], yaml: str) -> None:
    files = {MAIN: f"<launch>{''.join(trees)}</launch>", "bot/p.yaml": yaml}
    launched = run([MAIN], files, args={"a": "1"}, env={"X": "x"})
    assert launched == run([MAIN], files, args={"a": "1"}, env={"X": "x"})
    assert MAIN in launched.files
    assert all(problem.path in files and problem.message for problem in launched.problems)
    for started in launched.nodes:
        assert started.name.startswith("/") and started.namespace.startswith("/")
        assert "\ue000" not in repr(started)
    for parameter in launched.parameters:
        assert "\ue000" not in repr(parameter)
        assert parameter.value is not None or parameter.unknowns
        json.dumps(parameter.value)
    entry_files(workspace(files), loader(files))
    varied = evaluate([MAIN], workspace(files), loader(files), {"a": "1"}, {"X": "x"}, True)
    assert [replace(each, presence=()) for each in varied.nodes] == list(launched.nodes)
    assert [replace(each, presence=()) for each in varied.parameters] == list(launched.parameters)
    assert (varied.arguments, varied.files, varied.includes) == (launched.arguments, launched.files, launched.includes)
    assert varied.problems[: len(launched.problems)] == launched.problems
    assert all(
        each.presence and OTHER not in repr(each) for each in (*varied.alternatives, *varied.alternative_parameters)
    )


@hypothesis.settings(max_examples=40, deadline=None, derandomize=True, database=None)
@hypothesis.given(st.one_of(st.text(max_size=60), TREES.map(lambda text: text[:-3]), TREES))
def test_any_text(text: str) -> None:
    launch = read_launch(text)
    assert (launch.root is None) == bool(launch.problems)
    assert from_json(json.loads(json.dumps(to_json(launch)))) == launch
    run([MAIN], {MAIN: text})
