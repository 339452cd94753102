# SPDX-License-Identifier: Apache-2.0
"""Texts of properties that stand in YAML or in files of their own, with the place in the file of each of their characters."""

from __future__ import annotations

from bisect import bisect_right
from typing import Any, ClassVar

from haros_ci.behaviour.tree import Place
from haros_ci.bounded_yaml import MERGE, TAG, Composer, Scalar, YamlFault, YamlLimits
from haros_ci.model.location import Location
from haros_ci.records import dataclass
from haros_ci.regex import regex

LIMITS = YamlLimits(1_000_000, 50, 100_000, 1_000)
_NUMBERS = {TAG + name for name in ("int", "float", "bool", "null")}
#: Anchors and tags in front of a value.
_BEFORE = regex(r"(?:[&!]\S*\s+)+")


class Lines:
    """The lines of a text."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.starts = [0, *(at + 1 for at, sign in enumerate(text) if sign == "\n")]

    def offset(self, line: int, column: int) -> int:
        """The offset of a line and a column, both from 0."""
        return min(self.starts[min(line, len(self.starts) - 1)] + column, len(self.text))

    def at(self, offset: int) -> tuple[int, int]:
        """Line and column of an offset, both from 1."""
        row = bisect_right(self.starts, offset)
        return row, offset - self.starts[row - 1] + 1


@dataclass(frozen=True, slots=True)
class Source:
    """A text in the file *path*: *offsets* are where its characters stand there, and where its end is; () if it is the file's text itself."""

    path: str
    text: str
    lines: Lines
    offsets: tuple[int, ...] = ()

    def location(self, at: Place) -> Location:
        """Where a part of the text stands in the file."""
        begin, end = at.offset, max(at.end, at.offset)
        if self.offsets:
            last = len(self.offsets) - 1
            begin, end = self.offsets[min(begin, last)], self.offsets[min(max(end - 1, 0), last)] + 1
        line, column = self.lines.at(begin)
        end_line, end_column = self.lines.at(max(end, begin))
        return Location(self.path, line, column, end_line, end_column)


@dataclass(frozen=True, slots=True)
class Value:
    """A scalar, list or map of a YAML file, its place there, and whether it is text."""

    data: Scalar | tuple[Value, ...] | dict[Scalar, Value]
    begin: int
    end: int
    is_text: bool = False
    size: int = 1


def read_yaml(lines: Lines) -> Value | None:
    """The one document of a YAML text; None if it is empty or none."""
    try:
        return _Composer(lines).document()
    except YamlFault:  # the reader of the project file says what is wrong with it
        return None


def source_of(path: str, lines: Lines, value: Value) -> Source:
    """The text that *value*, a text, is."""
    text = str(value.data)
    return Source(path, text, lines, _offsets(text, lines.text, value.begin, value.end))


def _offsets(text: str, raw: str, begin: int, end: int) -> tuple[int, ...]:
    """Where each character of a YAML scalar stands in *raw* between *begin* and *end*.

    Folding and quoting change white space, quotes and backslashes only, so that the others stand in the same order; a character that
    is written as an escape sequence has the place where the sequence is passed.
    """
    found: list[int] = []
    at = begin
    for sign in text:
        if not sign.isspace():
            here = at
            while here < end and raw[here] != sign and (raw[here].isspace() or raw[here] in "\"'\\|>-+"):
                here += 1
            if here < end and raw[here] == sign:
                at = here
        elif at < end and not raw[at].isspace():
            while at < end and raw[at] in "\"'\\" and not raw[at].isspace():
                at += 1
        found.append(min(at, max(begin, end - 1)))
        at = min(at + 1, end)
    found.append(min(at, max(begin, end - 1)))
    return tuple(found)


class _Composer(Composer[Value]):
    is_single: ClassVar = True

    def __init__(self, lines: Lines) -> None:
        super().__init__(lines.text, LIMITS)
        self.lines = lines

    def scalar(self, event: Any, tag: str) -> Scalar:
        if tag in _NUMBERS:
            try:
                return self.number(event, tag)
            except YamlFault:
                return str(event.value)
        return "<<" if tag == MERGE else str(event.value)

    def made(self, event: Any, data: Any, size: int) -> Value:
        begin, end = self._offset(event.start_mark), self._offset(event.end_mark)
        before = _BEFORE.match(self.lines.text, begin, end)
        if before is not None and isinstance(data, str):
            begin = before.end()
        return Value(data, begin, end, isinstance(data, str), size)

    def under(self, value: Value, event: Any) -> Value:
        return value

    def _offset(self, mark: Any) -> int:
        return self.lines.offset(mark.line, mark.column)
