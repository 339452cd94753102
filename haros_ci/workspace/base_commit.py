# SPDX-License-Identifier: Apache-2.0
"""The commit that a change is compared with, and its files, whatever the head says."""

from __future__ import annotations

import os
from pathlib import Path

from haros_ci.records import dataclass
from haros_ci.workspace.git import BaselineUnavailable, Repository, merge_base, read_in_commit, repository_of

#: How far below a root that is in no repository one is looked for: ``ws/src/group/repository``.
MAX_DEPTH = 3
MAX_DIRECTORIES = 2_000


@dataclass(frozen=True, slots=True)
class BaseCommit:
    """The *commit* of the repository with its work tree at *top* at which the history of the head left that of the base."""

    top: Path
    commit: str

    def holds(self, path: Path) -> bool:
        """Whether *path*, absolute, lies in the work tree: what a change of this repository could bring."""
        return path.is_relative_to(self.top)

    def read(self, path: Path) -> bytes | None:
        """The file at *path*, which the work tree holds, as it is in the base; None if it is not there.

        BaselineUnavailable if it cannot be read.
        """
        return read_in_commit(Repository(self.top), self.commit, path.relative_to(self.top).as_posix())


def base_commit(root: Path, rev: str, known: tuple[Path, str] | None = None) -> BaseCommit:
    """The merge base of HEAD and *rev* in the repository that *root* lies in, or in the only one below it; *known* if it was found before.

    BaselineUnavailable says why there is none.
    """
    if known is not None:
        return BaseCommit(*known)
    top = repository_of(root) or only_repository_below(root)
    return BaseCommit(top, merge_base(top, rev))


def only_repository_below(root: Path) -> Path:
    """The one repository below *root*, which is in none; BaselineUnavailable without one, and where there are several."""
    found: list[Path] = []
    pending, entered = [(root, 0)], 0
    while pending and entered < MAX_DIRECTORIES:
        directory, depth = pending.pop()
        entered += 1
        try:
            with os.scandir(directory) as entries:
                names = sorted(
                    e.name
                    for e in entries
                    if e.name == ".git" or (e.is_dir(follow_symlinks=False) and e.name[0] != ".")
                )
        except OSError:
            continue
        if ".git" in names:
            found.append(directory)
        elif depth < MAX_DEPTH:
            pending += [(directory / name, depth + 1) for name in names]
    if not found:
        raise BaselineUnavailable("not in a git repository; use a baseline file instead of a revision")
    if len(found) > 1:
        raise BaselineUnavailable(
            f"a revision belongs to one repository, and the files lie in {len(found)}; use a baseline file, "
            "or analyse one repository at a time"
        )
    return found[0]
