# SPDX-License-Identifier: Apache-2.0
"""Reading a tool's XML with expat alone: no DTD, no entities, no depth to speak of."""

from __future__ import annotations

from haros_ci.records import dataclass, field
from haros_ci.regex import regex

#: Characters that XML 1.0 does not allow (§2.2), which a tool may copy from a source; decoding leaves no surrogates.
_FORBIDDEN = regex("[\x00-\x08\x0b\x0c\x0e-\x1f\ufffe\uffff]")


@dataclass(slots=True)
class ToolElement:
    """An element of interest: its attributes, and those of the children that were asked for."""

    attributes: dict[str, str]
    children: list[dict[str, str]] = field(default_factory=list)


def elements(data: bytes, name: str, child: str) -> list[ToolElement]:
    """All elements called *name*, each with its children called *child*. Raises ValueError if *data* is not XML."""
    from xml.parsers import expat

    found: list[ToolElement] = []

    def start(tag: str, attributes: dict[str, str]) -> None:
        if tag == name:
            found.append(ToolElement(attributes))
        elif tag == child and found:
            found[-1].children.append(attributes)

    def refuse(*_: object) -> None:
        raise ValueError("a document type declaration")

    parser = expat.ParserCreate("utf-8")
    parser.StartElementHandler = start
    parser.StartDoctypeDeclHandler = refuse
    try:
        parser.Parse(_FORBIDDEN.sub("?", data.decode("utf-8", "replace")).encode("utf-8"), True)
    except expat.ExpatError as err:
        raise ValueError(f"not XML: {err}") from err
    return found
