# SPDX-License-Identifier: Apache-2.0
"""Names of interfaces that rosidl refuses are named where a change brings them into a package of ROS 2."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from linter_samples import workspace

from haros_ci.linters.refused_interfaces import is_refused, notifications, refused
from haros_ci.model.package import Package

FIRES = {
    "twice": ("int32 a\nstring a\n", 2),
    "twice with a value": ("int32 a 1\nint32 a 2\n", 2),
    "a constant twice": ("int8 A=1\nint8 A=2\n", 2),
    "capitals": ("int32 bigName\n", 1),
    "two underlines": ("int32 a\nint32 a__b\n", 2),
    "an underline at the end": ("int32 a_\n", 1),
    "a small constant": ("int8 top=1\n", 1),
    "a constant with two underlines": ("int8 A__B = 1\n", 1),
    "behind a carriage return": ("# a\rint32 bigName\n", 2),
    "in an array": ("std_msgs/String[<=3] Words\n", 1),
}
QUIET = {
    "plain": "int32 a\nfloat64[3] b_2c\nstring<=5 d 'x'\n",
    "constants": "int8 A=1\nint8 B_2=2\nint8 A_B = 3  # int8 A=1\n",
    "a field and a constant": "int8 A=1\nint8 a\n",
    "in two parts": "int8 a\n---\nint8 a\n---\nint8 a\n",
    "comments": "# int32 bigName\n   # int32 a__b\nint32 a # int32 a\n",
    "annotations": "@verbatim (language='comment', text='bigName')\nint32 a\n",
    "a value like a name": "string a 'bigName b'\nstring B='bigName = 1'\n",
    "numbers": "int32 a1\nint32 a_1\nint32 x2y3\n",
    "no definition": "bigName\n= 1\n\n",
    "nothing": "",
}


@pytest.mark.parametrize("name", FIRES)
def test_fires(name: str) -> None:
    text, line = FIRES[name]
    assert [number for number, _ in refused("arm/msg/Word.msg", text)] == [line]


@pytest.mark.parametrize("name", QUIET)
def test_stays_quiet(name: str) -> None:
    assert list(refused("arm/action/Word.action", QUIET[name])) == []


@pytest.mark.parametrize(
    ("path", "count"),
    [
        ("arm/msg/word.msg", 1),
        ("arm/msg/Big_Word.msg", 1),
        ("arm/srv/Big-Word.srv", 1),
        ("arm/msg/Word2.msg", 0),
        ("arm/old/word.msg", 0),
        ("msg/word.idl", 0),
    ],
)
def test_names_of_files(path: str, count: int) -> None:
    assert is_refused(path) is bool(count)


@pytest.mark.parametrize("ros", [1, 2, None])
def test_what_a_change_brings(tmp_path: Path, ros: int | None) -> None:
    def said(place: str, base: str, head: str) -> list[int | None]:
        package = replace(Package(name="arm", path="arm"), ros=ros)
        sides = [
            workspace(tmp_path / place / side, {"arm/srv/Word.srv": text}, [package])
            for side, text in (("b", base), ("h", head))
        ]
        assert notifications(sides[1], None) == ()
        return [note.line for note in notifications(sides[1], sides[0])]

    assert said("1", "int32 a\n", "int32 a\nint32 bigName\n") == ([2] if ros == 2 else [])
    package = replace(Package(name="arm", path="arm"), ros=ros)
    texts = {"arm/srv/Word.srv": "int32 a\n"}, {"arm/srv/Word.srv": "int32 a\n", "arm/srv/word.srv": "int32 a\n"}
    old, new = (workspace(tmp_path / str(number), files, [package]) for number, files in enumerate(texts))
    assert [note.path for note in notifications(new, old)] == (["arm/srv/word.srv"] if ros == 2 else [])
    assert notifications(new, new) == ()
    assert said("2", "int32 bigName\n", "int32 a\nint32 bigName\n") == []


def test_a_long_file_takes_linear_time() -> None:
    assert len(list(refused("msg/A.msg", "int32 a_\n" * 50_000))) == 5_000
    assert list(refused("msg/A.msg", "a " * 100_000 + "a_" * 100_000)) == []
