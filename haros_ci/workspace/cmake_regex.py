# SPDX-License-Identifier: Apache-2.0
"""CMake's regular expressions (cmake ``string``, Regex Specification), run only where their time is bounded."""

from __future__ import annotations

import re
from functools import lru_cache

from haros_ci.model.digits import whole_number

#: Steps that a search may take at worst: length to the power of the repetitions that can overlap.
MAX_WORK = 5_000_000
MAX_PATTERN = 500


@lru_cache(maxsize=256)
def translated(pattern: str) -> tuple[re.Pattern[str], int] | None:  # noqa: C901 - one branch for each sign of the grammar
    """*pattern* for ``re`` and the power of the length that a search costs; None if it is malformed or not bounded.

    Unlike in ``re``: a backslash only quotes, braces are characters, ``$`` is the very end, a bracket knows no escape.
    A repetition inside a repetition is not bounded.
    """
    if len(pattern) > MAX_PATTERN:
        return None
    out: list[str] = []
    groups: list[bool] = []  # for each open group, whether something in it varies in length
    varies = False
    closed_varies = False
    repetitions = 0
    at, end = 0, len(pattern)
    can_repeat = False
    while at < end:
        character = pattern[at]
        at += 1
        if character in "*+?":
            if not can_repeat or (character != "?" and closed_varies):
                return None
            out.append(character)
            repetitions += character != "?"
            varies = True
            can_repeat = closed_varies = False
            continue
        if character == "(":
            groups.append(varies)
            varies = can_repeat = closed_varies = False
            out.append("(")
            continue
        if character == ")":
            if not groups:
                return None
            closed_varies = varies
            varies = groups.pop() or varies
            out.append(")")
            can_repeat = True
            continue
        closed_varies = False
        can_repeat = character not in "^|"
        if character == "|":
            varies = True
            out.append("|")
        elif character == "^":
            out.append(r"\A")
        elif character == "$":
            out.append(r"\Z")
            can_repeat = False
        elif character == ".":
            out.append(".")
        elif character == "[":
            close = pattern.find("]", at + (2 if pattern[at : at + 1] == "^" else 1))
            if close < 0:
                return None
            inner = pattern[at:close]
            mark = "^" if inner[:1] == "^" else ""
            out.append(f"[{mark}{_bracket(inner[len(mark) :])}]")
            at = close + 1
        elif character == "\\":
            if at >= end:
                return None
            out.append(re.escape(pattern[at]))
            at += 1
        else:
            out.append(re.escape(character))
    if groups:
        return None
    try:
        return re.compile("".join(out), re.DOTALL), repetitions + (pattern[:1] != "^")
    except (re.error, OverflowError, RecursionError):
        return None


def _bracket(inner: str) -> str:
    """The characters and ranges of a bracket; only ``-`` between two means something."""
    found = []
    at = 0
    while at < len(inner):
        if inner[at + 1 : at + 2] == "-" and at + 2 < len(inner) and inner[at] <= inner[at + 2]:
            found.append(f"{re.escape(inner[at])}-{re.escape(inner[at + 2])}")
            at += 3
        else:
            found.append(re.escape(inner[at]))
            at += 1
    return "".join(found)


def work(pattern: str, text: str) -> int:
    """What a search may take, in steps of evaluation; 0 if it is not run."""
    made = translated(pattern)
    cost = 0 if made is None else max(len(text), 2) ** made[1]
    return cost // 2_000 if cost <= MAX_WORK else 0


def usable(pattern: str, text: str) -> re.Pattern[str] | None:
    """The translated pattern, if searching *text* with it is bounded."""
    made = translated(pattern)
    return made[0] if made is not None and max(len(text), 2) ** made[1] <= MAX_WORK else None


def search(pattern: str, text: str) -> tuple[str, ...] | None:
    """The first match and its groups, () if there is none; None if the pattern cannot be used."""
    compiled = usable(pattern, text)
    if compiled is None:
        return None
    match = compiled.search(text)
    return () if match is None else (match[0], *(group or "" for group in match.groups()))


def find_all(pattern: str, text: str) -> list[str] | None:
    """All matches; None if the pattern cannot be used or matches nothing at some place."""
    compiled = usable(pattern, text)
    if compiled is None:
        return None
    found = [match[0] for match in compiled.finditer(text) if match[0] or match.start() < len(text)]
    return found if all(found) else None


def replace(pattern: str, replacement: str, text: str) -> str | None:
    r"""*text* with matches replaced, ``\0`` to ``\9`` in *replacement* standing for groups; None as in find_all."""
    compiled = usable(pattern, text)
    if compiled is None:
        return None
    parts: list[str] = []
    position = 0
    for match in compiled.finditer(text):
        if not match[0]:
            if match.start() == len(text):
                break
            return None
        parts += [text[position : match.start()], _filled(replacement, match)]
        position = match.end()
    return "".join([*parts, text[position:]])


def _filled(replacement: str, match: re.Match[str]) -> str:
    """*replacement* with the groups of *match* in it."""

    def group(reference: re.Match[str]) -> str:
        character = reference[1]
        index = whole_number(character)
        if index is not None:
            return (match[index] or "") if index <= match.re.groups else ""
        return "\n" if character == "n" else character

    return re.sub(r"\\(.)", group, replacement)
