# SPDX-License-Identifier: Apache-2.0
"""Files as pieces: functions, classes, and what is outside of both, each with the words that it mentions."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from haros_ci.coverage.blanked import closed
from haros_ci.index.index import Source
from haros_ci.syntax import Class, Function

_WORDS = re.compile(r"(?<![\w\"'])[A-Za-z_]\w*")
#: A function that is declared or defined, with its type or class before it; the head of a class.
_DECLARED = re.compile(
    r"(?<![\w.])(?!(?:return|else|new|throw|case|co_return|co_await|delete|and|or|not)\b)"
    r"[A-Za-z_]\w*[\s>*&]+(?:\w+\s*::\s*)*(~?\w+)(?=\s*\()"
)
_HEAD = re.compile(r"\b(?:class|struct)\s+(?:[A-Z_]+\s+)?(\w+)(?=\s*(?:final\b|[:;{]))")
_DEFINED = re.compile(r"\b(?:def|class)[ \t]+(\w+)")
#: What registers plug-ins and components; it loads none.
_REGISTERING = re.compile(
    r"\b(?:PLUGINLIB_\w+|RCLCPP_COMPONENTS_REGISTER_NODE|CLASS_LOADER_REGISTER_CLASS)\s*\([^()]{0,400}\)"
)


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


def last_name(name: str) -> str:
    """The last part of a name of C++ or Python."""
    return name.rpartition("::")[2].rpartition(".")[2]


def at(pieces: Mapping[str, Sequence[Piece]], path: str, offset: int) -> Piece | None:
    """The innermost piece around an offset of a file; None for a file without pieces."""
    around = [each for each in pieces.get(path, ()) if each.begin <= offset < each.end]
    return max(around, key=lambda each: (each.begin, -each.end)) if around else None


def pieces_of(source: Source, text: str) -> Iterator[Piece]:
    """The pieces of a file whose blanked text is *text*: what is outside of functions and classes first."""
    lines = [0, *(found.end() for found in re.finditer(r"\n", text))]
    is_python = source.separator == "."
    functions = [
        each for each in source.program.functions if each.kind not in ("lambda", "module") and each.body is not None
    ]
    spans = [(each, span) for each in functions if (span := _span(each, is_python, text, lines)) is not None]
    outside = list(text)
    made = []
    for function, (begin, end) in spans:
        name = function.name.rpartition(source.separator)[2]
        words = _words(text[begin:end], is_python)
        made.append(Piece(source.path, begin, end, words, name, last_name(function.owner), function))
    for _, (begin, end) in spans:
        outside[begin:end] = " " * (end - begin)
    if not is_python:
        left = "".join(outside)
        inner = sorted(source.program.classes, key=lambda each: (-each.line, -each.column))
        for definition in inner:  # those within others come after them: they are taken out first
            area = _class_span(definition, left, lines)
            if area is None:
                continue
            begin, end = area
            name = last_name(definition.name)
            words = _words("".join(outside[begin:end]), is_python) - {name}
            made.append(Piece(source.path, begin, end, words, name, name, None, definition))
            outside[begin:end] = " " * (end - begin)
    yield Piece(source.path, 0, len(text), _words("".join(outside), is_python))
    yield from made


def _span(function: Function, is_python: bool, text: str, lines: list[int]) -> tuple[int, int] | None:
    """Where a function begins and ends in its file's text."""
    if not 0 < function.line <= len(lines):
        return None
    begin = lines[function.line - 1]
    if is_python:
        return begin, _indented(text, begin)
    begin += max(function.column - 1, 0)
    if not 0 < function.body_line <= len(lines):
        return None
    brace = text.find("{", lines[function.body_line - 1] + max(function.body_column - 1, 0))
    return (min(begin, brace), closed(text, brace, len(text)) + 1) if brace >= 0 else None


def _class_span(definition: Class, text: str, lines: list[int]) -> tuple[int, int] | None:
    if not 0 < definition.line <= len(lines):
        return None
    begin = lines[definition.line - 1]
    brace = text.find("{", begin)
    return (begin, closed(text, brace, len(text)) + 1) if brace >= 0 else None


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
