# SPDX-License-Identifier: Apache-2.0
"""Where the text of C++ is none to a compiler: comments, raw texts, and what stands under ``#if 0``.

A header that is included there alone is not seen through the file that does so.
"""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Iterator

from haros_ci.regex import regex
from haros_ci.results.comments import BEGINS_CHARACTER, SPLICE

#: Nothing else makes text dead that is looked at here.
_MAY_HIDE = regex(r"R\"|/\*|^[ \t]*#[ \t]*if\b", re.M)
#: Comments, the beginning of a raw text, and texts and characters of one line ([lex.string]).
_LEXEME = regex(
    r"//[^\n]*|/\*|\bu?8?[uUL]?R\"([^()\\\s\"]{0,16})\(|\"(?:[^\"\\\n]|\\.)*\""
    rf"|'{BEGINS_CHARACTER}(?:[^'\\\n]|\\.){{1,12}}'"
)
_CONDITIONAL = regex(r"^[ \t]*#[ \t]*(if|ifdef|ifndef|elif|elifdef|elifndef|else|endif)\b([^\n]*)", re.M)
_FALSE = regex(r"[\s(]*(?:0+[uUlL]*|false|![\s(]*(?:1|true))[\s)]*(?:&&.*)?")
_TRUE = regex(r"[\s(]*(?:1[uUlL]*|true|![\s(]*(?:0|false))[\s)]*(?:\|\|.*)?")
#: Raw texts without an end that are looked for; the text behind more of them is taken as it stands.
_MOST_OPEN = 16
#: Lines that go on in the next one ([lex.phases] 2), and the lexemes above where such a splice may stand within them.
_SPLICE = SPLICE.pattern
_GAP = rf"(?:{_SPLICE}){{0,20}}"
_MAY_BE_RAW = regex(rf'R{_GAP}"')
_UNSPLICED = regex(
    rf"/{_GAP}/(?:{_SPLICE}|[^\n])*|/{_GAP}\*"
    rf"|(?<!\w)(?:u{_GAP}8|[uUL])?{_GAP}R{_GAP}\"([^()\\\s\"]{{0,16}})\("
    rf'|"(?:{_SPLICE}|\\.|[^"\\\n])*"?'
    rf"|'{BEGINS_CHARACTER}(?:{_SPLICE}|\\.|[^'\\\n]){{1,12}}'"
)
_ENDS_COMMENT = regex(rf"\*{_GAP}/")


def dead(text: str) -> tuple[tuple[int, int], ...]:
    """From and to of what no compiler reads in *text*, in order, without overlaps; linear in its length. Spliced lines are to be joined before (:func:`joined`)."""
    if _MAY_HIDE.search(text) is None:
        return ()
    hidden = tuple(_hidden(text))
    return tuple(_joined(sorted((*hidden, *_under_false(text, hidden)))))


def joined(text: str) -> str:
    """*text* with its spliced lines joined, but for those in raw texts, in which a compiler takes that back; linear in its length."""
    if "\\" not in text or SPLICE.search(text) is None:
        return text
    if _MAY_BE_RAW.search(text) is None:
        return SPLICE.sub("", text)
    parts, at = [], 0
    for start, end in _raw_texts(text):
        parts += [SPLICE.sub("", text[at:start]), text[start:end]]
        at = end
    return "".join((*parts, SPLICE.sub("", text[at:])))


def without_raw_texts(text: str) -> str:
    """*text*, whose lines are joined, with nothing in its raw texts: what looks like a directive there is none."""
    if _MAY_BE_RAW.search(text) is None:
        return text
    parts, at = [], 0
    for start, end in _hidden(text):
        if text[start] != "/":
            parts += [text[at:start], '""']
            at = end
    return "".join((*parts, text[at:]))


def is_in(at: int, ranges: tuple[tuple[int, int], ...]) -> bool:
    """Whether the position lies in one of the *ranges* that :func:`dead` has found."""
    i = bisect_right(ranges, (at, len(ranges) and ranges[-1][1] + 1)) - 1
    return i >= 0 and ranges[i][0] <= at < ranges[i][1]


def _hidden(text: str) -> Iterator[tuple[int, int]]:
    at = opened = 0
    while match := _LEXEME.search(text, at):
        at = match.end()
        if match[0].startswith("/"):
            if match[0] == "/*":
                end = text.find("*/", at)
                at = len(text) if end < 0 else end + 2
            yield match.start(), at
        elif match[1] is not None and opened < _MOST_OPEN:
            end = text.find(f'){match[1]}"', at)
            if end < 0:
                opened += 1
            else:
                at = end + len(match[1]) + 2
                yield match.start(), at


def _raw_texts(text: str) -> Iterator[tuple[int, int]]:
    """From and to of what stands within raw texts of *text*, whose lines are not joined."""
    at = opened = 0
    while match := _UNSPLICED.search(text, at):
        at = match.end()
        if match[0].startswith("/") and match[0].endswith("*") and SPLICE.sub("", match[0]) == "/*":
            end = _ENDS_COMMENT.search(text, at)
            at = len(text) if end is None else end.end()
        elif match[1] is not None and opened < _MOST_OPEN:
            end_at = text.find(f'){match[1]}"', at)
            if end_at < 0:
                opened += 1
            else:
                yield at, end_at
                at = end_at + len(match[1]) + 2


def _under_false(text: str, hidden: tuple[tuple[int, int], ...]) -> Iterator[tuple[int, int]]:
    """What stands in branches whose condition is written false, or that follow one that is written true."""
    stack: list[
        tuple[int, bool]
    ] = []  # where the branch begins if it is dead, else -1; whether one before is written true
    for match in _CONDITIONAL.finditer(text):
        if is_in(match.start(), hidden):
            continue
        word, condition = match[1], match[2].partition("//")[0].partition("/*")[0]
        is_decided = word in ("if", "elif")
        is_false = is_decided and _FALSE.fullmatch(condition) is not None
        is_true = is_decided and _TRUE.fullmatch(condition) is not None
        was_true = False
        if not word.startswith("if"):
            if not stack:
                continue
            start, was_true = stack.pop()
            if start >= 0:
                yield start, match.start()
        if word != "endif":
            stack.append((match.end() if was_true or is_false else -1, was_true or is_true))
    yield from ((start, len(text)) for start, _ in stack if start >= 0)


def _joined(ranges: list[tuple[int, int]]) -> Iterator[tuple[int, int]]:
    start, end = -1, -1
    for one, other in ranges:
        if one > end:
            if end > start:
                yield start, end
            start = one
        end = max(end, other)
    if end > start:
        yield start, end
