# SPDX-License-Identifier: Apache-2.0
"""Names of the workspace in generated Python as identifiers: of ASCII letters, digits and underscores alone."""

from __future__ import annotations

from haros_ci.regex import regex

#: Characters of an identifier that come of a name.
LONGEST = 60
_OTHER = regex(r"[^A-Za-z0-9]+")


def identifier(text: str, taken: set[str] | None = None) -> str:
    """*text* as a part of an identifier; with *taken* one that is not among them yet, which is added."""
    made = _OTHER.sub("_", text)[:LONGEST].strip("_").lower() or "x"
    if taken is None:
        return made
    found, number = made, 1
    while found in taken:
        number += 1
        found = f"{made}_{number}"
    taken.add(found)
    return found
