# SPDX-License-Identifier: Apache-2.0
"""Where a CMakeLists.txt ends before its last command, whatever is configured: what stands behind is not run, nor looked at."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from haros_ci.regex import regex
from haros_ci.workspace.build_steps import BuildStep
from haros_ci.workspace.cmake_parse import ParsedCommand, parse_cmake

_TRUE = regex(r"(?:TRUE|ON|YES|Y|1|NOT (?:FALSE|OFF|NO|N|0))", re.I)
#: Conditions that stand in one another deeper than this are not looked into.
_DEEPEST = 20
#: What makes or installs something; without one of these nothing is lost.
_MAKES = regex(
    r"install|catkin_install_python|ament_package|ament_auto_package|catkin_package|add_(?:executable|library)|\w+_(?:register|generate|install|export)\w*|\w+_add_(?:library|executable)"
)


def early_end(text: str) -> BuildStep | None:
    """The first ``return()`` of *text* that always ends it, under no condition or one that always holds, with something behind it that makes or installs."""
    body = parse_cmake(text).commands
    at, line = _leaving(body, 0)
    lost = [name for name in _names(body[at + 1 :]) if _MAKES.fullmatch(name)] if line else []
    if not lost:
        return None
    names = [f"{name}()" for name in dict.fromkeys(lost)]
    more = f" and {len(names) - 3} more" if len(names) > 3 else ""
    are = "is" if len(names) == 1 else "are"
    effect = f"always ends the file: {', '.join(names[:3])}{more} behind it {are} not run, and not looked at"
    return BuildStep(line, "return()", True, effect)


def _leaving(body: Sequence[ParsedCommand], depth: int) -> tuple[int, int]:
    """The number of the command of *body* behind which nothing is run, and the line of the ``return()``; 0 as the line if there is none."""
    for number, command in enumerate(body):
        if command.name == "return":
            return number, command.line
        if command.name == "if" and depth < _DEEPEST:
            opener, inner = command.branches[0]
            ends = [_leaving(part, depth + 1)[1] for _, part in command.branches]
            is_sure = _TRUE.fullmatch(" ".join(argument.text for argument in opener.arguments)) is not None
            is_of_all = all(ends) and command.branches[-1][0].name == "else"
            if ends[0] and (is_sure or is_of_all):
                return number, ends[0]
    return len(body), 0


def _names(body: Sequence[ParsedCommand]) -> Iterator[str]:
    pending = list(reversed(body))
    while pending:
        command = pending.pop()
        yield command.name
        for _, inner in reversed(command.branches):
            pending += reversed(inner)
