# SPDX-License-Identifier: Apache-2.0
"""Names that the compiler or the linker takes for others: a tool that reads the code alone looks at another function than the one that is called.

By ``__asm__("name")`` behind a declaration (GCC, "Asm Labels"), the attributes ``alias``, ``weakref`` and ``ifunc`` ("Common Function Attributes"),
and ``#pragma weak a = b`` ("Weak Pragmas"). Instructions of an assembler, and registers, are none of these.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.regex import regex
from haros_ci.results.code_alone import code_alone

_ASM = regex(r"\b(?:__asm__|__asm|asm)[ \t\n]{0,20}\(")
_WORDS = regex(r"L?\"[\w.$@]*\"|[A-Za-z_]\w*|#")
_BEHIND = regex(r"\s*(?:[;,={)]|__attribute|\[\[|\Z)")
_REST = regex(r"[ \t;]*(?:\n|\Z)")
_LAST = regex(r"(?:\w+|[^\w\s])\Z")
#: What stands before an instruction, not before the name of what is declared.
_OF_STATEMENTS = frozenset((";", "{", "}", ":", "else", "do", "volatile", "__volatile__", "goto", "inline"))
_CONTROL = regex(r"\b(?:if|for|while|switch|constexpr)\s*\Z")
_REGISTER = regex(r"\bregister\b[^;{}]*\Z")
_NEAR = 400
_ATTRIBUTE = regex(
    r"(?:__attribute__|__attribute)\s*\(\s*\([^;{}]{0,300}?\b(?:__)?(alias|weakref|ifunc)(?:__)?\s*\("
    r"|\[\[[^;{}\]]{0,300}?\b(?:gnu|clang)\s*::\s*(?:__)?(alias|weakref|ifunc)(?:__)?\s*\("
    r"|\[\[\s*using\s+gnu\s*:[^;{}\]]{0,300}?\b(?:__)?(alias|weakref|ifunc)(?:__)?\s*\("
)
_WEAK = regex(r"\bweak\b[ \t(]*([A-Za-z_]\w*)[ \t]*=[ \t]*([A-Za-z_]\w*)")


def linked_names(code: str) -> Iterator[str]:
    """What *code*, without comments and with spliced lines joined, gives another name, in words."""
    if "asm" in code:
        for match in _ASM.finditer(code):
            if words := _label(code, match):
                yield f"what is called {words} for the assembler"
    if "alias" in code or "weakref" in code or "ifunc" in code:
        for found in _ATTRIBUTE.finditer(code_alone(code, "c")):
            yield f"a function with the attribute {found[1] or found[2] or found[3]}"
    if "weak" in code and "ragma" in code:
        for weak in _WEAK.finditer(code):
            line = code[code.rfind("\n", 0, weak.start()) + 1 : weak.start()]
            if "ragma" in line:
                yield f"{weak[1]}, which is {weak[2]} by a pragma,"


def _label(code: str, match: re.Match[str]) -> str:
    """The name that *match* gives what is declared before it; "" for instructions."""
    end = code.find(")", match.end(), match.end() + _NEAR)
    text = code[match.end() : end] if end >= 0 else ""
    if not text.strip() or _WORDS.sub("", text).strip():
        return ""
    line = code[code.rfind("\n", 0, match.start()) + 1 : match.start()]
    is_of_macro = line.lstrip().startswith("#") and _REST.match(code, end + 1) is not None
    if not is_of_macro and _BEHIND.match(code, end + 1) is None:
        return ""
    before = code[max(0, match.start() - _NEAR) : match.start()].rstrip()
    last = _LAST.search(before[-100:])
    if last is None or last[0] in _OF_STATEMENTS or _REGISTER.search(before):
        return ""
    if last[0] == ")" and _CONTROL.search(before[: _opening(before)]):
        return ""
    return " ".join(text.split())


def _opening(text: str) -> int:
    """Where the bracket stands that the last character of *text* closes; 0 without it."""
    depth = 0
    for at in range(len(text) - 1, -1, -1):
        depth += {")": 1, "(": -1}.get(text[at], 0)
        if depth == 0:
            return at
    return 0
