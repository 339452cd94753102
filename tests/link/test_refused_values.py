# SPDX-License-Identifier: Apache-2.0
"""Where rcl stops in a parameter file that is valid YAML, as its ``parse_file_events`` does."""

from __future__ import annotations

import pytest

from haros_ci.launch.ros2.refused_values import refused_value

HEAD = "a:\n  ros__parameters:\n"


@pytest.mark.parametrize(
    ("below", "line", "problem"),
    [
        ("g: [1, 2.0]", 3, "the list g mixes int and double"),
        ("g: [1.0, 2]", 3, "the list g mixes double and int"),
        ("g: [x, y]", 3, "the list g mixes str and bool"),
        ("g: ['1', 2]", 3, "the list g mixes str and int"),
        ("g: [1, null]", 3, "the list g mixes int and str"),
        ("g: [1, ~]", 3, "the list g mixes int and str"),
        ("g: [1, 0o17]", 3, "the list g mixes int and str"),
        ("g: [1, 1_000]", 3, "the list g mixes int and str"),
        ("g: [1, 9223372036854775808]", 3, "the list g mixes int and double"),
        ("g: [1, .inf]", 3, "the list g mixes int and double"),
        ("g.h:\n  - true\n  - 1", 5, "the list g.h mixes bool and int"),
        ("n: {o: {g: [1, 2], h: [a, 1]}}", 3, "the list h mixes str and int"),
        ("g: [[1, 2], [3]]", 3, "the list g has lists in it"),
        ("g: [[1, 2.0]]", 3, "the list g mixes int and double"),
        ("g: [1,,]", 0, ""),
        ("g: [1, ]\nh:", 4, "h has no value"),
        ("g: &x 1\nh: *x", 4, "*x is an alias"),
        ("g: &x {a: 1}\nh:\n  <<: *x", 5, "*x is an alias"),
        ("'': 1", 3, "a key is empty"),
    ],
)
def test_it_stops(below: str, line: int, problem: str) -> None:
    found = refused_value(HEAD + "".join(f"    {part}\n" for part in below.split("\n")), "p.yaml")
    assert (found.line if found else 0, found.problem if found else "") == (line, problem)


@pytest.mark.parametrize(
    ("text", "line", "problem"),
    [
        ("a: 1\n", 1, "a has a value outside of ros__parameters"),
        ("a:\n  b: [1]\n", 2, "b has a value outside of ros__parameters"),
        ("a:\n", 1, "a has a value outside of ros__parameters"),
        ("a:\n  ros__parameters:\nb: 1\n", 2, "ros__parameters has no parameters"),
        ("a: {ros__parameters: {x: 1}}\nb: 2\n", 2, "b has a value outside of ros__parameters"),
        ("a: {ros__parameters: {x: 1}}\n---\nb: {ros__parameters: {x: [1, a]}}\n", 3, "the list x mixes int and str"),
        ("ros__parameters:\n  a: 1\n", 1, "ros__parameters stands below no name of a node"),
        ("- a\n", 1, "a list stands in place of a name"),
    ],
)
def test_it_stops_outside_of_sections(text: str, line: int, problem: str) -> None:
    found = refused_value(text, "p.yaml")
    assert found is not None
    assert (found.line, found.problem) == (line, problem)


@pytest.mark.parametrize(
    "below",
    [
        "g: [1, 2, 0x10, -7, +3, 010]",
        "g: [1.0, .5, -2., 1e3, 08, .nan, -.inf, nan]",
        "g: [a, 'true', \"1\", null, ~, 1_0, 1.2.3, 0x, Null]",
        "g: [true, yes, On, N, n, FALSE]",
        "g: []",
        "g: [[]]",
        "g: [[1, 2]]",
        "g: [1, [a, b]]",
        "g:\n- 1\n- 2",
        "g: [1, ]",
        "g: ''",
        "g: null",
        "g: ~",
        "g: *",
        "g: {h: {i: {j: [1]}}, k: [a]}",
        "g: &x [1, 2]",
        "g: [!!str 1, a]",
        "g: [!!str 1, 2]",
        "g: [|\n      1\n  , 2]",
        "g: [1.0, 1e400]",
        "g: [1.0, 0x1p3]",
        "g: [{a: 1, b: x}, 2]",
        "g: {}\nh: [1, a]",
        "ros__parameters: {a: 1}",
        "ros__parameters: [1, 2]",
        "g: [$(var x), 1]",
        "g: {{ robot }}",
        f"g: [1, {'1' * 200}]",
    ],
)
def test_it_goes_on_or_nobody_can_tell(below: str) -> None:
    assert refused_value(HEAD + "".join(f"    {part}\n" for part in below.split("\n")), "p.yaml") is None


@pytest.mark.parametrize(
    "text",
    [
        "",
        "# nothing\n",
        "---\n",
        "word\n",
        "a: {ros__parameters: {x: 1}, b: {ros__parameters: {y: [1]}}}\n",
        "/**:\n  ros__parameters: {x: 1}\n/ns/a:\n  ros__parameters: {x: 2.0}\n",
        "? {a: 1}\n: 1\n",
        "a: {ros__parameters: {x: [1, " + "[" * 3_000,
    ],
)
def test_other_texts(text: str) -> None:
    assert refused_value(text, "p.yaml") is None
