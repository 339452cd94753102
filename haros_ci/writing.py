# SPDX-License-Identifier: Apache-2.0
"""The one writer of all outputs: whole files or none, and never where a link of the analysed code leads.

A file is written as a draft beside its place, which then takes the place; the draft is gone whatever happens. Whoever wrote the
analysed code may have put symbolic links into it: one in the current directory or in a git work tree must not lead out of there.
"""

from __future__ import annotations

import errno
import os
import stat
import sys
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path

from haros_ci.errors import RunFailure, UserError
from haros_ci.interruption import held
from haros_ci.regex import regex

_NEW = os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_NOFOLLOW | os.O_CLOEXEC
#: Names of what this process has open already.
_OPEN = regex(r"/dev/(?:(stdout)|(stderr)|fd/([0-9]{1,6}))|/proc/(?:self|thread-self)/fd/([0-9]{1,6})")
#: What the machine has no room for; another name would not help.
_FULL = frozenset({errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO, errno.EMFILE, errno.ENFILE, errno.ENOMEM})
_MOST_LINKS = 40


def write(text: str, path: Path | None) -> None:
    """*text* in UTF-8 to *path* as ``put`` does it, or to stdout."""
    data = text.encode("utf-8", "backslashreplace")
    if path is None:
        sys.stdout.flush()
        sys.stdout.buffer.write(data)
    else:
        put(data, path)


def put(data: bytes, path: Path) -> None:
    """*data* to a file that appears whole or not at all; into what is no plain file (``/dev/null``, a pipe) as it is.

    UserError where the place cannot be written to or a link leads out, RunFailure where there is no room.
    """
    try:
        keep_inside(path)
        number = _descriptor(path)
        if number is not None:
            _into(os.dup(number), data)
            return
        place = os.path.realpath(path)
        known = os.stat(place) if os.path.exists(place) else None
        if known is not None and stat.S_ISDIR(known.st_mode):
            raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
        if known is not None and not stat.S_ISREG(known.st_mode):
            _into(os.open(place, os.O_WRONLY | os.O_NOCTTY | os.O_CLOEXEC), data)
            return
        os.makedirs(os.path.dirname(place), exist_ok=True)
        replace(place, data, known)
    except (OSError, ValueError) as err:
        raise cannot(path, err, "name another --output path") from err


def put_below(folder: Path, documents: Mapping[str, str | bytes]) -> None:
    """Each of *documents* below *folder* by its path there, in their order; what else lies there stays as it is.

    Below *folder* no symbolic link is followed. Errors as of ``put``.
    """
    at = folder
    try:
        keep_inside(folder)
        os.makedirs(folder, exist_ok=True)
        for name, content in documents.items():
            *directories, own = name.split("/")
            place = folder
            for directory in directories:
                place = at = place / directory
                if place.is_symlink():
                    raise UserError(
                        f"{place}: is a symbolic link", help="remove it, or name another --output directory"
                    )
                with suppress(FileExistsError):
                    os.mkdir(place)
            at = place / own
            data = content if isinstance(content, bytes) else content.encode("utf-8", "backslashreplace")
            replace(os.fspath(at), data)
    except (OSError, ValueError) as err:
        raise cannot(at, err, "name another --output directory") from err


def create(root: Path, name: str, text: str) -> None:
    """A new file *name* below *root*. OSError if anything is there; UserError if a directory on the way is a symbolic link."""
    for directory in reversed(Path(name).parents[:-1]):
        place = root / directory
        if place.is_symlink():
            raise UserError(
                f"{directory}: a symbolic link, which could lead out of the workspace", help="make it a directory"
            )
        with suppress(FileExistsError):
            os.mkdir(place)
    path, made = root / name, False
    try:
        with held():
            descriptor = os.open(path, _NEW, 0o666)
            made = True
        _into(descriptor, text.encode("utf-8"))
    except BaseException:
        if made:
            with suppress(OSError):
                os.unlink(path)
        raise


def replace(place: str, data: bytes, known: os.stat_result | None = None, mode: int | None = None) -> None:
    """The file at *place* becomes *data*, a link there is replaced; OSError, and nothing is changed, where that is not possible.

    Permissions and owner are those of *known*, the file as it was, as far as this user may give them; *mode* goes before.
    """
    draft = os.path.join(os.path.dirname(place), f".haros-ci-{os.getpid()}-{os.urandom(4).hex()}.new")
    try:
        descriptor = os.open(draft, _NEW, 0o666)
        if known is not None:
            mode = stat.S_IMODE(known.st_mode) if mode is None else mode
            with suppress(OSError):
                if (known.st_uid, known.st_gid) != (os.geteuid(), os.getegid()):
                    os.fchown(descriptor, known.st_uid, known.st_gid)
        if mode is not None:
            with suppress(OSError):
                os.fchmod(descriptor, mode)
        _into(descriptor, data)
        os.replace(draft, place)
    except BaseException:
        with suppress(OSError):
            os.unlink(draft)
        raise


def append(path: Path, text: str) -> None:
    """*text* at the end of a file, which is made if there is none. UserError and RunFailure as of ``put``; the file is then as it was."""
    try:
        keep_inside(path)
        descriptor = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_APPEND | os.O_NOCTTY | os.O_CLOEXEC, 0o666)
        size = os.fstat(descriptor).st_size
        kept = os.dup(descriptor)
        try:
            _into(descriptor, text.encode("utf-8", "backslashreplace"))
        except BaseException:
            with suppress(OSError):
                os.ftruncate(kept, size)
            raise
        finally:
            os.close(kept)
    except (OSError, ValueError) as err:
        raise cannot(path, err, "name another file") from err


def keep_inside(path: Path) -> None:
    """UserError if *path* lies in the current directory or in a git work tree by its name, and elsewhere by symbolic links."""
    real, named = os.path.realpath(path), os.path.abspath(path)
    if real == named:
        return
    here = os.getcwd()
    for directory in map(str, Path(named).parents):
        is_theirs = directory == here or os.path.lexists(os.path.join(directory, ".git"))
        if is_theirs and not Path(real).is_relative_to(os.path.realpath(directory)):
            what = "the current directory" if directory == here else f"the git work tree {directory}"
            raise UserError(
                f"{path}: a symbolic link leads out of {what}",
                help="remove it, or name the place where it leads",
            )


def cannot(path: Path, err: Exception, help: str) -> Exception:
    """What to raise where *path* cannot be written because of *err*."""
    number = err.errno if isinstance(err, OSError) else None
    why = (err.strerror if isinstance(err, OSError) else None) or str(err)
    if number in _FULL:
        return RunFailure(f"{path}: cannot be written: {why}", help=remedy(number) or help)
    return UserError(f"{path}: cannot be written: {why}", help=help)


def remedy(number: int | None) -> str:
    """What a user can do where the machine has refused with this error number; "" for one that says nothing of the machine."""
    if number in (errno.EMFILE, errno.ENFILE):
        return "allow more open files: ulimit -n 1024"
    if number == errno.EFBIG:
        return "allow larger files: ulimit -f unlimited"
    if number == errno.ENOMEM:
        return "allow more memory (ulimit -v, ulimit -d), or run fewer processes: --jobs 1"
    if number == errno.EAGAIN:
        return "allow more processes: ulimit -u"
    if number in _FULL:
        return "make room, or name another place: TMPDIR for temporary files, --cache-dir for the cache, --output for a report"
    return ""


def _descriptor(path: Path) -> int | None:
    """The number of what this process has open that *path* is a name of: of ``/dev/stdout``, and of links to it."""
    place = os.path.abspath(path)
    for _ in range(_MOST_LINKS):
        if found := _OPEN.fullmatch(place):
            if found[1] or found[2]:
                sys.stdout.flush()
            return 1 if found[1] else 2 if found[2] else int(found[3] or found[4])
        if not os.path.islink(place):
            return None
        place = os.path.abspath(os.path.join(os.path.dirname(place), os.readlink(place)))
    return None


def _into(descriptor: int, data: bytes) -> None:
    """All of *data*, and the end of it."""
    try:
        rest = memoryview(data)
        while rest:
            rest = rest[os.write(descriptor, rest) :]
    finally:
        os.close(descriptor)
