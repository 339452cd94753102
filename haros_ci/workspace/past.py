# SPDX-License-Identifier: Apache-2.0
"""What the base revision of a change holds, so that the change cannot hide its files from discovery."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path

from haros_ci.records import dataclass, field
from haros_ci.workspace.base_commit import base_commit, only_repository_below
from haros_ci.workspace.git import BaselineUnavailable, GitError, Repository, repository_of, run_git

#: What a listing of all files may have, in bytes.
MAX_LISTING = 40_000_000
SUBMODULE = "160000"


@dataclass(frozen=True, slots=True)
class Past:
    """The entries of the base revision of the repository at *top*, submodules followed: names of objects by path.

    Paths are relative to the root of the workspace. *is_known* is False where a base was asked for and cannot be had: then nothing was
    there before. *top* is None where there is no repository.
    """

    top: Path | None
    entries: Mapping[str, str] = field(default_factory=dict)
    is_known: bool = True


def past_of(root: Path, rev: str, *, known: tuple[Path, str] | None = None, is_missing: bool = False) -> Past:
    """What the merge base of HEAD and *rev* holds below *root* (absolute), or *known*, as base_commit has it; no contents are read.

    Where it cannot be had, which the comparison says, or *is_missing* says so, nothing was there.
    """
    try:
        if is_missing:
            raise BaselineUnavailable(rev)
        base = base_commit(root, rev, known)
        return Past(base.top, _entries(Repository(base.top), base.commit, root))
    except (BaselineUnavailable, GitError):
        return Past(_top(root), is_known=False)


def _top(root: Path) -> Path | None:
    try:
        return repository_of(root) or only_repository_below(root)
    except BaselineUnavailable:
        return None


def _entries(repository: Repository, commit: str, root: Path) -> dict[str, str]:
    top = repository.top
    inside = f"{root.relative_to(top).as_posix()}/" if root != top and root.is_relative_to(top) else ""
    mount = f"{top.relative_to(root).as_posix()}/" if root != top and not inside else ""
    arguments = ("ls-tree", "-r", "-z", "--full-tree", commit, *(("--", inside) if inside else ()))
    found: dict[str, str] = {}
    for record in run_git(repository, *arguments, limit=MAX_LISTING).split(b"\0"):
        kind, _, raw = record.partition(b"\t")
        if not record:
            continue
        path = mount + os.fsdecode(raw).removeprefix(inside)
        mode, _, name = kind.decode("ascii").split()
        found[path] = name
        if mode == SUBMODULE and os.path.lexists(root / path / ".git"):
            try:
                found.update(_entries(Repository(root / path), name, root))
            except GitError:  # the clone lacks that commit: nothing of it was there before
                continue
    return found
