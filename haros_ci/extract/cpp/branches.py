# SPDX-License-Identifier: Apache-2.0
"""Conditionals that split a statement or braces: only one branch of them can be parsed."""

from __future__ import annotations

import re
from typing import NamedTuple

from haros_ci.extract.cpp import blanks

_DIRECTIVE = re.compile(
    r"^[ \t]*#[ \t]*(if|ifdef|ifndef|elif|elifdef|elifndef|else|endif)\b(?:[^\n\\]|\\.)*", re.MULTILINE | re.DOTALL
)
_BRACKETS = re.compile(r"[(){}]")
_MIDDLE = tuple(",(=+-*/&|<?[")
_LIST = re.compile(r"[=,({\]]\s*\{\Z")
_NEVER = re.compile(r"\s*#\s*if\s+(?:0|false)\s*")


class Split(NamedTuple):
    """The one branch that is left of a conditional: its *first* and *last* line, *line* and *text* of its directive, and the line of the *next* one."""

    first: int
    last: int
    line: int
    text: str
    next: int


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
                cuts = _cuts(bare, directives)
                blanked.extend(cuts)
                if cuts:
                    left.append(_left(text, directives, _kept(bare, directives)))
    return _without(text, blanked), tuple(left)


def _kept(bare: str, directives: list[tuple[int, int]]) -> int:
    """The number of the branch that is left: the first; of ``#if 0`` the next, and alone nothing is compiled of it."""
    return 1 if _NEVER.fullmatch(bare[slice(*directives[0])]) else 0


def _left(text: str, directives: list[tuple[int, int]], number: int) -> Split:
    number = min(number, len(directives) - 1)
    (start, end), follows = directives[number], directives[min(number + 1, len(directives) - 1)][0]
    last = text.count("\n", 0, follows)
    line = text.count("\n", 0, start) + 1
    return Split(
        text.count("\n", 0, end) + 2, last, line, " ".join(text[start:end].replace("\\\n", " ").split()), last + 1
    )


def _cuts(bare: str, directives: list[tuple[int, int]]) -> list[tuple[int, int]]:
    """What to blank of a conditional: nothing if each branch is whole."""
    spans = [(directives[i][1], directives[i + 1][0]) for i in range(len(directives) - 1)]
    before = bare[max(0, directives[0][0] - 400) : directives[0][0]].rstrip()
    after = bare[directives[-1][1] : directives[-1][1] + 400].lstrip()[:1]
    is_inside = before.endswith(_MIDDLE) or _LIST.search(before) is not None
    if not is_inside and all(_is_whole(bare[start:end], after) for start, end in spans):
        return []
    kept = _kept(bare, directives)
    return [*directives, *(span for index, span in enumerate(spans) if index != kept)]


def _is_whole(branch: str, after: str) -> bool:
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
    return not (stripped and after == "{" and stripped[-1] not in ";}:")


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
