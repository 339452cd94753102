# SPDX-License-Identifier: Apache-2.0
"""YAML of unknown origin: plain data with lines, and nothing else."""

from __future__ import annotations

import pytest

from haros_ci.config.yaml_lines import MAX_ALIASES, MAX_DEPTH, YamlValue, parse, plain
from haros_ci.errors import UserError

BOMB = b"a: &a [x, x, x, x, x, x, x, x, x]\n" + b"".join(
    b"%c: &%c [%s]\n" % (98 + i, 98 + i, b", ".join([b"*%c" % (97 + i)] * 9)) for i in range(12)
)


@pytest.mark.parametrize(
    ("data", "expected"),
    [
        (b"", None),
        (b"# only a comment\n", None),
        (b"%YAML 1.1\n---\na: 1\n", {"a": 1}),
        (b"%YAML 1.2\n---\na: 1\n", {"a": 1}),
        (b"\xef\xbb\xbfa: 1", {"a": 1}),
        (b"a: 1\r\nb: 2\r\n", {"a": 1, "b": 2}),
        ("a: prüfen".encode(), {"a": "prüfen"}),
        (b"a: [1, 2.5, yes, null, text]", {"a": [1, 2.5, True, None, "text"]}),
        (b"a: off\nb: 'off'\nc: !!str off", {"a": False, "b": "off", "c": "off"}),
        (b"a: 0x10\nb: 1_000\nc: 1:30", {"a": 16, "b": 1000, "c": 90}),
        (b"a: 2020-01-01", {"a": "2020-01-01"}),  # a date stays text: the file is carried as plain data
        (b"a: !!seq [1]\nb: !!map {c: !!int '3'}", {"a": [1], "b": {"c": 3}}),
        (b"a: &x [1]\nb: *x", {"a": [1], "b": [1]}),
        (b"1: a\ntrue: b\nnull: c", {1: "b", None: "c"}),
        (b"x: &x {a: 1, b: 2}\ny: {<<: *x, b: 3}", {"x": {"a": 1, "b": 2}, "y": {"a": 1, "b": 3}}),
        (b"y:\n  <<: [{a: 1}, {a: 2, b: 2}]\n  c: 3", {"y": {"a": 1, "b": 2, "c": 3}}),
        (b"a: '<<'", {"a": "<<"}),
        (b"a: |\n  two\n  lines\n", {"a": "two\nlines\n"}),
    ],
)
def test_plain_data(data: bytes, expected: object) -> None:
    top = parse(data, "f.yaml").top
    assert (None if top is None else plain(top)) == expected


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (b"a: [1\nb: 2", "f.yaml:2: not valid YAML"),
        (b"a:\n\t- b", "f.yaml:2: not valid YAML"),
        (b'a: "open', "f.yaml:1: not valid YAML"),
        (b"%YAML 2.0\n---\na: 1", "f.yaml:1: not valid YAML"),
        (b"a: 1\nb: \xe9\n", "f.yaml:2: not UTF-8"),
        ("a: 1".encode("utf-16"), "f.yaml:1: not UTF-8"),
        (b"a: 1\n\nb: \x1b[2J", "f.yaml:3: not valid YAML: it holds a control character"),
        (b"a: \x00", "f.yaml:1: not valid YAML: it holds a control character"),
        (b"a: 1\n---\nb: 2", "f.yaml:2: a second document"),
        (b"a: !!python/object/apply:os.system [id]", "f.yaml:1: tag 'tag:yaml.org,2002:python/object/apply:os.system'"),
        (b"a: !!python/name:os.system ''", "f.yaml:1: tag"),
        (b"%TAG ! tag:yaml.org,2002:python/\n---\na: !name:os.system x", "f.yaml:3: tag"),
        (b"a: !own {b: 1}", "f.yaml:1: tag '!own'"),
        (b"a: !!binary aGk=", "f.yaml:1: tag"),
        (b"a: !!set {x}", "f.yaml:1: tag"),
        (b"a: 1\n? [b]\n: c", "f.yaml:2: a list or map cannot be a key"),
        (b"{{a: 1}: 2}", "f.yaml:1: a list or map cannot be a key"),
        (b"a: {<<: 3}", "f.yaml:1: '<<' merges maps only"),
        (b"a: *b", "f.yaml:1: no anchor 'b'"),
        (b"a: &a [*a]", "f.yaml:1: 'a' contains itself"),
        (b"a: &a {b: {<<: *a}}", "f.yaml:1: 'a' contains itself"),
        (b"a: !!int foo", "f.yaml:1: 'foo' is no int"),
        (b"a: !!int ''", "f.yaml:1: '' is no int"),
        (b"a: !!bool foo", "f.yaml:1: 'foo' is no bool"),
        (b"a: " + b"1" * 5000, "f.yaml:1: number too long"),
        (b"a: 1" + b":59" * 100_000, "f.yaml:1: number too long"),
        (b"a" * 2_000_000, "f.yaml: larger than 1000000 bytes"),
        (b"[" * 900_000, "f.yaml:1: nested deeper than 50 levels"),
        (b"{a: " * 200_000, "f.yaml:1: nested deeper than 50 levels"),
        (b"- " * 400_000, "f.yaml:1: nested deeper than 50 levels"),
        (b"".join(b" " * i + b"a:\n" for i in range(60)), f"f.yaml:{MAX_DEPTH}: nested deeper"),
        (BOMB, "f.yaml:6: more than 100000 values, aliases counted"),
        (b"a: &a x\nb: [" + b"*a, " * (MAX_ALIASES + 1) + b"]", f"f.yaml:2: more than {MAX_ALIASES} aliases"),
    ],
)
def test_refused(data: bytes, message: str) -> None:
    with pytest.raises(UserError) as caught:
        parse(data, "f.yaml")
    assert caught.value.message.startswith(message)
    assert caught.value.help
    assert len(caught.value.message) < 300


@pytest.mark.parametrize(
    ("data", "line"),
    [
        (b"e: [", 1),
        (b"a: 1\ne: {", 2),
        (b"a: 1\ne: 'open", 2),
        (b"e: [\n", 2),
        (b"a: 1\r\re: [\r", 4),
        ("a: 1\u2028e: [\u2029".encode(), 3),
        (b"a: |\n  \xc2\x85 x\n\t- [", 4),
    ],
)
def test_what_ends_too_early_is_refused_at_a_line_of_the_file(data: bytes, line: int) -> None:
    with pytest.raises(UserError, match=rf"^f\.yaml:{line}: not valid YAML"):
        parse(data, "f.yaml")


def test_a_tab_is_named_as_the_cause() -> None:
    with pytest.raises(UserError) as caught:
        parse(b"a:\n\t- b", "f.yaml")
    assert caught.value.help == "indent with spaces: YAML forbids tabs"


def test_lines_are_those_of_keys_and_values() -> None:
    top = parse(b"# first\na: 1\nb:\n  - x\n  - y\n", "f.yaml").top
    assert top is not None and isinstance(top.data, dict)
    second = top.data["b"]
    assert (top.data["a"].key_line, second.key_line, second.line) == (2, 3, 4)
    assert isinstance(second.data, tuple)
    assert second.data == (YamlValue(4, "x"), YamlValue(5, "y"))


def test_repeated_keys_are_told_and_the_last_counts() -> None:
    document = parse(b"a: 1\nb: {c: 1,\n  c: 2}\na: 3", "f.yaml")
    assert document.top is not None and plain(document.top) == {"a": 3, "b": {"c": 2}}
    assert [(d.key, d.line, d.first) for d in document.duplicates] == [("c", 3, 2), ("a", 4, 1)]


def test_a_merged_key_is_no_repetition() -> None:
    assert parse(b"a: &a {x: 1}\nb: {<<: *a, x: 2}", "f.yaml").duplicates == ()


def test_depth_just_within_the_limit() -> None:
    inner = MAX_DEPTH - 1
    assert parse(b"[" * inner + b"1" + b"]" * inner, "f.yaml").top is not None
