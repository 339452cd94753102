# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Any

import pytest

from haros_ci.workspace.interfaces import read_interface


def fields(text: str) -> list[tuple[str, str, Any, bool]]:
    found, problems = read_interface("arm/msg/A.msg", text, "arm")
    assert problems == []
    assert len(found.sections) == 1
    return [(f.type, f.name, f.default, f.is_constant) for f in found.sections[0]]


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        ("int32 x", ("int32", "x", None, False)),
        ("  float64[3]   xyz  # metres", ("float64[3]", "xyz", None, False)),
        ("Header header", ("std_msgs/Header", "header", None, False)),
        ("std_msgs/Header header", ("std_msgs/Header", "header", None, False)),
        ("Other[] others", ("arm/Other[]", "others", None, False)),
        ("geometry_msgs/Pose pose", ("geometry_msgs/Pose", "pose", None, False)),
        ("geometry_msgs/msg/Pose pose", ("geometry_msgs/Pose", "pose", None, False)),
        ("time stamp", ("time", "stamp", None, False)),
        ("string<=10 s", ("string<=10", "s", None, False)),
        ("int32[<=5] v", ("int32[<=5]", "v", None, False)),
        ("string<=10[<=5] v", ("string<=10[<=5]", "v", None, False)),
        ("int32 X=123", ("int32", "X", 123, True)),
        ("int32 X = -0x10 # c", ("int32", "X", -16, True)),
        ("float32 Y=1.5e3", ("float32", "Y", 1500.0, True)),
        ("bool B=True", ("bool", "B", True, True)),
        ("byte B = 1", ("byte", "B", 1, True)),
        ("string S= a # b", ("string", "S", "a # b", True)),
        ("string S='a b'", ("string", "S", "a b", True)),
        ("int32 x 42", ("int32", "x", 42, False)),
        ("bool x false # c", ("bool", "x", False, False)),
        ('string s "a # b"', ("string", "s", "a # b", False)),
        ("int32[] v [1, 2]", ("int32[]", "v", (1, 2), False)),
        ("float64[3] v [0.0, 1.0, 2.0]", ("float64[3]", "v", (0.0, 1.0, 2.0), False)),
        ("string[] v ['a, b', \"c\"]", ("string[]", "v", ("a, b", "c"), False)),
        ("int32[] v []", ("int32[]", "v", (), False)),
        ("string report_type SYSTEM", ("string", "report_type", "SYSTEM", False)),
        ("string s two words # c", ("string", "s", "two words", False)),
        ("string<=5 s 'abc'", ("string<=5", "s", "abc", False)),
        ("wstring s abc", ("wstring", "s", "abc", False)),
        ("string s it's", ("string", "s", "it's", False)),
        ("string[] v [a, 'b c']", ("string[]", "v", ("a", "b c"), False)),
        ("uint8 x 0b101", ("uint8", "x", 5, False)),
        ("uint8 X = 0o17", ("uint8", "X", 15, True)),
        ("int64 X=1_000_000", ("int64", "X", 1_000_000, True)),
        ("uint32 X=0xFF_FF", ("uint32", "X", 0xFFFF, True)),
        ("int32 X=010", ("int32", "X", 10, True)),
        ("float64 x nan", ("float64", "x", pytest.approx(float("nan"), nan_ok=True), False)),
    ],
)
def test_fields(line: str, expected: tuple[str, str, Any, bool]) -> None:
    assert fields(f"# first\n\n{line}\r\n") == [expected]


def test_lines() -> None:
    found, _ = read_interface("A.msg", "# c\nint32 x\n\nint32 y", "arm")
    assert [field.line for field in found.sections[0]] == [2, 4]


@pytest.mark.parametrize(
    ("path", "text", "expected"),
    [
        ("srv/S.srv", "int32 a\n---\nint32 b", [["a"], ["b"]]),
        ("srv/S.srv", "---", [[], []]),
        ("srv/S.srv", "int32 a", [["a"], []]),
        ("action/S.action", "int32 a\n---\n---\nint32 c", [["a"], [], ["c"]]),
        ("msg/S.msg", "", [[]]),
    ],
)
def test_sections(path: str, text: str, expected: list[list[str]]) -> None:
    found, problems = read_interface(path, text, "arm")
    assert (found.name, found.kind, problems) == ("arm/S", path.rpartition(".")[2], [])
    assert [[field.name for field in section] for section in found.sections] == expected


@pytest.mark.parametrize(
    "line",
    [
        "int32",
        "int32 1x",
        "int32 x=abc",
        "int32 x = 1.5",
        "int32 x y",
        "int32 x-y",
        "int32<=5 x",
        "int32[ x",
        "a/b/c/d x",
        "a/b/C x",
        "int32[] v [1, a]",
        "time T=1",
        "<xml/>",
        "Other X=1",
    ],
)
def test_lines_that_are_none(line: str) -> None:
    found, problems = read_interface("msg/A.msg", f"int32 a\n{line}\nint32 b", "arm")
    assert [field.name for field in found.sections[0]] == ["a", "b"]
    assert [(p.line, p.message) for p in problems] == [(2, f"not a field or constant: {line!r}")]


def test_a_section_too_many() -> None:
    found, problems = read_interface("msg/A.msg", "int32 a\n---\nint32 b", "arm")
    assert [[field.name for field in section] for section in found.sections] == [["a"]]
    assert [(p.line, p.message) for p in problems] == [(2, "one '---' too many for a .msg; what follows is ignored")]


def test_any_text() -> None:
    hypothesis = pytest.importorskip("hypothesis")
    st = hypothesis.strategies
    piece = st.sampled_from(
        ["int32", "string<=9", " ", " x", "=", "[", "]", ",", "---", "\n", "'", '"', "\\", "#", "1", "/"]
    )

    @hypothesis.settings(max_examples=60, deadline=None, database=None, derandomize=True)
    @hypothesis.given(
        st.lists(piece, max_size=40).map("".join), st.sampled_from(["a.msg", "a.srv", "a.action", "a", ""])
    )
    def check(text: str, path: str) -> None:
        found, _ = read_interface(path, text, "arm")
        assert (found, []) == (read_interface(path, text, "arm")[0], [])

    check()
