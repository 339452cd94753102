# SPDX-License-Identifier: Apache-2.0
"""The settings files of linters where a part of the tree is analysed (``Workspace.settings``)."""

from __future__ import annotations

from pathlib import Path

from haros_ci.model.workspace import Reader
from haros_ci.workspace.files import FileTree, TooLarge, decode, read_head
from haros_ci.workspace.selection import AnalysedPaths


class SettingsAround:
    """Reads what is listed with *listed*, and on disk files that lie outside the *scope* of the run (``model.workspace.Reader``).

    A run on a part of the tree so finds the settings that lie above it, and what these refer to. No symbolic link is followed.
    """

    def __init__(self, root: Path, scope: AnalysedPaths, limit: int, listed: Reader) -> None:
        self._root, self._scope, self._limit, self._listed = FileTree(root), scope, limit, listed
        self._data: dict[str, bytes | None] = {}

    def text(self, path: str) -> str:
        """The decoded text of the file at *path*; "" if it is not there or not text."""
        if (text := self._listed.text(path)) or not self._is_around(path):
            return text
        data = self.data(path) or b""
        return "" if b"\0" in data else decode(data)

    def data(self, path: str) -> bytes | None:
        """The bytes of the file at *path*; None if it is not there, too large or no regular file."""
        if not self._is_around(path):
            return self._listed.data(path)
        if path not in self._data:
            try:
                self._data[path] = self._root.read(path, self._limit)
            except (OSError, TooLarge, ValueError):
                self._data[path] = None
        return self._data[path]

    def head(self, path: str, length: int) -> bytes:
        """The first *length* bytes; b"" if there is no such file."""
        if not self._is_around(path):
            return self._listed.head(path, length)
        try:
            return read_head(self._root.place(path), length)
        except (OSError, ValueError):
            return b""

    def _is_around(self, path: str) -> bool:
        parts = path.split("/")
        inside = not any(part in ("", ".", "..") or part.lower() == ".git" for part in parts)
        return inside and self._scope.given(path.rpartition("/")[0] or ".") is None
