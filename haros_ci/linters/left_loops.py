# SPDX-License-Identifier: Apache-2.0
"""Loops over a container that end as soon as it is changed."""

from __future__ import annotations

import re
from bisect import bisect_right

from haros_ci.linters.brackets import CLOSING, OPENING, closing_of, opening_of
from haros_ci.linters.cppcheck_indices import Step
from haros_ci.regex import regex

_CALLED = regex(r"Calling '([A-Za-z_]\w*)'")
_HEADED = regex(r"(?:if(?:\s+constexpr)?|for|while|switch|catch)\s*\(")
_BARE = regex(r"(?:else|do|try)\b")
_ELSE = regex(r"\s*(?:else\b|catch\s*\()")
_LEAVES = regex(r"(?:return|throw|goto|co_return)\b")
_KEYWORD = regex(r"\b(?:break|continue|return|throw|goto|co_return)\b")
_LOOP = regex(r"\b(?:for|while|do|switch)\b")
#: What a block may begin with; anything else is a lambda or a function.
_BLOCK = regex(r"(?:\}|\s|else|do|try|(?:case\b[^;{}]{0,200}|default\s*):|(?:if|for|while|switch|catch)\b[^{}]*\))*")
#: The variable of a loop over a container.
_VARIABLE = regex(r"\bfor\s*\([^;{}()]{0,200}?(\w+|\[[\w\s,]{0,200}\])\s*:(?!:)")
_WORD = regex(r"[A-Za-z_]\w*")
#: Characters behind the change that are looked at, and statements.
_LONGEST = 6_000
_MOST = 200


def is_left(message: str, changed: Step, loop: Step, text: str) -> bool:
    """Whether the loop over a container is left for certain behind the call that changes it, and what it iterates with is not used before that.

    *changed* is the place of the call, *loop* that of the container in the head of the loop; *text* is without comments.
    """
    name = _CALLED.search(message)
    if name is None or changed[0] != loop[0] or not 0 < loop[1] <= changed[1]:
        return False
    way = _Way(text, loop[1])
    start = way.start(changed[1])
    call = re.compile(rf"\b{name[1]}\s*\(").search(text, start, way.start(changed[1] + 1))
    if call is None:
        return False
    closed = closing_of(text, call.end() - 1, _LONGEST)
    rest = re.compile(r"[^{};]*;").match(text, closed + 1) if closed > 0 else None
    if rest is None or _KEYWORD.search(rest[0]) or not way.is_inside(call.start()):
        return False
    end = way.end(rest.end())
    head = text[way.start(loop[1]) : call.start()]
    names = {word for found in _VARIABLE.finditer(head) for word in _WORD.findall(found[1])}
    return end > 0 and not names.intersection(_WORD.findall(text[rest.end() : end]))


class _Way:
    """The way from a statement of *text* to where the loop at *loop*, a line, ends."""

    def __init__(self, text: str, loop: int) -> None:
        self._text = text
        self._starts = [0, *(found.end() for found in re.finditer("\n", text))]
        self._loop = loop

    def start(self, line: int) -> int:
        return self._starts[line - 1] if line <= len(self._starts) else len(self._text)

    def is_inside(self, at: int) -> bool:
        """Whether only blocks of statements are around *at* up to the loop: no lambda, no class."""
        for _ in range(_MOST):
            closing = _end_of_block(self._text, at)
            is_own, is_known = self._block(closing) if closing >= 0 else (False, False)
            if is_own or not is_known:
                return is_own
            at = closing + 1
        return False

    def end(self, at: int) -> int:
        """Where the loop is left by the statements from *at* on; 0 if that is not certain."""
        stop = at + _LONGEST
        for _ in range(_MOST):
            at = _blank(self._text, at)
            if at >= min(len(self._text), stop):
                return 0
            if self._text[at] == "}":
                is_own, is_known = self._block(at)
                if is_own or not is_known:
                    return 0
                at = self._behind(at)
            elif _LEAVES.match(self._text, at):
                return at
            elif self._text.startswith("break", at):
                inner, is_own = self._breaks(at)
                if is_own:
                    return at
                if inner == 0:
                    return 0
                at = self._behind(inner)
            elif self._text.startswith("continue", at):
                return 0
            else:
                at = _next(self._text, at, 0)
        return 0

    def _behind(self, closing: int) -> int:
        """Where it goes on behind a block: past the ``else`` of the same ``if``."""
        at = closing + 1
        while _ELSE.match(self._text, at):
            at = _next(self._text, _blank(self._text, at), 0)
        return at

    def _head(self, opening: int) -> tuple[str, int]:
        """The text before a block from the statement before it on, and where that begins."""
        at, depth = opening - 1, 0
        while at >= 0 and opening - at < _LONGEST:
            depth += (self._text[at] in ")]") - (self._text[at] in "([")
            if depth == 0 and self._text[at] in ";{}":
                break
            at -= 1
        return self._text[at + 1 : opening], at + 1

    def _block(self, closing: int) -> tuple[bool, bool]:
        """Whether the block that ends there is that of the loop, and whether it is one of a statement."""
        opening = opening_of(self._text, closing)
        if opening < 0:
            return False, False
        head, begin = self._head(opening)
        begin += len(head) - len(head.lstrip())
        is_own = _LOOP.search(head) is not None and self._line(begin) <= self._loop <= self._line(opening)
        return is_own, _BLOCK.fullmatch(head) is not None

    def _breaks(self, at: int) -> tuple[int, bool]:
        """The end of the loop, or of the ``switch``, that a ``break`` there leaves, and whether it is the loop itself."""
        for _ in range(_MOST):
            closing = _end_of_block(self._text, at)
            if closing < 0:
                return 0, False
            is_own, is_known = self._block(closing)
            if is_own or not is_known:
                return 0, is_own
            head, _begin = self._head(opening_of(self._text, closing))
            if _LOOP.search(head):
                return closing, False
            at = closing + 1
        return 0, False

    def _line(self, at: int) -> int:
        return bisect_right(self._starts, at)


def _blank(text: str, at: int) -> int:
    while at < len(text) and text[at].isspace():
        at += 1
    return at


def _next(text: str, at: int, depth: int) -> int:
    """The end of the statement that begins there."""
    if depth > _MOST or at >= len(text):
        return len(text)
    if text[at] == "{":
        closed = closing_of(text, at, _LONGEST)
        return closed + 1 if closed > 0 else len(text)
    headed = _HEADED.match(text, at)
    if headed is not None or (bare := _BARE.match(text, at)) is not None:
        closed = closing_of(text, headed.end() - 1, _LONGEST) + 1 if headed is not None else bare.end() if bare else 0
        if closed <= 0:
            return len(text)
        end = _next(text, _blank(text, closed), depth + 1)
        while _ELSE.match(text, end):
            end = _next(text, _blank(text, end), depth + 1)
        return end
    level = 0
    for index in range(at, min(at + _LONGEST, len(text))):
        level += (text[index] in OPENING) - (text[index] in CLOSING)
        if level < 0:
            return index
        if level == 0 and text[index] == ";":
            return index + 1
    return len(text)


def _end_of_block(text: str, at: int) -> int:
    """The index of the brace that ends the block around *at*; -1 if it is not there."""
    depth = 0
    for index in range(at, min(at + _LONGEST, len(text))):
        depth += (text[index] == "{") - (text[index] == "}")
        if depth < 0:
            return index
    return -1
