# SPDX-License-Identifier: Apache-2.0
"""Interfaces of ROS 2 that rosidl refuses: names in the wrong form, and names that stand twice. Nothing of their package is built then.

The forms are those of rosidl_adapter (``rosidl_adapter/parser.py``, ``VALID_*_PATTERN``); ROS 1 takes most of them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

from haros_ci.linters.changed_code import Found, brought, notes
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Workspace
from haros_ci.regex import regex
from haros_ci.results.result import Notification

#: Names that are mentioned; the rest is counted. Lines that are looked at.
MOST = 20
_MOST_LINES = 5_000
_DIRECTORIES = ("msg", "srv", "action")
_FIELD = regex(r"[a-z](?:_?[a-z0-9])*")
_CONSTANT = regex(r"[A-Z](?:_?[A-Z0-9])*")
_NAME = regex(r"[A-Z][A-Za-z0-9]*")
_LINE = regex(r"(?:<=|[^\s#=])+[ \t]+([A-Za-z]\w*)[ \t]*(=?)")
_BREAK = regex(r"\r\n|\n|\r")


def notifications(head: Workspace, base: Workspace | None) -> tuple[Notification, ...]:
    """A note for each such name of *head* that no file of *base* which changed or is gone has; none without a base."""
    if base is None:
        return ()
    return notes(brought(head, base, _look), MOST, "names of interfaces are refused by rosidl, since this change")


def _look(workspace: Workspace) -> Callable[[SourceFile], Iterable[Found]]:
    ros2 = {package.name for package in workspace.packages if package.ros == 2}

    def look(file: SourceFile) -> Iterator[Found]:
        if file.language == "interface" and file.package in ros2:
            for line, words in refused(file.path, workspace.text(file.path)):
                yield (
                    line,
                    (file.path.rpartition("/")[2], words),
                    f"since this change rosidl refuses {words}: a package that generates code of it is not built",
                )

    return look


def refused(path: str, text: str) -> Iterator[tuple[int, str]]:
    """The lines and names of the definition at *path* that rosidl refuses, in words; takes linear time."""
    folder, _, name = path.rpartition("/")
    stem, _, kind = name.rpartition(".")
    if folder.rpartition("/")[2] not in _DIRECTORIES or kind not in _DIRECTORIES:
        return
    if _NAME.fullmatch(stem) is None:
        yield 1, f"the name {stem} of an interface, which has to be written as in 'BatteryState'"
    fields: set[str] = set()
    constants: set[str] = set()
    for number, line in enumerate(_BREAK.split(text)[:_MOST_LINES], start=1):
        bare = line.strip()
        if bare.startswith("---"):
            fields, constants = set(), set()
            continue
        match = _LINE.match(bare) if not bare.startswith(("#", "@")) else None
        if match is None:
            continue
        word, known, form = match[1], fields, _FIELD
        if match[2]:
            known, form = constants, _CONSTANT
        if form.fullmatch(word) is None:
            example = "'MAX_SPEED'" if match[2] else "'max_speed'"
            yield (
                number,
                f"the name {word} of a {'constant' if match[2] else 'field'}, which has to be written as in {example}",
            )
        elif word in known:
            yield number, f"the name {word}, which stands twice"
        known.add(word)
