# SPDX-License-Identifier: Apache-2.0
"""The texts of a package.xml: its description, its people, where to find more (REP 149)."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from haros_ci.model.manifest import Manifest
from haros_ci.workspace.xml import XmlError, parse_xml

MOST_PEOPLE = 1000
#: A tag right below the outermost one: its name, its attributes, all text in it.
ManifestTag = tuple[str, Mapping[str, str], str]


def read_manifest(data: bytes) -> Manifest:
    """What the manifest *data* tells people; nothing, where it cannot be read (which is a finding elsewhere)."""
    try:
        parse_xml(data)  # refuses what must not be read
    except XmlError:
        return Manifest()
    elements = _tags(data)
    addresses = {attributes.get("type", "website"): text for tag, attributes, text in elements if tag == "url"}
    return Manifest(
        description=next((text for tag, _, text in elements if tag == "description"), ""),
        authors=_people(elements, "author"),
        maintainers=_people(elements, "maintainer"),
        website=addresses.get("website", ""),
        repository=addresses.get("repository", ""),
        bugtracker=addresses.get("bugtracker", ""),
    )


def _people(elements: Iterable[ManifestTag], tag: str) -> tuple[str, ...]:
    return tuple(dict.fromkeys(text for own, _, text in elements if own == tag and text))[:MOST_PEOPLE]


def _tags(data: bytes) -> list[ManifestTag]:
    """The tags in document order; of markup in them (descriptions may be XHTML) the text stays."""
    from xml.parsers import expat

    found: list[tuple[str, Mapping[str, str], list[str]]] = []
    depth = 0

    def start(tag: str, attributes: dict[str, str]) -> None:
        nonlocal depth
        depth += 1
        if depth == 2:
            found.append((tag, attributes, []))

    def end(_: str) -> None:
        nonlocal depth
        depth -= 1

    def text(characters: str) -> None:
        if depth >= 2:
            found[-1][2].append(characters)

    parser = expat.ParserCreate()
    parser.StartElementHandler = start
    parser.EndElementHandler = end
    parser.CharacterDataHandler = text
    parser.Parse(data, True)
    return [(tag, attributes, " ".join("".join(parts).split())) for tag, attributes, parts in found]
