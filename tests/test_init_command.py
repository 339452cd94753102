# SPDX-License-Identifier: Apache-2.0
"""``haros-ci init``: what it writes works, what is there stays, and it says both."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from commandline import commit, git, haros, write

WRITTEN = {".github/workflows/haros-ci.yml", ".pre-commit-config.yaml", ".haros-ci.yaml"}
SOURCES = {"arm/package.xml": "<package><name>arm</name></package>\n", "arm/a.py": '"""An arm."""\n'}


@pytest.fixture
def repository(tmp_path: Path) -> Path:
    root = write(tmp_path / "ws", SOURCES)
    git(root, "init", "-q", "-b", "devel")
    commit(root)
    return root


def files(root: Path) -> dict[str, bytes]:
    found = (path for path in root.rglob("*") if path.is_file() and ".git/" not in path.as_posix())
    return {path.relative_to(root).as_posix(): path.read_bytes() for path in found}


def test_a_repository_without_anything(repository: Path) -> None:
    done = haros("init", cwd=repository)
    assert done.returncode == 0 and set(files(repository)) == {*SOURCES, *WRITTEN}
    assert all(f"wrote  {name}:" in done.stdout for name in WRITTEN)
    assert "branches: [devel]" in (repository / ".github/workflows/haros-ci.yml").read_text()
    checked = haros("check", "--show-settings", cwd=repository)
    assert checked.returncode == 0 and ".haros-ci.yaml" in checked.stdout


def test_twice_is_once(repository: Path) -> None:
    haros("init", cwd=repository)
    before = files(repository)
    done = haros("init", cwd=repository / "arm")
    assert files(repository) == before and "wrote" not in done.stdout and done.stdout.count("left ") == 3


def test_a_dry_run_writes_nothing(repository: Path) -> None:
    done = haros("init", "--dry-run", cwd=repository)
    assert set(files(repository)) == set(SOURCES)
    assert "would write .haros-ci.yaml" in done.stdout and "    profile: ros" in done.stdout


@pytest.mark.parametrize(
    ("there", "unwritten", "says"),
    [
        ({"haros.yaml": "project: p\n"}, ".haros-ci.yaml", "haros.yaml is the project file"),
        ({".haros-ci.yaml": ""}, ".haros-ci.yaml", "it is there already"),
        ({".pre-commit-config.yaml": "repos: []\n"}, ".pre-commit-config.yaml", "      - id: haros-ci-arch"),
        ({".pre-commit-config.yaml": "# haros-ci\n"}, ".pre-commit-config.yaml", "it runs haros-ci already"),
        (
            {".github/workflows/x.yaml": "- uses: haros-ci/haros-ci@v0.1.0\n"},
            ".github/workflows/haros-ci.yml",
            "left   .github/workflows/x.yaml",
        ),
        ({".gitlab-ci.yml": "x: y\n"}, ".github/workflows/haros-ci.yml", "a GitLab project"),
    ],
)
def test_what_is_there_stays(repository: Path, there: dict[str, str], unwritten: str, says: str) -> None:
    write(repository, there)
    done = haros("init", cwd=repository)
    assert done.returncode == 0 and says in done.stdout
    assert set(files(repository)) == {*SOURCES, *there, *WRITTEN} - ({unwritten} - set(there))
    assert all((repository / name).read_text() == text for name, text in there.items())


def test_outside_git_only_the_project_file(tmp_path: Path) -> None:
    root = write(tmp_path / "ws", SOURCES)
    done = haros("init", cwd=root)
    assert set(files(root)) == {*SOURCES, ".haros-ci.yaml"} and "not in a git repository" in done.stdout


def test_a_link_out_of_the_workspace_is_not_followed(repository: Path, tmp_path: Path) -> None:
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    os.symlink(elsewhere, repository / ".github")
    done = haros("init", cwd=repository)
    assert done.returncode == 2 and "a symbolic link" in done.stderr
    assert list(elsewhere.iterdir()) == []


def test_a_dangling_link_is_not_written_through(repository: Path, tmp_path: Path) -> None:
    os.symlink(tmp_path / "target", repository / ".haros-ci.yaml")
    done = haros("init", cwd=repository)
    assert not (tmp_path / "target").exists() and "it is there already" in done.stdout


def test_a_hostile_branch_name_stays_a_name(repository: Path) -> None:
    git(repository, "update-ref", "refs/remotes/origin/x,on]", "HEAD")
    git(repository, "symbolic-ref", "refs/remotes/origin/HEAD", "refs/remotes/origin/x,on]")
    haros("init", cwd=repository)
    assert 'branches: ["x,on]"]' in (repository / ".github/workflows/haros-ci.yml").read_text()
