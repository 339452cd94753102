# SPDX-License-Identifier: Apache-2.0
"""Conditions of C++ of which cppcheck says what does not hold, or what makes no difference."""

from __future__ import annotations

import re

from haros_ci.regex import regex

#: Rules that compare values.
OF_VALUES = frozenset(
    """
    compareValueOutOfTypeRangeError incorrectLogicOperator knownConditionTrueFalse oppositeInnerCondition redundantCondition
    unsignedLessThanZero unsignedPositive
    """.split()
)
#: ``Logical conjunction always evaluates to false: smooth && !(fast)``
_SWITCHES = regex(r"always evaluates to (?:true|false): !?\(?([A-Za-z_]\w*)\)? (?:&&|\|\|) !?\(?([A-Za-z_]\w*)\)?\.?")
_NUMBER = regex(r"(?<![\w.'])(?:0[xX]([0-9a-fA-F']{1,40})|([1-9][0-9']{0,40}))[uUlLzZ]{0,3}(?![\w']|\.\d)")
_LARGEST = 2**63 - 1
#: ``Either the condition 'step>0' is redundant or there is division by zero at line 42.``
_SIGN = regex(r"condition '([A-Za-z_][\w.]{0,100})(?:>|<|>=|<=)0(?:\.0*f?)?'")
#: Lines above a division in which the condition may stand.
_NEAR = 6
_OPPOSITE = regex(r"opposite to previous condition")
_HIDDEN = regex(
    r"//[^\n]*|/\*.*?(?:\*/|\Z)|\"(?:[^\"\\\n]|\\.){0,1000}\"|'(?:[^'\\\n]|\\.){1,8}'|\bR\"\(.{0,4000}?\)\"", re.DOTALL
)
_ELSE_IF = regex(r"\belse\s+if\s*(?:constexpr\s*)?\(|\bif\s*(?:constexpr\s*)?\(")
_ELSE = regex(r"\s*else\b")
#: Characters that are read behind a condition.
_LONGEST = 20_000


def has_large_constant(*texts: str) -> bool:
    """Whether one of *texts* has a constant above the largest signed number of 64 bits, which cppcheck takes for a negative one."""
    for text in texts:
        for number in _NUMBER.finditer(text[:2000]):
            digits = (number[1] or number[2]).replace("'", "")
            if digits and int(digits, 16 if number[1] else 10) > _LARGEST:
                return True
    return False


def is_of_switches(message: str) -> bool:
    """Whether the condition joins two names, each with its value alone: constants that somebody sets by hand (``const bool smooth = true, fast = true;``)."""
    found = _SWITCHES.search(message)
    return found is not None and found.end() == len(message) and found[1] != found[2]


def is_spelled_out(message: str, line: int, text: str) -> bool:
    """Whether the condition at *line* repeats the opposite of the one before it, and no ``else`` follows that it would make dead."""
    lines = text.split("\n")
    if _OPPOSITE.search(message) is None or not 0 < line <= len(lines):
        return False
    first = line - 2 if line > 1 and lines[line - 2].rstrip().endswith("else") else line - 1
    rest = "\n".join(lines[first:])[:_LONGEST]
    rest = _HIDDEN.sub(lambda found: re.sub(r"[^\n]", " ", found[0]), rest)
    condition = _ELSE_IF.search(rest)
    if condition is None or rest.count("\n", 0, condition.start()) > 1:
        return False
    end = _closed(rest, condition.end(), "(", ")")
    if end is None:
        return False
    opened = re.match(r"\s*\{", rest[end:])
    if opened is not None:
        after = _closed(rest, end + opened.end(), "{", "}")
    else:
        statement = re.match(r"(?!\s*(?:if|for|while|do|switch|try|else)\b)[^;{}]{0,2000};", rest[end:])
        after = end + statement.end() if statement is not None else None
    return after is not None and _ELSE.match(rest, after) is None and bool(rest[after:].strip())


def asks_for_sign(message: str, line: int, text: str) -> bool:
    """Whether the condition that *message* names asks whether the divisor is above or below zero, and its branch divides by it as well.

    ``if (step > 0) return a / step; return b / step;``: who divides on both ways takes it for granted that it is not zero.
    """
    named = _SIGN.search(message)
    if named is None:
        return False
    name = re.escape(named[1])
    above = _HIDDEN.sub("", "\n".join(text.split("\n")[max(line - 1 - _NEAR, 0) : max(line - 1, 0)]))
    condition = None
    for condition in re.finditer(rf"\bif\s*\(\s*{name}\s*[<>]=?\s*0(?:\.0*f?)?\s*\)", above):  # noqa: B007 - the last one
        pass
    return condition is not None and re.search(rf"[/%]=?\s*{name}(?![\w.(\[])", above[condition.end() :]) is not None


def _closed(text: str, start: int, opening: str, closing: str) -> int | None:
    """The position behind the bracket that closes the one before *start*."""
    depth = 1
    for bracket in re.finditer(rf"[{re.escape(opening + closing)}]", text[start:]):
        depth += 1 if bracket[0] == opening else -1
        if depth == 0:
            return start + bracket.end()
    return None
