# SPDX-License-Identifier: Apache-2.0
"""Two revisions of a repository as Workspaces: commits from git's objects, without a checkout, or the work tree."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from itertools import chain
from pathlib import Path

from haros_ci.model.workspace import Workspace
from haros_ci.records import dataclass
from haros_ci.workspace.assemble import Content, SymbolicLink, assemble
from haros_ci.workspace.base import base_workspace, scratch_directory, write_contents
from haros_ci.workspace.discover import MAX_FILE_SIZE, discover, manifests_above, unusable_name
from haros_ci.workspace.excludes import Excludes
from haros_ci.workspace.files import TextReader
from haros_ci.workspace.git import (
    BaselineUnavailable,
    GitError,
    Repository,
    repository_of,
    resolve_commit,
    run_git,
)
from haros_ci.workspace.objects import Blob, read_blobs, read_links, read_tree
from haros_ci.workspace.renames import find_renames
from haros_ci.workspace.selection import AnalysedPaths, CandidatePath, select


@dataclass(frozen=True, slots=True)
class Revisions:
    """The workspace at two revisions; *base_commit* and *head_commit* are commits, None the work tree.

    *renames* maps paths of the base to those that the files have at head.
    """

    base: Workspace
    head: Workspace
    base_commit: str
    head_commit: str | None
    renames: Mapping[str, str]


@contextmanager
def revisions(
    root: Path,
    base: str,
    head: str | None = None,
    *,
    paths: tuple[str, ...] = (".",),
    exclude: tuple[str, ...] = (),
    max_file_size: int = MAX_FILE_SIZE,
    from_merge_base: bool = False,
) -> Iterator[Revisions]:
    """The revisions *base* and *head* (None: the work tree) of the repository that *root* lies in, for as long as they are needed.

    With *from_merge_base* the base is the commit at which head's history left that of *base*. BaselineUnavailable if a revision cannot be
    had. Nothing is checked out, so no hook and no filter runs; of commits submodules are left out.
    """
    top = repository_of(root)
    if top is None:
        raise BaselineUnavailable("not in a git repository")
    repository = Repository(top)
    old = resolve_commit(repository, base)
    new = resolve_commit(repository, head) if head is not None else None
    if from_merge_base:
        old = _merge_base(repository, old, new or resolve_commit(repository, "HEAD"), base)
    if new is None:
        present = discover(root, paths, exclude=exclude, max_file_size=max_file_size)
        limits = {"paths": paths, "exclude": exclude, "max_file_size": max_file_size}
        with base_workspace(present, old, use_merge_base=False, **limits) as found:  # type: ignore[arg-type]  # limits by name
            yield Revisions(found.workspace, present, old, None, found.renames)
        return
    try:
        nothing = Workspace(root, (), (), TextReader(root, (), max_file_size))
        links: tuple[dict[str, Blob], dict[str, Blob]] = ({}, {})
        trees = read_tree(repository, old, nothing, links[0]), read_tree(repository, new, nothing, links[1])
        selected = [_selected(tree, paths, exclude) for tree in trees]
        size = sum(tree[c.path].size for tree, found in zip(trees, selected, strict=True) for c in found)
        with scratch_directory(size) as scratch:
            made = [
                _workspace(scratch / name, root.name, tree, found, tuple(aliases), paths, max_file_size)
                for name, tree, found, aliases in zip(
                    ("base", "head"), trees, selected, map(read_links, trees, links), strict=True
                )
            ]
            yield Revisions(made[0], made[1], old, new, _renames(scratch, made[0], made[1], trees))
    except GitError as err:
        raise BaselineUnavailable(f"the revisions cannot be read: {err}; is the clone complete (no --filter)?") from err


def _merge_base(repository: Repository, one: str, other: str, named: str) -> str:
    try:
        return run_git(repository, "merge-base", one, other).decode("ascii").strip()
    except GitError as err:
        raise BaselineUnavailable(f"{named!r} and the head have no commit in common here; fetch more history") from err


def _scope(tree: Mapping[str, Blob], paths: tuple[str, ...]) -> AnalysedPaths:
    files = tuple(sorted(path for path in paths if path in tree))
    directories = tuple(sorted(path for path in paths if path not in tree))
    return AnalysedPaths(directories or (".",), files, named=bool(directories))


def _selected(tree: Mapping[str, Blob], paths: tuple[str, ...], exclude: tuple[str, ...]) -> list[CandidatePath]:
    return select(tree, _scope(tree, paths), Excludes(exclude))


def _workspace(
    directory: Path,
    name: str,
    tree: dict[str, Blob],
    selected: list[CandidatePath],
    links: tuple[SymbolicLink, ...],
    paths: tuple[str, ...],
    limit: int,
) -> Workspace:
    """The files of a commit, written below *directory*, as a Workspace."""
    directory.mkdir()
    above = [CandidatePath(path, "package") for path in manifests_above(_scope(tree, paths)) if path in tree]
    return assemble(
        directory,
        chain(write_contents(directory, read_blobs(tree, selected, limit)), links),
        listed=[candidate.path for candidate in selected],
        problems=(),
        targets=None,
        context=[c for c in read_blobs(tree, above, limit) if isinstance(c, Content)],
        max_file_size=limit,
        name=name,
        names=tree,
    )


def _renames(
    scratch: Path, base: Workspace, head: Workspace, trees: tuple[dict[str, Blob], dict[str, Blob]]
) -> dict[str, str]:
    old, new = ({file.path for file in side.files} for side in (base, head))
    deleted = {path: trees[0][path] for path in old - trees[1].keys() if unusable_name(path) is None}
    added = [path for path in new - trees[0].keys() if os.path.lexists(head.root / path)]
    return find_renames(scratch, head.root, deleted, added)
