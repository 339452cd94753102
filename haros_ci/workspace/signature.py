# SPDX-License-Identifier: Apache-2.0
"""What tells whether anything in a workspace has changed, without a file being read."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from pathlib import Path

from haros_ci.workspace.discover import scope_of
from haros_ci.workspace.excludes import Excludes
from haros_ci.workspace.listing import list_files
from haros_ci.workspace.selection import select

#: By path: time of the last change in ns, size, inode and mode; None for a file that is not there.
Signature = Mapping[str, tuple[int, int, int, int] | None]


def signature(
    root: Path,
    paths: tuple[str, ...],
    *,
    exclude: tuple[str, ...] = (),
    more: Iterable[Path] = (),
    but: Iterable[Path] = (),
) -> Signature:
    """Of every file that a run over *paths* (relative to *root*) would look at.

    *more* are further files, absolute, that a run reads, wherever they lie. What is in *but*, or below a directory in it, is
    left out: what a run itself writes. UserError if a path of *paths* is gone.
    """
    root = root.resolve()
    scope = scope_of(root, paths)
    listing = list_files(root, scope.directories)
    own = {os.path.relpath(path, root) for path in map(os.path.realpath, but)}
    chosen = (candidate.path for candidate in select([*listing.paths, *scope.files], scope, Excludes(exclude)))
    kept = [path for path in chosen if not own or not _is_in(path, own)]
    others = (os.path.relpath(path, root) if path.is_relative_to(root) else str(path) for path in more)
    return {path: _of(root / path) for path in dict.fromkeys((*kept, *others))}


def changes(before: Signature, now: Signature) -> tuple[tuple[str, str], ...]:
    """The paths that differ, sorted, each with ``changed``, ``new`` or ``gone``."""
    changed = []
    for path in sorted({*before, *now}):
        old, new = before.get(path), now.get(path)
        if old != new:
            changed.append((path, "new" if old is None else "gone" if new is None else "changed"))
    return tuple(changed)


def _is_in(path: str, places: set[str]) -> bool:
    while path:
        if path in places:
            return True
        path = path.rpartition("/")[0]
    return False


def _of(path: str | Path) -> tuple[int, int, int, int] | None:
    try:
        found = os.lstat(path)
    except (OSError, ValueError):
        return None
    return found.st_mtime_ns, found.st_size, found.st_ino, found.st_mode
