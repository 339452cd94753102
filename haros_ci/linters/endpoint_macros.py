# SPDX-License-Identifier: Apache-2.0
"""Macros of C++ that make topics, services or timers: the model, which expands no macro of the workspace, does not have what they make."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

from haros_ci.linters.changed_code import Found, brought, notes
from haros_ci.linters.macros_elsewhere import DEFINED
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Workspace
from haros_ci.regex import regex
from haros_ci.results.code_alone import code_alone
from haros_ci.results.result import Notification

#: Macros that are named; the rest is counted.
MOST = 10
#: What makes them, of rclcpp and roscpp.
_MAKES = regex(
    r"\b(create_(?:publisher|subscription|service|client|wall_timer|timer)|advertise(?:Service)?|subscribe|serviceClient|createTimer|createWallTimer)\b"
)


def notifications(head: Workspace, base: Workspace | None) -> tuple[Notification, ...]:
    """A note for each such macro of *head* that no file of *base* has in the same words; none without a base."""
    if base is None:
        return ()
    return notes(brought(head, base, _look), MOST, "macros make topics, services or timers since this change")


def _look(workspace: Workspace) -> Callable[[SourceFile], Iterable[Found]]:
    text = "makes topics, services or timers, which the model does not have"

    def look(file: SourceFile) -> Iterator[Found]:
        for line, name, words in _macros(workspace.text(file.path)) if file.language == "cpp" else ():
            yield line, (name, words), f"since this change the macro {name} {text}; look at it"

    return look


def _macros(text: str) -> Iterator[tuple[int, str, str]]:
    """The line, name and words of each such macro."""
    if "define" not in text or _MAKES.search(text) is None:
        return
    code = code_alone(text, "c")
    for match in DEFINED.finditer(code):
        if _MAKES.search(match[2]):
            yield code.count("\n", 0, match.start()) + 1, match[1], "".join(match[2].split())
