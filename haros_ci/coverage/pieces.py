# SPDX-License-Identifier: Apache-2.0
"""Files as pieces: functions, classes, and what is outside of both, each with the words that it mentions."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from heapq import heappop, heappush

from haros_ci.coverage.blanked import closings
from haros_ci.index.index import Source
from haros_ci.records import dataclass
from haros_ci.regex import regex
from haros_ci.syntax import Class, Function

_WORDS = regex(r"(?<![\w\"'])[A-Za-z_]\w*")
#: A function that is declared or defined, with its type or class before it; the head of a class.
_DECLARED = regex(
    r"(?<![\w.])(?!(?:return|else|new|throw|case|co_return|co_await|delete|and|or|not)\b)"
    r"[A-Za-z_]\w*[\s>*&]+(?:\w+\s*::\s*)*(~?\w+)(?=\s*\()"
)
_HEAD = regex(r"\b(?:class|struct)\s+(?:[A-Z_]+\s+)?(\w+)(?=\s*(?:final\b|[:;{]))")
_DEFINED = regex(r"\b(?:def|class)[ \t]+(\w+)")
#: What registers plug-ins and components; it loads none.
_REGISTERING = regex(
    r"\b(?:PLUGINLIB_\w+|RCLCPP_COMPONENTS_REGISTER_NODE|CLASS_LOADER_REGISTER_CLASS"
    r"|(?:GZ|IGN|IGNITION|GAZEBO)_(?:REGISTER|ADD)_\w+)\s*\([^()]{0,400}\)"
)
#: How often the characters of a file are read for its functions and classes, which stand in one another: what is left then stays outside.
_MOST_READ = 50


@dataclass(slots=True, eq=False)
class Piece:
    """A function, a class without its functions, or what is outside of both; *name* is the last part of its name.

    *owner* is the last part of the name of the class that a method is of.
    """

    path: str
    begin: int
    end: int
    words: frozenset[str]
    name: str = ""
    owner: str = ""
    function: Function | None = None
    definition: Class | None = None
    is_python: bool = False


def last_name(name: str) -> str:
    """The last part of a name of C++ or Python."""
    return name.rpartition("::")[2].rpartition(".")[2]


def around(pieces: Iterable[Piece], offsets: Iterable[int]) -> dict[int, Piece]:
    """The innermost of a file's *pieces* around each of the *offsets* that stands in any."""
    every = sorted(pieces, key=lambda piece: piece.begin, reverse=True)
    found: dict[int, Piece] = {}
    active: list[tuple[int, int, int, Piece]] = []
    for offset in sorted(offsets):
        while every and every[-1].begin <= offset:
            piece = every.pop()
            heappush(active, (-piece.begin, piece.end, len(every), piece))
        while active and active[0][1] <= offset:
            heappop(active)
        if active:
            found[offset] = active[0][3]
    return found


def pieces_of(source: Source, text: str) -> Iterator[Piece]:
    """The pieces of a file whose blanked text is *text*: what is outside of functions and classes first."""
    lines = [0, *(found.end() for found in re.finditer(r"\n", text))]
    is_python = source.separator == "."
    functions = [
        function
        for function in source.program.functions
        if function.kind not in ("lambda", "module") and function.body is not None
    ]
    spans = list(_spans(functions, is_python, text, lines))
    outside = list(text)
    made = []
    for function, (begin, end) in spans:
        name = function.name.rpartition(source.separator)[2]
        words = _words(text[begin:end], is_python)
        made.append(Piece(source.path, begin, end, words, name, last_name(function.owner), function, None, is_python))
    for _, (begin, end) in spans:
        outside[begin:end] = " " * (end - begin)
    if not is_python:
        code = "".join(outside)
        closing = closings(code)
        left = _MOST_READ * len(text)
        inner = sorted(source.program.classes, key=lambda class_: (-class_.line, -class_.column))
        for definition in inner:  # those within others come after them: they are taken out first
            area = _class_span(definition, code, lines, closing)
            if area is None or left <= 0:
                continue
            begin, end = area
            left -= end - begin
            name = last_name(definition.name)
            words = _words("".join(outside[begin:end]), is_python) - {name}
            made.append(Piece(source.path, begin, end, words, name, name, None, definition))
            outside[begin:end] = " " * (end - begin)
    yield Piece(source.path, 0, len(text), _words("".join(outside), is_python), is_python=is_python)
    yield from made


def _spans(
    functions: Iterable[Function], is_python: bool, text: str, lines: list[int]
) -> Iterator[tuple[Function, tuple[int, int]]]:
    """Where functions begin and end in their file's text."""
    closing = {} if is_python else closings(text)
    left = _MOST_READ * len(text)
    for function in functions:
        span = _span(function, is_python, text, lines, closing)
        if span is not None:
            yield function, span
            left -= span[1] - span[0]
            if left <= 0:
                return


def _span(
    function: Function, is_python: bool, text: str, lines: list[int], closing: dict[int, int]
) -> tuple[int, int] | None:
    if not 0 < function.line <= len(lines):
        return None
    begin = lines[function.line - 1]
    if is_python:
        return begin, _indented(text, begin)
    begin += max(function.column - 1, 0)
    if not 0 < function.body_line <= len(lines):
        return None
    brace = text.find("{", lines[function.body_line - 1] + max(function.body_column - 1, 0))
    return (min(begin, brace), closing.get(brace, len(text) - 1) + 1) if brace >= 0 else None


def _class_span(definition: Class, text: str, lines: list[int], closing: dict[int, int]) -> tuple[int, int] | None:
    if not 0 < definition.line <= len(lines):
        return None
    begin = lines[definition.line - 1]
    brace = text.find("{", begin)
    return (begin, closing.get(brace, len(text) - 1) + 1) if brace >= 0 else None


def _indented(text: str, begin: int) -> int:
    """The end of the block that the line at *begin* opens: before the first line that is indented no deeper."""
    depth = -1
    brackets = 0
    at = begin
    while at < len(text):
        end = text.find("\n", at)
        end = len(text) if end < 0 else end
        line = text[at:end]
        bare = line.strip()
        indent = len(line) - len(line.lstrip())
        if depth < 0:
            depth = indent
        elif bare and brackets <= 0 and indent <= depth and bare[0] not in ")]}\"'":
            return at
        brackets += line.count("(") + line.count("[") - line.count(")") - line.count("]")
        at = end + 1
    return len(text)


def _words(text: str, is_python: bool) -> frozenset[str]:
    """The names that a text mentions, but for those that it only declares, defines or registers."""
    if is_python:
        spans = {found.start(1) for found in _DEFINED.finditer(text)}
    else:
        text = _REGISTERING.sub(" ", text)
        spans = {found.start(1) for pattern in (_DECLARED, _HEAD) for found in pattern.finditer(text)}
    return frozenset(found[0] for found in _WORDS.finditer(text) if found.start() not in spans)
