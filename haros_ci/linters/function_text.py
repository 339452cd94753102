# SPDX-License-Identifier: Apache-2.0
"""The function of C++ that a line is in."""

from __future__ import annotations

from haros_ci.results.scope import scopes


def function_text(line: int, text: str) -> str:
    """The text of the function around *line*, with its head; "" outside of any."""
    inside = scopes(text, "cpp")
    name, lines = inside.at(line), text.split("\n")
    first, last = line, line
    while name and first > 1 and inside.at(first - 1) == name:
        first -= 1
    while name and last < len(lines) and inside.at(last + 1) == name:
        last += 1
    return "\n".join(lines[first - 1 : last]) if name else ""
