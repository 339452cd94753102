# SPDX-License-Identifier: Apache-2.0
"""Statements of firmware that cppcheck calls redundant or wrong: reads of device registers, and symbols of the linker's script."""

from __future__ import annotations

import re

from haros_ci.regex import regex

OF_FIRMWARE = frozenset({"constStatement", "comparePointers", "subtractPointers"})
#: ``i2c->SR2;``: members that CMSIS and makers' headers declare volatile; to read them changes what the device does.
_REGISTER = regex(
    r"[ \t]*(?:\([ \t]*void[ \t]*\)[ \t]*)?\(?[A-Za-z_]\w{0,80}\)?(?:\[[^\]\n]{0,80}\])?(?:(?:->|\.)\w{1,80}){0,4}->[A-Z][A-Z0-9_]{0,80}"
    r"(?:\[[^\]\n]{0,80}\])?(?:\.\w{1,80}){0,2}[ \t]*;"
)
_NAME = regex(r"(?<![\w.>])[A-Za-z_]\w{0,80}")
_LONGEST = 1000
_EXTERN = regex(r"^[ \t]*extern\b[^;(){}]{1,400};", re.MULTILINE)
#: A declaration of the file's own, which hides a symbol: ``int one[2]``, ``char * one =``.
_OWN = r"\b(?!return\b|else\b|case\b|goto\b|new\b|delete\b|sizeof\b)[A-Za-z_]\w*[ \t*&]+{name}[ \t]*[\[=;,({{)]"
#: Words of a declaration that are no names of symbols.
_TYPES = frozenset("extern const volatile unsigned signed char short int long float double void struct".split())
_TYPES |= {f"{sign}int{size}_t" for sign in ("", "u") for size in (8, 16, 32, 64)}


def is_of_firmware(rule: str, line: str, text: str) -> bool:
    """Whether *line* of *text* reads a register for its effect, or compares addresses that a linker's script gives.

    The symbols of a script are declared ``extern``; which of them belong to one region is not known in C.
    """
    line = line[:_LONGEST]
    if rule == "constStatement":
        return _REGISTER.match(line) is not None
    names = set(_NAME.findall(line))
    declared = (match[0] for match in _EXTERN.finditer(text))
    symbols = {name for declaration in declared for name in names & set(_NAME.findall(declaration)) - _TYPES}
    rest = _EXTERN.sub("", text)
    return any(re.search(_OWN.format(name=name), rest) is None for name in symbols)
