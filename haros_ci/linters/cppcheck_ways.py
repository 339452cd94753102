# SPDX-License-Identifier: Apache-2.0
"""Findings of cppcheck on ways through the code that nobody takes, or where what it says does no harm."""

from __future__ import annotations

import re
from collections.abc import Callable

from haros_ci.linters.cppcheck_conditions import asks_for_sign, has_large_constant
from haros_ci.regex import regex
from haros_ci.results.scope import scopes

_THROW = regex(r"\bthrow\b")
#: A macro with a ``throw`` in it, over several lines, too.
_THROWING = regex(
    r"^[ \t]*#[ \t]*define[ \t]+([A-Za-z_]\w{0,100})(?:[^\n\\]|\\\r?\n|\\.){0,2000}?\bthrow\b", re.MULTILINE
)
#: ``Resource leak: file`` and ``Comparing expression of type 'unsigned char' against value 255.``
_RESOURCE = regex(r": (\w+)\.?$")
_VALUE = regex(r"against value (-?\d+)")
#: The constant of a comparison by a name, as macros and enumerators are written.
_NAMED = regex(r"[<>=!]=?\s*(?:\(\s*)?(?:[a-z]\w*::)*[A-Z][A-Z0-9_]{2,}\b|\b[A-Z][A-Z0-9_]{2,}\s*(?:\)\s*)?[<>=!]=?")
_NOTHING = r"(?:NULL|nullptr|0|-\s*1|INVALID_\w+)"
#: That a handle is not open: ``!file``, ``file == NULL``, ``(file = fopen(…)) == NULL``, ``NULL == file``.
_FAILED = (
    r"!\s*(?:\(\s*)*{name}\s*(?:\)|&&|$|=(?!=))"
    rf"|\b{{name}}\s*(?:==|<=|<)\s*{_NOTHING}(?!\w)"
    rf"|\b{{name}}\s*=(?!=)[^;]{{{{0,300}}}}\)\s*(?:==|<=|<)\s*{_NOTHING}(?!\w)"
    rf"|(?<!\w){_NOTHING}\s*(?:==|>=|>)\s*{{name}}\b"
)
#: What turns a condition round: ``(file == nullptr) == false``, ``!(!file)``.
_TWISTED = regex(r"\b(?:true|false|not)\b|![\s(]*!|!\s*\([^()]*[=!<>]=|[=!<>]=[^()]*\)\s*[=!]=|\^|\?")
_HIDDEN = regex(r"//[^\n]*|/\*.*?(?:\*/|\Z)|\"(?:[^\"\\\n]|\\.){0,1000}\"|'(?:[^'\\\n]|\\.){1,8}'", re.DOTALL)
_IF = regex(r"\bif\s*\(")
_ITSELF = regex(r"of '([^']{1,200})' to itself")
#: An assignment to itself as one of the cases of a switch.
_CASE = regex(r"\s*(?:case\b[^;:]{0,80}|default\s*):")
_ENDS_CASE = regex(r"[;{]\s*break\s*;|^\s*break\s*;", re.MULTILINE)
#: What begins a lambda; an index before a bracket looks so, too.
_LAMBDA = regex(r"\]\s*(?:\(|mutable\b|->|<|noexcept\b|\{|$)")
#: Characters that are looked at before a place.
_LONGEST = 4_000


def is_thrown_elsewhere(message: str, line: int, text: str) -> bool:
    """Whether no ``throw``, nor a macro of the file with one, stands at *line*: whether the checks of a function that is called there can fail depends on what it is given."""
    here = _HIDDEN.sub("", _line(text, line))
    if _THROW.search(here) is not None:
        return False
    return all(re.search(rf"\b{macro}\b", here) is None for macro in _THROWING.findall(text))


def has_not_opened(message: str, line: int, text: str) -> bool:
    """Whether *line* is where the handle that *message* names is not open: in the ``if`` that asks whether opening has failed."""
    name = _RESOURCE.search(message)
    lines = text.split("\n")
    if name is None or not 0 < line <= len(lines):
        return False
    before = "\n".join(lines[: line - 1])[-_LONGEST:]
    before = _HIDDEN.sub(lambda found: re.sub(r"[^\n]", " ", found[0]), before)
    condition = _condition_around(before)
    if condition is None or "||" in condition or _TWISTED.search(condition) is not None:
        return False
    return re.search(_FAILED.format(name=re.escape(name[1])), condition) is not None


def is_named_limit(message: str, line: int, text: str) -> bool:
    """Whether the condition compares with a constant that has a name, which may be another number tomorrow."""
    here, value = _line(text, line), _VALUE.search(message)
    if has_large_constant(message, here):
        return True
    if value is None or re.search(rf"(?<![\w.]){re.escape(value[1])}(?![\w.])", here):
        return False
    return _NAMED.search(_HIDDEN.sub("", here)) is not None


def sets_nothing(message: str, line: int, text: str) -> bool:
    """Whether the assignment stands for symmetry, as all of one case of a ``switch`` or of an ``if`` whose ``else`` sets the same variable.

    Or whether it only looks so to cppcheck: a macro stands before the second name.
    """
    itself, lines = _ITSELF.search(message), text.split("\n")
    if itself is None or not 1 < line <= len(lines):
        return False
    here, name = lines[line - 1], re.escape(itself[1])
    if re.search(rf"{name}\s*=\s*[A-Za-z_]\w*\s+{name}\b", here):
        return True
    after = "\n".join(lines[line : line + 4])
    if re.match(rf"\s*\}}?\s*else\b[^;{{}}]{{0,300}}\{{?\s*{name}\s*[-+*/]?=", after):
        before = next((other for other in reversed(lines[: line - 1]) if other.strip(" \t{")), "")
        return re.search(r"\bif\s*\(", before) is not None
    if _CASE.match(here) is None and _CASE.match(lines[line - 2]) is None:
        return False
    return _ENDS_CASE.search("\n".join(lines[line - 1 : line + 1])) is not None


def is_list_of_values(message: str, line: int, text: str) -> bool:
    """Whether the comma is one of Eigen's and OpenCV's lists of values, ``matrix << 1,\n 2;``, which begins lines above."""
    if "','" not in message:
        return False
    before = "\n".join(text.split("\n")[:line])[-_LONGEST:]
    statement = re.split(r"[;{}]", _HIDDEN.sub("", before).rstrip().rstrip(";"))[-1]
    return "<<" in statement


def ends_process(message: str, line: int, text: str) -> bool:
    """Whether *line* is a ``return`` of ``main()`` itself, or its end: the system takes back what is left.

    The end of a block in it is none, nor is the ``return`` of a lambda in it.
    """
    inside = scopes(text, "cpp")
    lines = text.split("\n")
    if inside.at(line) != "main" or not 0 < line <= len(lines):
        return False
    if re.search(r"\breturn\b", _HIDDEN.sub("", lines[line - 1])) is None:
        return lines[line - 1].startswith("}") and inside.at(line + 1) != "main"
    before = _HIDDEN.sub(lambda found: re.sub(r"[^\n]", " ", found[0]), "\n".join(lines[: line - 1]))[-5 * _LONGEST :]
    depth = 0
    for brace in reversed(list(re.finditer(r"[{}]", before))):
        depth += 1 if brace[0] == "}" else -1
        if depth < 0:
            depth = 0
            head = before[max(brace.start() - 400, 0) : brace.start()]
            if _LAMBDA.search(re.split(r"[;{}]", head)[-1]) is not None:
                return False
    return _LAMBDA.search(lines[line - 1]) is None


def loses_nothing(message: str, line: int, text: str) -> bool:
    """Whether nothing is lost where cppcheck says that a resource leaks: it was not opened, or the process ends."""
    return has_not_opened(message, line, text) or ends_process(message, line, text)


#: The questions by rule; each takes the message, the line, counted from 1, and the text of the file.
OF_WAYS: dict[str, Callable[[str, int, str], bool]] = {
    "throwInNoexceptFunction": is_thrown_elsewhere,
    "resourceLeak": loses_nothing,
    "compareValueOutOfTypeRangeError": is_named_limit,
    "zerodivcond": asks_for_sign,
}


def _line(text: str, line: int) -> str:
    lines = text.split("\n")
    return lines[line - 1] if 0 < line <= len(lines) else ""


def _condition_around(before: str) -> str | None:
    """The condition of the ``if`` whose branch is open at the end of *before*; None where none is, or the branch is that of an else."""
    end = before.rstrip()
    if not end.endswith(")"):
        depth = 0
        for brace in reversed(list(re.finditer(r"[{}]", before))):
            depth += 1 if brace[0] == "}" else -1
            if depth < 0:
                end = before[: brace.start()].rstrip()
                break
        else:
            return None
    if not end.endswith(")"):
        return None
    depth = 0
    for bracket in reversed(list(re.finditer(r"[()]", end))):
        depth += 1 if bracket[0] == ")" else -1
        if depth == 0:
            start = bracket.start()
            opened = [found for found in _IF.finditer(end) if found.end() - 1 == start]
            return end[start + 1 : -1] if opened else None
    return None
