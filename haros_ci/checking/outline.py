# SPDX-License-Identifier: Apache-2.0
"""Where the elements of an XML text begin and end, for edits of it. The text is well-formed: an Element was made of it."""

from __future__ import annotations

import re
from bisect import bisect_right

from haros_ci.model.element import Element
from haros_ci.records import dataclass, field
from haros_ci.regex import regex
from haros_ci.results.fix import Edit, Point

_PIECE = regex(
    r"<!--.*?-->|<!\[CDATA\[.*?\]\]>|<\?.*?\?>|<(?P<close>/)?(?P<tag>[^\s/<>!?]+)(?=[\s/>])(?P<rest>(?:[^<>\"']|\"[^\"]*\"|'[^']*')*)>",
    re.S,
)


@dataclass(slots=True)
class Span:
    """An element of the text: [start, end) is all of it, [open, close) what stands between its tags.

    *name* is where its name stands in the opening tag, *closing* where it does in the closing one, None for ``<tag/>``.
    """

    tag: str
    start: int
    open: int
    close: int = 0
    end: int = 0
    closing: int | None = None
    children: list[Span] = field(default_factory=list)

    @property
    def name(self) -> int:
        return self.start + 1


class Outline:
    """The elements of *text*, found by the Element that was made of each."""

    def __init__(self, path: str, text: str, root: Element) -> None:
        self.path = path
        self.text = text
        self._starts = [0]
        for line in text.splitlines(keepends=True):
            self._starts.append(self._starts[-1] + len(line))
        self._spans: dict[int, Span] = {}
        top = _root(text)
        if top is not None:
            self._pair(root, top)

    def _pair(self, element: Element, span: Span) -> None:
        open_pairs = [(element, span)]
        while open_pairs:
            one, place = open_pairs.pop()
            if one.tag == place.tag and [c.tag for c in one.children] == [c.tag for c in place.children]:
                self._spans[id(one)] = place
                open_pairs += zip(one.children, place.children)

    def span(self, element: Element) -> Span | None:
        """Where *element* stands; None if the text is not the one it was made of."""
        return self._spans.get(id(element))

    def point(self, offset: int) -> Point:
        """Line and column of *offset*, as edits count them."""
        line = bisect_right(self._starts, offset) - 1
        return line + 1, offset - self._starts[line] + 1

    def edit(self, start: int, end: int, text: str) -> Edit:
        """[start, end) becomes *text*."""
        return Edit(self.path, self.point(start), self.point(end), text)

    def insert(self, offset: int, text: str) -> Edit:
        return self.edit(offset, offset, text)

    @property
    def newline(self) -> str:
        """How lines end in it."""
        return "\r\n" if "\r\n" in self.text[:1000] else "\n"

    def indentation(self, span: Span) -> str | None:
        """The white space before *span*; None if anything else stands before it on its line."""
        before = self.text[self.text.rfind("\n", 0, span.start) + 1 : span.start]
        return before if not before.strip() else None

    def line_end(self, offset: int) -> int | None:
        """Where the line after *offset* begins; None if anything but white space and whole comments stands in between."""
        found = re.compile(r"[ \t]*(?:<!--(?:(?!-->)[^\n])*-->[ \t]*)*(?:\r?\n)").match(self.text, offset)
        return found.end() if found is not None else None

    def is_alone(self, span: Span) -> bool:
        """Whether nothing but a comment shares its lines with it."""
        return self.indentation(span) is not None and self.line_end(span.end) is not None


def _root(text: str) -> Span | None:
    """The outermost element of *text* with all that is in it; None if its tags do not pair."""
    top = Span("", 0, 0)
    open_spans = [top]
    for piece in _PIECE.finditer(text):
        tag = piece["tag"]
        if tag is None:
            continue
        if piece["close"]:
            span = open_spans.pop()
            if not open_spans or span.tag != tag:
                return None
            span.close, span.end, span.closing = piece.start(), piece.end(), piece.start() + 2
            continue
        span = Span(tag, piece.start(), piece.end())
        open_spans[-1].children.append(span)
        if piece["rest"].endswith("/"):
            span.close = span.end = piece.end()
        else:
            open_spans.append(span)
    return top.children[0] if len(open_spans) == 1 and top.children else None
