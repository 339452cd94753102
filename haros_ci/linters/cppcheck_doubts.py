# SPDX-License-Identifier: Apache-2.0
"""Findings of cppcheck that the text around them refutes."""

from __future__ import annotations

import re

#: A literal of the user's own that takes a default, as pybind11's arguments do: ``"steps"_a = false``.
_NAMED_ARGUMENT = re.compile(r"\"_[A-Za-z]\w*[ \t]*=(?!=)")
_OF_LITERALS = frozenset({"assignBoolToPointer", "selfAssignment", "AssignmentIntegerToAddress", "stringLiteralWrite"})
_QUOTED_NAME = re.compile(r"'(\w+)'")


def is_refuted(rule: str, message: str, line: int, text: str) -> bool:
    """Whether the *text* refutes what cppcheck says by *rule* at *line*, counted from 1.

    Cppcheck 2.22 takes a string with a suffix for a pointer, and does not see that a ``case`` reads the constant that
    is its label.
    """
    if rule in _OF_LITERALS:
        lines = text.split("\n")
        return 0 < line <= len(lines) and _NAMED_ARGUMENT.search(lines[line - 1]) is not None
    name = _QUOTED_NAME.search(message) if rule == "unreadVariable" else None
    return name is not None and re.search(rf"\bcase\s[^:;{{}}]{{0,200}}\b{name[1]}\b", text) is not None
