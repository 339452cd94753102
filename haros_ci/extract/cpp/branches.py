# SPDX-License-Identifier: Apache-2.0
"""Conditionals that split a statement or braces: only one branch of them can be parsed."""

from __future__ import annotations

import re

from haros_ci.extract.cpp import blanks

_DIRECTIVE = re.compile(
    r"^[ \t]*#[ \t]*(if|ifdef|ifndef|elif|elifdef|elifndef|else|endif)\b(?:[^\n\\]|\\.)*", re.MULTILINE | re.DOTALL
)
_BRACKETS = re.compile(r"[(){}]")
_MIDDLE = tuple(",(=+-*/&|<?[")
_LIST = re.compile(r"[=,({\]]\s*\{\Z")
_NEVER = re.compile(r"\s*#\s*if\s+(?:0|false)\s*")


def single(text: str) -> str:
    """*text*, free of comments, with one branch left of each conditional that splits braces or a statement."""
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
                blanked.extend(_cuts(bare, unfinished.pop()))
    return _without(text, blanked)


def _cuts(bare: str, directives: list[tuple[int, int]]) -> list[tuple[int, int]]:
    """What to blank of a conditional: nothing if each branch is whole."""
    spans = [(directives[i][1], directives[i + 1][0]) for i in range(len(directives) - 1)]
    before = bare[max(0, directives[0][0] - 400) : directives[0][0]].rstrip()
    after = bare[directives[-1][1] : directives[-1][1] + 400].lstrip()[:1]
    is_inside = before.endswith(_MIDDLE) or _LIST.search(before) is not None
    if not is_inside and all(_is_whole(bare[start:end], after) for start, end in spans):
        return []
    kept = 1 if _NEVER.fullmatch(bare[slice(*directives[0])]) else 0  # of #if 0 alone nothing is compiled
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
                kept = 1 if _NEVER.fullmatch(bare[slice(*directives[0])]) else 0
                spans = [(directives[i][1], directives[i + 1][0]) for i in range(len(directives) - 1)]
                blanked += [*directives, *(span for index, span in enumerate(spans) if index != kept)]
    return _without(text, blanked)
