# SPDX-License-Identifier: Apache-2.0
"""Names without a value that a change brings into Python, and that no linter reports: notes, so that somebody looks there."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property

from haros_ci.linters.changed_code import Found, brought, notes
from haros_ci.linters.never_bound import NeverBound, never_bound
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Workspace
from haros_ci.regex import regex
from haros_ci.results.result import Notification

#: Names that are mentioned; the rest is counted.
MOST = 20
#: What can name a function of a module: Python, and what has entry points.
_WORD = regex(r"\w+")
_CALLING = frozenset(("python", "setup", "cmake", "yaml", "xml", "toml", "launch"))


def notifications(head: Workspace, base: Workspace | None) -> tuple[Notification, ...]:
    """A note for each such name of a changed file of *head*, which no file of *base* that changed or is gone has for the same reason."""
    if base is None:
        return ()
    new = brought(head, base, lambda workspace: _Names(workspace).look)
    return notes(new, MOST, "names have no value where they are used, since this change")


class _Names:
    """The names without a value of files of a *workspace*, of which each word is known once."""

    def __init__(self, workspace: Workspace) -> None:
        self.workspace = workspace

    def look(self, file: SourceFile) -> Iterator[Found]:
        path = file.path
        if file.language == "python":
            for one in never_bound(self.workspace.text(path), lambda name: self._words.get(name, path) != path):
                yield one.line, (one.name, one.why), _message(one)

    @cached_property
    def _words(self) -> dict[str, str]:
        """Each word of the files that may call a function, with the one file that has it, or "" for several."""
        found: dict[str, str] = {}
        for file in self.workspace.files:
            if file.language in _CALLING:
                for word in set(_WORD.findall(self.workspace.text(file.path))):
                    found[word] = "" if found.get(word, file.path) != file.path else file.path
        return found


def _message(one: NeverBound) -> str:
    return f"since this change {one.name} has no value where it is used: {one.why} (line {one.bound}); look at it"
