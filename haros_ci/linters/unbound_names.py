# SPDX-License-Identifier: Apache-2.0
"""Names without a value that a change brings into Python, and that no linter reports: notes, so that somebody looks there."""

from __future__ import annotations

from collections.abc import Iterable
from functools import cached_property

from haros_ci.linters.never_bound import NeverBound, never_bound
from haros_ci.model.workspace import Workspace
from haros_ci.regex import regex
from haros_ci.results.result import Notification
from haros_ci.results.rule import Level

#: Names that are mentioned; the rest is counted.
MOST = 20
#: What can name a function of a module: Python, and what has entry points.
_WORD = regex(r"\w+")
_CALLING = frozenset(("python", "setup", "cmake", "yaml", "xml", "toml", "launch"))


def notifications(head: Workspace, base: Workspace | None) -> tuple[Notification, ...]:
    """A note for each such name of a changed file of *head*, which no file of *base* that changed or is gone has for the same reason."""
    if base is None:
        return ()
    after, before = _Names(head), _Names(base)
    old = {file.digest for file in base.files}
    now = {file.digest for file in head.files}
    found = [
        (file.path, one)
        for file in head.files
        if file.language == "python" and file.digest not in old and not file.third_party and head.reports_on(file.path)
        for one in after.of(file.path)
    ]
    if not found:
        return ()
    gone = [file.path for file in base.files if file.language == "python" and file.digest not in now]
    known = {(one.name, one.why) for path in gone for one in before.of(path)}
    new = [(path, one) for path, one in found if (one.name, one.why) not in known]
    notes = (Notification(Level.NOTE, _message(one), path=path, line=one.line) for path, one in new[:MOST])
    rest = f"since this change {len(new) - MOST} more names have no value where they are used"
    return (*notes, *([Notification(Level.NOTE, rest)] if len(new) > MOST else []))


class _Names:
    """The names without a value of files of a *workspace*, of which each word is known once."""

    def __init__(self, workspace: Workspace) -> None:
        self.workspace = workspace

    def of(self, path: str) -> Iterable[NeverBound]:
        return never_bound(self.workspace.text(path), lambda name: self._words.get(name, path) != path)

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
