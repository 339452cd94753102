# SPDX-License-Identifier: Apache-2.0
"""What git calls the contents of a file on disk."""

from __future__ import annotations

import hashlib
import os
import stat

_PIECE = 1 << 20


def object_name(path: str, length: int) -> str | None:
    """What git calls the contents of the file or link at *path*, with names of *length* digits; None if there is none."""
    made = hashlib.sha256() if length == 64 else hashlib.sha1(usedforsecurity=False)
    try:
        status = os.lstat(path)
        if stat.S_ISLNK(status.st_mode):
            target = os.fsencode(os.readlink(path))
            made.update(b"blob %d\0" % len(target) + target)
            return made.hexdigest()
        if not stat.S_ISREG(status.st_mode):
            return None
        made.update(b"blob %d\0" % status.st_size)
        with open(os.open(path, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC), "rb") as file:
            while piece := file.read(_PIECE):
                made.update(piece)
    except FileNotFoundError:
        return None
    return made.hexdigest()
