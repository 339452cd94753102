# SPDX-License-Identifier: Apache-2.0
"""When the revision under analysis was committed."""

from __future__ import annotations

from pathlib import Path

from haros_ci.workspace.git import (
    LARGEST_CONTROL_FILE,
    BaselineUnavailable,
    GitError,
    Repository,
    repository_of,
    resolve_commit,
    run_git,
)


def commit_time(root: Path) -> int | None:
    """When the commit was made that the repository around *root* is at, in seconds since 1970; None outside git."""
    top = repository_of(root)
    try:
        if top is None:
            return None
        repository = Repository(top)
        text = run_git(repository, "cat-file", "commit", resolve_commit(repository, "HEAD"), limit=LARGEST_CONTROL_FILE)
        (line,) = (line for line in text.partition(b"\n\n")[0].split(b"\n") if line.startswith(b"committer "))
        return int(line.split()[-2])
    except (BaselineUnavailable, GitError, ValueError, IndexError):
        return None
