# SPDX-License-Identifier: Apache-2.0
"""The paths of the files that lie below given directories: as git knows them, else as they lie on disk."""

from __future__ import annotations

import os
from pathlib import Path

from haros_ci.model.workspace import Problem
from haros_ci.records import dataclass, field
from haros_ci.workspace.git import LISTING, GitError, Repository, listed_files, repository_of
from haros_ci.workspace.selection import MARKERS, is_never_source, is_output

#: Said of a repository whose .gitignore takes git too long.
SLOW = f"git did not find in {LISTING:g} s which untracked files it ignores: tracked files alone are analysed; look at the patterns of its .gitignore files"


@dataclass(slots=True)
class PathListing:
    """Paths relative to the root, in no order, with doubles where directories overlap; symbolic links are among them.

    *executables* have the execute bit in git's index, which keeps it on file systems without modes. *is_tracked* if git
    listed anything. *tracked* is what the repository of a change tracks, and its *submodules*: the name of what the index holds, by path.
    """

    paths: list[str] = field(default_factory=list)
    executables: set[str] = field(default_factory=set)
    is_tracked: bool = False
    problems: list[Problem] = field(default_factory=list)
    tracked: dict[str, str] = field(default_factory=dict)
    submodules: set[str] = field(default_factory=set)
    empty: list[str] = field(default_factory=list)


def list_files(root: Path, directories: tuple[str, ...], change: Path | None = None) -> PathListing:
    """Every file below *directories* (relative to *root*) that .gitignore does not exclude.

    One git process for each repository; nested repositories and submodules are listed on their own. Outside git, or
    where git does not work, directories are walked and .gitignore has no meaning. *change* is the top of the repository whose
    ``tracked`` files are asked for.
    """
    listing = PathListing()
    by_repository: dict[Path, list[str]] = {}
    for directory in directories:
        top = repository_of(root / directory)
        if top is None:
            _walk(listing, root, directory, change=change)
        else:
            by_repository.setdefault(top, []).append(directory)
    for top, below in by_repository.items():
        _list_repository(listing, root, top, below, is_changed=top == change, change=change)
    return listing


def _list_repository(
    listing: PathListing,
    root: Path,
    top: Path,
    directories: list[str],
    *,
    is_changed: bool = False,
    change: Path | None = None,
) -> None:
    """List *directories*, all of the repository at *top*, and what is nested in them; *is_changed* if it is that of the change."""
    inside = root.is_relative_to(top)
    cwd = root if inside else top
    mount = "" if inside else f"{top.relative_to(root).as_posix()}/"
    below = tuple(os.path.relpath(root / directory, cwd) for directory in directories)
    try:
        found = listed_files(Repository(top), cwd, below)
    except GitError as err:
        place = mount.rstrip("/") or "."
        listing.problems.append(Problem(place, f"{err}: all files are listed, .gitignore is not honoured"))
        for directory in directories:
            _walk(listing, root, directory, repositories=False)
        return
    if not found.is_whole:
        place = mount.rstrip("/") or "."
        listing.problems.append(Problem(place, SLOW))
    listing.problems += _left_out(root, [mount + path for path in found.sparse])
    paths = [mount + path for path in found.files]
    listing.paths += paths
    listing.executables.update(mount + path for path in found.executables)
    listing.is_tracked = True
    if is_changed:
        listing.tracked.update((mount + path, name) for path, name in found.tracked.items())
        listing.submodules.update(mount + path for path in found.nested if path in found.tracked)
    for path in found.nested:
        if os.path.lexists(f"{root}/{mount}{path}/.git"):
            below_it = root / mount / path
            part = (is_changed and path in found.tracked) or below_it == change
            _list_repository(listing, root, below_it, [mount + path], is_changed=part, change=change)
        elif path in found.tracked and not os.path.lexists(f"{root}/{mount}{path}"):
            listing.empty.append(mount + path)  # as in an export, or where somebody has removed the empty directory
        else:
            before = len(listing.paths)
            _walk(listing, root, mount + path)
            if len(listing.paths) == before and path in found.tracked:
                listing.empty.append(mount + path)
    for directory in directories if found.is_whole else ():
        for ignored in _ignored_as_a_whole(root, directory, paths + [mount + path for path in found.nested]):
            _walk(listing, root, ignored, change=change)


def _left_out(root: Path, sparse: list[str]) -> list[Problem]:
    """One problem for all tracked files that a sparse checkout has left out: a directory that is not there looks as if nothing were in it."""
    gone = [path for path in sparse if not os.path.lexists(f"{root}/{path}")]
    if not gone:
        return []
    files, verb = ("file", "is") if len(gone) == 1 else ("files", "are")
    why = f"{len(gone):,} tracked {files} {verb} not checked out (git sparse-checkout) and so not analysed"
    return [Problem(gone[0], f"{why}; git sparse-checkout disable brings all of them")]


def _ignored_as_a_whole(root: Path, directory: str, known: list[str]) -> list[str]:
    """Directories of which git lists nothing though they are asked for.

    That is a given directory, and the ``src`` of a workspace whose own repository leaves its sources to others.
    """
    prefix = "" if directory == "." else f"{directory}/"
    if not any(path.startswith(prefix) for path in known):
        return [directory]
    source = f"{prefix}src"
    if any(path == source or path.startswith(f"{source}/") for path in known):
        return []
    return [source] if os.path.isdir(root / source) and not os.path.islink(root / source) else []


def _walk(
    listing: PathListing, root: Path, directory: str, *, repositories: bool = True, change: Path | None = None
) -> None:
    """List by reading directories; those that are no source are not entered, those with ``.git`` are left to git."""
    pending = [directory]
    while pending:
        here = pending.pop()
        prefix = "" if here == "." else f"{here}/"
        try:
            with os.scandir(f"{root}/{here}") as entries:
                found = [
                    (e.name, e.is_dir(follow_symlinks=False), e.is_file(follow_symlinks=False) or e.is_symlink())
                    for e in entries
                ]
        except OSError as err:
            listing.problems.append(Problem(here, f"skipped: the directory cannot be read ({err.strerror})"))
            continue
        names = {name for name, _, _ in found}
        if here != directory and is_output(names):
            listing.paths += [prefix + name for name in names & MARKERS]  # they tell of the directories beside it
            continue
        if here != directory and repositories and ".git" in names:
            _list_repository(listing, root, root / here, [here], is_changed=root / here == change, change=change)
            continue
        listing.paths += [prefix + name for name, _, is_file in found if is_file]
        pending += [prefix + name for name, is_directory, _ in found if is_directory and not is_never_source(name)]
