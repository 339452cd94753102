# SPDX-License-Identifier: Apache-2.0
"""Measures C and C++ files with lizard, in one pass over its tokens; run as a script in a process of its own."""

from __future__ import annotations

import re
import sys
from bisect import bisect_left, bisect_right
from collections import Counter
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

if not __package__:  # run as a script: haros_ci itself, also where it is not installed
    sys.path.append(str(Path(__file__).resolve().parents[2]))

from haros_ci.linters.metrics_worker import Tokens, Unmeasurable, begin, file_metrics, serve
from haros_ci.regex import regex

#: Names that lizard takes for functions where macros or templates confuse it.
NOT_FUNCTIONS = frozenset(
    "if else for while do switch case catch try return throw sizeof alignof decltype typeof new delete defined"
    " static_assert noexcept requires using namespace template typename class struct union enum __attribute__".split()
)
#: The operators of Halstead's that are words ([lex.key]); types are operands, as names of classes are.
KEYWORDS = frozenset(
    "alignas alignof and and_eq asm break case catch class co_await co_return co_yield compl concept const const_cast"
    " consteval constexpr constinit continue decltype default delete do dynamic_cast else enum explicit export extern for"
    " friend goto if inline mutable namespace new noexcept not not_eq operator or or_eq private protected public register"
    " reinterpret_cast requires return sizeof static static_assert static_cast struct switch template thread_local throw"
    " try typedef typeid typename union using virtual volatile while xor xor_eq".split()
)
OPERAND = regex(r"""[\w"'~]""")
PUNCTUATION = frozenset("{}()[];,")
CLOSING = frozenset(")]}")
OFF = regex(r"#\s*if\s+(0|false)\b")
DIRECTIVE = regex(r"#\s*(\w+)")
#: What lizard looks for in comments; and a comment that it takes for the name of a file.
MARKS = ("#lizard", "GENERATED CODE")
BEHIND_INCLUDE = regex(r"#\s*include\s*/[/*]")


def measure(source: bytes) -> dict[str, Any]:
    """The metrics of one file. Of the branches of ``#if`` the first is read (of ``#if 0`` the next), as lizard would
    otherwise see the braces of both."""
    import lizard

    if b"\0" in source:
        raise Unmeasurable("not text")
    code = _decode(source)
    lines = _LizardLines()
    counters = [lizard.line_counter, lizard.condition_counter]
    if _is_for_lizard(code) or BEHIND_INCLUDE.search(code):  # else no comment comes so far
        counters.insert(0, lizard.comment_counter)
    analyze = lizard.FileAnalyzer([lines.watch, lizard.preprocessing, *counters])
    parsed = analyze.analyze_source_code("x.cpp", code)
    text = code.split("\n")
    effective = sorted(lines.effective)
    functions = [_function(f, text, effective) for f in parsed.function_list if _is_function(f)]
    functions.sort(key=lambda f: (f["line"], f["name"]))
    metrics = file_metrics(
        code=lines.code,
        comments=lines.comments,
        effective=len(effective),
        logical=len(effective),
        complexity=sum(f["cc"] for f in functions),
        tokens=lines.halstead(),
    )
    return {"functions": functions, "file": metrics}


def _is_for_lizard(text: str) -> bool:
    return any(mark in text for mark in MARKS)


def _decode(source: bytes) -> str:
    try:
        text = source.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = source.decode("latin-1")
    return text.replace("\r\n", "\n").replace("\r", "\n")


class _LizardLines:
    """What the lines and tokens of a file are, gathered while lizard reads it."""

    def __init__(self) -> None:
        self.code: set[int] = set()
        self.effective: set[int] = set()  # more than braces and other punctuation, no preprocessor lines
        self.comments: set[int] = set()
        self.words: list[str] = []

    def watch(self, tokens: Iterable[str], reader: object) -> Iterator[str]:
        """Passes on what lizard needs: of plain comments and of branches that are not read only the newlines."""
        branches = _Branches()
        code, effective, words = self.code, self.effective, self.words
        line = 1
        for token in tokens:
            first = token[0]
            if first == "\n":
                line += 1
                yield token
            elif first.isspace():  # blanks, without a newline
                continue
            elif first == "#" or branches.skipping:
                skipped = branches.skipping
                if first == "#":
                    branches.enter(token)
                last = line + token.count("\n")
                if skipped and branches.skipping:
                    yield from "\n" * (last - line)
                else:
                    code.update(range(line, last + 1))
                    yield token
                line = last
            elif first == "/" and token[:2] in ("//", "/*"):
                last = line + token.count("\n")
                self.comments.update(range(line, last + 1))
                if _is_for_lizard(token):
                    yield token
                else:
                    yield from "\n" * (last - line)
                line = last
            elif token in PUNCTUATION:
                code.add(line)
                words.append(token)
                yield token
            else:
                words.append(token)
                if "\n" in token:
                    last = line + token.count("\n")
                    code.update(range(line, last + 1))
                    effective.update(range(line, last + 1))
                    line = last
                else:
                    code.add(line)
                    effective.add(line)
                yield token

    def halstead(self) -> Tokens:
        """Names and literals are operands; a pair of brackets is one operator, preprocessor lines are left out."""
        counts = Counter(self.words)
        for closing in CLOSING:
            counts.pop(closing, None)
        operands = [count for word, count in counts.items() if OPERAND.match(word) and word not in KEYWORDS]
        total = sum(operands)
        return Tokens(counts.total() - total, total, len(counts) - len(operands), len(operands))


class _Branches:
    """Which branch of the ``#if`` around the current token is read: the first, of ``#if 0`` the next."""

    def __init__(self) -> None:
        self._open: list[tuple[bool, bool]] = []  # per #if: whether its branch was found, whether this one is dropped
        self._dropped = 0

    @property
    def skipping(self) -> bool:
        return self._dropped > 0

    def enter(self, token: str) -> None:
        found = DIRECTIVE.match(token)
        word = found.group(1) if found else ""
        if word in ("if", "ifdef", "ifndef"):
            off = OFF.match(token) is not None
            self._push(not off, off)
        elif word in ("elif", "else", "elifdef", "elifndef") and self._open:
            taken = self._pop()
            self._push(True, taken)
        elif word == "endif" and self._open:
            self._pop()

    def _push(self, taken: bool, dropped: bool) -> None:
        self._open.append((taken, dropped))
        self._dropped += dropped

    def _pop(self) -> bool:
        taken, dropped = self._open.pop()
        self._dropped -= dropped
        return taken


def _is_function(function: Any) -> bool:
    name = function.name.rsplit("::", 1)[-1].strip()
    return bool(re.match(r"[A-Za-z_~]", name)) and name not in NOT_FUNCTIONS


def _function(function: Any, text: list[str], effective: list[int]) -> dict[str, Any]:
    start, end = function.start_line, function.end_line
    macro = function.name.isupper()
    name = _call(function.long_name) if macro else _plain(function.name)
    return {
        "name": name,
        "line": start,
        "column": _column(text[start - 1] if start <= len(text) else "", name),
        "cc": function.cyclomatic_complexity,
        "nloc": function.nloc,
        "eloc": bisect_right(effective, end) - bisect_left(effective, start),
        "parameters": 0 if macro else function.parameter_count,
    }


def _plain(name: str) -> str:
    """*name* without the blanks that lizard sets into ``operator<<`` and template arguments."""
    return re.sub(r"(?<=\W) | (?=\W)", "", name)


def _call(long_name: str) -> str:
    """A macro that makes functions (``TEST_F(Fixture, name)``) as the whole call: its name alone says nothing."""
    return re.sub(r" ?, ?", ", ", re.sub(r"(?<=\() | (?=[()])", "", " ".join(long_name.split())))


def _column(line: str, name: str) -> int | None:
    """Where the longest trailing part of *name* that *line* holds as a word begins, counted from 1."""
    part = name.split("(", 1)[0] if "operator" not in name else name.partition("operator")[0] + "operator"
    while part:
        at = line.find(part)
        while at >= 0:
            around = line[at - 1 : at] + line[at + len(part) : at + len(part) + 1]
            if not any(c.isalnum() or c == "_" for c in around):
                return at + 1
            at = line.find(part, at + 1)
        part = part.partition("::")[2]
    return None


if __name__ == "__main__":
    begin()
    serve(measure)
