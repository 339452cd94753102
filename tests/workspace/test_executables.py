# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from pathlib import Path

from git_histories import Git, manifest

from haros_ci.workspace.base import base_workspace
from haros_ci.workspace.discover import discover

SCRIPT = b"#!/usr/bin/env python3\n"


def test_the_execute_bits_of_scripts_are_known(git: Git) -> None:
    git.commit({"package.xml": manifest("arm"), "go.py": SCRIPT, "stay.py": SCRIPT, "go.sh": b"", "model.xml": b""})
    for name in ("go.py", "go.sh", "model.xml"):
        (git.top / name).chmod(0o755)
    assert discover(git.top, (".",)).executables == {"go.py", "go.sh"}, "an XML file is no script"


def test_in_git_no_bit_at_all_is_known_too(git: Git) -> None:
    git.commit({"package.xml": manifest("arm"), "stay.py": SCRIPT})
    assert discover(git.top, (".",)).executables == frozenset()


def test_what_git_tracks_as_executable_is_so_on_a_file_system_without_modes(git: Git) -> None:
    git.commit({"package.xml": manifest("arm"), "go.py": SCRIPT})
    (git.top / "go.py").chmod(0o755)
    git.commit()
    (git.top / "go.py").chmod(0o644)
    assert discover(git.top, (".",)).executables == {"go.py"}


def test_outside_git_a_tree_without_any_bit_tells_nothing(tmp_path: Path) -> None:
    (tmp_path / "a.py").write_bytes(SCRIPT)
    (tmp_path / "b.py").write_bytes(SCRIPT)
    assert discover(tmp_path, (".",)).executables is None
    (tmp_path / "a.py").chmod(0o744)
    assert discover(tmp_path, (".",)).executables == {"a.py"}


def test_a_base_revision_has_the_bits_of_its_tree(git: Git) -> None:
    git.commit({"package.xml": manifest("arm"), "go.py": SCRIPT})
    (git.top / "go.py").chmod(0o755)
    git.commit()
    (git.top / "go.py").chmod(0o644)
    git.commit()
    with base_workspace(discover(git.top, (".",)), "HEAD~1") as base:
        assert base.workspace.executables == {"go.py"}
    with base_workspace(discover(git.top, (".",)), "HEAD~2") as base:
        assert base.workspace.executables == frozenset()
