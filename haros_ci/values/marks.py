# SPDX-License-Identifier: Apache-2.0
"""Marks: what stands in a text for a name or value that is given from outside."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from haros_ci.regex import regex

#: What begins and ends a mark; Unicode has no characters there (U+FDD0, U+FDD1).
BEGIN, END = "\ufdd0", "\ufdd1"
#: What the mark of a parameter begins with.
PARAMETER = f"{BEGIN}p"
#: A mark by its key; that of a namespace (s) has the slash that it begins with, and the next one.
_MARKS = regex(f"/?{BEGIN}(s\\d+){END}(/?)|{BEGIN}([np]\\d+){END}")


def keys(text: str) -> Iterator[str]:
    """The keys of the marks in *text*."""
    return (found[1] or found[3] for found in _MARKS.finditer(text)) if BEGIN in text else iter(())


def filled(text: str, texts: Mapping[str, str]) -> str:
    """*text* with what its marks stand for; a mark that *texts* has not stays."""
    if BEGIN not in text:
        return text

    def put(found: re.Match[str]) -> str:
        space, after, other = found.groups()
        known = texts.get(space or other)
        if known is None:
            return found[0]
        return known if known == "/" and after else known + (after or "")

    return _MARKS.sub(put, text)
