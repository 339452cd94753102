# SPDX-License-Identifier: Apache-2.0
"""Negative indices of which cppcheck assumes what the code before them rules out."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable

from haros_ci.regex import regex

#: A place that leads to a finding: its file, its line from 1, and what cppcheck says of it.
Step = tuple[str, int, str]

OF_INDICES = frozenset({"negativeContainerIndex", "negativeIndex"})
_UNSET = regex(r"Assignment '(\w{1,100})=-1', assigned value is -1")
_LOOP = regex(r"\b(?:for|while)\s*\(")
_HIDDEN = regex(r"//[^\n]*|\"(?:[^\"\\\n]|\\.){0,1000}\"")
#: The start of a search, as large or as small as the type has it; ``numeric_limits<double>::min()`` is a small positive number.
_LARGEST = (
    r"(?:std\s*::\s*)?numeric_limits\s*<[^<>;]{1,60}>\s*::\s*(?:max|infinity)\s*\(\s*\)|\b(?:DBL|FLT|LDBL|U?INT|U?LONG|U?LLONG)_MAX\b"
    r"|\bINFINITY\b|\bHUGE_VAL[FL]?\b|\b1(?:\.0*)?[eE]\+?\d{2,3}\b|\b9{5,}(?:\.\d*)?\b"
)
_SMALLEST = rf"-\s*(?:{_LARGEST})|(?:std\s*::\s*)?numeric_limits\s*<[^<>;]{{1,60}}>\s*::\s*lowest\s*\(\s*\)|\b(?:INT|LONG|LLONG)_MIN\b"
#: One side of a comparison, brackets in brackets included.
_SIDE = r"((?:[^;{}<>=&|()]|\((?:[^;{}<>=&|()]|\([^;{}<>=&|()]{0,100}\)){0,100}\)){1,200}?)"
_COMPARISON = regex(rf"\bif\s*\(\s*{_SIDE}\s*([<>])=?\s*{_SIDE}\s*\)")
_BLANKS = regex(r"\s+")
_LONGEST = 300
#: How far above its use a bound is set, and how long a search is, in lines.
_ABOVE, _SEARCH = 10, 40
#: Lines above a finding in which a condition may stand.
_CONDITION = 12


def is_searched(steps: Iterable[Step], text: Callable[[str], str]) -> bool:
    """Whether the index is -1 only where a search for the least or the greatest value has found none: where there is nothing to search, or only what is no number.

    ``int best = -1; double least = DBL_MAX; for (…) if (cost[i] < least) { least = cost[i]; best = i; }``
    """
    for path, line, note in steps:
        unset = _UNSET.search(note)
        if unset is not None and _is_search(unset[1], line, text(path)):
            return True
    return False


def is_multiple(line: int, text: str) -> bool:
    """Whether the branch around *line* asks for a positive multiple (``n > 0 && n % 34 == 0``), of which the quotient is one at least."""
    before = _laid(text.split("\n")[max(line - _CONDITION, 0) : max(line - 1, 0)])
    for modulo in re.finditer(r"\b(\w{1,100})\s*%\s*(\w{1,100})\s*(?:\)\s*)?==\s*0\b", before):
        name, divisor = map(re.escape, modulo.groups())
        is_positive = re.search(rf"\b{name}\s*(?:>\s*0|>=\s*1|!=\s*0)(?![\w.])", before)
        quotient = re.search(rf"\b{name}\s*/\s*{divisor}\b", before[modulo.end() :])
        if is_positive and quotient and _is_inside(before[modulo.end() :]):
            return True
    return False


def _is_search(name: str, line: int, text: str) -> bool:
    lines = text.split("\n")
    above, after = _laid(lines[max(line - _ABOVE, 0) : line + _ABOVE]), _laid(lines[line : line + _SEARCH])
    loop = _LOOP.search(after)
    if loop is None:
        return False
    body = after[loop.end() :]
    for comparison in _COMPARISON.finditer(body):
        then = body[comparison.end() : comparison.end() + 400]
        then = then[: then.find("}") + 1 or None] if then.lstrip().startswith("{") else then.partition(";")[0] + ";"
        if re.search(rf"\b{re.escape(name)}\s*=(?!=|\s*-)", then) is None:
            continue
        for bound, is_less in ((comparison[3], comparison[2] == "<"), (comparison[1], comparison[2] == ">")):
            if re.fullmatch(r"\w{1,100}", bound) and _begins(bound, _LARGEST if is_less else _SMALLEST, above):
                return re.search(rf"\b{re.escape(bound)}\s*=(?!=)", then) is not None
    return False


def _laid(lines: Iterable[str]) -> str:
    """*lines* as one, with single blanks and without comments; what is too long for a line of a search is cut."""
    return _BLANKS.sub(" ", " ".join(_HIDDEN.sub("", line[:_LONGEST]) for line in lines))


def _begins(bound: str, extreme: str, text: str) -> bool:
    """Whether *bound* is set to the *extreme* of its type."""
    return re.search(rf"\b{re.escape(bound)}\s*(?:=(?!=)|\(|\{{)\s*(?:{extreme})", text) is not None


def _is_inside(after: str) -> bool:
    """Whether the block that is opened behind a condition is still open at the end of *after*."""
    depth = 0
    for brace in re.finditer(r"[{}]", after):
        depth += 1 if brace[0] == "{" else -1
        if depth == 0:
            return False
    return depth > 0
