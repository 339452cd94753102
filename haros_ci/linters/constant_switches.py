# SPDX-License-Identifier: Apache-2.0
"""Conditions of C++ on switches that are set by hand: ``bool smooth = true;``, which nothing sets again."""

from __future__ import annotations

import re

from haros_ci.regex import regex
from haros_ci.results.scope import scopes

_IF = regex(r"\bif\s*(?:constexpr\s*)?\(")
_NAME = regex(r"(?<![\w.>:])[A-Za-z_]\w*(?!\w|\s*(?:\(|\.|->|::|\[))")
_COMMENT = regex(r"//[^\n]*|/\*.*?(?:\*/|\Z)", re.DOTALL)
_WORDS = frozenset(("true", "false", "not", "and", "or"))
#: Lines that a condition may have, and names in it.
_LINES = 6
_MOST = 8


def is_switched_by_hand(line: int, text: str) -> bool:
    """Whether the ``if`` at *line* asks switches alone, which the same function sets once, to a constant."""
    names = _names(line, text)
    inside = scopes(text, "cpp")
    here = inside.at(line)
    lines = text.split("\n")
    own = "\n".join("" if inside.at(number) != here else item for number, item in enumerate(lines, start=1))
    plain = _COMMENT.sub(lambda match: re.sub(r"[^\n]", " ", match[0]), own)
    return bool(names) and bool(here) and all(_is_constant(name, plain) for name in names)


def _names(line: int, text: str) -> list[str]:
    """The names in the condition at *line*; none where something else is in it: a call, a member, an element, a number."""
    lines = text.split("\n")
    start = "\n".join(lines[max(line - 1, 0) : line - 1 + _LINES]) if 0 < line <= len(lines) else ""
    opened = _IF.search(start)
    if opened is None:
        return []
    depth, end = 1, 0
    for bracket in re.finditer(r"[()]", start[opened.end() :]):
        depth += 1 if bracket[0] == "(" else -1
        if depth == 0:
            end = bracket.start()
            break
    condition = start[opened.end() :][:end]
    names = [name for name in _NAME.findall(condition) if name not in _WORDS]
    rest = _NAME.sub("", condition)
    return names if len(names) <= _MOST and re.fullmatch(r"[\s!&|()=]*", rest) else []


def _is_constant(name: str, text: str) -> bool:
    """Whether *text* defines *name* as a truth value, once, and neither sets it again nor hands it out to be set."""
    value = r"(?:=\s*(?:true|false)|\{\s*(?:true|false)\s*\}|\(\s*(?:true|false)\s*\))\s*[;,]"
    defined = re.findall(rf"\bbool\s+(?:const\s+)?{name}\s*{value}", text)
    assigned = re.findall(
        rf"(?<![\w.>:]){name}\s*(?:[|&^]?=(?!=)|[{{])|(?:>>|\bref\s*\(|(?<!&)&(?!&))\s*{name}\b", text
    )
    if len(defined) != 1:
        return False
    passed = re.search(rf"\b(?!if\b|while\b)\w+\s*\((?:[^();]*,)?\s*{name}\s*[,)]", text)
    is_const = re.search(rf"\bconst(?:expr)?\s+bool\s+{name}\b|\bbool\s+const\s+{name}\b", text) is not None
    return is_const or (len(assigned) <= (0 if defined[0].startswith("(") else 1) and passed is None)
