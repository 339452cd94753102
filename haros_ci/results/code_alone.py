# SPDX-License-Identifier: Apache-2.0
"""The text of a file without what is no code in it: evidence for or against a finding, which comments and texts are not."""

from __future__ import annotations

import re
from functools import lru_cache

from haros_ci.regex import regex
from haros_ci.results.comments import PATTERNS

_CODE = {kind: regex(PATTERNS[kind], re.MULTILINE) for kind in ("c", "python", "cmake", "shell")}
#: A text of one word is a name or a key at most (``"__main__"``, ``row["x"]``, ``"steps"_a``); code takes more.
_WORD = regex(r"[\w.]*")
_TRIPLE = ('"""', "'''")
_NO_END = regex(r"[^\n]")


@lru_cache(maxsize=8)
def code_alone(text: str, kind: str) -> str:
    """*text* of syntax *kind* (``comments.syntax``) with blanks for comments, and for what stands in texts of more than a word.

    Quotes, lines and columns stay; takes linear time. Another kind is left as it is.
    """
    pattern = _CODE.get(kind)
    return text if pattern is None else pattern.sub(_blank, text)


@lru_cache(maxsize=8)
def without_comments(text: str, kind: str) -> str:
    """*text* of syntax *kind* with blanks for comments alone: names of files and of attributes are texts."""
    pattern = _CODE.get(kind)
    return (
        text
        if pattern is None
        else pattern.sub(lambda found: found[0] if found[0][0] in "\"'" else _blank(found), text)
    )


def _blank(found: re.Match[str]) -> str:
    whole = found[0]
    quote = whole[:3] if whole.startswith(_TRIPLE) else whole[:1]
    if quote[0] not in "\"'":
        return _NO_END.sub(" ", whole)
    is_closed = len(whole) >= 2 * len(quote) and whole.endswith(quote)
    inner = whole[len(quote) : -len(quote)] if is_closed else whole[len(quote) :]
    if _WORD.fullmatch(inner):
        return whole
    return f"{quote}{_NO_END.sub(' ', inner)}{quote if is_closed else ''}"
