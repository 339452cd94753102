# SPDX-License-Identifier: Apache-2.0
"""Findings of cppcheck that the places which lead to them refute: what somebody else sets between, and what is done on purpose."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence

from haros_ci.linters.cppcheck_indices import OF_INDICES, Step, is_multiple, is_searched
from haros_ci.linters.left_loops import is_left
from haros_ci.regex import regex
from haros_ci.results.code_alone import code_alone
from haros_ci.results.scope import scopes

_OF_TWO_CONDITIONS = frozenset({"identicalConditionAfterEarlyExit", "oppositeInnerCondition"})
_IS_NULL = regex(r"Assignment '(?:this->)?(\w{1,100})=(?:NULL|nullptr|0)', assigned value is 0")
#: A call of a method of the same object.
_OWN_CALL = regex(r"(?:\bthis\s*->\s*|(?<![\w.>:~]))([A-Za-z_]\w*)\s*\(")
_COMMENT = regex(r"//[^\n]*|/\*.*?(?:\*/|\Z)", re.DOTALL)
#: Names in a condition of a message, none of them called or behind a dot.
_NAME = regex(r"(?<![\w.>:])[A-Za-z_]\w*(?!\w|\s*\()")
_WORDS = frozenset(("true", "false", "not", "and", "or", "nullptr", "NULL", "this"))
_QUOTED = regex(r"'([^']{1,300})'")
_INNER = regex(r"condition: (.{1,300})")
_LAMBDA = regex(r"\[\s*(?:&|=|this\b)[^\[\];{}]{0,200}\]\s*(?:\([^(){};]{0,400}\)\s*)?[^;{}()]{0,60}\{")
#: A division by a zero that stands there: ``1/0``, ``x % 0``, ``1.0 / 0.0f``.
_BY_ZERO = regex(r"(?:/=?|%=?)\s*(?:\(\s*)?(?:0[xX])?0+(?:\.0*)?[uUlLfF]{0,3}(?![\w.])")
_DIVISOR = regex(r"(?:/=?|%=?)\s*(?:\(\s*)?([A-Za-z_]\w{0,100})\b(?!\s*[(.\[]|\s*->)")
#: Where the result goes if a division is done for its own sake.
_TRIAL = regex(r"\bvolatile\b[^;=()]{1,200}=(?!=)")
#: What a step of the way says of a call; and a text of Qt that names a function (QObject::connect), which cppcheck takes for a call of it.
_CALLING = regex(r"Calling (?:function )?'?([A-Za-z_]\w*)")
_QT_TEXT = regex(r"\b(?:SLOT|SIGNAL)\s*\([^()]{0,300}\([^()]{0,300}\)[^()]{0,100}\)")
#: Lines between two conditions, and of the body of a lambda, that are looked at.
_BETWEEN = 60
_BODY = 4_000


def is_never_so(rule: str, message: str, steps: Sequence[Step], text: Callable[[str], str]) -> bool:
    """Whether the *steps* that lead to a finding of *rule* rule it out; the first is its place, and *text* reads a path."""

    def code(path: str) -> str:
        return code_alone(text(path), "c")

    path, line, _ = steps[0]
    if any(_is_named_alone(step, code) for step in steps[1:]):
        return True
    if rule in OF_INDICES:
        return is_multiple(line, code(path)) or is_searched(steps, code)
    if rule == "nullPointer":
        return any(_is_set_by_method(step, steps[0], code) for step in steps[1:])
    if rule == "invalidContainerLoop" and len(steps) > 1:
        return is_left(message, steps[0], steps[1], code(path))
    if rule == "zerodiv":
        return _is_on_purpose(steps, code)
    if rule in _OF_TWO_CONDITIONS and len(steps) > 1 and steps[1][0] == path:
        names = _names(message, steps)
        return bool(names) and _is_set_between(names, steps[1][1], line, text(path))
    return False


def _is_named_alone(step: Step, code: Callable[[str], str]) -> bool:
    """Whether the function that a step calls is named in ``SLOT()`` or ``SIGNAL()`` alone at that line."""
    name = _CALLING.match(step[2])
    if name is None:
        return False
    line = _line(code(step[0]), step[1])
    rest = _QT_TEXT.sub("", line)
    return rest != line and re.search(rf"(?<!\w){name[1]}\s*\(", rest) is None


def _is_set_by_method(null: Step, used: Step, code: Callable[[str], str]) -> bool:
    """Whether a method of the same object that is called between the assignment of *null* and the use sets the member.

    cppcheck does not look into the methods of a class template whose class is in another file.
    """
    name = _IS_NULL.search(null[2])
    if name is None or null[0] != used[0] or not 0 < null[1] <= used[1]:
        return False
    text = code(used[0])
    inside = scopes(text, "cpp")
    owner, _, function = inside.at(used[1]).rpartition("::")
    if not owner or inside.at(null[1]) != f"{owner}::{function}":
        return False
    lines = text.split("\n")
    called = set(_OWN_CALL.findall("\n".join(lines[null[1] - 1 : used[1]])))
    sets = re.compile(rf"(?<![\w.>:]){name[1]}\s*=(?!=)(?!\s*(?:NULL|nullptr|0)\s*;)|\bthis\s*->\s*{name[1]}\s*=(?!=)")
    setters = {inside.at(number) for number, item in enumerate(lines, 1) if sets.search(item)}
    return any(f"{owner}::{method}" in setters for method in called - {function})


def _is_on_purpose(steps: Sequence[Step], code: Callable[[str], str]) -> bool:
    """Whether the divisor is a zero that is written there or a constant that is zero, or the result goes to a ``volatile`` that nothing else sets.

    Compilers warn of the first (-Wdiv-by-zero): such a line tries out what a processor does.
    """
    path, line, _ = steps[0]
    text = code(path)
    here = _line(text, line)
    if _BY_ZERO.search(here) is not None:
        return True
    divisor = _DIVISOR.search(here)
    if divisor is not None:
        name = divisor[1]
        constant = (
            rf"^[ \t]*#[ \t]*define[ \t]+{name}[ \t]+\(?0+(?:\.0*)?\)?[uUlLfF]{{0,3}}[ \t]*$"
            rf"|\b(?:const|constexpr)\b[^;=(){{}}]{{1,100}}\b{name}\s*(?:=|\{{)\s*0+(?:\.0*)?[uUlLfF]{{0,3}}\s*[;}}]"
        )
        if re.search(constant, text, re.MULTILINE) is not None:
            return True
    uses = [steps[0], *(step for step in steps[1:] if step[2].startswith("Calling function"))]
    return any(_TRIAL.search(_line(code(step[0]), step[1])) is not None for step in uses)


def _names(message: str, steps: Sequence[Step]) -> list[str]:
    """The names in the second of two conditions, as cppcheck repeats it."""
    shown = _INNER.search(steps[0][2]) or _QUOTED.search(message)
    return [name for name in _NAME.findall(shown[1]) if name not in _WORDS] if shown is not None else []


def _is_set_between(names: Sequence[str], first: int, second: int, whole: str) -> bool:
    """Whether one of *names*, on which the conditions in lines *first* and *second* of a text depend, may be another at the second.

    By a line between them that is commented out; by a lambda of the same function, which somebody calls later; or, where the first is that of a loop, by another function: the loop waits for it.
    """
    if not 0 < first <= second <= first + _BETWEEN:
        return False
    between = "\n".join(whole.split("\n")[first - 1 : second])
    comments = "\n".join(found[0] for found in _COMMENT.finditer(between))
    text = code_alone(whole, "c")
    inside = scopes(text, "cpp")
    here, lines = inside.at(second), text.split("\n")
    is_loop = re.search(r"\bwhile\s*\(", _line(text, first)) is not None
    for name in names:
        sets = re.compile(rf"(?<![\w.>:])(?:this\s*->\s*)?{name}\s*=(?!=)")
        if sets.search(comments):
            return True
        numbers = [number for number, item in enumerate(lines, 1) if sets.search(item)]
        own = [number for number in numbers if inside.at(number) == here]
        is_local = re.search(rf"\b(?:bool|auto|int|unsigned|\w+_t|std::\w+)\s+{name}\b", _own(lines, own)) is not None
        if is_loop and not is_local and any(inside.at(number) not in ("", here) for number in numbers):
            return True
        if own and _is_in_lambda(sets, "\n".join(lines[own[0] - 1 : second])):
            return True
    return False


def _own(lines: Sequence[str], numbers: Sequence[int]) -> str:
    return "\n".join(lines[number - 1] for number in numbers)


def _is_in_lambda(sets: re.Pattern[str], text: str) -> bool:
    """Whether a lambda in *text* that captures what is around it has a statement that *sets* describes."""
    for opened in _LAMBDA.finditer(text):
        body = text[opened.end() : opened.end() + _BODY]
        depth = 1
        for brace in re.finditer(r"[{}]", body):
            depth += 1 if brace[0] == "{" else -1
            if depth == 0:
                body = body[: brace.start()]
                break
        if sets.search(body):
            return True
    return False


def _line(text: str, line: int) -> str:
    lines = text.split("\n")
    return lines[line - 1] if 0 < line <= len(lines) else ""
