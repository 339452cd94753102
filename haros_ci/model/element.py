# SPDX-License-Identifier: Apache-2.0
"""An element of an XML document, with its line."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.records import dataclass, field


@dataclass(slots=True)
class Element:
    """A tag; ``text`` is all character data directly in it."""

    tag: str
    attributes: dict[str, str]
    line: int
    text: str = ""
    children: list[Element] = field(default_factory=list)
    column: int = 1

    def all(self, *tags: str) -> Iterator[Element]:
        """The children with one of *tags*, in document order."""
        return (child for child in self.children if child.tag in tags)
