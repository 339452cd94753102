# SPDX-License-Identifier: Apache-2.0
"""What a function of C++ returns by its trailing return type: cppcheck does not look at that of a lambda."""

from __future__ import annotations

import re

from haros_ci.regex import regex
from haros_ci.results.comments import C_SKIPPED

#: Types that copy what a pointer points to when they are made of it: texts and paths of the standard library ([string.cons], [fs.path.construct]), of Boost and Qt.
_TEXT = r"(?:std\s*::\s*(?:pmr\s*::\s*)?(?:w|u8|u16|u32)?string|(?:std\s*::\s*(?:experimental\s*::\s*)?|boost\s*::\s*)filesystem\s*::\s*path|QString|QByteArray)"
_COPIES = regex(rf"(?:const\s+)?(?:::\s*)?(?:{_TEXT}|std\s*::\s*optional\s*<\s*{_TEXT}\s*>)(?:\s+const)?")
_SHORT = regex(r"(?:const\s+)?w?string(?:\s+const)?")
_OF_STD = regex(r"^[ \t]*using[ \t]+(?:namespace[ \t]+std|std[ \t]*::[ \t]*w?string)[ \t]*;", re.MULTILINE)
_TRAILING = regex(
    r"\)\s*(?:(?:mutable|constexpr|consteval|const|noexcept|static)\s*)*->\s*([\w\s:<>*&,\[\]()]{1,200})\Z"
)
_HIDDEN = regex(rf"""["'/](?:{C_SKIPPED})""")
#: What begins a block that is no function: the head of a statement, an ``else``, a label, or nothing.
_STATEMENT = regex(
    r"\A\s*\Z|\b(?:else|do|try)\s*\Z|\A\s*(?:else\s+)?(?:if|for|while|switch|catch)\b.*\)\s*\Z|\A\s*(?:case\b.*|default\s*|\w+\s*):\s*\Z",
    re.DOTALL,
)
_BRANCHES = regex(r"^[ \t]*#[ \t]*(?:else|elif)", re.MULTILINE)
#: Characters before the place that are looked at.
_LONGEST = 20_000
#: Blocks around the place that are looked at.
_MOST_BLOCKS = 64


def copies_what_it_returns(line: int, text: str) -> bool:
    """Whether each ``return`` at *line* of *text* is of a lambda or function whose trailing return type copies what a pointer points to.

    ``[]() -> std::string { …; return buffer.get(); }``: the text is made before the buffer dies. ``std::string_view``, pointers and references view it.
    """
    lines = text.split("\n")
    if not 0 < line <= len(lines):
        return False
    start = len("\n".join(lines[: line - 1])) + (line > 1)
    shown = _HIDDEN.sub(lambda found: re.sub(r"[^\n]", " ", found[0]), text[: start + len(lines[line - 1])])
    places = [start + found.start() for found in re.finditer(r"\breturn\b", shown[start:])] or [start]
    is_short = _OF_STD.search(shown) is not None
    return len(places) <= 8 and all(
        _is_copy(_type(shown[max(place - _LONGEST, 0) : place]), is_short) for place in places
    )


def _is_copy(kind: str, is_short: bool) -> bool:
    return _COPIES.fullmatch(kind) is not None or (is_short and _SHORT.fullmatch(kind) is not None)


def _type(before: str) -> str:
    """The trailing return type of the function whose body is open at the end of *before*; "" without one, or if the text does not say."""
    depth, end, blocks = 0, len(before), 0
    braces = [(found.start(), found[0]) for found in re.finditer(r"[{}]", before)]
    for place, brace in reversed(braces):
        depth += 1 if brace == "}" else -1
        if depth >= 0:
            continue
        depth, blocks = 0, blocks + 1
        head = _head(before[:place])
        trailing = _TRAILING.search(head)
        if trailing is not None:
            return "" if _BRANCHES.search(before, place, end) else trailing[1].strip()
        if blocks == _MOST_BLOCKS or _STATEMENT.search(head) is None:
            return ""
    return ""


def _head(before: str) -> str:
    """What stands before a brace, from the end of the statement or block before it; a semicolon in parentheses ends none."""
    depth = 0
    for found in reversed(list(re.finditer(r"[(){};]", before[-2_000:]))):
        if found[0] in "()":
            depth += 1 if found[0] == ")" else -1
        elif depth <= 0:
            return before[-2_000:][found.end() :]
    return before[-2_000:]
