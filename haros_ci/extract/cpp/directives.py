# SPDX-License-Identifier: Apache-2.0
"""The lines of the preprocessor that decide which other lines a build compiles."""

from __future__ import annotations

import re

from haros_ci.extract.cpp import blanks
from haros_ci.regex import regex
from haros_ci.syntax import Directive

_LINE = regex(
    r"^[ \t]*#[ \t]*(define|undef|include|ifdef|ifndef|if|elifdef|elifndef|elif|else|endif|pragma)\b((?:[^\n\\]|\\.)*)",
    re.MULTILINE | re.DOTALL,
)
_CONTINUED = regex(r"\\\r?\n")
#: A file with more of them has none that count, and a longer one is cut: no condition is understood that is cut.
MOST, LONGEST = 2000, 1000


def found(text: str) -> tuple[Directive, ...]:
    """The directives of *text*, which is free of comments, in their order."""
    if "#" not in text:
        return ()
    directives: list[Directive] = []
    line, counted = 1, 0
    for match in _LINE.finditer(blanks.skeleton(text)):
        word = match[1]
        whole = " ".join(_CONTINUED.sub(" ", text[match.start(2) : match.end(2)][: LONGEST + 1]).split())
        if word == "pragma" and whole != "once":
            continue
        line += text.count("\n", counted, match.start(1))
        counted = match.start(1)
        directives.append(Directive(line, word, whole))
        if len(directives) > MOST:
            return (Directive(1, "lost", ""),)
    return tuple(directives)
