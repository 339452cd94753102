# SPDX-License-Identifier: Apache-2.0
"""Conditionals that split a statement or braces: only one branch of them can be parsed."""

from __future__ import annotations

import re
from typing import NamedTuple

from haros_ci.extract.cpp import blanks
from haros_ci.regex import regex

_DIRECTIVE = regex(
    r"^[ \t]*#[ \t]*(if|ifdef|ifndef|elif|elifdef|elifndef|else|endif)\b(?:[^\n\\]|\\.)*", re.MULTILINE | re.DOTALL
)
_BRACKETS = regex(r"[(){}]")
_MIDDLE = tuple(",(=+-*/&|<?[")
_LIST = regex(r"[=,({\]]\s*\{\Z")
_NEVER = regex(r"\s*#\s*if\s+(?:0|false)\s*")
_ELSE = regex(r"\s*#\s*else\s*")
#: How a branch begins that goes on with an expression: no statement does.
_ONWARDS = regex(r"\s*(?:[,.?=<>%/|^)]|&&|\+(?!\+)|-(?!-)|[0-9]|:(?!:))")
#: How a branch begins that goes on with an expression if one is not finished before it.
_EITHER = regex(r"\s*(?:[*&]|\[(?!\[))")
#: The head of an ``if`` or of a loop, up to its bracket.
_HEAD = regex(r"(?:\A|[;{}]|\belse\b)\s*(?:if(?:\s+constexpr)?|while|for)\s*\(")
_PARTS = regex(r"[\[\](){},;]")
_LONGEST = 2000


class Other(NamedTuple):
    """What ``#else`` has in the place of *own*: its *text*, and where that begins."""

    own: str
    text: str
    line: int
    column: int


class Split(NamedTuple):
    """The one branch that is left of a conditional: its *first* and *last* line, *line* and *text* of its directive, and the line of the *next* one.

    *others* are the expressions of an ``#else``, by those of the branch in whose place they stand; *is_alone* where there is no other branch.
    """

    first: int
    last: int
    line: int
    text: str
    next: int
    others: tuple[Other, ...] = ()
    is_alone: bool = False


def single(text: str) -> tuple[str, tuple[Split, ...]]:
    """*text*, free of comments, with one branch left of each conditional that splits braces or a statement; and these branches."""
    bare = blanks.skeleton(text)
    blanked: list[tuple[int, int]] = []
    left: list[Split] = []
    unfinished: list[list[tuple[int, int]]] = []
    for match in _DIRECTIVE.finditer(bare):
        word = match.group(1)
        here = (match.start(), match.end())
        if word.startswith("if"):
            unfinished.append([here])
        elif unfinished:
            unfinished[-1].append(here)
            if word == "endif":
                directives = unfinished.pop()
                cuts = _cuts(text, bare, directives)
                blanked.extend(cuts)
                if cuts:
                    left.append(_left(text, bare, directives, _kept(bare, directives)))
    return _without(text, blanked), tuple(left)


def _kept(bare: str, directives: list[tuple[int, int]]) -> int:
    """The number of the branch that is left: the first; of ``#if 0`` the next, and alone nothing is compiled of it."""
    return 1 if _NEVER.fullmatch(bare[slice(*directives[0])]) else 0


def _left(text: str, bare: str, directives: list[tuple[int, int]], number: int) -> Split:
    others = _others(text, bare, directives) if number == 0 else ()
    number = min(number, len(directives) - 1)
    (start, end), follows = directives[number], directives[min(number + 1, len(directives) - 1)][0]
    last = text.count("\n", 0, follows)
    line = text.count("\n", 0, start) + 1
    return Split(
        text.count("\n", 0, end) + 2,
        last,
        line,
        " ".join(text[start:end].replace("\\\n", " ").split()),
        last + 1,
        others,
        len(directives) == 2,
    )


def _others(text: str, bare: str, directives: list[tuple[int, int]]) -> tuple[Other, ...]:
    """The expressions of ``#else``, if it has as many between its commas as the branch before it; none where there is another branch."""
    if len(directives) != 3 or _ELSE.fullmatch(bare[slice(*directives[1])]) is None:
        return ()
    own, other = (_parts(text, bare, directives[at][1], directives[at + 1][0]) for at in (0, 1))
    if len(own) != len(other) or any(
        (ours[0] == "") is not (theirs[0] == "") for ours, theirs in zip(own, other, strict=True)
    ):
        return ()
    return tuple(
        Other(ours, theirs, text.count("\n", 0, start) + 1, start - text.rfind("\n", 0, start))
        for (ours, _), (theirs, start) in zip(own, other, strict=True)
        if ours
    )


def _parts(text: str, bare: str, start: int, end: int) -> list[tuple[str, int]]:
    """What stands between the commas of a branch that is whole, with its offset; nothing of statements and of what is long."""
    depth, begins, found = 0, start, list[tuple[str, int]]()
    for match in _PARTS.finditer(bare, start, end) if end - start <= _LONGEST else ():
        depth += 1 if match.group() in "([{" else -1 if match.group() in ")]}" else 0
        if depth < 0 or (match.group() == ";" and not depth):
            return []
        if match.group() == "," and not depth:
            found.append(_part(text, begins, match.start()))
            begins = match.end()
    return [*found, _part(text, begins, end)] if not depth and end - start <= _LONGEST else []


def _part(text: str, start: int, end: int) -> tuple[str, int]:
    piece = text[start:end]
    return " ".join(piece.split()), start + len(piece) - len(piece.lstrip())


def _cuts(text: str, bare: str, directives: list[tuple[int, int]]) -> list[tuple[int, int]]:
    """What to blank of a conditional: nothing if each branch is whole."""
    spans = [(directives[i][1], directives[i + 1][0]) for i in range(len(directives) - 1)]
    before = bare[max(0, directives[0][0] - 400) : directives[0][0]].rstrip()
    after = bare[directives[-1][1] : directives[-1][1] + 400].lstrip()[:1]
    is_inside = before.endswith(_MIDDLE) or _LIST.search(before) is not None
    is_inside = is_inside or (_is_open(before) and any(_EITHER.match(bare[start:end]) for start, end in spans))
    if not is_inside and all(_is_whole(text[start:end], bare[start:end], after) for start, end in spans):
        return []
    kept = _kept(bare, directives)
    return [*directives, *(span for index, span in enumerate(spans) if index != kept)]


def _is_open(before: str) -> bool:
    """Whether what stands before a conditional may be part of an expression: it ends with a word or an index, and in no directive."""
    last = before[before.rfind("\n") + 1 :]
    return (before[-1:].isalnum() or before.endswith(("_", "]"))) and not last.lstrip().startswith("#")


def _is_whole(text: str, branch: str, after: str) -> bool:
    """Whether a *branch*, whose literals are blank and *text* has them, consists of statements or declarations."""
    if _ONWARDS.match(branch) or (branch.isspace() and not text.isspace()):
        return False
    depths = {"(": 0, "{": 0}
    for match in _BRACKETS.finditer(branch):
        bracket = match.group()
        if bracket in "({":
            depths[bracket] += 1
        else:
            opening = "(" if bracket == ")" else "{"
            depths[opening] -= 1
            if depths[opening] < 0:
                return False
    stripped = branch.strip()
    if depths["("] or depths["{"] or stripped.startswith("else"):
        return False
    if stripped.endswith(")") and after not in ("", ";") and _is_head(stripped):
        return False
    return not (stripped and after in ("{", ";") and stripped[-1] not in ";}:")


def _is_head(branch: str) -> bool:
    """Whether a branch ends with the head of an ``if`` or of a loop, whose body follows behind the branch."""
    heads = {match.end() - 1 for match in _HEAD.finditer(branch)}
    opened: list[int] = []
    closed = -1
    for match in _BRACKETS.finditer(branch):
        if match.group() == "(":
            opened.append(match.start())
        elif match.group() == ")" and opened:
            closed = opened.pop()
    return closed in heads


def _without(text: str, spans: list[tuple[int, int]]) -> str:
    pieces: list[str] = []
    done = 0
    for start, end in sorted(spans):
        start = max(start, done)
        if end > start:
            pieces += [text[done:start], re.sub(r"[^\n]", " ", text[start:end])]
            done = end
    return "".join([*pieces, text[done:]])


def first(text: str) -> str:
    """*text* with one branch of each conditional: the first, of ``#if 0`` the next. Directives and the rest are blank."""
    bare = blanks.skeleton(text)
    blanked: list[tuple[int, int]] = []
    unfinished: list[list[tuple[int, int]]] = []
    for match in _DIRECTIVE.finditer(bare):
        word = match.group(1)
        here = (match.start(), match.end())
        if word.startswith("if"):
            unfinished.append([here])
        elif unfinished:
            unfinished[-1].append(here)
            if word == "endif":
                directives = unfinished.pop()
                kept = _kept(bare, directives)
                spans = [(directives[i][1], directives[i + 1][0]) for i in range(len(directives) - 1)]
                blanked += [*directives, *(span for index, span in enumerate(spans) if index != kept)]
    return _without(text, blanked)
