# SPDX-License-Identifier: Apache-2.0
"""What stands in files that a change brings, and stood in none that it takes away: for notes on what neither linters nor the model see."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Sequence

from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Workspace
from haros_ci.results.result import Notification
from haros_ci.results.rule import Level

#: What stands in a file: a line, what it is (the same in a file that is gone: it has only moved), and a message.
Found = tuple[int, Hashable, str]
#: A path, a line (None for the whole file) and a message.
Place = tuple[str, int | None, str]


def brought(
    head: Workspace, base: Workspace, look: Callable[[Workspace], Callable[[SourceFile], Iterable[Found]]]
) -> list[Place]:
    """What *look* finds in the files of *head* whose text no file of *base* has, and not in those of *base* whose text is gone.

    *look* is given each workspace once. Files of other projects, and files on which nothing is reported, are not looked at.
    """
    old, now = ({file.digest for file in workspace.files} for workspace in (base, head))
    after = look(head)
    found = [
        (file.path, *one)
        for file in head.files
        if file.digest not in old and not file.third_party and head.reports_on(file.path)
        for one in after(file)
    ]
    if not found:
        return []
    before = look(base)
    known = {what for file in base.files if file.digest not in now for _, what, _ in before(file)}
    return [(path, line, message) for path, line, what, message in found if what not in known]


def notes(places: Sequence[Place], most: int, rest: str) -> tuple[Notification, ...]:
    """A note at each of the first *most* places; one more says how many others there are: *rest* follows their number."""
    shown = tuple(Notification(Level.NOTE, message, path=path, line=line) for path, line, message in places[:most])
    left = len(places) - most
    return (*shown, Notification(Level.NOTE, f"{left} more {rest}")) if left > 0 else shown
