# SPDX-License-Identifier: Apache-2.0
"""Directories for a while: they go with all that is in them, however deep, also when the run is abandoned."""

from __future__ import annotations

import errno
import os
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from haros_ci.errors import RunFailure
from haros_ci.interruption import held

_NAMES = ("TMPDIR", "TEMP", "TMP")
#: Where Linux has a file system in memory that everybody may write to (shm_overview(7)).
MEMORY = "/dev/shm"
#: Bytes that are put there at most, and how many times as many have to be free.
IN_MEMORY = 32 << 20
ROOM = 4


@contextmanager
def scratch_directory(prefix: str = "haros-ci-", place: str | None = None) -> Iterator[Path]:
    """A new directory in *place* (None: TMPDIR), resolved; gone at the end also where a signal comes while it is made or removed.

    RunFailure where there is no place for it: the current directory, which Python would take at last, may be the workspace.
    What cannot be removed is left without complaint. The standard library's TemporaryDirectory removes by recursion, which
    ends the run where a workspace has a thousand directories in each other.
    """
    made = None
    try:
        if place is None and not _is_temporary(tempfile.gettempdir()):
            raise FileNotFoundError(errno.ENOENT, "no directory for temporary files can be written")
    except OSError as err:
        places = "TMPDIR (or /tmp, /var/tmp)"
        raise RunFailure(
            f"temporary files: {err.strerror}", help=f"make room in {places}, or let TMPDIR name another place"
        ) from err
    try:
        with held():
            made = tempfile.mkdtemp(prefix=prefix, dir=place)
        yield Path(os.path.realpath(made))
    finally:
        with held():
            if made is not None:
                remove_tree(made)


def place_in_memory(size: int) -> str | None:
    """The directory of Linux for files in memory, where *size* bytes of small files go there quicker than to a disk; else None.

    None also where the user names a place for temporary files, for more than ``IN_MEMORY`` bytes, and where little is free.
    """
    if size > IN_MEMORY or any(os.environ.get(name) for name in _NAMES):
        return None
    try:
        status = os.statvfs(MEMORY)
        is_free = status.f_bavail * status.f_frsize >= ROOM * size + IN_MEMORY // 2
        return MEMORY if is_free and os.access(MEMORY, os.W_OK | os.X_OK) else None
    except OSError:
        return None


def _is_temporary(directory: str) -> bool:
    """Whether somebody has named *directory* for temporary files, be it the user or the system."""
    named = [os.environ[name] for name in _NAMES if os.environ.get(name)]
    return directory in (*map(os.path.abspath, named), "/tmp", "/var/tmp", "/usr/tmp")


def remove_tree(top: str) -> None:
    """Removes a directory with all that is below it; no symbolic link is followed, and nothing is raised."""
    pending, found = [top], []
    while pending:
        directory = pending.pop()
        found.append(directory)
        try:
            with os.scandir(directory) as entries:
                for entry in entries:
                    if entry.is_dir(follow_symlinks=False):
                        pending.append(entry.path)
                    else:
                        _attempt(os.unlink, entry.path)
        except OSError:
            continue
    for directory in reversed(found):
        _attempt(os.rmdir, directory)


def _attempt(remove: Callable[[str], None], path: str) -> None:
    try:
        remove(path)
    except OSError:
        pass
