# SPDX-License-Identifier: Apache-2.0
"""Carriage returns alone in CMake and in files of data are named where a change brings them."""

from __future__ import annotations

from pathlib import Path

import pytest
from linter_samples import workspace

from haros_ci.linters.lone_returns import lone_return, notifications

FIRES = {
    "a comment": ("# why\radd_executable(a a.cpp)\n", 1),
    "a later line": ("a: 1\n# b\rc: 2\n", 2),
    "with both kinds": ("a: 1\r\nb: 2\rc: 3\r\n", 2),
    "several": ("a: 1\r\rb: 2\n", 1),
    "the old kind": ("a: 1\rb: 2\r", 1),
}
QUIET = {
    "unix": "a: 1\nb: 2\n",
    "windows": "a: 1\r\nb: 2\r\n",
    "mixed": "a: 1\r\nb: 2\nc: 3\r\n",
    "twice": "a: 1\r\r\nb: 2\r\r\n",
    "at the end": "a: 1\nb: 2\r",
    "written": 'a: "\\r"\n<b>&#13;</b>\n',
    "nothing": "",
}
PATHS = ["CMakeLists.txt", "a.yaml", "a.launch", "package.xml", "a.urdf", "setup.cfg", "a.srv"]


@pytest.mark.parametrize("name", FIRES)
def test_fires(name: str) -> None:
    text, line = FIRES[name]
    assert lone_return(text) == line


@pytest.mark.parametrize("name", QUIET)
def test_stays_quiet(name: str) -> None:
    assert lone_return(QUIET[name]) is None


@pytest.mark.parametrize("path", PATHS)
def test_kinds_of_files(tmp_path: Path, path: str) -> None:
    assert said(tmp_path, {path: "a\n"}, {path: "# a\rb\n"}) == [path]


def test_what_a_change_brings(tmp_path: Path) -> None:
    old = {"a.yaml": "# a\rb: 1\n"}
    assert said(tmp_path / "1", old, {"a.yaml": "# a\rb: 2\n"}) == []
    assert said(tmp_path / "2", old, {"sub/a.yaml": "# a\rb: 2\n"}) == []
    assert said(tmp_path / "3", {}, {"a.py": "# a\rb = 1\n", "a.md": "a\rb\n"}) == []
    assert notifications(workspace(tmp_path / "4", old), None) == ()


def test_a_long_line_takes_linear_time() -> None:
    assert lone_return("\r" * 200_000 + "\n") is None
    assert lone_return(("\r" * 99 + "\n") * 5_000) is None


def said(place: Path, base: dict[str, str], head: dict[str, str]) -> list[str | None]:
    sides = {side: workspace(place / side, files) for side, files in (("base", base), ("head", head))}
    return [note.path for note in notifications(sides["head"], sides["base"])]
