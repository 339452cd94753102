# SPDX-License-Identifier: Apache-2.0
"""The unknowns of a node by stable names, ``advertise@name1``, and the entries of a project file that fill them.

HAROS counts over the whole run, so its names change with any change; these count within a node, in order of location.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

from haros_ci.declared.declared import LINKS, Reading, end_keys, is_name, near
from haros_ci.graph.names import resolve
from haros_ci.model.architecture import Condition, Configuration, Endpoint, Node
from haros_ci.model.location import Location
from haros_ci.model.package import Package
from haros_ci.records import dataclass

#: What HAROS calls the calls that make endpoints; those of actions are ours.
CALLS = {
    "publishers": "advertise",
    "subscribers": "subscribe",
    "servers": "advertiseService",
    "clients": "serviceClient",
    "action_servers": "actionServer",
    "action_clients": "actionClient",
    "getters": "getParam",
    "setters": "setParam",
}
#: The attributes that can be unknown, as HAROS calls them, with a value to show in an example.
ATTRIBUTES: dict[str, str] = {
    "name": '"/full/name"',
    "namespace": '"/namespace"',
    "type": '"package/Type"',
    "location": '{"package": "package", "file": "src/file.cpp", "line": 1, "column": 1}',
    "conditions": "false",
    "queue_size": "10",
    "latched": "false",
    "default_value": "0",
    "value": "0",
}
MAX_LISTED = 5


@dataclass(frozen=True, slots=True)
class UnknownAttribute:
    """An unknown of the endpoint at *index* of a node; *name* is ``KEY@attributeN``."""

    name: str
    attribute: str
    index: int
    reason: str
    location: Location | None

    @property
    def example(self) -> str:
        return f'"{self.name}": {ATTRIBUTES[self.attribute]}'


def variables(node: Node) -> tuple[UnknownAttribute, ...]:
    """The unknowns of *node*; N counts those of one key and attribute from 1, in order of location."""
    found = []
    counts: Counter[str] = Counter()
    for index in sorted(range(len(node.endpoints)), key=lambda i: _place(node.endpoints[i])):
        end = node.endpoints[index]
        reasons = _reasons(end)
        for attribute in ATTRIBUTES:
            if attribute in reasons and end.kind in CALLS:
                stem = f"{CALLS[end.kind]}@{attribute}"
                counts[stem] += 1
                reason, location = reasons[attribute]
                found.append(UnknownAttribute(f"{stem}{counts[stem]}", attribute, index, reason, location))
    return tuple(found)


def fill(configuration: Configuration, fix: object, reading: Reading, packages: Sequence[Package]) -> Configuration:
    """*configuration* with the entries of a ``fix`` map, ``{advertise@name1: value}`` or ``{/node: {...}}``.

    An entry that fits no single unknown is said, with the unknowns there are.
    """
    there = [(n, variable) for n, node in enumerate(configuration.nodes) for variable in variables(node)]
    chosen: list[tuple[int, UnknownAttribute, object]] = []
    for key, value in reading.map(fix, "hints.fix").items():
        if not key.startswith("/"):
            chosen += _fitting(configuration, there, key, value, "hints.fix", reading)
            continue
        indices = [n for n, node in enumerate(configuration.nodes) if node.name == key]
        if not indices:
            reading.say(f"hints.fix: there is no node {key!r}{near(key, (n.name for n in configuration.nodes))}")
        here = [pair for pair in there if pair[0] in indices]
        for name, item in reading.map(value, f"hints.fix.{key}").items() if indices else ():
            chosen += _fitting(configuration, here, name, item, f"hints.fix.{key}", reading, key)
    nodes = list(configuration.nodes)
    for n, variable, value in chosen:
        ends = list(nodes[n].endpoints)
        ends[variable.index] = _filled(nodes[n], ends[variable.index], variable, value, reading, packages)
        nodes[n] = replace(nodes[n], endpoints=tuple(ends))
    return replace(configuration, nodes=tuple(nodes))


def edited(
    end: Endpoint, fields: Mapping[str, Any], reading: Reading, packages: Sequence[Package], at: str
) -> Endpoint:
    """*end* with the values of a hint, in HAROS's words; its names stay. What changes has the source ``hint``."""
    _, type_key, value_key, _ = LINKS[end.kind]
    new: dict[str, Any] = {name: fields[name] for name in ("queue_size", "latched") if name in fields}
    if type_key in fields:
        new["type"] = fields[type_key]
    if value_key and value_key in fields:
        new["value"] = fields[value_key]
    new |= surroundings(end.location, end.conditions, fields, reading, packages, at)
    done = {*new, *(("value", "default_value") if "value" in new else ())}
    result = replace(end, **new, unknowns=tuple(why for why in end.unknowns if why.field not in done))
    return result if result == end else replace(result, source="hint")


def named(end: Endpoint, original: str, name: str) -> Endpoint:
    """*end* with other names."""
    known = "?" not in name and "?" not in original
    known_fields = ("name", "original_name", "namespace") if known else ()
    unknowns = tuple(why for why in end.unknowns if why.field not in known_fields)
    result = replace(end, name=name, original_name=original, unknowns=unknowns)
    return result if result == end else replace(result, source="hint")


def surroundings(
    location: Location | None,
    conditions: tuple[Condition, ...],
    fields: Mapping[str, Any],
    reading: Reading,
    packages: Sequence[Package],
    at: str,
) -> dict[str, Any]:
    """``traceability`` and ``conditional`` of a hint as attributes; a condition that only a hint knows is ``if ?``."""
    new: dict[str, Any] = {}
    if "traceability" in fields:
        new["location"] = _located(location, fields["traceability"], reading, packages, at)
    if "conditional" in fields:
        assumed = (Condition("if", "?", Location(reading.where)),)
        new["conditions"] = (conditions or assumed) if fields["conditional"] else ()
    return new


def resolved(name: str, node: str) -> str:
    """A graph resource name as the node with the full name *node* resolves it (wiki.ros.org/Names)."""
    return resolve(name, node.rpartition("/")[0], node)


def _reasons(end: Endpoint) -> dict[str, tuple[str, Location | None]]:
    """Why, by attribute, parts of *end* are unknown."""
    found: dict[str, tuple[str, Location | None]] = {}
    for why in end.unknowns:
        attribute = "name" if why.field == "original_name" else why.field
        if attribute in ("value", "default_value"):
            attribute = LINKS[end.kind][2] if end.kind in LINKS else attribute
        exact = why.location if why.location and why.location.line else None
        found.setdefault(attribute, (why.reason, exact or end.location or why.location))
    if "?" in end.name and "namespace" not in found:
        found.setdefault("name", ("", end.location))
    if end.type is None or "?" in end.type:
        found.setdefault("type", ("", end.location))
    return found


def _fitting(
    configuration: Configuration,
    there: Sequence[tuple[int, UnknownAttribute]],
    name: str,
    value: object,
    at: str,
    reading: Reading,
    node: str | None = None,
) -> Iterator[tuple[int, UnknownAttribute, object]]:
    fits = [pair for pair in there if pair[1].name == name]
    if len(fits) == 1:
        yield *fits[0], value
        return
    names = {n: configuration.nodes[n].name for n, _ in there}
    count = f"{len(fits)} unknowns are" if fits else "no unknown is"
    message = f"{at}: {count} called {name[:60]!r}{'' if fits else near(name, (v.name for _, v in there))}"
    listed = [
        f"{names[n]} {v.name} ({'; '.join(filter(None, (str(v.location or ''), v.reason)))})" for n, v in fits or there
    ]
    if not listed:
        reading.say(f"{message}: nothing is unknown in {node or 'any node'}; remove the entry")
        return
    rest = f" and {len(listed) - MAX_LISTED} more" if len(listed) > MAX_LISTED else ""
    alike = [pair for pair in there if pair[1].name.rstrip("0123456789") == name.rstrip("0123456789")]
    n, variable = (alike or there)[0]
    entry = f'fix: {{"{names[n]}": {{{variable.example}}}}}'
    reading.say(f"{message}; there are: {', '.join(listed[:MAX_LISTED])}{rest}; write for example {entry}")


def _filled(
    node: Node, end: Endpoint, variable: UnknownAttribute, value: object, reading: Reading, packages: Sequence[Package]
) -> Endpoint:
    at = f"hints.fix: {variable.name}"
    if variable.attribute in ("name", "namespace"):
        return _name_filled(node, end, variable, value, reading, at)
    words = {"type": LINKS[end.kind][1], "location": "traceability", "conditions": "conditional"}
    key = words.get(variable.attribute, variable.attribute)
    if key in ("queue_size", "latched") and key not in end_keys(end.kind):
        return end
    return edited(end, reading.fields({key: value}, (key,), at), reading, packages, at)


def _name_filled(
    node: Node, end: Endpoint, variable: UnknownAttribute, value: object, reading: Reading, at: str
) -> Endpoint:
    if not (isinstance(value, str) and is_name(value)):
        reading.say(f"{at} must be a name as text")
        return end
    before = end.original_name if "?" in end.original_name else end.name
    is_space = variable.attribute == "namespace"
    if value[0] in "/~":
        whole = resolved(value, node.name) + (before.partition("?")[2] if is_space else "")
    elif before.count("?") == 1 or is_space:
        whole = before.replace("?", value, 1)
    else:
        parts = before.count("?")
        reading.say(f"{at}: {before} has {parts} unknown parts; give the full name, beginning with /")
        return end
    whole = resolved(whole, node.name)
    if "?" not in end.original_name:
        return named(end, end.original_name, whole)
    return named(end, whole, dict(node.remaps).get(whole, whole))


def _located(
    location: Location | None, entry: Mapping[str, Any], reading: Reading, packages: Sequence[Package], at: str
) -> Location | None:
    """A location as ``traceability`` gives it; what it leaves out stays as it was."""
    path = location.path if location else None
    if "file" in entry:
        roots = {package.name: package.path for package in packages}
        if "package" in entry and entry["package"] not in roots:
            reading.say(f"{at}: there is no package {entry['package']!r}{near(entry['package'], roots)}")
            return location
        parts = [*roots.get(entry.get("package", ""), ".").split("/"), *entry["file"].split("/")]
        if entry["file"].startswith("/") or ".." in parts:
            reading.say(f"{at}: {entry['file']!r} must be relative to its package and inside it")
            return location
        path = "/".join(part for part in parts if part not in ("", "."))
    if not path:
        reading.say(f"{at}: a place needs a file")
        return location
    line = entry.get("line", location.line if location and "file" not in entry else None)
    column = entry.get("column", location.column if location and line == location.line else None)
    return Location(path, line or None, column or None)


def _place(end: Endpoint) -> tuple[str, int, int, int, int]:
    return end.location.sort_key if end.location else ("", 0, 0, 0, 0)
