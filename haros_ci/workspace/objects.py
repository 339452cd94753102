# SPDX-License-Identifier: Apache-2.0
"""Files as they are in a commit, straight from git's objects."""

from __future__ import annotations

import os
import posixpath
from collections.abc import Iterable, Iterator

from haros_ci.model.workspace import Problem, Workspace
from haros_ci.records import dataclass
from haros_ci.workspace.assemble import Content, SymbolicLink
from haros_ci.workspace.discover import too_large, unusable_name
from haros_ci.workspace.git import REGULAR, BaselineUnavailable, GitError, Repository, run_git
from haros_ci.workspace.language import HEAD, is_kept_copy, script_language, suffix_of
from haros_ci.workspace.selection import CandidatePath, parents

#: Bytes of files that are in memory at a time, unless a single file is larger.
BATCH = 32_000_000
#: Symbolic links that are looked into, and how many one may lead through.
MAX_LINKS = 500
MAX_STEPS = 8
#: What a listing of all files may have, in bytes; and a path that a disk takes, in directories and characters.
MAX_LISTING = 40_000_000
MAX_DEPTH = 200
MAX_PATH = 4_000


@dataclass(frozen=True, slots=True)
class Blob:
    """A regular file in a commit; *name* is that of the object, *size* is in bytes."""

    repository: Repository
    name: str
    size: int
    executable: bool


def read_tree(
    repository: Repository, commit: str, workspace: Workspace, links: dict[str, Blob] | None = None
) -> dict[str, Blob]:
    """The regular files of *commit* by their paths relative to the root of *workspace*; symbolic links are put into *links*.

    Submodules are followed if *workspace* has files in them. GitError if git cannot tell.
    """
    root, top = workspace.root, repository.top
    inside = f"{root.relative_to(top).as_posix()}/" if root != top and root.is_relative_to(top) else ""
    mount = f"{top.relative_to(root).as_posix()}/" if root != top and not inside else ""
    arguments = ("ls-tree", "-r", "-l", "-z", "--full-tree", commit, *(("--", inside) if inside else ()))
    tree: dict[str, Blob] = {}
    for record in run_git(repository, *arguments, limit=MAX_LISTING).split(b"\0"):
        kind, _, name = record.partition(b"\t")
        path = mount + os.fsdecode(name).removeprefix(inside)
        if not record or not _is_safe(path):
            continue
        if kind.startswith(REGULAR):
            mode, _, blob, size = kind.split()
            tree[path] = Blob(repository, blob.decode("ascii"), _size(size), mode == b"100755")
        elif kind.startswith(b"120000 ") and links is not None:
            links[path] = Blob(repository, kind.split()[2].decode("ascii"), 0, False)
        elif kind.startswith(b"160000 ") and any(file.path.startswith(f"{path}/") for file in workspace.files):
            tree.update(_read_submodule(path, kind.split()[2].decode("ascii"), workspace))
    return tree


def read_blobs(tree: dict[str, Blob], candidates: Iterable[CandidatePath], limit: int) -> Iterator[Content | Problem]:
    """The contents of *candidates*, with one git process for each repository and BATCH bytes.

    What would be skipped on disk is skipped here. GitError if git lacks an object.
    """
    batches: dict[Repository, tuple[list[CandidatePath], int]] = {}
    for candidate in candidates:
        blob = tree[candidate.path]
        unknown = candidate.language is None and candidate.fallback is None
        if unknown and suffix_of(candidate.path.rpartition("/")[2]) and not blob.executable:
            continue
        problem = unusable_name(candidate.path)
        if problem is None and blob.size > limit:
            if unknown:
                continue
            problem = too_large(candidate.path, blob.size, limit)
        if problem is not None:
            yield problem
            continue
        batch, size = batches.get(blob.repository, ([], 0))
        if batch and size + blob.size > BATCH:
            yield from _read_batch(blob.repository, tree, batch)
            batch, size = [], 0
        batch.append(candidate)
        batches[blob.repository] = (batch, size + blob.size)
    for repository, (batch, _) in batches.items():
        yield from _read_batch(repository, tree, batch)


def _read_batch(repository: Repository, tree: dict[str, Blob], candidates: list[CandidatePath]) -> Iterator[Content]:
    """Answers of ``git cat-file --batch``: a line ``NAME TYPE SIZE``, then so many bytes and a line feed."""
    request = "".join(f"{tree[candidate.path].name}\n" for candidate in candidates).encode("ascii")
    answer = memoryview(run_git(repository, "cat-file", "--batch", "--buffer", stdin=request))
    start = 0
    for candidate in candidates:
        end = start + len(tree[candidate.path].name) + len(" blob ")
        size = bytes(answer[end : end + 20]).partition(b"\n")[0]
        if bytes(answer[end - len(" blob ") : end]) != b" blob " or not size.isdigit():
            raise GitError(f"the contents of {candidate.path} are missing")
        start = end + len(size) + 1
        data = bytes(answer[start : start + int(size)])
        start += int(size) + 1
        asked = None if is_kept_copy(candidate.path.rpartition("/")[2]) else script_language(data[:HEAD])
        language = candidate.language or asked or candidate.fallback
        if language is not None:
            yield Content(candidate.path, language, data)


def read_links(tree: dict[str, Blob], links: dict[str, Blob]) -> Iterator[SymbolicLink]:
    """The symbolic *links* that lead to files or directories of *tree*, as on disk (the first ``MAX_LINKS``)."""
    directories = {parent for path in tree for parent in parents(path)}
    targets: dict[str, str] = {}
    for path, blob in sorted(links.items())[:MAX_LINKS]:
        text = os.fsdecode(run_git(blob.repository, "cat-file", "blob", blob.name))
        targets[path] = posixpath.normpath(posixpath.join(posixpath.dirname(path), text))
    for path, target in targets.items():
        for _ in range(MAX_STEPS):
            target = targets.get(target, target)
        if target in tree or target in directories:
            yield SymbolicLink(path, target)


def _read_submodule(path: str, commit: str, workspace: Workspace) -> dict[str, Blob]:
    top = workspace.root / path
    if not os.path.lexists(top / ".git"):
        return {}  # its files are part of the surrounding repository by now
    try:
        return read_tree(Repository(top), commit, workspace)
    except GitError as err:
        raise BaselineUnavailable(
            f"the submodule {path} lacks the commit that the base revision uses; fetch its history "
            "(git submodule foreach git fetch --unshallow)"
        ) from err


def _is_safe(path: str) -> bool:
    """Whether *path* stays where it is put: a tree from elsewhere can hold any name."""
    parts = path.split("/")
    if len(parts) > MAX_DEPTH or len(path) > MAX_PATH:
        return False
    return not any(part in ("", ".", "..") or part.lower() == ".git" for part in parts)


def _size(text: bytes) -> int:
    """git writes ``BAD`` for the size of an object that it lacks; reading such an object fails later, if it is asked for."""
    return int(text) if text.isdigit() else 0
