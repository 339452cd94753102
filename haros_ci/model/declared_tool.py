# SPDX-License-Identifier: Apache-2.0
"""A tool that a project file declares: what to start, on which files, and how to read what it writes."""

from __future__ import annotations

from haros_ci.model import globs
from haros_ci.records import dataclass

#: What stands for the files of a batch (a whole argument), for one file, and for the workspace root (anywhere in an argument).
FILES, FILE, ROOT = "{files}", "{file}", "{root}"

OUTPUTS = ("gcc", "regex", "checkstyle", "json", "json-lines", "sarif")
STREAMS = ("stdout", "stderr", "both")
#: What can be read of a finding, by group name in ``pattern`` and by key in ``fields``.
PARTS = ("path", "line", "column", "end-line", "end-column", "rule", "message", "level")


@dataclass(frozen=True, slots=True, kw_only=True)
class DeclaredTool:
    """One entry of ``linters`` with an ``exec`` (docs/declared-tools.md).

    ``argv`` is started without a shell. ``files`` are globs and ``languages`` kinds of files that it is given; ``reads``
    are globs of files that its results depend on besides. ``fields`` and ``levels`` are pairs, ``levels`` from the tool's
    words to ours. ``exits`` are the codes of a run without trouble,
    empty for any. ``origin`` is ``FILE:LINE``.
    """

    name: str
    argv: tuple[str, ...]
    files: tuple[str, ...] = ()
    languages: tuple[str, ...] = ()
    reads: tuple[str, ...] = ()
    output: str = "gcc"
    pattern: str = ""
    fields: tuple[tuple[str, str], ...] = ()
    levels: tuple[tuple[str, str], ...] = ()
    stream: str = "stdout"
    exits: tuple[int, ...] = (0, 1)
    origin: str = ""

    def claims(self, path: str, language: str) -> bool:
        """Whether the file *path* of *language* is one of those to be given to the tool."""
        return language in self.languages or self.names(path)

    def names(self, path: str) -> bool:
        """Whether one of the globs ``files`` matches *path*."""
        return any(globs.matches(glob, path) for glob in self.files)

    def depends_on(self, path: str) -> bool:
        """Whether one of the globs ``reads`` matches *path*."""
        return any(globs.matches(glob, path) for glob in self.reads)
