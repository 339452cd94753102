# SPDX-License-Identifier: Apache-2.0
"""What counts as a change of a workspace, and what does not."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import pytest
from commandline import commit, write

from haros_ci.errors import UserError
from haros_ci.workspace.signature import changes, signature

FILES = {
    "a/package.xml": "<package/>",
    "a/x.cpp": "int x;\n",
    "a/mesh.stl": "solid",
    "build/CMakeCache.txt": "",
    "b.py": "\n",
}


@pytest.fixture(params=["plain", "git"])
def root(tmp_path: Path, request: pytest.FixtureRequest) -> Path:
    made = write(tmp_path / "ws", FILES)
    if request.param == "git":
        write(made, {".gitignore": "*.log\n"})
        commit(made)
    return made


def later(path: Path) -> None:
    """As if saved a second after it was."""
    found = path.stat()
    os.utime(path, ns=(found.st_atime_ns, found.st_mtime_ns + 10**9))


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda root: later(root / "a/x.cpp"), (("a/x.cpp", "changed"),)),
        (lambda root: write(root, {"a/y.py": ""}), (("a/y.py", "new"),)),
        (lambda root: (root / "b.py").unlink(), (("b.py", "gone"),)),
        (lambda root: (root / "b.py").chmod(0o755), (("b.py", "changed"),)),
        (lambda root: (root / "b.py").rename(root / "c.py"), (("b.py", "gone"), ("c.py", "new"))),
        (lambda root: later(root / "a/mesh.stl"), (("a/mesh.stl", "changed"),)),
        (lambda root: write(root, {".haros-ci.yaml": ""}), ((".haros-ci.yaml", "new"),)),
        (lambda root: write(root, {"../other.yaml": "x"}), (("{more}", "new"),)),
    ],
    ids=["saved", "new", "gone", "mode", "renamed", "mesh", "project file", "named elsewhere"],
)
def test_changes(root: Path, change: Callable[[Path], object], said: tuple[tuple[str, str], ...]) -> None:
    more = [root.parent / "other.yaml"]
    before = signature(root, (".",), more=more)
    change(root)
    named = tuple((path.replace("{more}", str(more[0])), how) for path, how in said)
    assert changes(before, signature(root, (".",), more=more)) == named


@pytest.mark.parametrize(
    "change",
    [
        lambda root: None,
        lambda root: (root / "b.py").read_bytes(),
        lambda root: write(root, {"out/log.xml": "<x/>"}),
        lambda root: write(root, {"cache/ab/cd.json": "{}"}),
        lambda root: write(root, {".venv/lib/x.py": ""}) and write(root, {"__pycache__/b.pyc": b"x"}),
        lambda root: write(root, {"build/CMakeFiles/x.cpp": ""}),
        lambda root: write(root, {"excluded/x.py": ""}),
        lambda root: write(root, {".git/HEAD.lock": ""}),
    ],
    ids=["nothing", "read", "own output", "own cache", "environment", "build tree", "excluded", "git's own"],
)
def test_what_is_no_change(root: Path, change: Callable[[Path], object]) -> None:
    def look() -> object:
        return signature(root, (".",), exclude=("excluded/",), but=[root / "out/log.xml", root / "cache"])

    before = look()
    change(root)
    assert look() == before and before


def test_only_what_was_asked_for_counts(root: Path) -> None:
    before = signature(root, ("a",))
    write(root, {"b.py": "x = 1\n"})
    assert signature(root, ("a",)) == before
    with pytest.raises(UserError):
        signature(root, ("nowhere",))


def test_links_and_vanishing_files_do_no_harm(root: Path) -> None:
    (root / "loop.py").symlink_to("loop.py")
    (root / "away.py").symlink_to("/nowhere/x.py")
    found = signature(root, (".",))
    assert {"loop.py", "away.py"} <= found.keys()


def test_a_file_named_twice_is_one(root: Path) -> None:
    plain = signature(root, (".",))
    assert signature(root, (".",), more=[root / "b.py"]) == plain
    assert signature(root, (".",), more=[root / "none.jsonl"]) == {**plain, "none.jsonl": None}
