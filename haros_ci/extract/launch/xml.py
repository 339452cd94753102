# SPDX-License-Identifier: Apache-2.0
"""A launch file in XML as a tree of tags that know their places: no DTD, no entities, bounded depth and number."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from haros_ci.model.launch import LaunchElement, LaunchFile
from haros_ci.model.xml_faults import hyphens
from haros_ci.records import dataclass, field

MAX_DEPTH = 100
MAX_ELEMENTS = 100_000


#: Characters of a tag that a message shows.
_LONGEST = 60
_MEANS = {
    "not well-formed (invalid token)": "such as & or < in a text, which are &amp; and &lt;, or an attribute without quotes",
    "junk after document element": "something stands behind the end of <launch>",
    "duplicate attribute": "one stands twice in this tag",
    "unbound prefix": "the tag of the file lacks xmlns: for it",
}


class _Refused(Exception):
    """The file is well-formed so far, but not accepted."""


@dataclass(slots=True)
class _Open:
    tag: str
    line: int
    column: int
    attributes: tuple[tuple[str, str], ...]
    text: list[str] = field(default_factory=list)
    length: int = 0
    next_line: int = 0
    text_lines: list[tuple[int, int]] = field(default_factory=list)
    children: list[LaunchElement] = field(default_factory=list)

    def add_text(self, characters: str, line: int) -> None:
        if line != self.next_line or not self.text:
            self.text_lines.append((self.length, line))
        self.text.append(characters)
        self.length += len(characters)
        self.next_line = line + characters.count("\n")

    def close(self) -> LaunchElement:
        text = "".join(self.text)
        lines = tuple(self.text_lines)
        if not text.strip():
            text, lines = "", ()
        return LaunchElement(self.tag, self.line, self.column, self.attributes, text, lines, tuple(self.children))


class _Places:
    """Turns growing byte offsets into lines and columns; lines end at line feeds, columns count code points."""

    def __init__(self, data: bytes) -> None:
        self.data = data
        self.offset = 0
        self.line = 1
        self.column = 1

    def at(self, offset: int) -> tuple[int, int]:
        breaks = self.data.count(b"\n", self.offset, offset)
        if breaks:
            self.line += breaks
            self.column = 1
            self.offset = self.data.rfind(b"\n", self.offset, offset) + 1
        self.column += len(self.data[self.offset : offset].decode("utf-8", "replace"))
        self.offset = offset
        return self.line, self.column


def read_launch(text: str) -> LaunchFile:
    """The tags of a launch file, ROS 1 or ROS 2, with what is wrong with it as XML; never raises.

    Document types and entity declarations are refused; nesting and number of tags are bounded.
    """
    from xml.parsers import expat

    data = text.removeprefix("\ufeff").encode("utf-8", "replace")
    places = _Places(data)
    parser = expat.ParserCreate("utf-8")
    parser.ordered_attributes = True
    parser.buffer_text = False
    top = _Open("", 1, 1, ())
    opened = [top]
    count = 0

    def start(tag: str, attributes: Any) -> None:
        nonlocal count
        count += 1
        if len(opened) > MAX_DEPTH:
            raise _Refused(f"tags nested deeper than {MAX_DEPTH} levels; flatten the file")
        if count > MAX_ELEMENTS:
            raise _Refused(f"more than {MAX_ELEMENTS} tags; split the file")
        line, column = places.at(parser.CurrentByteIndex)
        pairs = tuple(zip(attributes[::2], attributes[1::2], strict=True))
        opened.append(_Open(tag, line, column, pairs))

    def end(_: str) -> None:
        closed = opened.pop().close()
        opened[-1].children.append(closed)

    def characters(part: str) -> None:
        opened[-1].add_text(part, places.at(parser.CurrentByteIndex)[0])

    def refuse(*_: object) -> None:
        raise _Refused("a document type or entity declaration is not allowed; remove it")

    parser.StartElementHandler = start
    parser.EndElementHandler = end
    parser.CharacterDataHandler = characters
    parser.StartDoctypeDeclHandler = refuse
    parser.EntityDeclHandler = refuse
    try:
        parser.Parse(data, True)
    except expat.ExpatError as err:
        line, _ = _Places(data).at(max(parser.ErrorByteIndex, 0))
        what = hyphens(data, parser.ErrorByteIndex) or expat.ErrorString(err.code)
        return LaunchFile(None, ((line, _fault(what, opened[1:])),))
    except _Refused as err:
        return LaunchFile(None, ((places.at(parser.CurrentByteIndex)[0], str(err)),))
    return LaunchFile(top.children[0])


def _fault(problem: str, opened: Sequence[_Open]) -> str:
    """What is wrong, in the words of expat, with the tag that is still open where that is what is missing."""
    if problem in ("mismatched tag", "no element found", "unclosed token") and opened:
        problem += f", while <{opened[-1].tag[:_LONGEST]}> of line {opened[-1].line} is open"
    elif problem in _MEANS:
        problem += f" ({_MEANS[problem]})"
    return f"the launch file is not well-formed XML: {problem}; correct it"


def to_json(launch: LaunchFile) -> object:
    """*launch* as lists, strings and numbers, for the cache."""
    return [None if launch.root is None else _element_to_json(launch.root), [list(p) for p in launch.problems]]


def from_json(value: object) -> LaunchFile | None:
    """What to_json made; None if *value* has another shape (a cache is not trusted)."""
    try:
        root, problems = _list(value, 2)
        pairs = tuple((_int(line), _str(message)) for line, message in (_list(p, 2) for p in _list(problems)))
        return LaunchFile(None if root is None else _element_from_json(root, 0), pairs)
    except TypeError:
        return None


def _element_to_json(element: LaunchElement) -> list[object]:
    return [
        element.tag,
        element.line,
        element.column,
        [list(pair) for pair in element.attributes],
        element.text,
        [list(pair) for pair in element.text_lines],
        [_element_to_json(child) for child in element.children],
    ]


def _element_from_json(value: object, depth: int) -> LaunchElement:
    if depth > MAX_DEPTH:
        raise TypeError
    tag, line, column, attributes, text, lines, children = _list(value, 7)
    return LaunchElement(
        _str(tag),
        _int(line),
        _int(column),
        tuple((_str(name), _str(content)) for name, content in (_list(a, 2) for a in _list(attributes))),
        _str(text),
        tuple((_int(offset), _int(number)) for offset, number in (_list(n, 2) for n in _list(lines))),
        tuple(_element_from_json(child, depth + 1) for child in _list(children)),
    )


def _list(value: object, length: int | None = None) -> Sequence[object]:
    if not isinstance(value, list) or (length is not None and len(value) != length):
        raise TypeError
    return value


def _str(value: object) -> str:
    if not isinstance(value, str):
        raise TypeError
    return value


def _int(value: object) -> int:
    if not isinstance(value, int) or isinstance(value, bool):
        raise TypeError
    return value
