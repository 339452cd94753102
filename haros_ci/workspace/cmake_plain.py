# SPDX-License-Identifier: Apache-2.0
"""CMake text in its plainest form, for those who look for names in it: cmake-language(7) has many ways to write one argument."""

from __future__ import annotations

import re

from haros_ci.regex import regex
from haros_ci.workspace.cmake_parse import ParsedCommand, parse_cmake

_GENEX = regex(r"\$<[\w.,-]{0,80}:?|[<>\"();]")
_ESCAPE = regex(r"\\(?:\r?\n|(.))", re.DOTALL)


def spelled_out(text: str) -> str:
    """The commands of *text*, one a line, without comments, brackets, quotes, escapes and generator expressions, which leave a blank; takes linear time."""
    lines: list[str] = []
    pending = list(reversed(parse_cmake(text).commands))
    while pending:
        command = pending.pop()
        lines.append(_line(command))
        for opener, body in reversed(command.branches):
            pending += reversed(body)
            if opener is not command:
                lines.append(_line(opener))
    return "\n".join(lines)


def _line(command: ParsedCommand) -> str:
    words = (
        argument.text if argument.is_literal or argument.is_plain else _ESCAPE.sub(r"\1", argument.text)
        for argument in command.arguments
    )
    return f"{command.name}({' '.join(' '.join(_GENEX.sub(' ', word).split()) for word in words)})"
