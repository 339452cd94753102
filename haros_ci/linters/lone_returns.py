# SPDX-License-Identifier: Apache-2.0
"""Lines of CMake and of files of data that end in a carriage return alone: for some programs the line ends there, for others it goes on."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

from haros_ci.linters.changed_code import Found, brought, notes
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Workspace
from haros_ci.regex import regex
from haros_ci.results.result import Notification

#: Files that are named; the rest is counted.
MOST = 10
#: Those of C++ and Python have a note of their own (:mod:`seen_otherwise`), or a finding.
_LOOKED_AT = frozenset("cmake dockerfile interface launch package setup shell toml world xml yaml".split())
#: As many returns as there are, with what ends them: looked at once, however many there are.
_RETURNS = regex(r"\r+\n?")


def notifications(head: Workspace, base: Workspace | None) -> tuple[Notification, ...]:
    """A note for each file of *head* with such a line, where *base* has no file with it that changed or is gone; none without a base."""
    if base is None:
        return ()
    rest = "files have lines that end in a carriage return alone, since this change"
    return notes(brought(head, base, _look), MOST, rest)


def _look(workspace: Workspace) -> Callable[[SourceFile], Iterable[Found]]:
    text = "since this change a line ends in a carriage return alone: what stands behind it is another line for some programs, and for others none; look at it"

    def look(file: SourceFile) -> Iterator[Found]:
        at = lone_return(workspace.text(file.path)) if file.language in _LOOKED_AT else None
        if at is not None:
            yield at, file.path.rpartition("/")[2], text

    return look


def lone_return(text: str) -> int | None:
    """The first line of *text* with a carriage return that no line feed follows; one at the very end is none."""
    if "\r" not in text:
        return None
    found = _RETURNS.finditer(text.rstrip("\r"))
    alone = next((match.start() for match in found if not match[0].endswith("\n")), None)
    return None if alone is None else text.count("\n", 0, alone) + 1
