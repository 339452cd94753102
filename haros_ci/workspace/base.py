# SPDX-License-Identifier: Apache-2.0
"""The base revision as a second Workspace, made from git's objects in a temporary directory."""

from __future__ import annotations

import errno
import os
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from itertools import chain
from pathlib import Path

from haros_ci import scratch
from haros_ci.model.workspace import Problem, Reader, Workspace
from haros_ci.records import dataclass
from haros_ci.workspace.assemble import Content, assemble
from haros_ci.workspace.base_settings import BaseSettings
from haros_ci.workspace.discover import MAX_FILE_SIZE, manifests_above, scope_of, unusable_name
from haros_ci.workspace.excludes import Excludes
from haros_ci.workspace.git import BaselineUnavailable, GitError, Repository, merge_base, repository_of, resolve_commit
from haros_ci.workspace.objects import Blob, read_blobs, read_links, read_tree
from haros_ci.workspace.renames import find_renames
from haros_ci.workspace.selection import Also, AnalysedPaths, CandidatePath, select
from haros_ci.workspace.tool_settings import TOOL_SETTINGS

__all__ = ["Base", "BaselineUnavailable", "base_workspace"]


#: What the machine lacks for any file; a base revision that holds only some of its files would make old findings new.
NO_ROOM = frozenset({errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO, errno.EMFILE, errno.ENFILE, errno.ENOMEM})
IN_MEMORY = "/dev/shm"
IN_MEMORY_RESERVE = 256_000_000


@dataclass(frozen=True, slots=True)
class Base:
    """The workspace at *revision* (a commit); ``renames`` maps paths there to the paths that these files have now.

    ``settings`` reads the settings files of linters there, which count for the present workspace, too; None where those of
    the present one are trusted.
    """

    workspace: Workspace
    revision: str
    renames: dict[str, str]
    settings: Reader | None = None


@contextmanager
def base_workspace(
    workspace: Workspace,
    rev: str,
    *,
    paths: tuple[str, ...] = (".",),
    exclude: tuple[str, ...] = (),
    max_file_size: int = MAX_FILE_SIZE,
    use_merge_base: bool = True,
    also: Also | None = None,
    trusted: bool = False,
    known: tuple[Path, str] | None = None,
) -> Iterator[Base]:
    """What discover would have found at the merge base of *rev* and HEAD (or at *rev* itself), for as long as it is needed; *known* is that merge base, if
    it was found before in the same repository.

    *workspace* is the present one; *paths*, *exclude*, *max_file_size* and *also* are those it was discovered with. Linters have the
    settings of the base; if *workspace* is *trusted*, those of *workspace*, whose tools look for them on disk.
    BaselineUnavailable if the revision or anything of it cannot be had. Nothing is written into the repository and
    nothing is checked out, so no hook and no filter runs.
    """
    root = workspace.root
    repository = _repository(workspace)
    if known is not None and known[0] == repository.top:
        commit = known[1]
    else:
        commit = merge_base(repository.top, rev) if use_merge_base else resolve_commit(repository, rev)
    try:
        links: dict[str, Blob] = {}
        tree = read_tree(repository, commit, workspace, links)
        scope = _scope(workspace, paths, tree)
        selected = select(tree, scope, Excludes(exclude), also)
        aliases = read_links(tree, {c.path: links[c.path] for c in select(links, scope, Excludes(exclude))})
        with scratch_directory(sum(tree[candidate.path].size for candidate in selected)) as place:
            directory = place / "base"
            directory.mkdir()
            renames = find_renames(place, root, *_moved(tree, selected, workspace))
            copied = _copy_settings(workspace, directory, selected) if trusted else []
            settings = None if trusted else _settings(workspace, repository, tree, selected, max_file_size)
            manifests = [CandidatePath(path, "package") for path in manifests_above(scope) if path in tree]
            base = assemble(
                directory,
                chain(write_contents(directory, read_blobs(tree, selected, max_file_size)), aliases),
                listed=[*(candidate.path for candidate in selected), *copied],
                problems=(),
                targets=_targets(workspace, tree, renames),
                context=[c for c in read_blobs(tree, manifests, max_file_size) if isinstance(c, Content)],
                max_file_size=max_file_size,
                name=root.name,
                names=tree,
                executables=(path for path, blob in tree.items() if blob.executable),
                elsewhere=root,
                requested=scope.directories,
            )
            hiding = replace(base.hiding, databases=workspace.hiding.databases)
            yield Base(replace(base, settings=settings, hiding=hiding), commit, renames, settings)
    except GitError as err:
        raise BaselineUnavailable(f"{rev!r} cannot be read: {err}; is the clone complete (no --filter)?") from err


@contextmanager
def scratch_directory(size: int) -> Iterator[Path]:
    """A temporary directory for *size* bytes: in memory if there is ample room, as making files is slow on some disks."""
    place = None
    if not os.environ.get("TMPDIR") and os.access(IN_MEMORY, os.W_OK):
        room = os.statvfs(IN_MEMORY)
        if room.f_bavail * room.f_frsize > 4 * size + IN_MEMORY_RESERVE:
            place = IN_MEMORY
    with scratch.scratch_directory("haros-ci-base-", place) as directory:
        yield directory


def _repository(workspace: Workspace) -> Repository:
    """The one repository that all files lie in, submodules aside."""
    root = workspace.root
    tops: dict[str, Path | None] = {".": repository_of(root)}
    for file in workspace.files:
        chain = []
        directory = file.path.rpartition("/")[0] or "."
        while directory not in tops:
            chain.append(directory)
            directory = directory.rpartition("/")[0] or "."
        top = tops[directory]
        for directory in reversed(chain):
            top = tops[directory] = root / directory if os.path.lexists(root / directory / ".git") else top
    used = {tops[file.path.rpartition("/")[0] or "."] for file in workspace.files} - {None} or {tops["."]}
    outer = tops["."]
    if outer is not None and all(top == outer or (top is not None and (top / ".git").is_file()) for top in used):
        return Repository(outer if len(used) > 1 else used.pop() or outer)
    if len(used) > 1:
        raise BaselineUnavailable(
            f"a revision belongs to one repository, and the files lie in {len(used)}; use a baseline file, "
            "or analyse one repository at a time"
        )
    top = used.pop()
    if top is None:
        raise BaselineUnavailable("not in a git repository; use a baseline file instead of a revision")
    return Repository(top)


def _scope(workspace: Workspace, paths: tuple[str, ...], tree: dict[str, Blob]) -> AnalysedPaths:
    """The scope that *paths* have now, where directories may be gone or have been files."""
    present = scope_of(workspace.root, paths)
    return replace(present, files=tuple(path for path in present.files if path in tree))


def _moved(
    tree: dict[str, Blob], selected: list[CandidatePath], workspace: Workspace
) -> tuple[dict[str, Blob], list[str]]:
    """What is in the base alone, and what is in the work tree alone."""
    present = {file.path for file in workspace.files}
    removed = [c.path for c in selected if c.path not in present and unusable_name(c.path) is None]
    deleted = {path: tree[path] for path in removed if not os.path.lexists(workspace.root / path)}
    return deleted, sorted(present - tree.keys())


def _targets(workspace: Workspace, tree: dict[str, Blob], renames: dict[str, str]) -> frozenset[str] | None:
    """The targets, and what they were called in the base."""
    targets = workspace.targets
    return None if targets is None else frozenset(path for path in tree if renames.get(path, path) in targets)


def write_contents(directory: Path, contents: Iterable[Content | Problem]) -> Iterator[Content | Problem]:
    """Write contents below *directory* as they pass."""
    made = {""}
    for content in contents:
        if isinstance(content, Content):
            parent = content.path.rpartition("/")[0]
            try:
                if parent not in made:
                    os.makedirs(directory / parent, exist_ok=True)
                    made.add(parent)
                _create(directory / content.path, content.data)
            except OSError as err:  # names that are too long, or that only a crafted tree can hold side by side
                if err.errno in NO_ROOM:
                    raise
                if _holds(directory / content.path, content.data):  # settings of a tool that have not changed
                    yield content
                    continue
                yield Problem(content.path, f"skipped in the base revision: it cannot be written ({err.strerror})")
                continue
        yield content


def _holds(path: Path, data: bytes) -> bool:
    """Whether *path*, which is ours, is a file of these bytes."""
    try:
        return path.read_bytes() == data
    except OSError:
        return False


def _copy_settings(workspace: Workspace, directory: Path, selected: list[CandidatePath]) -> list[str]:
    """Copy tools' settings from the present workspace to where they apply in the base; returns their paths."""
    copied = []
    for parent in sorted(_directories(selected)):
        for name in TOOL_SETTINGS:
            path = f"{parent}/{name}" if parent else name
            text = workspace.setting(path)
            if text:
                os.makedirs(directory / parent, exist_ok=True)
                _create(directory / path, text.encode("utf-8"))
                copied.append(path)
    return copied


def _settings(
    workspace: Workspace, repository: Repository, tree: dict[str, Blob], selected: list[CandidatePath], limit: int
) -> BaseSettings:
    """The settings of the base revision that *tree* is of."""
    root, top = workspace.root, repository.top
    below = f"{top.relative_to(root).as_posix()}/" if top != root and top.is_relative_to(root) else ""
    return BaseSettings(tree, _directories(selected), limit, workspace.settings or workspace.reader, below)


def _directories(selected: list[CandidatePath]) -> set[str]:
    """The directories of the *selected* paths, and all directories above them; the root is ""."""
    directories = {""}
    for candidate in selected:
        parent = candidate.path.rpartition("/")[0]
        while parent not in directories:
            directories.add(parent)
            parent = parent.rpartition("/")[0]
    return directories


def _create(path: Path, data: bytes) -> None:
    descriptor = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_CLOEXEC, 0o600)
    with os.fdopen(descriptor, "wb") as file:
        file.write(data)
