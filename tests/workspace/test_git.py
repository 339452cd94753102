# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import os
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest
from git_histories import Git, plant

from haros_ci.results.result import Provenance
from haros_ci.workspace.base import base_workspace
from haros_ci.workspace.discover import discover
from haros_ci.workspace.git import BaselineUnavailable, merge_base, read_at, repository_of
from haros_ci.workspace.provenance import provenance, public_uri


def test_repository_of(git: Git, tmp_path: Path) -> None:
    plant(git.top, {"a/b/c.cpp": b""})
    assert repository_of(git.top / "a" / "b") == git.top
    assert repository_of(git.top) == git.top
    assert repository_of(tmp_path) is None


# -- merge base ---------------------------------------------------------------------------------------------------


def test_the_merge_base_is_where_histories_part(git: Git) -> None:
    parting = git.commit({"a.cpp": b""})
    git("checkout", "-q", "-b", "topic")
    topic = git.commit({"b.cpp": b""})
    git("checkout", "-q", "main")
    main = git.commit({"c.cpp": b""})
    git("checkout", "-q", "topic")
    assert merge_base(git.top, "main") == parting
    assert merge_base(git.top, main) == parting
    assert merge_base(git.top, "topic") == topic
    git("merge", "-q", "main")
    assert merge_base(git.top, "main") == main
    assert merge_base(git.top, "HEAD~1") == topic


def test_of_several_merge_bases_one_is_taken(git: Git) -> None:
    git.commit({"a.cpp": b""})
    git("checkout", "-q", "-b", "topic")
    one = git.commit({"b.cpp": b""})
    git("checkout", "-q", "main")
    two = git.commit({"c.cpp": b""})
    git("merge", "-q", "topic")
    git("checkout", "-q", "topic")
    git("merge", "-q", two)
    git.commit({"d.cpp": b""})
    assert set(git("merge-base", "--all", "main", "topic").split()) == {one, two}
    assert merge_base(git.top, "main") in {one, two}
    assert merge_base(git.top, "main") == merge_base(git.top, "main")


@pytest.mark.parametrize(
    "rev", ["nowhere", "", "-h", "--output=x", "a b", "HEAD\n", "HEAD^{tree}", "main:a.cpp", "\u202emain"]
)
def test_an_unknown_revision(git: Git, rev: str) -> None:
    git.commit({"a.cpp": b""})
    with pytest.raises(BaselineUnavailable, match="unknown revision .*spelling") as caught:
        merge_base(git.top, rev)
    assert str(caught.value).isprintable()


def test_no_commit_yet(git: Git) -> None:
    with pytest.raises(BaselineUnavailable, match="no commit yet"):
        merge_base(git.top, "HEAD")


def test_no_repository(tmp_path: Path) -> None:
    with pytest.raises(BaselineUnavailable, match="not in a git repository"):
        merge_base(tmp_path, "main")


def test_no_git(git: Git, monkeypatch: pytest.MonkeyPatch) -> None:
    git.commit()
    monkeypatch.setenv("PATH", "/nonexistent")
    with pytest.raises(BaselineUnavailable, match="git is not installed"):
        merge_base(git.top, "main")


def test_unrelated_histories(git: Git) -> None:
    git.commit({"a.cpp": b""})
    git("checkout", "-q", "--orphan", "other")
    git.commit({"b.cpp": b""})
    with pytest.raises(BaselineUnavailable, match="no commit in common"):
        merge_base(git.top, "main")


def clone(git: Git, place: Path, *options: str) -> Path:
    subprocess.run(["git", "clone", "-q", *options, git.top.as_uri(), str(place)], check=True, capture_output=True)
    return place


def test_a_shallow_clone(git: Git, tmp_path: Path) -> None:
    first = git.commit({"a.cpp": b""})
    git("checkout", "-q", "-b", "topic")
    git.commit({"b.cpp": b""})
    git.commit({"b.cpp": b"int b;\n"})
    shallow = clone(git, tmp_path / "shallow", "--depth=1", "--no-single-branch", "-b", "topic")
    with pytest.raises(BaselineUnavailable, match="unknown revision .*shallow.*fetch-depth: 0"):
        merge_base(shallow, first[:-1] + ("0" if first[-1] != "0" else "1"))
    with pytest.raises(BaselineUnavailable, match="shallow clone does not reach.*fetch-depth: 0"):
        merge_base(shallow, "origin/main")
    subprocess.run(["git", "fetch", "-q", "--unshallow"], cwd=shallow, check=True)
    assert merge_base(shallow, "origin/main") == first


# -- files of a revision ------------------------------------------------------------------------------------------


def test_read_at(git: Git) -> None:
    (git.top / "link").symlink_to("sub/a.yaml")
    old = git.commit({"sub/a.yaml": b"one\r\n", "sub/*.yaml": b"star"})
    git.commit({"sub/a.yaml": b"two"})
    plant(git.top, {"sub/a.yaml": b"three"})
    assert read_at(git.top, old, "sub/a.yaml") == b"one\r\n"
    assert read_at(git.top, "HEAD", "./sub//a.yaml") == b"two"
    assert read_at(git.top / "sub", old, "a.yaml") == b"one\r\n"
    assert read_at(git.top, old, "sub/*.yaml") == b"star"
    for path in ("missing", "sub", "link", "../a.yaml", "sub/../sub/a.yaml", "/etc/passwd", "", "?ub/a.yaml", "a\0b"):
        assert read_at(git.top, old, path) is None
    with pytest.raises(BaselineUnavailable):
        read_at(git.top, "nowhere", "sub/a.yaml")


# -- provenance ---------------------------------------------------------------------------------------------------


def test_provenance(git: Git, tmp_path: Path) -> None:
    assert provenance(tmp_path) is None
    assert provenance(git.top) == Provenance(branch="main")
    commit = git.commit({"sub/a.cpp": b""})
    git("remote", "add", "fork", "https://example.org/fork.git")
    assert provenance(git.top) == Provenance("https://example.org/fork.git", commit, "main")
    git("remote", "add", "origin", "https://ada:secret@example.org/robots/arm.git")
    assert provenance(git.top / "sub") == Provenance("https://example.org/robots/arm.git", commit, "main")
    git("pack-refs", "--all")
    assert provenance(git.top) == Provenance("https://example.org/robots/arm.git", commit, "main")
    git("checkout", "-q", "--detach")
    assert provenance(git.top) == Provenance("https://example.org/robots/arm.git", commit, "")


def test_provenance_of_a_linked_work_tree(git: Git, tmp_path: Path) -> None:
    commit = git.commit({"a.cpp": b""})
    git("remote", "add", "origin", "git@example.org:robots/arm.git")
    git("worktree", "add", "-q", "-b", "topic/one", "../linked")
    assert provenance(tmp_path / "linked") == Provenance("ssh://example.org/robots/arm.git", commit, "topic/one")


@pytest.mark.parametrize(
    "files",
    [
        {".git": b"gitdir: /nowhere\n"},
        {".git": b""},
        {".git/HEAD": b"\xff\xfe" * 50},
        {".git/HEAD": b"ref: refs/heads/../../../secret\n"},
        {".git/HEAD": b"ref: ../secret\n", ".git/config": b"[remote"},
        {".git/config": b'[remote "origin"]\nurl = \x1b]0;x\n'},
    ],
)
def test_provenance_of_what_only_looks_like_a_repository(tmp_path: Path, files: dict[str, bytes]) -> None:
    plant(tmp_path, {"secret": b"0" * 40, **{f"ws/{name}": data for name, data in files.items()}})
    assert provenance(tmp_path / "ws") == Provenance()


@pytest.mark.parametrize(
    ("url", "uri"),
    [
        ("https://example.org/a.git", "https://example.org/a.git"),
        ("https://token@example.org/a", "https://example.org/a"),
        ("https://ada:p@ss@example.org:8443/a", "https://example.org:8443/a"),
        ("https://example.org/a?private_token=secret#x", "https://example.org/a"),
        ("ssh://git@example.org/a/b.git", "ssh://example.org/a/b.git"),
        ("git@example.org:a/b.git", "ssh://example.org/a/b.git"),
        ("example.org:/srv/a.git", "ssh://example.org/srv/a.git"),
        ("https://ada:pa/ss@example.org/a", ""),
        ("/home/ada/arm", ""),
        ("../arm", ""),
        ("file:///home/ada/arm", ""),
        ("C:/arm", ""),
        ("ext::sh -c true", ""),
        ("https://example.org/a b", ""),
        ("https://example.org/\x1b[31m", ""),
        ("", ""),
    ],
)
def test_public_uri(url: str, uri: str) -> None:
    assert public_uri(url) == uri
    assert "secret" not in uri


# -- repositories that are set as a trap --------------------------------------------------------------------------


@pytest.fixture
def trap(tmp_path: Path) -> tuple[Path, Path]:
    """A script, and the file that tells that it ran."""
    mark = tmp_path / "it-ran"
    script = tmp_path / "trap.sh"
    script.write_text(f"#!/bin/sh\ntouch '{mark}'\nexit 1\n")
    script.chmod(0o755)
    return script, mark


def analyse(root: Path, rev: str) -> int:
    """Everything this room does with git, with an addition and a deletion for it to compare."""
    workspace = discover(root, (".",))
    provenance(root)
    read_at(root, rev, "a.cpp")
    with base_workspace(workspace, rev) as base:
        assert base.renames == {"b.cpp": "c.cpp"}
        return len(base.workspace.files)


def test_nothing_that_a_repository_configures_runs(git: Git, trap: tuple[Path, Path], tmp_path: Path) -> None:
    script, mark = trap
    rev = git.commit({"a.cpp": b"int a;\n" * 9, "b.cpp": b"int b;\n" * 9, ".gitattributes": b"*.cpp filter=x diff=x\n"})
    (git.top / "b.cpp").rename(git.top / "c.cpp")
    for key in ("core.fsmonitor", "filter.x.clean", "filter.x.smudge", "filter.x.process", "diff.external"):
        git("config", key, str(script))
    for key in ("diff.x.textconv", "diff.x.command", "core.sshCommand", "core.pager", "core.editor", "gpg.program"):
        git("config", key, str(script))
    git("config", "filter.x.required", "true")
    git("config", "core.hooksPath", str(tmp_path / "hooks"))
    git("config", "core.worktree", str(tmp_path / "elsewhere"))
    for hook in ("post-checkout", "post-index-change", "reference-transaction", "pre-commit"):
        plant(tmp_path, {f"hooks/{hook}": script.read_bytes()})
        (tmp_path / "hooks" / hook).chmod(0o755)
    assert analyse(git.top, rev) == 2
    assert not mark.exists()
    git("config", "--unset", "core.worktree")
    git("config", "--unset", "filter.x.process")
    subprocess.run(["git", "status"], cwd=git.top, capture_output=True, check=False)
    assert mark.exists(), "the trap works"


def test_a_missing_object_is_not_fetched(git: Git, trap: tuple[Path, Path], tmp_path: Path) -> None:
    script, mark = trap
    git("config", "uploadpack.allowFilter", "true")
    rev = git.commit({"a.cpp": b"int a;\n"})
    git.commit({"a.cpp": b"int b;\n"})
    partial = clone(git, tmp_path / "partial", "--filter=blob:none")
    for key, value in (("remote.origin.url", f"ext::{script}"), ("protocol.ext.allow", "always")):
        subprocess.run(["git", "config", key, value], cwd=partial, check=True)
    workspace = discover(partial, (".",))
    with pytest.raises(BaselineUnavailable, match="complete"), base_workspace(workspace, rev):
        pass
    assert not mark.exists()
    allowed = {**os.environ, "GIT_ALLOW_PROTOCOL": "ext"}
    subprocess.run(
        ["git", "cat-file", "-p", f"{rev}:a.cpp"], cwd=partial, env=allowed, capture_output=True, check=False
    )
    assert mark.exists(), "the trap works"


def test_a_git_in_the_workspace_is_not_started(
    git: Git, trap: tuple[Path, Path], monkeypatch: pytest.MonkeyPatch
) -> None:
    script, mark = trap
    rev = git.commit({"a.cpp": b"int a;\n" * 9, "b.cpp": b"int b;\n" * 9, "git": script.read_bytes()})
    (git.top / "git").chmod(0o755)
    (git.top / "b.cpp").rename(git.top / "c.cpp")
    monkeypatch.chdir(git.top)
    monkeypatch.setenv("PATH", f".::{os.environ['PATH']}")
    assert analyse(git.top, rev) == 3, "the script is one of the files"
    assert not mark.exists()


def test_variables_of_a_surrounding_hook_have_no_effect(
    git: Git, new_git: Callable[[str], Git], monkeypatch: pytest.MonkeyPatch
) -> None:
    other = new_git("other")
    other.commit({"o.cpp": b""})
    rev = git.commit({"a.cpp": b"int a;\n" * 9, "b.cpp": b"int b;\n" * 9})
    (git.top / "b.cpp").rename(git.top / "c.cpp")
    for name, value in (("DIR", ".git"), ("WORK_TREE", "."), ("INDEX_FILE", ".git/index"), ("OBJECT_DIRECTORY", "x")):
        monkeypatch.setenv(f"GIT_{name}", str(other.top / value))
    assert analyse(git.top, rev) == 2


def test_the_repository_is_left_as_it_was(git: Git) -> None:
    rev = git.commit({"a.cpp": b"int a;\n" * 9, "b.cpp": b"int b;\n" * 9})
    (git.top / "b.cpp").rename(git.top / "c.cpp")

    def state() -> dict[str, tuple[int, int]]:
        paths = (path for path in git.top.rglob("*") if path.is_file())
        return {str(path): (path.stat().st_ino, path.stat().st_mtime_ns) for path in paths}

    before = state()
    analyse(git.top, rev)
    assert state() == before
