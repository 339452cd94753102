# SPDX-License-Identifier: Apache-2.0
"""Which directory a run's paths are relative to, and where the search for a project file begins."""

from __future__ import annotations

from pathlib import Path

import pytest
from commandline import write

from haros_ci.errors import UserError
from haros_ci.workspace.roots import locate

FILES = {"ws/src/a/a.cpp": "", "ws/src/b/b.cpp": "", "other/o.cpp": ""}


@pytest.mark.parametrize(
    ("git", "cwd", "arguments", "root", "paths", "start"),
    [
        (None, "ws", (), "ws", (".",), "ws"),
        (None, "ws", ("src/a",), "ws", ("src/a",), "ws/src/a"),
        (None, "ws", ("src/a/a.cpp",), "ws", ("src/a/a.cpp",), "ws/src/a"),
        (None, "ws/src", ("a", "b/b.cpp"), "ws/src", ("a", "b/b.cpp"), "ws/src"),
        (None, "other", ("../ws/src/a",), "ws/src/a", (".",), "ws/src/a"),
        (None, "other", ("../ws/src/a", "../ws/src/b"), "ws/src", ("a", "b"), "ws/src"),
        ("ws", "ws/src/a", (), "ws", ("src/a",), "ws/src/a"),
        ("ws", "other", ("../ws/src/b/b.cpp",), "ws", ("src/b/b.cpp",), "ws/src/b"),
        ("ws/src/a", "ws", (), "ws", (".",), "ws"),
        ("ws/src/a", "ws", ("src/a",), "ws/src/a", (".",), "ws/src/a"),
        (".", "ws", ("src",), ".", ("ws/src",), "ws/src"),
    ],
)
def test_locate(
    tmp_path: Path, git: str | None, cwd: str, arguments: tuple[str, ...], root: str, paths: tuple[str, ...], start: str
) -> None:
    write(tmp_path, FILES)
    if git:
        (tmp_path / git / ".git").mkdir()
    place = locate(arguments, tmp_path / cwd)
    assert (place.root, place.paths, place.start) == ((tmp_path / root).resolve(), paths, (tmp_path / start).resolve())


def test_what_is_not_there(tmp_path: Path) -> None:
    with pytest.raises(UserError, match="no such file"):
        locate(("nowhere",), tmp_path)
