# SPDX-License-Identifier: Apache-2.0
"""Macros of C++ that make topics, services or timers: the model, which expands no macro of the workspace, does not have what they make."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.linters.macros_elsewhere import DEFINED
from haros_ci.model.workspace import Workspace
from haros_ci.regex import regex
from haros_ci.results.code_alone import code_alone
from haros_ci.results.result import Notification
from haros_ci.results.rule import Level

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
    old = {file.digest for file in base.files}
    now = {file.digest for file in head.files}
    found: list[tuple[str, int, str, str]] = []
    for file in head.files:
        if file.language == "cpp" and file.digest not in old and not file.third_party and head.reports_on(file.path):
            found += ((file.path, line, name, words) for line, name, words in _macros(head.text(file.path)))
    if not found:
        return ()
    gone = (file.path for file in base.files if file.language == "cpp" and file.digest not in now)
    known = {(name, words) for path in gone for _, name, words in _macros(base.text(path))}
    new = [(path, line, name) for path, line, name, words in found if (name, words) not in known]
    text = "makes topics, services or timers, which the model does not have"
    notes = [
        Notification(Level.NOTE, f"since this change the macro {name} {text}; look at it", path=path, line=line)
        for path, line, name in new
    ]
    rest = [
        Notification(Level.NOTE, f"{len(new) - MOST} more macros make topics, services or timers since this change")
    ]
    return (*notes[:MOST], *(rest if len(new) > MOST else []))


def _macros(text: str) -> Iterator[tuple[int, str, str]]:
    """The line, name and words of each such macro."""
    if "define" not in text or _MAKES.search(text) is None:
        return
    code = code_alone(text, "c")
    for match in DEFINED.finditer(code):
        if _MAKES.search(match[2]):
            yield code.count("\n", 0, match.start()) + 1, match[1], "".join(match[2].split())
