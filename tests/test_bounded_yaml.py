# SPDX-License-Identifier: Apache-2.0
"""YAML of unknown origin: what is plain is read, the rest is refused with its line, and soon."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import pytest

from haros_ci.bounded_yaml import TAG, Composer, YamlFault, YamlLimits, YamlTooLarge, check, data, nodes, scalar_value
from haros_ci.extract.parameter_library_yaml import parse_yaml
from haros_ci.robot.unknown import UNKNOWN
from haros_ci.robot.yaml_values import yaml_value

SMALL = YamlLimits(characters=2_000, depth=5, values=100, aliases=10)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("", None),
        ("a: 1", {"a": 1}),
        ("- &x [1, 2]\n- *x\n", [[1, 2], [1, 2]]),
        ("a: {b: {c: {d: [1]}}}", {"a": {"b": {"c": {"d": [1]}}}}),
        ("a: !!str 1", {"a": "1"}),
        ("a: yes", {"a": True}),
        ("# nothing\n", None),
    ],
)
def test_plain_data_is_read(text: str, value: object) -> None:
    check(text, SMALL)
    assert data(text, SMALL) == value


@pytest.mark.parametrize(
    ("text", "line", "said"),
    [
        ("a: 1\nb: [1\n", 3, "correct it"),
        ("a: 1\nb: *x\n", 2, "undefined alias"),
        ("a: \x01", 1, "control character"),
        ("a: !!python/object:os.system {}", 1, "could not determine a constructor"),
        ("a: !!timestamp x", 1, "of the type that its tag"),
        ("a: !!int x", 1, "invalid literal"),
        ("? [a]\n: 1\n", 1, "unhashable"),
    ],
)
def test_what_is_no_plain_data_is_refused_with_its_line(text: str, line: int, said: str) -> None:
    with pytest.raises(YamlFault) as raised:
        data(text, SMALL)
    assert (raised.value.line, said in str(raised.value)) == (line, True), str(raised.value)
    assert not isinstance(raised.value, YamlTooLarge)


@pytest.mark.parametrize(
    ("text", "line", "said"),
    [
        ("x" * 2_001, 1, "more than 2000 characters"),
        ("a:\n  " + "[" * 100, 2, "nested deeper than 5 levels"),
        ("a\n...\n---\n" + "- 1\n" * 200, 102, "more than 100 values"),
        ("- &x 1\n" + "- *x\n" * 11, 12, "more than 10 aliases"),
    ],
)
def test_what_is_over_a_limit_is_refused_with_its_line(text: str, line: int, said: str) -> None:
    with pytest.raises(YamlTooLarge) as raised:
        check(text, SMALL)
    assert (raised.value.line, said in str(raised.value)) == (line, True), (raised.value.line, str(raised.value))


def test_documents_are_nodes_with_their_lines() -> None:
    found = list(nodes("a: 1\n---\nb: 2\n", SMALL))
    assert [(node.id, node.start_mark.line) for node in found] == [("mapping", 0), ("mapping", 2)]
    assert list(nodes("", SMALL)) == []


@dataclass(frozen=True)
class Placed:
    data: Any
    size: int
    line: int


class Lines(Composer[Placed]):
    def __init__(self, text: str) -> None:
        super().__init__(text, SMALL)
        self.again_at: list[tuple[str, int, int]] = []

    def scalar(self, event: Any, tag: str) -> object:
        return self.number(event, tag) if tag in (TAG + "int", TAG + "bool") else event.value

    def made(self, event: Any, data: Any, size: int) -> Placed:
        return Placed(data, size, event.start_mark.line + 1)

    def under(self, value: Placed, event: Any) -> Placed:
        return replace(value, line=event.start_mark.line + 1)

    def twice(self, key: Any, event: Any, first: Placed) -> None:
        self.again_at.append((key, first.line, event.start_mark.line + 1))


def bare(value: Placed) -> object:
    if isinstance(value.data, dict):
        return {key: bare(item) for key, item in value.data.items()}
    return [bare(item) for item in value.data] if isinstance(value.data, tuple) else value.data


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("a: 1", {"a": 1}),
        ("a: yes\nb: '1'\nc: !!str 1", {"a": True, "b": "1", "c": "1"}),
        ("- &x [1, 2]\n- *x\n", [[1, 2], [1, 2]]),
        ("x: &x {a: 1, b: 2}\ny: {<<: *x, b: 3}", {"x": {"a": 1, "b": 2}, "y": {"a": 1, "b": 3}}),
        ("<<: [{a: 1}, {a: 2, b: 2}]\nc: 3", {"a": 1, "b": 2, "c": 3}),
        ("'<<': {a: 1}", {"<<": {"a": 1}}),
        ("[[[[1]]]]", [[[[1]]]]),
        ("&a a: 1\n*a : 2", {"a": 2}),
    ],
)
def test_values_are_composed(text: str, value: object) -> None:
    top = Lines(text).document()
    assert top is not None and bare(top) == value


def test_what_is_composed_knows_its_lines_and_keys_that_stand_twice() -> None:
    lines = Lines("a: 1\nb:\n  c: 2\na: 3\n")
    top = lines.document()
    assert top is not None and {key: item.line for key, item in top.data.items()} == {"a": 4, "b": 2}
    assert lines.again_at == [("a", 1, 4)]
    assert Lines("").document() is None


@pytest.mark.parametrize(
    ("text", "line", "said"),
    [
        ("x" * 2_001, 1, "more than 2000 characters; split it"),
        ("a:\n  [[[[1]]]]", 2, "nested deeper than 5 levels; flatten it"),
        (
            "a: b\n" + "- 1\n" * 3,
            2,
            "not valid YAML: did not find expected key (the line is indented otherwise than those above it); correct it",
        ),
        (
            "a:\n\t- b",
            2,
            "not valid YAML: found character that cannot start any token (a tab stands in the indentation, or",
        ),
        ("- 1\n" * 120, 100, "more than 100 values, aliases counted; split it"),
        ("- &a [1, 2, 3, 4, 5, 6, 7, 8, 9]\n- &b [*a, *a, *a]\n- [*b, *b, *b]", 3, "more than 100 values"),
        ("- &x 1\n" + "- *x\n" * 11, 12, "more than 10 aliases; write the values out"),
        ("- *x", 1, "alias 'x' is not defined above"),
        ("- &x\n  - *x", 2, "alias 'x' contains itself"),
        ("<<: 3", 1, "'<<' merges maps only"),
        ("a: 1\n? [b]\n: *x\n", 2, "a list or map cannot be a key"),
        ("a: !own {b: 1}", 1, "tag '!own' is not allowed"),
        ("a: !!bool maybe", 1, "'maybe' is no bool; correct or quote it"),
        ("a: 1" + ":59" * 100, 1, "number too long"),
        ("a: 1\n---\nb: 2", 2, "a second document begins here; keep one"),
        ("a: \x01", 1, "it holds a control character"),
        ("a: \ud800", 1, "it holds a control character"),
    ],
)
def test_what_cannot_be_composed_is_refused_with_its_line(text: str, line: int, said: str) -> None:
    with pytest.raises(YamlFault) as raised:
        Lines(text).document()
    assert (raised.value.line, said in str(raised.value)) == (line, True), (raised.value.line, str(raised.value))


@pytest.mark.parametrize(
    ("kind", "text", "value"),
    [("int", "0x1f", 31), ("int", "1_000", 1000), ("float", "1.5", 1.5), ("bool", "off", False), ("null", "~", None)],
)
def test_scalars_are_those_of_pyyaml(kind: str, text: str, value: object) -> None:
    assert scalar_value(kind, text) == value


@pytest.mark.parametrize(
    ("kind", "text"), [("int", ""), ("int", "x"), ("float", "-"), ("bool", "maybe"), ("int", "1" + ":59" * 100_000)]
)
def test_what_is_no_such_scalar_is_refused(kind: str, text: str) -> None:
    with pytest.raises(ValueError, match=r"no |longer|invalid|could not|empty"):
        scalar_value(kind, text)


def test_a_quoted_merge_sign_is_a_key_of_a_parameter_library_like_any_other() -> None:
    top = parse_yaml("x: &x {a: 1}\ny: {'<<': *x}\nz: {<<: *x}\n")
    assert top is not None and isinstance(top.data, dict)
    inner = [item.data for item in top.data.values()]
    assert [list(item) for item in inner if isinstance(item, dict)] == [["a"], ["<<"], ["a"]]


@pytest.mark.parametrize("text", ["a: !!bool maybe", "a: !!int x", "a: !!int ''"])
def test_a_scalar_that_is_not_of_its_tag_makes_a_file_of_xacro_unknown(text: str) -> None:
    assert yaml_value(text, float) is UNKNOWN
