# SPDX-License-Identifier: Apache-2.0
"""The robot that an expanded description declares, as urdfdom reads it: only what stands directly in the document's root counts."""

from __future__ import annotations

from collections.abc import Mapping

from haros_ci.model.robot import Joint, Limit, Link, Mesh, Robot
from haros_ci.robot.expand import expand
from haros_ci.robot.nodes import XmlNode
from haros_ci.robot.sources import DescriptionSources, Located, as_written
from haros_ci.robot.unknown import UNKNOWN, UnknownValue


def read_robot(
    sources: DescriptionSources,
    path: str,
    arguments: Mapping[str, str | UnknownValue] | None = None,
    *,
    legacy: bool = False,
    is_open: bool = False,
) -> Robot | None:
    """The description at *path* with xacro's *arguments* (UNKNOWN for a value that is not known); None if it is no XML.

    *legacy* and *is_open* are those of ``expand``.
    """
    expanded = expand(sources, path, arguments, legacy=legacy, is_open=is_open)
    root = expanded.root
    if root is None:
        return None
    links, meshes = [], []
    for node in root.all("link"):
        link = Link(name=node.given("name"), location=node.location, way=node.way, certain=node.certain)
        links.append(link)
        meshes += [_mesh(other_node, link, sources, path) for other_node in node.walk() if other_node.tag == "mesh"]
    return Robot(
        path=path,
        arguments=tuple(sorted((k, v if isinstance(v, str) else None) for k, v in (arguments or {}).items())),
        root=root.tag,
        name=root.given("name") if "name" in root.attributes else "",
        links=tuple(links),
        joints=tuple(_joint(node) for node in root.all("joint")),
        meshes=tuple(meshes),
        faults=expanded.faults,
        files=expanded.files,
        macros=expanded.macros,
        size=len(root.children),
        is_whole=expanded.is_whole and all(node.certain for node in root.children),
    )


def _mesh(node: XmlNode, link: Link, sources: DescriptionSources, path: str) -> Mesh:
    name = node.given("filename")
    located = sources.mesh(name, path) if name else Located()
    return Mesh(
        filename=as_written(name) if name else name,
        link=link.name,
        path=located.path,
        is_missing=located.is_missing,
        similar=located.similar,
        location=node.location,
        way=node.way,
        certain=node.certain and link.certain,
    )


def _joint(node: XmlNode) -> Joint:
    limit = next(node.all("limit"), None)
    mimic = next(node.all("mimic"), None)
    return Joint(
        name=node.given("name"),
        type=node.given("type"),
        parent=_end(node, "parent"),
        child=_end(node, "child"),
        limit=None if limit is None else _limit(limit),
        mimic=None if mimic is None else mimic.given("joint"),
        factor=None if mimic is None else _value(mimic, "multiplier"),
        offset=None if mimic is None else _value(mimic, "offset"),
        origin=_origin(node),
        location=node.location,
        way=node.way,
        certain=node.certain,
    )


def _end(node: XmlNode, tag: str) -> str | None:
    found = next(node.all(tag), None)
    return "" if found is None else found.given("link")


def _origin(node: XmlNode) -> tuple[str | None, str | None]:
    found = next(node.all("origin"), None)
    if found is None:
        return "", ""
    return (found.given("xyz"), found.given("rpy")) if found.certain else (None, None)


def _limit(node: XmlNode) -> Limit:
    values = {name: _value(node, name) for name in ("lower", "upper", "effort", "velocity")}
    return Limit(location=node.location, **values)


def _value(node: XmlNode, name: str) -> str | None:
    """An attribute as it comes out; None where it is not given, ``?`` where it is not known."""
    value = node.attributes.get(name)
    known = value if isinstance(value, str) else None
    return "?" if value is UNKNOWN or not node.certain else known
