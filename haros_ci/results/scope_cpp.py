# SPDX-License-Identifier: Apache-2.0
"""Namespaces, classes and functions of a C or C++ text by a light tokenizer: no preprocessor, no symbol table."""

from __future__ import annotations

import re
from bisect import bisect_right
from dataclasses import replace

from haros_ci.records import dataclass, field
from haros_ci.regex import regex
from haros_ci.results.comments import C_SKIPPED
from haros_ci.results.declaration import KEYS, DeclarationKind, classify
from haros_ci.results.scope import mark

_SKIPPED = rf"{C_SKIPPED}|(?<=\#)(?:[^\n\\/]+|\\[\s\S]?|//[^\n]*|/\*[\s\S]*?(?:\*/|\Z)|/)*"
_IN_BODY = regex(rf"""["'/\#{{}}](?:(?<=[{{}}])|{_SKIPPED})""")
_IN_CONTAINER = regex(rf"""["'/\#{{}};](?:(?<=[{{}};])|{_SKIPPED})""")
_TOKEN = regex(rf"""["'/\#](?:{_SKIPPED})|[A-Za-z_]\w*|\d(?:[\w.]|'(?=\w))*|::|->|<=>|[<>=!]=|[^\s\w]""")
_NO_TOKENS = ("//", "/*", "#")
_ACCESS = frozenset({"public", "private", "protected", "signals", "slots", "Q_SIGNALS", "Q_SLOTS"})
_CONDITIONAL = regex(r"#\s*(if|ifdef|ifndef|elif|elifdef|elifndef|else|endif)\b\s*(0\b)?")
_LONGEST_NAME = 400
_LONGEST_HEAD = 400  # tokens of a declaration that are kept; names stand at its front
_DEEPEST_CONDITION = 64


@dataclass(slots=True)
class _Container:
    """A namespace or class whose braces are open; ``name`` is qualified, ``own`` is not."""

    name: str
    own: str
    outer: _Container | None


@dataclass(slots=True)
class _ScanState:
    """Where the scan is: in *container*, or *depth* braces deep in a body within it.

    The declaration at hand is the tokens *head*, the first of them at offset *begin*, and the text from *read* on.
    """

    container: _Container
    head: list[str] = field(default_factory=list)
    begin: int = -1
    last: str = ""  # the token read last, also when head is full
    parens: int = 0
    read: int = 0
    depth: int = 0
    body: str = ""  # the name of what those braces enclose
    part: bool = False  # a pair of braces within the declaration has been met

    @property
    def scope(self) -> str:
        return self.body if self.depth else self.container.name

    def next_declaration(self, position: int) -> None:
        self.head, self.begin, self.last, self.parens, self.part = [], -1, "", 0, False
        self.read = position


def cpp_marks(text: str) -> list[tuple[int, str]]:
    """(line, qualified name from there on), ascending."""
    marks: list[tuple[int, str]] = []
    breaks = [match.start() for match in re.finditer("\n", text)]
    state = _ScanState(_Container("", "", None))
    conditions: list[tuple[_ScanState | None, bool]] = []  # (state at #if, its branch is "#if 0")
    position = 0
    while match := (_IN_BODY if state.depth else _IN_CONTAINER).search(text, position):
        position = match.end()
        brace = text[match.start()]
        if brace not in "{};":
            if brace == "#":
                before = state.scope
                state = _conditional(match, text, state, conditions)
                if state.scope != before:
                    mark(marks, bisect_right(breaks, match.start()) + 1, state.scope)
        elif state.depth:
            state.depth += 1 if brace == "{" else -1
            if not state.depth:
                state.read, state.last = position, "}"
                if not state.part:
                    state.next_declaration(position)
                    mark(marks, bisect_right(breaks, match.start()) + 2, state.container.name)
        elif brace == "{":
            tokens = _read(state, text, match.start())
            begin = state.begin if state.head else match.start()
            _open(state, tokens, position, marks, bisect_right(breaks, begin) + 1)
        else:
            state.next_declaration(position)
            if brace == "}" and state.container.outer:
                state.container = state.container.outer
                mark(marks, bisect_right(breaks, match.start()) + 2, state.container.name)
    return marks


def _read(state: _ScanState, text: str, end: int) -> list[str]:
    """Move the text up to *end* into the head; returns its tokens."""
    tokens: list[str] = []
    for match in _TOKEN.finditer(text, state.read, end):
        token = match[0]
        if token.startswith(_NO_TOKENS):
            continue
        if token == ":" and state.last in _ACCESS:
            state.next_declaration(match.end())
            tokens = []
            continue
        if token == "(":
            state.parens += 1
        elif token == ")":
            state.parens -= state.parens > 0
        if state.begin < 0:
            state.begin = match.start()
        if len(state.head) < _LONGEST_HEAD:
            state.head.append(token)
        tokens.append(token)
        state.last = token
    state.read = end
    return tokens


def _open(state: _ScanState, tokens: list[str], position: int, marks: list[tuple[int, str]], line: int) -> None:
    """Go through an opening brace into what the declaration makes of it; *tokens* are those since its last part."""
    state.depth, state.body = 1, state.container.name
    if state.parens or (state.part and state.last not in (")", "}") and KEYS.isdisjoint(tokens)):
        state.part = True
        return
    kind, name = classify(state.head, state.last, state.container.own)
    outer = state.container.name
    qualified = f"{outer}::{name}" if outer and name else outer or name
    if len(qualified) > _LONGEST_NAME:
        qualified = outer
    state.part = kind is DeclarationKind.PART
    if kind is DeclarationKind.CONTAINER:
        state.depth = 0
        state.container = _Container(qualified, name.rpartition("::")[2], state.container)
        state.next_declaration(position)
    if kind is not DeclarationKind.PART:
        state.body = qualified
        mark(marks, line, qualified)


def _conditional(
    match: re.Match[str], text: str, state: _ScanState, conditions: list[tuple[_ScanState | None, bool]]
) -> _ScanState:
    """Both branches of ``#if`` start from the same state, so that each may open the same brace."""
    found = _CONDITIONAL.match(match[0])
    if not found:
        return state
    word, saved = found[1], None
    if word in ("if", "ifdef", "ifndef"):
        if len(conditions) < _DEEPEST_CONDITION:
            if not state.depth:
                _read(state, text, match.start())
            saved = replace(state, head=state.head.copy())
        conditions.append((saved, found[2] is not None))
    elif conditions and word == "endif":
        saved, dead = conditions.pop()
        if not dead:
            saved = None
    elif conditions:
        saved, _ = conditions[-1]
        conditions[-1] = (saved, False)
    if saved is None or word in ("if", "ifdef", "ifndef"):
        return state
    return replace(saved, head=saved.head.copy(), read=match.end())
