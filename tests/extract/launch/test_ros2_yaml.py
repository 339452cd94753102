# SPDX-License-Identifier: Apache-2.0
"""ROS 2 launch files in YAML: the same actions as in XML, with typed values."""

from __future__ import annotations

import pytest

from haros_ci.extract.launch.ros2_yaml import read_ros2_yaml
from haros_ci.model.launch_actions import Description, Substitution

PATH = "bot/launch/a.launch.yaml"


def read(text: str) -> Description:
    found = read_ros2_yaml(text, PATH)
    assert found is not None
    return found


def test_elements_in_order_with_their_places() -> None:
    description = read(
        """
launch:
- arg:
    name: a
    default: "1"
- group:
  - push_ros_namespace: {namespace: x}
  - node:
      pkg: p
      exec: e
      name: n$(var a)
      if: true
      param:
      - {name: i, value: 1}
      - name: t
        value: "1"
      - from: f.yaml
      remap:
      - {from: a, to: b}
"""
    )
    assert description.problems == ()
    arg, group = description.actions
    assert (arg.kind, arg.get("default"), arg.location.line) == ("arg", ("1",), 3)
    push, node = group.children
    assert (push.kind, push.get("namespace")) == ("push-namespace", ("x",))
    assert node.location.line == 8
    name = node.get("name")
    assert name is not None
    assert name[0] == "n"
    assert isinstance(name[1], Substitution)
    assert [test.text for test in node.tests] == ["true"]
    assert [source.values for source in node.parameters] == [((("i",), 1),), ((("t",), "1"),), ()]
    assert [(source, target) for source, target, _ in node.remaps] == [(("a",), ("b",))]


def test_a_group_with_attributes_has_its_elements_below_children() -> None:
    text = "launch:\n- group:\n    scoped: false\n    children:\n    - let: {name: a, value: b}\n"
    group = read(text).actions[0]
    assert group.get("scoped") == ("false",)
    assert [child.kind for child in group.children] == ["let"]


@pytest.mark.parametrize(
    ("text", "line", "message"),
    [
        ("", 1, "not a launch file: it needs the one key 'launch', with a list"),
        ("a: 1\nb: 2", 1, "not a launch file: it needs the one key 'launch', with a list"),
        ("launch: [}", 1, "the launch file is not valid YAML: did not find expected node content; correct it"),
        (
            "launch:\n- a: 1\n  b: 2",
            2,
            "each item of a list must be a map with one key, the tag; split this item",
        ),
        ("launch:\n- nodes: {}", 2, "launch knows no <nodes> here; did you mean <node>?"),
        ("launch:\n- node: x", 2, "'node' needs a map of its attributes"),
    ],
)
def test_what_is_refused_is_reported(text: str, line: int, message: str) -> None:
    assert (line, message) in read(text).problems


def test_deep_and_circular_files_are_refused() -> None:
    assert read("launch: " + "[" * 500).actions == ()
    assert read("launch: &a\n- group: *a\n").actions == ()


PARAMETERS = "/bot/driver_launch:\n  ros__parameters:\n    rate: 5\n"


@pytest.mark.parametrize(
    ("path", "text"),
    [
        ("bot/config/driver_launch.yaml", PARAMETERS),
        ("bot/test/driver.launch.yaml", PARAMETERS),
        ("bot/test/driver.launch.yml", f"bot:\n  {PARAMETERS.replace(chr(10), chr(10) + '  ')}"),
        ("bot/test/driver.launch.yaml", "a: &a\n  b: *a\n  /n:\n    ros__parameters: {}\n"),
        ("bot/config/rocket_launch.yaml", "pad: 39\nthrust: [1, 2]\n"),
        ("bot/config/rocket_launch.yml", "launcher: {node: x}\n"),
    ],
)
def test_a_map_of_something_else_is_no_launch_file(path: str, text: str) -> None:
    assert read_ros2_yaml(text, path) is None


@pytest.mark.parametrize(
    ("path", "text"),
    [
        ("bot/launch/a.launch.yaml", "a: &a\n  b: *a\n"),
        ("bot/launch/a.launch.yaml", "lauch:\n- node: {}\n"),
        ("bot/launch/a_launch.yaml", "launch:\n- node: {}\n"),
        ("bot/launch/a_launch.yaml", "launch: []\nros__parameters: {}\n"),
        ("bot/launch/a_launch.yaml", "- node: {}\n"),
        ("bot/launch/a_launch.yaml", ""),
    ],
)
def test_a_launch_file_stays_one(path: str, text: str) -> None:
    assert read_ros2_yaml(text, path) is not None


def test_maps_that_aliases_name_again_and_again_are_looked_through_once() -> None:
    levels = "".join(f"a{n}: &a{n}\n" + "".join(f"  k{m}: *a{n - 1}\n" for m in range(300)) for n in range(1, 6))
    assert read_ros2_yaml(f"a0: &a0\n  k: {{x: 1}}\n{levels}", "bot/launch/a.launch.yaml") is not None


@pytest.mark.parametrize(
    ("node", "executable"),
    [
        ("{pkg: p, exec: a, exec: b}", "b"),
        ("{exec: a, pkg: p, exec: b, pkg: p}", "b"),
        ("{<<: {pkg: p, exec: a}}", "a"),
        ("{exec: b, <<: {pkg: p, exec: a}}", "b"),
        ("{<<: {exec: a, <<: {pkg: p}}}", "a"),
        ("{pkg: p, <<: [{exec: a}, {exec: b}]}", "a"),
        ("{pkg: p, exec: a}", "a"),
        ("{pkg: p, '<<': x, exec: a}", "a"),
    ],
)
def test_keys_that_stand_twice_or_are_merged_are_those_of_yaml(node: str, executable: str) -> None:
    (found,) = read(f"launch:\n- node: {node}\n").actions
    assert found.get("executable") == (executable,) and found.get("package") == ("p",)


def test_merges_without_end_are_refused() -> None:
    levels = "".join(f"- group: &g{n} {{<<: [*g{n - 1}, *g{n - 1}, *g{n - 1}]}}\n" for n in range(1, 30))
    for text in (f"launch:\n- group: &g0 {{scoped: false}}\n{levels}", "launch:\n- group: &g {<<: *g}\n"):
        assert any("merged" in message for _, message in read(text).problems), text
