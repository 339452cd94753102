# SPDX-License-Identifier: Apache-2.0
"""Who owns what is written in a file, as its copyright lines say."""

from __future__ import annotations

import re
from collections.abc import Iterable

from haros_ci.regex import regex

_OWNER = regex(
    r"(?:\bcopyright|\bSPDX-FileCopyrightText)\b[ \t:]*(?=[^\n]{0,60}?(?:\d{4}|\(c\)|©))(?:\(c\)|©)?[ \t]*(?:\d{4}[\d \t,–-]{0,60}(?:present\b)?)?[ \t,]*(?:\(c\)|©)?"
    r"[ \t]*(?:by\b)?[ \t]*([^\n\d<(;,]{3,80})",
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


def owner_lines(head: str) -> list[str]:
    """What each copyright line of *head* has behind the year."""
    return [found[1] for found in _OWNER.finditer(head)]


def owners_in(head: str) -> frozenset[str]:
    """The words that tell the owners of *head*'s copyright lines from others; none where a line has no such word."""
    return owners_of(owner_lines(head))


def owners_of(lines: Iterable[str]) -> frozenset[str]:
    """The same of *lines* as owner_lines() gives them."""
    named = [words(line) - _COMMON for line in lines]
    return frozenset().union(*named) if all(named) else frozenset()


def words(text: str) -> frozenset[str]:
    """The words of *text* of four letters or more, in small letters."""
    return frozenset(word.lower() for word in _WORD.findall(text))
