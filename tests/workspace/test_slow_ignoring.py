# SPDX-License-Identifier: Apache-2.0
"""Patterns of .gitignore that take git minutes: what git tracks is analysed, what it ignores is not, and the reason is told."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from haros_ci.workspace import git
from haros_ci.workspace.listing import SLOW, list_files

#: A directory so deep that git tries the parts of a pattern in more ways than it can.
DEEP = "d/" * 30
SLOW_PATTERN = "**/" * 16 + "x\n"


def repository(root: Path, ignore: str, where: str = ".gitignore") -> Path:
    files = {"a.py": "", f"{DEEP}b.py": "", "secret.py": "", "new.py": "", where: f"secret.py\n{ignore}"}
    for path, text in files.items():
        (root / path).parent.mkdir(parents=True, exist_ok=True)
        (root / path).write_text(text)
    subprocess.run(["git", "init", "-q", str(root)], check=True)
    subprocess.run(["git", "-C", str(root), "add", "-f", "a.py", where], check=True)
    return root


@pytest.mark.parametrize("where", [".gitignore", "d/.gitignore", ".git/info/exclude"])
def test_tracked_files_alone_are_listed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, where: str) -> None:
    monkeypatch.setattr(git, "LISTING", 0.3)
    if where.startswith(".git/"):
        repository(tmp_path, "")
        (tmp_path / where).write_text(SLOW_PATTERN)
        where = ".gitignore"
    else:
        repository(tmp_path, SLOW_PATTERN, where)
    listing = list_files(tmp_path, (".",))
    assert sorted(listing.paths) == sorted(["a.py", where]) and listing.is_tracked
    assert [(problem.path, problem.message) for problem in listing.problems] == [(".", SLOW)]


def test_of_a_directory_without_tracked_files_nothing_is_listed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(git, "LISTING", 0.3)
    listing = list_files(repository(tmp_path, SLOW_PATTERN), ("d",))
    assert listing.paths == [] and len(listing.problems) == 1


@pytest.mark.parametrize("ignore", ["", "build/\n*.pyc\n", "**/x\n**/y/**/z\n", "**/" * 3 + "x\n"])
def test_patterns_as_they_are_written(tmp_path: Path, ignore: str) -> None:
    listing = list_files(repository(tmp_path, ignore), (".",))
    assert sorted(listing.paths) == sorted([".gitignore", "a.py", f"{DEEP}b.py", "new.py"]) and listing.problems == []
