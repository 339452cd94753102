# SPDX-License-Identifier: Apache-2.0
"""Which files of the base moved where, by git's own measure of likeness."""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path

from haros_ci.workspace.git import Repository, run_git
from haros_ci.workspace.objects import Blob

#: With more pairs than the square of this, git compares equal files and equal names only.
LIMIT = 2_000


def find_renames(scratch: Path, root: Path, deleted: dict[str, Blob], added: Iterable[str]) -> dict[str, str]:
    """Paths of the base that are gone by the *added* paths below *root* that hold their contents, or most of them.

    The work tree's files become objects in a repository made for this in *scratch*, so that files not committed count
    and the user's repository is not touched. GitError if git fails.
    """
    paths = sorted(added)
    if not deleted or not paths:
        return {}
    git = scratch / "git"
    _make_repository(git, sha256=any(len(blob.name) == 64 for blob in deleted.values()))
    here = Repository(root)
    environment = {"GIT_DIR": str(git), "GIT_INDEX_FILE": str(git / "before")}
    request = "".join(f"./{path}\n" for path in paths).encode("utf-8")  # ./ as a quote would begin a quoted name
    new = run_git(here, "hash-object", "-w", "--no-filters", "--stdin-paths", stdin=request, environment=environment)
    before = ((path, blob.name) for path, blob in sorted(deleted.items()))
    after = zip(paths, new.decode("ascii").split(), strict=True)
    run_git(here, "update-index", "-z", "--index-info", stdin=_index(before), environment=environment)
    tree = run_git(here, "write-tree", "--missing-ok", environment=environment).decode("ascii").strip()
    environment["GIT_INDEX_FILE"] = str(git / "after")
    run_git(here, "update-index", "-z", "--index-info", stdin=_index(after), environment=environment)
    _borrow_objects(git, {blob.repository for blob in deleted.values()})  # not before: writing would touch them
    arguments = ("diff-index", "--cached", "--raw", "-z", "-M50%", f"-l{LIMIT}", "--no-ext-diff", "--no-textconv")
    fields = run_git(here, *arguments, "--diff-filter=R", tree, environment=environment).split(b"\0")
    return {os.fsdecode(old): os.fsdecode(now) for old, now in zip(fields[1::3], fields[2::3], strict=False)}


def _make_repository(git: Path, *, sha256: bool) -> None:
    (git / "objects" / "info").mkdir(parents=True)
    (git / "refs").mkdir()
    (git / "HEAD").write_text("ref: refs/heads/none\n", encoding="ascii")
    settings = ["[core]", f"repositoryFormatVersion = {int(sha256)}"]
    settings += ["protectNTFS = false", "protectHFS = false"]  # names that are odd elsewhere are names here
    settings += ["[extensions]", "objectFormat = sha256"] if sha256 else []
    (git / "config").write_text("\n".join([*settings, ""]), encoding="ascii")


def _borrow_objects(git: Path, others: set[Repository]) -> None:
    objects = sorted(os.fsencode((other.common_directory / "objects").resolve()) for other in others)
    (git / "objects" / "info" / "alternates").write_bytes(b"".join(path + b"\n" for path in objects))


def _index(entries: Iterable[tuple[str, str]]) -> bytes:
    """Input of ``git update-index -z --index-info``."""
    return b"".join(f"100644 {name}\t".encode("ascii") + os.fsencode(path) + b"\0" for path, name in entries)
