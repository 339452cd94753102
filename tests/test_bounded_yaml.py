# SPDX-License-Identifier: Apache-2.0
"""YAML of unknown origin: what is plain is read, the rest is refused with its line, and soon."""

from __future__ import annotations

import pytest

from haros_ci.bounded_yaml import Limits, TooMuch, YamlFault, check, data, nodes

SMALL = Limits(characters=2_000, depth=5, values=100, aliases=10)


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
    assert not isinstance(raised.value, TooMuch)


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
    with pytest.raises(TooMuch) as raised:
        check(text, SMALL)
    assert (raised.value.line, said in str(raised.value)) == (line, True), (raised.value.line, str(raised.value))


def test_documents_are_nodes_with_their_lines() -> None:
    found = list(nodes("a: 1\n---\nb: 2\n", SMALL))
    assert [(node.id, node.start_mark.line) for node in found] == [("mapping", 0), ("mapping", 2)]
    assert list(nodes("", SMALL)) == []
