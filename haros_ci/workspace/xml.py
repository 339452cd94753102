# SPDX-License-Identifier: Apache-2.0
"""XML of unknown origin as elements that know their lines: no DTD, no entities, bounded depth and number."""

from __future__ import annotations

from haros_ci.model.element import Element
from haros_ci.model.xml_faults import hyphens

MAX_DEPTH = 100
MAX_ELEMENTS = 100_000


class XmlError(ValueError):
    """Not well-formed, or refused; *line* is 1-based."""

    def __init__(self, message: str, line: int) -> None:
        super().__init__(message)
        self.message = message
        self.line = line


def parse_xml(data: bytes) -> Element:
    """The root element of *data*. XmlError says what is wrong, and where."""
    from xml.parsers import expat

    parser = expat.ParserCreate()
    parser.buffer_text = True
    top = Element("", {}, 1)
    open_elements = [top]
    count = 0

    def start(tag: str, attributes: dict[str, str]) -> None:
        nonlocal count
        count += 1
        if len(open_elements) > MAX_DEPTH:
            raise XmlError(f"nested deeper than {MAX_DEPTH} elements", parser.CurrentLineNumber)
        if count > MAX_ELEMENTS:
            raise XmlError(f"more than {MAX_ELEMENTS} elements", parser.CurrentLineNumber)
        element = Element(tag, attributes, parser.CurrentLineNumber, column=parser.CurrentColumnNumber + 1)
        open_elements[-1].children.append(element)
        open_elements.append(element)

    def end(_: str) -> None:
        open_elements.pop()

    def text(characters: str) -> None:
        open_elements[-1].text += characters

    def refuse(*_: object) -> None:
        raise XmlError("a document type or entity declaration is not allowed; remove it", parser.CurrentLineNumber)

    parser.StartElementHandler = start
    parser.EndElementHandler = end
    parser.CharacterDataHandler = text
    parser.StartDoctypeDeclHandler = refuse
    parser.EntityDeclHandler = refuse
    try:
        parser.Parse(data, True)
    except expat.ExpatError as err:
        what = hyphens(data, parser.ErrorByteIndex) or expat.ErrorString(err.code)
        raise XmlError(f"not well-formed XML: {what}", err.lineno) from err
    except (LookupError, ValueError) as err:
        if isinstance(err, XmlError):
            raise
        raise XmlError("unknown character encoding; save it as UTF-8", 1) from err
    return top.children[0]
