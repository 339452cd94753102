# SPDX-License-Identifier: Apache-2.0
"""From a directory on disk to a Workspace: its packages and the files that can be analysed."""

from __future__ import annotations

import errno
import os
import posixpath
import stat
from collections.abc import Iterable, Iterator
from dataclasses import replace
from pathlib import Path

from haros_ci.errors import UserError
from haros_ci.model.workspace import Buffer, Problem, Workspace
from haros_ci.timing import timed
from haros_ci.workspace.assemble import Content, Skipped, SymbolicLink, assemble, in_order
from haros_ci.workspace.excludes import Excludes
from haros_ci.workspace.files import FileTree, TooLarge, read_head, read_regular
from haros_ci.workspace.hiding import TrackedChange
from haros_ci.workspace.language import HEAD, is_kept_copy, script_language, suffix_of
from haros_ci.workspace.listing import list_files
from haros_ci.workspace.past import Past
from haros_ci.workspace.selection import Also, AnalysedPaths, CandidatePath, select
from haros_ci.workspace.settings_around import SettingsAround
from haros_ci.workspace.unfetched import unfetched

MAX_FILE_SIZE = 2_000_000

#: Where the CMakeLists.txt leads to that catkin_init_workspace puts into every ``src``.
CATKIN_TOP_LEVEL = "/catkin/cmake/toplevel.cmake"

_CAN_BE_SCRIPTS = (None, "python", "setup", "shell")
_EXECUTE = stat.S_IXUSR | stat.S_IXGRP | stat.S_IXOTH


@timed("discover")
def discover(
    root: Path,
    paths: tuple[str, ...],
    *,
    exclude: tuple[str, ...] = (),
    max_file_size: int = MAX_FILE_SIZE,
    also: Also | None = None,
    past: Past | None = None,
    buffer: Buffer | None = None,
) -> Workspace:
    """Find, read and hash what there is to analyse below *root*.

    *paths* are directories and files, POSIX-style and relative to *root* (absolute). Directories are the subtree to
    analyse; where files are given they become the targets, and without any directory all of *root* is the subtree.
    *exclude* are patterns as in .gitignore; they hold for given files, and below given directories. Files over
    *max_file_size* bytes are not read. *also* tells which files are read whatever their kind. *past* is the base
    revision of a change, whose markers count instead of those that the change brings. UserError for a path that does not exist or leads out of *root*.
    With *buffer* it is the one file to report on, in place of *paths*; it need not be on disk.
    """
    root = root.resolve()
    scope = scope_of(root, paths) if buffer is None else AnalysedPaths((".",), (buffer.path,), named=False)
    listing = list_files(root, scope.directories, None if past is None else past.top)
    change = None if past is None else TrackedChange(root, past, listing)
    excludes = Excludes(exclude)
    candidates = select([*listing.paths, *scope.files], scope, excludes, also, change)
    disk = _Disk(root, max_file_size, buffer)
    executables = listing.executables | disk.executables(candidates)
    present = [*listing.paths, *scope.files]
    workspace = assemble(
        root,
        disk.read(candidates),
        listed=present,
        names=present,
        problems=listing.problems,
        targets=targets_of(scope, (candidate.path for candidate in candidates)),
        context=disk.manifests(manifests_above(scope)),
        max_file_size=max_file_size,
        executables=executables if executables or listing.is_tracked else None,
        differs=None if change is None else change.has_changed,
        requested=scope.directories,
        buffer=buffer,
    )
    if scope.named or not scope.files:
        lacking = tuple(unfetched(workspace, listing.empty, excludes))
        workspace = replace(workspace, problems=in_order((*workspace.problems, *lacking)))
    workspace = replace(workspace, unfetched=frozenset(listing.empty))
    if change is not None:
        workspace = change.applied_to(workspace, candidates, scope, excludes)
    if "." in scope.directories:
        return workspace
    return replace(workspace, settings=SettingsAround(root, scope, max_file_size, workspace.reader))


def scope_of(root: Path, paths: Iterable[str]) -> AnalysedPaths:
    """*paths* sorted into directories and files, symbolic links in them resolved; UserError as discover has it."""
    directories: set[str] = set()
    files: set[str] = set()
    for path in paths:
        normal = posixpath.normpath(path)
        try:
            real = (root / normal).resolve(strict=True)
            mode = real.stat().st_mode
        except (OSError, RuntimeError, ValueError) as err:  # RuntimeError: a loop, before Python 3.13; ValueError: NUL
            raise UserError(
                f"{path!r}: no such file or directory", help=f"paths are relative to {root.name!r}"
            ) from err
        if not real.is_relative_to(root):
            raise UserError(f"{path!r} leads out of the workspace", help="run haros-ci in a directory that holds both")
        (directories if stat.S_ISDIR(mode) else files).add(real.relative_to(root).as_posix())
    return AnalysedPaths(tuple(sorted(directories)) or (".",), tuple(sorted(files)), named=bool(directories))


def targets_of(scope: AnalysedPaths, paths: Iterable[str]) -> frozenset[str] | None:
    """The files to report on: None for all that there are, else those given and all below directories given."""
    if not scope.files:
        return None
    if not scope.named:
        return frozenset(scope.files)
    below = tuple(f"{directory}/" for directory in scope.directories)
    return frozenset((*scope.files, *(path for path in paths if "." in scope.directories or path.startswith(below))))


def manifests_above(scope: AnalysedPaths) -> list[str]:
    """Where the manifests of packages would be that the given directories lie in."""
    above = {parent for path in scope.directories for parent in _parents(path)} - set(scope.directories)
    return sorted("package.xml" if directory == "." else f"{directory}/package.xml" for directory in above)


class _Disk:
    """Reads candidates below *root*, with a problem instead of contents where that is not possible."""

    def __init__(self, root: Path, max_file_size: int, buffer: Buffer | None = None) -> None:
        self._root = os.fspath(root)
        self._buffer = buffer
        self._tree = FileTree(root)
        self._limit = max_file_size

    def read(self, candidates: Iterable[CandidatePath]) -> Iterator[Content | SymbolicLink | Skipped]:
        for candidate in candidates:
            path = candidate.path
            found: Content | SymbolicLink | Problem | None = unusable_name(path)
            if found is None:
                try:
                    found = self._content(candidate)
                except TooLarge as err:
                    found = too_large(path, err.args[0], self._limit)
                except OSError as err:
                    found = self._trouble(candidate, err)
            if isinstance(found, Problem):
                yield Skipped(path, found, is_source=candidate.language != "markdown" and candidate.fallback is None)
            elif found is not None:
                yield found

    def executables(self, candidates: Iterable[CandidatePath]) -> set[str]:
        """Those of the *candidates* that can be scripts and have an execute bit."""
        found = set()
        for candidate in candidates:
            if candidate.language in _CAN_BE_SCRIPTS:
                try:
                    mode = os.lstat(f"{self._root}/{candidate.path}").st_mode
                except OSError:
                    continue
                if mode & _EXECUTE:
                    found.add(candidate.path)
        return found

    def manifests(self, paths: Iterable[str]) -> Iterator[Content]:
        """Those of *paths* that are there."""
        for path in paths:
            try:
                data = self._tree.read(path, self._limit)
            except (OSError, TooLarge):
                continue
            if data is not None:
                yield Content(path, "package", data)

    def _content(self, candidate: CandidatePath) -> Content | None:
        """The contents; None where only they can tell that it is no script. OSError, also if it is no regular file."""
        if self._buffer is not None and candidate.path == self._buffer.path:
            data = self._buffer.data
            language = candidate.language or script_language(data[:HEAD]) or candidate.fallback
            return None if language is None else Content(candidate.path, language, data)
        place = self._tree.place(candidate.path)
        language = candidate.language
        if language is None:
            name = candidate.path.rpartition("/")[2]
            if not is_kept_copy(name) and (not suffix_of(name) or _may_be_script(place)):
                language = script_language(read_head(place, HEAD))
            language = language or candidate.fallback
            if language is None:
                return None
        found = read_regular(place, self._limit)
        if found is None:
            raise OSError(errno.EINVAL, "it is a pipe, a device or another thing that is no file")
        return Content(candidate.path, language, found)

    def _trouble(self, candidate: CandidatePath, err: OSError) -> SymbolicLink | Problem | None:
        if err.errno in (errno.ELOOP, errno.EMLINK):  # what O_NOFOLLOW says of a symbolic link
            return self._link(candidate.path, candidate.language)
        if err.errno in (errno.ENOENT, errno.ENOTDIR):  # git still knows files that were deleted
            return None
        return Problem(candidate.path, f"skipped: it cannot be read ({err.strerror})")

    def _link(self, path: str, language: str | None) -> SymbolicLink | Problem | None:
        """A problem for a link that leads nowhere or out of the root; what it leads to inside is listed by itself, too."""
        for directory in sorted(_parents(path), key=len):
            if os.path.islink(f"{self._root}/{directory}"):  # git lists what was there when it was a directory
                path, language = directory, None
                break
        try:
            if os.readlink(f"{self._root}/{path}").endswith(CATKIN_TOP_LEVEL):
                return None
            target = os.path.realpath(f"{self._root}/{path}", strict=True)
        except OSError:
            return Problem(path, "skipped: a symbolic link that leads nowhere") if language else None
        if target == self._root:
            return None
        if target.startswith(f"{self._root}/"):
            return SymbolicLink(path, target[len(self._root) + 1 :])
        if language is None and not os.path.isdir(target):
            return None
        return Problem(path, "skipped: a symbolic link that leads out of the workspace")


def _may_be_script(place: str) -> bool:
    """Whether the file is executable, or a symbolic link (which is looked into further on)."""
    mode = os.lstat(place).st_mode
    return stat.S_ISLNK(mode) or bool(mode & stat.S_IXUSR)


def unusable_name(path: str) -> Problem | None:
    """A problem if *path* cannot stand in a line of text, as it is not UTF-8 or has a line break."""
    if path.isprintable():
        return None
    parts = path.split("/")
    for number, name in enumerate(parts):
        if not name.isprintable() and (any("\ud800" <= c <= "\udfff" for c in name) or name.splitlines() != [name]):
            return Problem("/".join(parts[:number]) or ".", f"skipped {name!a}: rename it, it is not one line of UTF-8")
    return None


def too_large(path: str, size: int, limit: int) -> Problem:
    """The problem of a file with *size* bytes."""
    return Problem(path, f"skipped: {size} bytes, more than the limit of {limit}; raise it or exclude the file")


def _parents(path: str) -> Iterator[str]:
    while path != ".":
        path = path.rpartition("/")[0] or "."
        yield path
