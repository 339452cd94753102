# SPDX-License-Identifier: Apache-2.0
"""Calls that look like ones of ROS APIs, found in the text of a file: what the interpreter does not see is found, too."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import replace
from functools import lru_cache

from haros_ci.coverage.blanked import closed
from haros_ci.coverage.names import Names
from haros_ci.records import dataclass
from haros_ci.regex import regex

#: Characters of a call that are shown.
SHOWN = 100
#: Characters of a call that are read for it.
_READ = 4 * SHOWN
#: Characters before a name in which its receiver is looked for.
FAR = 2_000
_TEMPLATE = regex(r"[<>;{}()]|::|->")
_SPACE = regex(r"\s*")
_SPACES = regex(r"\s+")
#: What stands before the name of a function that is declared or defined.
_DECLARED = regex(
    r"(?<![\w.])([A-Za-z_]\w*)(?:<[^;{}()]{0,200}>)?(?=(?P<signs>[\s>*&]+))(?P=signs)(?:\w+(?:<[\w:, ]{0,80}>)?\s*::\s*)*$"
)
#: Words that are no types, after which a call may stand.
_NO_TYPES = frozenset(
    "return co_return co_await co_yield throw new delete else do case not and or if while goto template endif".split()
)
_VARIABLE = regex(r"\s*[A-Za-z_]\w*\s*(?=[({])")
_DEF = regex(r"(?:\bdef|\bclass|\bimport|\bfrom|#[ \t]*define)[ \t]+$")
_QUALIFIER = regex(r"(?:(?:[A-Za-z_]\w*)\s*::\s*)*$")
_DOTTED = regex(r"(?:(?:[A-Za-z_]\w*)\s*\.\s*)*$")
_WORD = regex(r"[A-Za-z_]\w*\Z")


@dataclass(frozen=True, slots=True)
class TextCall:
    """A call in a file's text: *offset* is that of its *name*, *start* that of the expression, receiver included, *opening* that of its arguments."""

    name: str
    offset: int
    start: int
    opening: int
    end: int
    #: The class whose object is made, as it is written; "" for functions and methods.
    made: str = ""


def calls_in(text: str, names: Names, language: str) -> Iterator[TextCall]:
    """The calls in *text*, whose comments and texts are blank, of the functions and classes that *names* has."""
    is_python = language == "python"
    starts: dict[int, int] = {}
    for found in _pattern(names).finditer(text):
        name, offset = found[0], found.start()
        if offset and (text[offset - 1].isalnum() or text[offset - 1] == "_"):
            continue
        before = text[max(0, offset - 200) : offset]
        if _DEF.search(before):
            continue
        if name in names.classes and name[:1].isupper():
            call = _object(text, name, offset, found.end(), is_python)
        else:
            call = _function(text, names, found, before, is_python, starts)
        if call is not None and _has_argument(text, call.opening, is_python):
            yield replace(call, end=closed(text, call.opening, _READ))


@lru_cache(maxsize=8)
def _compiled(words: tuple[str, ...]) -> re.Pattern[str]:
    return re.compile(rf"(?:{'|'.join(words)})(?!\w)")  # what stands before is looked at later: this is faster


def may_have(text: str, names: Names) -> bool:
    """Whether a name stands anywhere in *text*."""
    return _pattern(names).search(text) is not None


def _pattern(names: Names) -> re.Pattern[str]:
    words = {*names.methods, *names.classes, *(item.rpartition("::")[2] for item in names.qualified)}
    return _compiled(tuple(sorted(words)))


def _function(
    text: str, names: Names, found: re.Match[str], before: str, is_python: bool, starts: dict[int, int]
) -> TextCall | None:
    name, offset = found[0], found.start()
    opening = _opening(text, found.end(), is_python)
    if opening is None or text[opening] != "(":
        return None
    if name not in names.methods:
        qualifier = _QUALIFIER.search(before)
        whole = _SPACES.sub("", qualifier[0] if qualifier is not None else "") + name
        if not any(whole == item or whole.endswith(f"::{item}") for item in names.qualified):
            return None
    if not is_python:
        declared = _DECLARED.search(before)
        if declared is not None and declared[1] not in _NO_TYPES and "&&" not in declared[0]:
            return None
    starts[offset] = _start(text, offset, starts)
    return TextCall(name, offset, starts[offset], opening, opening)


def _object(text: str, name: str, offset: int, end: int, is_python: bool) -> TextCall | None:
    """An object that is made: ``Name(...)``, ``new Name<T>(...)``, ``Name<T> it(...)``, ``make_shared<Name<T>>(...)``."""
    written = (_DOTTED if is_python else _QUALIFIER).search(text, max(0, offset - 200), offset)
    path = _SPACES.sub("", written[0]) if written is not None else ""
    start = offset - (len(written[0]) if written is not None else 0)
    if is_python:
        opening = _opening(text, end, is_python)
        place = (start, opening) if opening is not None else None
    else:
        place = _constructed(text, start, end, is_qualified=bool(path))
    return TextCall(name, offset, *place, place[1], path + name) if place is not None else None


def _constructed(text: str, start: int, end: int, is_qualified: bool) -> tuple[int, int] | None:
    """Where the expression begins that makes an object of the C++ class written from *start* to *end*, and where its arguments open."""
    after = _behind_template(text, end)
    if after is None:
        return None
    rest = _SPACE.match(text, after)
    at = rest.end() if rest is not None else after
    if text[at : at + 1] == ">":  # std::make_shared<Name>(...)
        maker = re.search(r"(?:std|boost)?(?:::)?make_(?:shared|unique)\s*<\s*$", text[max(0, start - 80) : start])
        if maker is None or text[at + 1 : at + 2] != "(":
            return None
        return start - len(maker[0]), at + 1
    if text[at : at + 1] in ("(", "{"):
        is_base = text[max(0, start - 2) : start].strip() in (":", ",") or text[at] == "{"
        return None if is_base and not is_qualified else (start, at)
    variable = _VARIABLE.match(text, after)
    return (start, variable.end()) if variable is not None else None


def _opening(text: str, end: int, is_python: bool) -> int | None:
    """Where the arguments begin of what ends at *end*: behind template arguments, if any."""
    after = end if is_python else _behind_template(text, end)
    if after is None:
        return None
    space = _SPACE.match(text, after)
    at = space.end() if space is not None else after
    if is_python and "\n" in text[after:at]:
        return None
    return at if text[at : at + 1] == "(" else None


def _behind_template(text: str, end: int) -> int | None:
    """Where the template arguments end that begin at *end*; *end* without any, None where these are none."""
    space = _SPACE.match(text, end)
    at = space.end() if space is not None else end
    if text[at : at + 1] != "<":
        return end
    depth = 0
    for found in _TEMPLATE.finditer(text, at, at + 2_000):
        if found[0] == "<":
            depth += 1
        elif found[0] == ">":
            depth -= 1
            if depth == 0:
                return found.end()
        elif found[0] in ";{}":
            return None
    return None


def _has_argument(text: str, opening: int, is_python: bool) -> bool:
    """Whether something is given: a call without arguments names nothing."""
    space = _SPACE.match(text, opening + 1)
    at = space.end() if space is not None else opening + 1
    return text[at : at + 1] not in (")", "}", "")


def _start(text: str, offset: int, starts: Mapping[int, int]) -> int:
    """Where the expression begins whose last name is at *offset*: ``a.b(c)->d`` before ``->name``.

    *starts* has those of earlier calls, which may be the first part of a chain: ``a.f(1).f(2)``.
    """
    at = start = offset
    least = max(0, offset - FAR)
    while at > least:
        at = _skip(text, at, least)
        if text[at - 2 : at] in ("->", "::"):
            at -= 2
        elif text[at - 1 : at] == ".":
            at -= 1
        else:
            break
        at = _operand(text, _skip(text, at, least), least)
        if at < 0:
            break
        start = starts.get(at, at)
        if start != at:
            break
    return start


def _operand(text: str, at: int, least: int) -> int:
    """Where the operand begins that ends at *at*: a name with the brackets behind it; -1 if it is none."""
    first = at
    while at > least and text[at - 1] in ")]>":
        begin = _open(text, at - 1, least)
        if begin < 0:
            return -1
        at = _skip(text, begin, least) if text[at - 1] != ">" else begin
    word = _WORD.search(text[max(least, at - 80) : at])
    if word is not None:
        return at - len(word[0])
    return at if at < first else -1


def _open(text: str, at: int, least: int) -> int:
    """Where the bracket is opened that is closed at *at*; -1 if that is not found."""
    pairs = {")": "(", "]": "[", ">": "<"}
    opening, closing = pairs[text[at]], text[at]
    depth = 0
    while at >= least:
        if text[at] == closing and not (closing == ">" and text[at - 1] == "-"):
            depth += 1
        elif text[at] == opening:
            depth -= 1
            if depth == 0:
                return at
        at -= 1
    return -1


def _skip(text: str, at: int, least: int) -> int:
    while at > least and text[at - 1].isspace():
        at -= 1
    return at


def shown(text: str, call: TextCall) -> str:
    """The text of a call on one line, cut where it is long; *text* is the file's own."""
    whole = _SPACES.sub(" ", text[call.start : min(call.end + 1, call.start + _READ)])
    return whole if len(whole) <= SHOWN else f"{whole[: SHOWN - 3]}..."
