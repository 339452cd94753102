# SPDX-License-Identifier: Apache-2.0
"""The texts of a package.xml: its description, its people, where to find more (REP 149)."""

from __future__ import annotations

from haros_ci.model.element import Element
from haros_ci.model.manifest import Manifest
from haros_ci.workspace.xml import XmlError, parse_xml

MOST_PEOPLE = 1000


def read_manifest(data: bytes) -> Manifest:
    """What the manifest *data* tells people; nothing, where it cannot be read (which is a finding elsewhere)."""
    try:
        root = parse_xml(data)
    except XmlError:
        return Manifest()
    addresses: dict[str, str] = {}
    for url in root.all("url"):
        addresses[url.attributes.get("type", "website")] = _text(url)
    return Manifest(
        description=next((_text(each) for each in root.all("description")), ""),
        authors=_people(root, "author"),
        maintainers=_people(root, "maintainer"),
        website=addresses.get("website", ""),
        repository=addresses.get("repository", ""),
        bugtracker=addresses.get("bugtracker", ""),
    )


def _people(root: Element, tag: str) -> tuple[str, ...]:
    names = [_text(each) for each in root.all(tag)][:MOST_PEOPLE]
    return tuple(dict.fromkeys(name for name in names if name))


def _text(element: Element) -> str:
    """All text in *element*, what stands directly in it first (descriptions may be XHTML)."""
    return " ".join(" ".join((element.text, *(_text(child) for child in element.children))).split())
