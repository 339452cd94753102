# SPDX-License-Identifier: Apache-2.0
"""What every test of this room stands on: git without settings of the machine, and repositories to write into."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from git_histories import Git


@pytest.fixture(autouse=True, scope="module")
def only_our_git_settings() -> Iterator[None]:
    with pytest.MonkeyPatch.context() as monkeypatch:
        for name in [name for name in os.environ if name.startswith("GIT_")]:
            monkeypatch.delenv(name)
        monkeypatch.setenv("GIT_CONFIG_GLOBAL", "/dev/null")
        monkeypatch.setenv("GIT_CONFIG_SYSTEM", "/dev/null")
        for role in ("AUTHOR", "COMMITTER"):
            monkeypatch.setenv(f"GIT_{role}_NAME", "Ada")
            monkeypatch.setenv(f"GIT_{role}_EMAIL", "ada@example.org")
            monkeypatch.setenv(f"GIT_{role}_DATE", "2024-01-01T00:00:00Z")
        monkeypatch.setenv("GIT_ALLOW_PROTOCOL", "file")  # submodules and clones of local repositories
        yield


@pytest.fixture
def new_git(tmp_path: Path) -> Callable[[str], Git]:
    """Makes a repository at a path below tmp_path."""
    return lambda path: Git(tmp_path / path)


@pytest.fixture
def git(tmp_path: Path) -> Git:
    return Git(tmp_path / "ws")
