# SPDX-License-Identifier: Apache-2.0
"""Elements of a robot description that know their file, before and after they are expanded."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.model.element import Element
from haros_ci.model.location import Location
from haros_ci.model.robot import Way
from haros_ci.records import dataclass, field
from haros_ci.robot.unknown import UnknownValue


@dataclass(slots=True)
class XmlNode:
    """An element. Attributes and text of an expanded one may be UNKNOWN; it is not *certain* under an unknown condition.

    *doubts* is the number of such conditions around it.
    """

    tag: str
    attributes: dict[str, str | UnknownValue]
    location: Location
    text: str | UnknownValue = ""
    children: list[XmlNode] = field(default_factory=list)
    certain: bool = True
    way: Way = ()
    doubts: int = 0

    def has_surely(self, child: XmlNode) -> bool:
        """Whether *child* is there wherever this element is."""
        return child.certain or 0 < child.doubts == self.doubts

    def given(self, name: str) -> str | None:
        """A known attribute; "" if it is not there, None if it is not known."""
        value = self.attributes.get(name, "")
        return value if isinstance(value, str) else None

    def all(self, *tags: str) -> Iterator[XmlNode]:
        return (child for child in self.children if child.tag in tags)

    def walk(self) -> Iterator[XmlNode]:
        """All elements below, in document order."""
        pending = list(reversed(self.children))
        while pending:
            node = pending.pop()
            yield node
            pending.extend(reversed(node.children))


def nodes_of(element: Element, path: str) -> XmlNode:
    """*element* and all below it, as parsed from *path*."""
    return XmlNode(
        element.tag,
        dict(element.attributes),
        Location(path, element.line, element.column),
        element.text,
        [nodes_of(child, path) for child in element.children],
    )
