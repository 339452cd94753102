# SPDX-License-Identifier: Apache-2.0
"""Node types in NoDL, the Node Definition Language (version 1, XML), one ``<node>`` each.

The grammar is that of the schema ``v1.xsd`` of the package nodl_python, whose design page is "ROS 2 Node Interface
Definition Language" (ros2/design, pull request 266).
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from haros_ci.model.architecture import Architecture, Endpoint, Unknown
from haros_ci.regex import regex
from haros_ci.report.channels import is_known
from haros_ci.report.escape import REPLACEMENT, terminal
from haros_ci.report.message import shorten
from haros_ci.report.node_interface import Entry, Interface, interfaces

#: Per kind of end its element, its role, and the middle part of its type. Elements stand in the order of the schema.
ELEMENTS = {
    "action_clients": ("action", "client", "action"),
    "action_servers": ("action", "server", "action"),
    "parameters": ("parameter", "", ""),
    "publishers": ("topic", "publisher", "msg"),
    "subscribers": ("topic", "subscription", "msg"),
    "clients": ("service", "client", "srv"),
    "servers": ("service", "server", "srv"),
}
ORDER = ("action", "parameter", "topic", "service")
_ROLES = ("publisher", "subscription", "server", "client")
_NO_XML = regex("[\x00-\x08\x0b\x0c\x0e-\x1f\ud800-\udfff\ufffe\uffff]")


def render(architecture: Architecture, package: str | None = None) -> str:
    """One document for the node types of *package*, or of all; what is not known in full stands in comments only.

    The schema wants at least one node in an interface and one entry in a node: without, the document says so in a
    comment. A component or nodelet, which is no executable, stands with its class.
    """
    lines = ['<?xml version="1.0" encoding="UTF-8"?>', '<interface version="1">']
    last = None
    for item in interfaces(architecture):
        if package is None or item.package == package:
            if item.package != last:
                lines.append(f"  {_comment(f'package {item.package}')}")
                last = item.package
            lines += _node(item)
    if last is None:
        lines.append(f"  {_comment('no node was found')}")
    return "\n".join([*lines, "</interface>", ""])


def is_valid(architecture: Architecture, package: str | None = None) -> bool:
    """Whether the document is one by its schema, which wants a node in it."""
    return "\n  <node " in render(architecture, package)


def type_name(kind: str, type: str, ros: int) -> str:
    """A type as NoDL writes it: ``pkg/msg/T``; a parameter's ``string`` for ``str``."""
    if kind == "parameters":
        return type.replace("str", "string", 1) if type in ("str", "str[]") else type
    package, _, name = type.partition("/")
    return f"{package}/{ELEMENTS[kind][2]}/{name}" if ros == 1 and name and "/" not in name else type


def _node(item: Interface) -> Iterator[str]:
    known = [] if item.is_library else [e for e in item.entries if is_known(e.name) and is_known(e.type)]
    reported = dict(_elements(known, item.ros))
    left = [_left_out(entry, item.ros) for entry in item.entries if entry not in known]
    more = sorted({why.reason for node in item.nodes for why in node.unknowns if why.field == "endpoints"})
    left += [f"there may be more: {reason}" for reason in more]
    name = item.names[0]
    if not reported or not is_known(name) or not name:
        what = "no entry is known" if not reported else "the node's name is not known"
        what = "a class of a library, for the node of whoever uses it" if item.is_library else what
        yield f"  {_comment(f'left out: {item.type}: {what}')}"
        yield from (f"  {_comment(text)}" for text in left)
        return
    yield f"  <node name={_quoted(name)} executable={_quoted(item.type)}>"
    others = [other for other in item.names[1:] if is_known(other)]
    if others:
        yield f"    {_comment('also runs as ' + ', '.join(others))}"
    for (element, spelt, type), roles in sorted(reported.items(), key=lambda pair: (ORDER.index(pair[0][0]), pair[0])):
        role = f" role={_quoted(roles[0] if len(roles) == 1 else 'both')}" if roles != [""] else ""
        yield f"    <{element} name={_quoted(spelt)} type={_quoted(type)}{role} />"
    yield from (f"    {_comment(text)}" for text in left)
    yield "  </node>"


def _elements(entries: Iterable[Entry], ros: int) -> Iterator[tuple[tuple[str, str, str], list[str]]]:
    """Element, name and type, each with its roles."""
    found: dict[tuple[str, str, str], set[str]] = {}
    for entry in entries:
        element, role, _ = ELEMENTS[entry.kind]
        found.setdefault((element, entry.name, type_name(entry.kind, entry.type or "", ros)), set()).add(role)
    yield from ((key, sorted(roles)) for key, roles in found.items())


def _left_out(entry: Entry, ros: int) -> str:
    element, role, _ = ELEMENTS[entry.kind]
    why = sorted(
        {_reason(end, unknown) for end in entry.ends for unknown in end.unknowns if unknown.field in ("name", "type")}
    )
    type = type_name(entry.kind, entry.type, ros) if is_known(entry.type) else "?"
    what = f"left out: {element} name={entry.name} type={type}" + (f" role={role}" if role else "")
    return f"{what}: {'; '.join(why)}" if why else what


def _reason(end: Endpoint, unknown: Unknown) -> str:
    place = unknown.location if unknown.location and unknown.location.line else end.location
    return f"{unknown.reason} ({place})" if place else unknown.reason


def _quoted(text: str) -> str:
    escaped = _plain(text).replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;").replace('"', "&quot;")
    return f'"{escaped}"'


def _comment(text: str) -> str:
    """A comment, in which XML knows no two hyphens in a row."""
    return f"<!-- {re.sub('-(?=-)', '- ', shorten(_plain(text), 500))} -->"


def _plain(text: str) -> str:
    return _NO_XML.sub(REPLACEMENT, terminal(text))
