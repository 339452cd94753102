# SPDX-License-Identifier: Apache-2.0
"""Files that somebody else has written: their first comment has a copyright line of an owner whom no manifest of the workspace names."""

from __future__ import annotations

import re

from haros_ci.regex import regex

#: Characters of a file that are looked at.
_MOST = 8_192
#: The first comments, of XML, or of Python and YAML.
_HEAD = regex(r"\s*(?:<\?xml[^>\n]{0,200}\?>\s*)?(<!--.*?-->|#[^\n]*(?:\n[ \t]*#[^\n]*)*)", re.DOTALL)
_OWNER = regex(
    r"\bcopyright\b[ \t:]*(?:\(c\)|©)?[ \t]*\d{4}[\d \t,–-]{0,60}(?:\(c\)|©)?[ \t]*(?:by\b)?[ \t]*([^\n\d<(;]{3,80})",
    re.IGNORECASE,
)
_WORD = regex(r"[^\W\d_]{4,}")
#: Words of an owner that say nothing of who it is.
_COMMON = frozenset(
    """
    rights reserved author authors contributors corporation company incorporated limited gmbh university institute technology
    laboratory laboratories research robotics robot robots open source foundation group team project software developers
    department engineering science school copyright holder holders notice
    """.split()
)


def is_of_others(text: str, people: frozenset[str]) -> bool:
    """Whether the first comment of *text* has copyright lines, each of an owner of whose name no word is in *people*, the words of all manifests."""
    head = _HEAD.match(text[:_MOST].removeprefix("\ufeff"))
    owners = [words(found[1]) - _COMMON for found in _OWNER.finditer(head[1])] if head is not None else []
    return bool(owners) and all(owner and people.isdisjoint(owner) for owner in owners)


def words(text: str) -> frozenset[str]:
    """The words of *text* of four letters or more, in small letters."""
    return frozenset(word.lower() for word in _WORD.findall(text))
