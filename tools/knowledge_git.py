# SPDX-License-Identifier: Apache-2.0
"""Reads clones as they stand, bare or not, without a work tree."""

from __future__ import annotations

import subprocess
from collections.abc import Iterable, Iterator
from pathlib import Path


def git(clone: Path, *arguments: str) -> str:
    """What git says about *clone*; "" if it fails."""
    done = subprocess.run(["git", "-C", str(clone), *arguments], capture_output=True, check=False)
    return done.stdout.decode("utf-8", "replace") if done.returncode == 0 else ""


def commit(clone: Path, *names: str) -> str:
    """The commit that the first of *names* that exists stands for."""
    for name in names:
        for form in (f"refs/heads/{name}", f"refs/tags/{name}", f"refs/remotes/origin/{name}", name):
            found = git(clone, "rev-parse", "--verify", "-q", f"{form}^{{commit}}").strip()
            if found:
                return found
    return ""


def paths(clone: Path, revision: str, *under: str) -> dict[str, str]:
    """All files of *revision* by path, with the object that holds each."""
    found = {}
    for row in git(clone, "ls-tree", "-r", "-z", revision, *under).split("\0"):
        head, tab, path = row.partition("\t")
        if tab and head.split()[1] == "blob":
            found[path] = head.split()[2]
    return found


def texts(clone: Path, objects: Iterable[str]) -> Iterator[str]:
    """What *objects* hold, in their order."""
    asked = list(objects)
    done = subprocess.run(
        ["git", "-C", str(clone), "cat-file", "--batch"],
        input="\n".join(asked).encode(),
        capture_output=True,
        check=True,
    )
    data, at = done.stdout, 0
    for _ in asked:
        end = data.index(b"\n", at)
        head = data[at:end].split()
        size = int(head[2]) if len(head) == 3 else 0
        yield data[end + 1 : end + 1 + size].decode("utf-8", "replace")
        at = end + 1 + size + (1 if len(head) == 3 else 0)


def clones(root: Path) -> dict[str, Path]:
    """The clones below *root* by ``owner/name`` in lower case, each in a folder ``owner+name``."""
    found = {}
    for folder in sorted(root.iterdir()):
        owner, plus, name = folder.name.partition("+")
        clone = next((each for each in (folder / "repo", folder) if git(each, "rev-parse", "--git-dir").strip()), None)
        if plus and clone is not None:
            found[f"{owner}/{name}".lower()] = clone
    return found
