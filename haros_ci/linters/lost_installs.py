# SPDX-License-Identifier: Apache-2.0
"""Installations of CMake that a usual build leaves out: ``EXCLUDE_FROM_ALL``, or ``CONFIGURATIONS`` for some types of build alone. They are read as if they were made."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

from haros_ci.linters.changed_code import Found, brought, notes
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Workspace
from haros_ci.regex import regex
from haros_ci.results.code_alone import code_alone
from haros_ci.results.result import Notification

#: Commands that are named; the rest is counted.
MOST = 10
_INSTALL = regex(r"(?<!\w)[iI][nN][sS][tT][aA][lL][lL][ \t]*\(([^()]{1,8000})\)")
#: The types of build that packages of ROS are built as; without one that is empty (``colcon build``).
_USUAL = frozenset(("Release", "RelWithDebInfo", "Debug", "MinSizeRel", "None", '""'))
_LEAST = 3


def notifications(head: Workspace, base: Workspace | None) -> tuple[Notification, ...]:
    """A note for each such command of *head* that no file of *base* which changed or is gone has; none without a base."""
    if base is None:
        return ()
    return notes(brought(head, base, _look), MOST, "commands install what a usual build leaves out, since this change")


def _look(workspace: Workspace) -> Callable[[SourceFile], Iterable[Found]]:
    def look(file: SourceFile) -> Iterator[Found]:
        for line, what, words in lost_installs(workspace.text(file.path)) if file.language == "cmake" else ():
            yield (
                line,
                (what, words),
                f"since this change install() has {what}: a usual build may not install it; look at it",
            )

    return look


def lost_installs(text: str) -> Iterator[tuple[int, str, str]]:
    """The line of each such command, why a build leaves it out, and its words; takes linear time."""
    if "EXCLUDE_FROM_ALL" not in text and "CONFIGURATIONS" not in text:
        return
    code = code_alone(text, "cmake")
    for match in _INSTALL.finditer(code):
        words = match[1].split()
        what = "EXCLUDE_FROM_ALL" if "EXCLUDE_FROM_ALL" in words else ""
        if "CONFIGURATIONS" in words:
            types = words[words.index("CONFIGURATIONS") + 1 :]
            what = what or ("" if len(_USUAL.intersection(types)) >= _LEAST else "CONFIGURATIONS")
        if what:
            yield code.count("\n", 0, match.start()) + 1, what, " ".join(words)
