# SPDX-License-Identifier: Apache-2.0
"""The settings files of linters as they are in a commit (``Workspace.settings``)."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path

from haros_ci.model.workspace import Reader
from haros_ci.workspace.assemble import Content
from haros_ci.workspace.files import TextReader, decode
from haros_ci.workspace.git import GitError
from haros_ci.workspace.objects import Blob, read_blobs
from haros_ci.workspace.selection import CandidatePath
from haros_ci.workspace.tool_settings import TOOL_SETTINGS

#: Bytes of settings files that are read ahead, in one go.
MOST_AHEAD = 8_000_000


def no_settings(root: Path) -> Reader:
    """What reads nothing: for a run whose base revision cannot be had."""
    return TextReader(root, (), 0)


class BaseSettings:
    """Reads files of a commit, for what is in the work tree does not count (``model.workspace.Reader``).

    *repository* is the directory of the repository relative to the root, with a slash ("" for the root): what lies outside is
    no part of any change, and is read with *present*. Files that lie in *directories* and are known to hold
    settings are read at once, others when they are asked for. GitError if git lacks one of the former.
    """

    def __init__(
        self, tree: Mapping[str, Blob], directories: Iterable[str], limit: int, present: Reader, repository: str = ""
    ) -> None:
        self._tree = dict(tree)
        self._limit = limit
        self._present = present
        self._repository = repository
        self._data: dict[str, bytes | None] = {}
        self._texts: dict[str, str] = {}
        self._read_ahead(directories)

    def text(self, path: str) -> str:
        """The decoded text of the file at *path* in the commit; "" if it is not there or not text."""
        if not path.startswith(self._repository):
            return self._present.text(path)
        if path not in self._tree:
            return ""
        if path not in self._texts:
            data = self.data(path) or b""
            self._texts[path] = "" if b"\0" in data else decode(data)
        return self._texts[path]

    def data(self, path: str) -> bytes | None:
        """The bytes of the file at *path* in the commit; None if it is not there, too large or cannot be had."""
        if not path.startswith(self._repository):
            return self._present.data(path)
        if path in self._tree and path not in self._data:
            try:
                self._read([path])
            except GitError:
                self._data[path] = None
        return self._data.get(path)

    def head(self, path: str, length: int) -> bytes:
        """The first *length* bytes; b"" if there is no such file."""
        return (self.data(path) or b"")[:length]

    def _read_ahead(self, directories: Iterable[str]) -> None:
        size, paths = 0, []
        for directory in sorted(directories):
            for name in TOOL_SETTINGS:
                path = f"{directory}/{name}" if directory else name
                if path in self._tree and (size := size + self._tree[path].size) <= MOST_AHEAD:
                    paths.append(path)
        if paths:
            self._read(paths)

    def _read(self, paths: list[str]) -> None:
        self._data |= dict.fromkeys(paths)
        for content in read_blobs(self._tree, [CandidatePath(path, "setup") for path in paths], self._limit):
            if isinstance(content, Content):
                self._data[content.path] = content.data
