# SPDX-License-Identifier: Apache-2.0
"""Members of which cppcheck says that they are initialized by themselves."""

from __future__ import annotations

import re

from haros_ci.linters.brackets import CLOSING, OPENING, opening_of
from haros_ci.regex import regex

#: ``Member variable 'frame' is initialized by itself.``
_SUBJECT = regex(r"'(\w+)'")
#: Characters before an initializer in which its constructor's parameters are looked for, and of the line.
_LONGEST = 4_000
_SPACE = " \t\r\n"
#: What may stand between the parameters and the colon: ``noexcept(false)``.
_BEHIND = regex(r"(?:noexcept|requires|explicit|__attribute__|try)\s*$")


def self_initialized_line(message: str, line: int, text: str) -> int:
    """The line of the initializer that *message* names; cppcheck gives the place of what stands before it."""
    name = _SUBJECT.search(message)
    lines = text.split("\n")
    if name and 0 < line < len(lines):
        initializer = _initializer(name[1])
        if not initializer.search(lines[line - 1]) and initializer.search(lines[line]):
            return line + 1
    return line


def is_of_parameter(message: str, line: int, text: str) -> bool:
    """Whether the constructor has a parameter of the member's name, which is what the initializer takes ([class.base.init] of the standard).

    cppcheck does not see one in a macro, or of a declaration that it does not match with the definition. *text* is without comments.
    """
    name = _SUBJECT.search(message)
    if name is None:
        return False
    right = self_initialized_line(message, line, text)
    lines = text.split("\n")
    found = _initializer(name[1]).search(lines[right - 1]) if 0 < right <= len(lines) else None
    if found is None:
        return False
    before = "\n".join((*lines[: right - 1], lines[right - 1][: found.start()]))[-_LONGEST:]
    parameters = _parameters(before)
    return parameters is not None and re.search(rf"\b{name[1]}\s*(?:=|,|\[|\)|$)", parameters) is not None


def _initializer(name: str) -> re.Pattern[str]:
    return re.compile(rf"\b{name}\s*[({{]\s*{name}\b")


def _parameters(before: str) -> str | None:
    """The parameters of the constructor whose list of initializers *before* ends in; None if there is none."""
    at = len(before) - 1
    while at >= 0:
        character = before[at]
        if character in CLOSING:
            at = opening_of(before, at) - 1
        elif character == ":" and before[at - 1 : at] != ":" and before[at + 1 : at + 2] != ":":
            return _before_colon(before[:at])
        elif character in ";" + OPENING:
            return None
        else:
            at -= 1
    return None


def _before_colon(head: str) -> str | None:
    head = head.rstrip(_SPACE)
    while head.endswith(")"):
        start = opening_of(head, len(head) - 1)
        if start < 0:
            return None
        rest = head[:start].rstrip(_SPACE)
        if not _BEHIND.search(rest[-40:]):
            return head[start + 1 : -1]
        head = _BEHIND.sub("", rest).rstrip(_SPACE)
    bare = re.sub(r"\b(?:noexcept|try)$", "", head).rstrip(_SPACE)
    return _before_colon(bare) if bare != head else None
