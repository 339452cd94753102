# SPDX-License-Identifier: Apache-2.0
"""How a finding can be mended, where that is certain: edits of text, and a file made executable (SARIF §3.55)."""

from __future__ import annotations

from collections.abc import Iterable

from haros_ci.records import dataclass
from haros_ci.regex import regex

#: As editors and XML have it; ``str.splitlines`` knows more ends than they do.
LINE_END = regex(r"\r\n|\n|\r")
#: What some readers take for the end of a line and others do not: where it stands, lines are not counted alike.
_ODD_END = regex("\r(?!\n)|[\v\f\x1c-\x1e\x85\u2028\u2029]")
#: Line and column, 1-based; columns count Unicode code points (SARIF §3.30).
Point = tuple[int, int]


@dataclass(frozen=True, slots=True)
class Edit:
    """The text of *path* from *start* up to *end* becomes *text*; with both equal it is inserted.

    A point may be column 1 of the line after the last one: the end of the file. With *is_executable* the file's execute
    bits are set, and nothing else changes.
    """

    path: str
    start: Point = (1, 1)
    end: Point = (1, 1)
    text: str = ""
    is_executable: bool = False

    @classmethod
    def executable(cls, path: str) -> Edit:
        """Set the execute bits of *path*."""
        return cls(path, is_executable=True)


@dataclass(frozen=True, slots=True)
class Fix:
    """One way to mend a finding: all *edits* or none. *description* is an order: ``declare std_msgs``."""

    description: str
    edits: tuple[Edit, ...]


def is_counted_alike(text: str) -> bool:
    """Whether all that read *text* agree on its lines, so that an edit stands where it is meant to."""
    return _ODD_END.search(text) is None


def applied(text: str, edits: Iterable[Edit]) -> str:
    """*text* after *edits* of it, given in any order; ValueError if two of them overlap or one lies outside."""
    starts = [0]  # of each line, and the end of the text
    starts += [end.end() for end in LINE_END.finditer(text)]
    if starts[-1] < len(text):
        starts.append(len(text))

    def offset(point: Point) -> int:
        line, column = point
        if not 1 <= line <= len(starts) or column < 1 or starts[line - 1] + column - 1 > len(text):
            raise ValueError(f"line {line}, column {column} is not in the text")
        return starts[line - 1] + column - 1

    parts, at = [], 0
    for start, end, new in sorted((offset(edit.start), offset(edit.end), edit.text) for edit in edits):
        if start < at or end < start:
            raise ValueError("two edits overlap")
        parts += [text[at:start], new]
        at = end
    return "".join((*parts, text[at:]))
