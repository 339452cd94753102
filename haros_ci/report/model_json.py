# SPDX-License-Identifier: Apache-2.0
"""The architecture as JSON, schema version 1 (``model-schema.json``): keys are added, never renamed.

Beside nodes, endpoints and parameters each configuration lists what the endpoints connect: topics, services, actions.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from dataclasses import fields, replace
from math import isfinite
from pathlib import PurePosixPath
from typing import Any

from haros_ci.model.architecture import (
    KINDS,
    PROVENANCES,
    Architecture,
    Condition,
    Configuration,
    Endpoint,
    Node,
    Parameter,
    Qos,
    Unknown,
)
from haros_ci.model.location import Location
from haros_ci.model.package import Package
from haros_ci.report.channels import (
    CHANNELS,
    UNKNOWN,
    Channel,
    channels,
    endpoints_of,
    nodes_of,
    parameters_of,
    place_key,
)
from haros_ci.report.escape import no_command, terminal
from haros_ci.report.model_dependence import dependence_of
from haros_ci.report.model_rates import rates_of

SCHEMA_VERSION = 1
_SCALARS = (bool, float, int, str, type(None))
_BROKEN_LEVELS = 6  # containers this deep stand on one line: an endpoint, a location
_DEEPEST = 50
_LARGEST = 10**300


def render(architecture: Architecture) -> str:
    """The document; ASCII, one endpoint a line, with a final newline. It has the same bytes for the same architecture.

    A location's package is the innermost one around its path, and its file is relative to that package. A value that
    JSON cannot hold is text: ``nan``, a date; what is nested deeper than anyone writes is ``?``.
    """
    return laid_out(document_of(architecture))


def document_of(architecture: Architecture) -> dict[str, Any]:
    """The document as JSON holds it. What is the same in several places, endpoints above all, is one object."""
    place = Places(architecture.packages)
    return {
        "schema_version": SCHEMA_VERSION,
        "configurations": [
            _configuration(item, place) for item in sorted(architecture.configurations, key=lambda item: item.name)
        ],
        "packages": [_package(item) for item in sorted(architecture.packages, key=lambda item: (item.name, item.path))],
        "problems": [
            {"path": item.path, "line": item.line, "message": terminal(item.message)}
            for item in sorted(architecture.problems, key=lambda item: (item.path, item.line or 0, item.message))
        ],
    }


def laid_out(document: Mapping[str, Any]) -> str:
    """The text of a *document*, as ``render`` gives it."""
    parts: list[str] = []
    _lay_out(document, 0, parts, {})
    return no_command("".join(parts)) + "\n"


def plain(value: object, depth: int = 0) -> Any:
    """*value* as JSON holds it; None stays None."""
    if value is None or isinstance(value, (bool, str)):
        return value
    if isinstance(value, int):
        return int(value) if abs(value) < _LARGEST else UNKNOWN
    if isinstance(value, float):
        return value if isfinite(value) else str(value)
    if depth >= _DEEPEST:
        return UNKNOWN
    if isinstance(value, Mapping):
        return {str(plain(key, depth + 1)): plain(item, depth + 1) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(item, depth + 1) for item in value]
    return value.hex() if isinstance(value, bytes) else str(value)


class Places:
    """Where packages are, to say a location by its package."""

    __slots__ = ("_locations", "_packages", "_split", "made")

    def __init__(self, packages: Iterable[Package]) -> None:
        self._packages = {package.path: package.name for package in packages}
        self._split: dict[str, tuple[str | None, str]] = {}
        self._locations: dict[Location, dict[str, Any]] = {}
        #: What has been made of endpoints: they stand in many configurations.
        self.made: dict[object, dict[str, Any]] = {}

    def split(self, path: str) -> tuple[str | None, str]:
        """The innermost package around *path* and the path in it; None and *path* outside any."""
        found = self._split.get(path)
        if found is None:
            found = self._split[path] = self._searched(path)
        return found

    def _searched(self, path: str) -> tuple[str | None, str]:
        whole = PurePosixPath(path)
        for folder in whole.parents:
            name = self._packages.get(str(folder))
            if name is not None:
                return name, str(whole.relative_to(folder))
        return None, path

    def location(self, location: Location | None) -> dict[str, Any] | None:
        if location is None:
            return None
        found = self._locations.get(location)
        if found is None:
            package, file = self.split(location.path)
            line, column = location.line, location.column
            found = {"package": package, "file": file, "path": location.path, "line": line, "column": column}
            self._locations[location] = found
        return found


def _configuration(configuration: Configuration, place: Places) -> dict[str, Any]:
    found = channels(configuration)
    return {
        "name": configuration.name,
        "launch": list(configuration.launch),
        "arguments": {name: str(plain(value)) for name, value in configuration.arguments},
        "nodes": [_node(node, place) for node in nodes_of(configuration)],
        "parameters": [_parameter(parameter, place) for parameter in parameters_of(configuration)],
        **{what: [_channel(item, place) for item in found if item.what == what] for what in CHANNELS},
        "user_data": plain(configuration.user_data),
        **({} if configuration.rates is None else {"rates": rates_of(configuration.rates, place.location)}),
        **({} if configuration.dependence is None else dependence_of(configuration.dependence, place.location)),
    }


def _node(node: Node, place: Places) -> dict[str, Any]:
    ends = endpoints_of(node)
    return {
        "name": node.name,
        "kind": node.kind,
        "package": node.package,
        "type": node.type,
        "class": node.class_name,
        "ros": node.ros,
        "container": node.container,
        "process": node.process,
        "args": node.arguments,
        "remaps": dict(node.remaps),
        "conditions": _conditions(node.conditions, place),
        "location": place.location(node.location),
        "source": node.source,
        "unknowns": _unknowns(node.unknowns, place),
        **{kind: [_endpoint(end, place) for end in ends if end.kind == kind] for kind in KINDS},
    }


def _endpoint(end: Endpoint, place: Places) -> dict[str, Any]:
    if not isinstance(end.value, _SCALARS) or not isinstance(end.effective, _SCALARS):
        return _endpoint_anew(end, place)
    qos = end.qos
    times = () if qos is None else (qos.depth, qos.deadline, qos.lifespan, qos.lease)
    # 1, 1.0 and True are equal, as 0.0 and -0.0 are, and are not written alike
    key = (end, *map(_exact, (end.value, end.effective, end.queue_size, *(end.range or ()), *times)))
    found = place.made.get(key)
    if found is None:
        found = place.made[key] = _endpoint_anew(end, place)
    return found


def _exact(value: object) -> object:
    """What differs between two values that are equal and not written alike."""
    return repr(value) if value.__class__ is float else value.__class__


def _endpoint_anew(end: Endpoint, place: Places) -> dict[str, Any]:
    return {
        "name": end.name,
        "original_name": end.original_name,
        "type": end.type,
        **_particulars(end),
        "implicit": end.implicit,
        "conditions": _conditions(end.conditions, place),
        **({"early_ways_out": _conditions(end.early_ways, place)} if end.early_ways else {}),
        **({"ruled_out": True} if end.is_ruled_out else {}),
        "location": place.location(end.location),
        "source": end.source,
        "unknowns": _unknowns((_of_key(why, end) for why in end.unknowns), place),
    }


def _of_key(why: Unknown, end: Endpoint) -> Unknown:
    """An unknown under the key of its field: of a declared parameter ``value`` is what it has, ``default`` the code's."""
    keys = {"value": "default", "effective": "value"} if end.kind == "parameters" else {}
    return replace(why, field=keys.get(why.field, why.field))


def _particulars(end: Endpoint) -> dict[str, Any]:
    match end.kind:
        case "publishers":
            return {"queue_size": _count(end.queue_size), "latched": end.latched, "qos": _qos(end.qos)}
        case "subscribers":
            return {"queue_size": _count(end.queue_size), "qos": _qos(end.qos)}
        case "servers" | "clients" | "action_servers" | "action_clients" if end.qos is not None:
            return {"qos": _qos(end.qos)}
        case "getters" | "setters":
            return {"value": plain(end.value)}
        case "parameters":
            limits = list(end.range) if end.range is not None else None
            provided = {"default": plain(end.value), "value": plain(end.effective)}
            return {**provided, "read_only": end.read_only, "range": limits}
        case _:
            return {}


def _qos(qos: Qos | None) -> dict[str, Any] | None:
    return None if qos is None else {field.name: plain(getattr(qos, field.name)) for field in fields(qos)}


def _count(value: int | None) -> int | None:
    return value if value is not None and abs(value) < _LARGEST else None


def _parameter(parameter: Parameter, place: Places) -> dict[str, Any]:
    return {
        "name": parameter.name,
        "type": parameter.type,
        "value": plain(parameter.value),
        "conditions": _conditions(parameter.conditions, place),
        "location": place.location(parameter.location),
        "origin": place.location(parameter.origin),
        "source": parameter.source,
        "unknowns": _unknowns(parameter.unknowns, place),
    }


def _channel(channel: Channel, place: Places) -> dict[str, Any]:
    sources = {end.source for _, end in channel.ends}
    return {
        "name": channel.name,
        "types": list(channel.types),
        **{key: list(channel.nodes(kind)) for kind, key in CHANNELS[channel.what]},
        "conditional": channel.conditional,
        "implicit": channel.implicit,
        "source": next((source for source in PROVENANCES if source in sources), "source"),
        "unknowns": _unknowns(
            (why for _, end in channel.ends for why in end.unknowns if why.field in ("name", "type")), place
        ),
    }


def _conditions(conditions: Iterable[Condition], place: Places) -> list[dict[str, Any]]:
    return [
        {"statement": item.statement, "condition": item.condition, "location": place.location(item.location)}
        for item in conditions
    ]


def _unknowns(unknowns: Iterable[Unknown], place: Places) -> list[dict[str, Any]]:
    entry = sorted(set(unknowns), key=lambda item: (item.field, place_key(item.location), item.reason))
    return [
        {"field": item.field, "reason": terminal(item.reason), "location": place.location(item.location)}
        for item in entry
    ]


def _package(package: Package) -> dict[str, Any]:
    return {
        "name": package.name,
        "path": package.path,
        "version": package.version,
        "format": package.format,
        "build_type": package.build_type,
        "ros": package.ros,
        "is_metapackage": package.is_metapackage,
    }


_ENCODE = json.JSONEncoder(ensure_ascii=True, allow_nan=False).encode
_STRING = json.encoder.encode_basestring_ascii
#: Between members, by the level that they are on.
_BREAKS = tuple("\n" + " " * level for level in range(_BROKEN_LEVELS + 1))


def _lay_out(value: Any, level: int, parts: list[str], known: dict[int, str]) -> None:
    """JSON text with a line for each member of the upper levels, so that two models compare line by line.

    *known* are the texts of objects on one line, which may stand in many places.
    """
    if level >= _BROKEN_LEVELS or not value or not isinstance(value, (dict, list)):
        parts.append(_on_one_line(value, known))
        return
    opening, closing = "{}" if isinstance(value, dict) else "[]"
    level += 1
    separator, follows = opening + _BREAKS[level], "," + _BREAKS[level]
    is_last = level >= _BROKEN_LEVELS
    for key, item in value.items() if isinstance(value, dict) else ((None, item) for item in value):
        parts.append(separator if key is None else f"{separator}{_STRING(key)}: ")
        separator = follows
        if is_last or not item or not isinstance(item, (dict, list)):
            parts.append(_on_one_line(item, known))
        else:
            _lay_out(item, level, parts, known)
    parts.append(_BREAKS[level - 1] + closing)


def _on_one_line(value: Any, known: dict[int, str]) -> str:
    if isinstance(value, str):
        return _STRING(value)
    if value is None:
        return "null"
    if not isinstance(value, dict) or not value:
        return _ENCODE(value)
    text = known.get(id(value))
    if text is None:
        text = known[id(value)] = _ENCODE(value)
    return text
