# SPDX-License-Identifier: Apache-2.0
"""When the revision was committed, from the commit itself."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import pytest

from haros_ci.workspace.commit_time import commit_time


def git(root: Path, *arguments: str, when: str = "2024-01-31T23:30:00+01:00") -> None:
    who = {f"GIT_{role}_{what}": "a@example.org" for role in ("AUTHOR", "COMMITTER") for what in ("NAME", "EMAIL")}
    given = {
        **who,
        "GIT_CONFIG_GLOBAL": os.devnull,
        "GIT_AUTHOR_DATE": "2000-01-01T00:00:00Z",
        "GIT_COMMITTER_DATE": when,
    }
    subprocess.run(["git", *arguments], cwd=root, env={**os.environ, **given}, check=True, capture_output=True)


def test_the_committers_date(tmp_path: Path) -> None:
    git(tmp_path, "init", "-q")
    git(tmp_path, "commit", "-q", "--allow-empty", "-m", "committer a <b> 1 +0000\n\ncommitter x 2 +0000")
    (tmp_path / "below").mkdir()
    assert commit_time(tmp_path / "below") == 1706740200
    git(tmp_path, "commit", "-q", "--allow-empty", "-m", "next", when="2024-02-01T00:00:00Z")
    assert commit_time(tmp_path) == 1706745600


@pytest.mark.parametrize("entry", ["", "gitdir: nowhere", "x"])
def test_none_without_a_commit(tmp_path: Path, entry: str) -> None:
    assert commit_time(tmp_path) is None
    if entry:
        (tmp_path / ".git").write_text(entry)
    else:
        git(tmp_path, "init", "-q")
    assert commit_time(tmp_path) is None


def test_no_program_of_the_repository_runs(tmp_path: Path) -> None:
    git(tmp_path, "init", "-q")
    git(tmp_path, "commit", "-q", "--allow-empty", "-m", "one")
    spy = tmp_path / "spy.sh"
    spy.write_text(f"#!/bin/sh\ntouch {tmp_path}/ran\n")
    spy.chmod(0o755)
    for key, value in (("log.showSignature", "true"), ("gpg.program", str(spy)), ("core.pager", str(spy))):
        git(tmp_path, "config", key, value)
    assert commit_time(tmp_path) is not None
    assert not (tmp_path / "ran").exists()
