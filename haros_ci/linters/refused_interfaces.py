# SPDX-License-Identifier: Apache-2.0
"""Interfaces of ROS 2 that rosidl refuses: names in the wrong form, and names that stand twice. Nothing of their package is built then.

The forms are those of rosidl_adapter (``rosidl_adapter/parser.py``, ``VALID_*_PATTERN``); ROS 1 takes most of them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

from haros_ci.linters.changed_code import Found, Place, brought, notes
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
    places = sorted({*_names(head, base), *brought(head, base, _look)}, key=lambda place: (place[0], place[1] or 0))
    return notes(places, MOST, "names of interfaces are refused by rosidl, since this change")


def _names(head: Workspace, base: Workspace) -> Iterator[Place]:
    """The files of *head* under a name that rosidl refuses, which *base* has no file of: their text may be that of another one."""
    old = {file.path.rpartition("/")[2] for file in base.files}
    ros2 = _of_ros2(head)
    for file in head.files:
        name = file.path.rpartition("/")[2]
        is_looked_at = file.package in ros2 and not file.third_party and head.reports_on(file.path)
        if file.language == "interface" and is_looked_at and name not in old and is_refused(file.path):
            words = f"the name {name.rpartition('.')[0]} of an interface, which has to be written as in 'BatteryState'"
            yield file.path, 1, _message(words)


def _of_ros2(workspace: Workspace) -> frozenset[str]:
    return frozenset(package.name for package in workspace.packages if package.ros == 2)


def _message(words: str) -> str:
    return f"since this change rosidl refuses {words}: a package that generates code of it is not built"


def _look(workspace: Workspace) -> Callable[[SourceFile], Iterable[Found]]:
    ros2 = _of_ros2(workspace)

    def look(file: SourceFile) -> Iterator[Found]:
        if file.language == "interface" and file.package in ros2:
            for line, words in refused(file.path, workspace.text(file.path)):
                yield line, (file.path.rpartition("/")[2], words), _message(words)

    return look


def is_refused(path: str) -> bool:
    """Whether rosidl refuses the name of the definition at *path*."""
    folder, _, name = path.rpartition("/")
    stem, _, kind = name.rpartition(".")
    return folder.rpartition("/")[2] in _DIRECTORIES and kind in _DIRECTORIES and _NAME.fullmatch(stem) is None


def refused(path: str, text: str) -> Iterator[tuple[int, str]]:
    """The lines and names of fields and constants of the definition at *path* that rosidl refuses, in words; takes linear time."""
    if path.rpartition("/")[0].rpartition("/")[2] not in _DIRECTORIES:
        return
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
