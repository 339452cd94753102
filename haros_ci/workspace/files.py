# SPDX-License-Identifier: Apache-2.0
"""Opens files of an untrusted tree: regular ones only, never through a symbolic link, never waiting on a pipe."""

from __future__ import annotations

import errno
import os
import stat
from collections.abc import Iterable
from pathlib import Path

from haros_ci.model.workspace import Buffer

FLAGS = os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC


class TooLarge(Exception):
    """The file has more bytes than asked for; it was not read."""


def read_regular(path: str | Path, limit: int) -> bytes | None:
    """All bytes of a regular file; None if it is something else. TooLarge over *limit* bytes, OSError as open(2) has it."""
    descriptor = os.open(path, FLAGS)
    try:
        status = os.fstat(descriptor)
        if not stat.S_ISREG(status.st_mode):
            return None
        if status.st_size > limit:
            raise TooLarge(status.st_size)
        data = os.read(descriptor, status.st_size + 1)
        if len(data) == status.st_size:
            return data
        parts = [data]  # it changed since fstat, or the read was cut short
        while (part := os.read(descriptor, 1 << 16)) and sum(map(len, parts)) <= limit:
            parts.append(part)
        return b"".join(parts)[:limit]
    finally:
        os.close(descriptor)


def read_head(path: str | Path, length: int) -> bytes:
    """The first *length* bytes of a regular file, b"" if it is something else. OSError as open(2) has it."""
    descriptor = os.open(path, FLAGS)
    try:
        return os.read(descriptor, length) if stat.S_ISREG(os.fstat(descriptor).st_mode) else b""
    finally:
        os.close(descriptor)


def decode(data: bytes) -> str:
    """Text of *data* without its byte-order mark: UTF-8, else Latin-1 (in which every byte is a character)."""
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        return data.decode("latin-1")


class FileTree:
    """The files below *root*, none of which is reached through a symbolic link."""

    def __init__(self, root: Path) -> None:
        self._root = os.fspath(root).rstrip("/")
        self._real: dict[str, bool] = {"": True}

    def place(self, path: str) -> str:
        """Where *path* is on disk. OSError with ELOOP if a directory on the way is a symbolic link."""
        if not self._is_real(path.rpartition("/")[0]):
            raise OSError(errno.ELOOP, os.strerror(errno.ELOOP))
        return f"{self._root}/{path}"

    def read(self, path: str, limit: int) -> bytes | None:
        """As read_regular, for *path* relative to the root."""
        return read_regular(self.place(path), limit)

    def _is_real(self, directory: str) -> bool:
        known = self._real.get(directory)
        if known is None:
            chain = [directory]
            while (parent := chain[-1].rpartition("/")[0]) not in self._real:
                chain.append(parent)
            known = self._real[parent]
            for name in reversed(chain):
                known = known and stat.S_ISDIR(os.lstat(f"{self._root}/{name}").st_mode)
                self._real[name] = known
        return known


class TextReader:
    """Reads and keeps the texts of listed files below *root* (``model.workspace.Reader``).

    *others* is where files lie that are not listed, if not there, too: a base revision has its texts alone. *buffer* is not read from disk.
    """

    def __init__(
        self, root: Path, paths: Iterable[str], limit: int, others: Path | None = None, buffer: Buffer | None = None
    ) -> None:
        self._tree = FileTree(root)
        self._others = self._tree if others is None else FileTree(others)
        self._limit = limit
        self._buffer = buffer
        self._texts: dict[str, str | None] = dict.fromkeys(paths)

    def text(self, path: str) -> str:
        """The decoded text of a listed file; "" if it is not listed, not text or cannot be read any more."""
        if path not in self._texts:
            return ""
        text = self._texts[path]
        if text is None:
            data = self.data(path) or b""
            text = self._texts[path] = "" if b"\0" in data else decode(data)
        return text

    def data(self, path: str) -> bytes | None:
        """The bytes of a listed file; None if it is not listed or cannot be read any more."""
        if path not in self._texts:
            return None
        if self._buffer is not None and path == self._buffer.path:
            return self._buffer.data
        try:
            return self._tree.read(path, self._limit)
        except (OSError, TooLarge):
            return None

    def head(self, path: str, length: int) -> bytes:
        """The first *length* bytes of a file; b"" if it is no regular one, or not there."""
        try:
            return read_head(self._others.place(path), length)
        except OSError:
            return b""
