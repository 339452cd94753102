# SPDX-License-Identifier: Apache-2.0
"""Nodes, endpoints and parameters as a person declares them in HAROS's words, in ground truths and in hints."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from difflib import get_close_matches
from pathlib import PurePosixPath
from typing import Any

from haros_ci.model.location import Location
from haros_ci.model.package import Package
from haros_ci.model.workspace import Problem
from haros_ci.records import dataclass, field
from haros_ci.regex import regex

#: Kinds of endpoints: key of the name, key of the type, key of the value, what one is called.
LINKS = {
    "publishers": ("topic", "msg_type", "", "publisher"),
    "subscribers": ("topic", "msg_type", "", "subscriber"),
    "servers": ("service", "srv_type", "", "server"),
    "clients": ("service", "srv_type", "", "client"),
    "action_servers": ("action", "action_type", "", "action server"),
    "action_clients": ("action", "action_type", "", "action client"),
    "getters": ("parameter", "param_type", "default_value", "getter"),
    "setters": ("parameter", "param_type", "value", "setter"),
}
#: Other words for the types of parameters, as HAROS case studies write them.
TYPE_ALIASES = {
    "string": "str",
    "std::string": "str",
    "boolean": "bool",
    "float": "double",
    "float64": "double",
    "int32": "int",
    "integer": "int",
}
PLACE = ("package", "file", "line", "column")
NODE_KEYS = ("node_type", "args", "remaps", "traceability", "conditions", "conditional")
END_KEYS = ("original_name", "traceability", "conditions", "conditional")
PARAMETER_KEYS = ("param_type", "default_value", "value", "traceability", "conditions", "conditional")
_NAME = regex(r"[~/A-Za-z0-9_?{}.:-]+")
_DEEPEST = 20
_MOST = 100_000


@dataclass(frozen=True, slots=True)
class DeclaredEntity:
    """One entity of a file: what is given of it by key, and the complete lists of its *ends* that are given."""

    name: str
    type: str | None
    fields: Mapping[str, Any]
    ends: Mapping[str, tuple[DeclaredEntity, ...]] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Reading:
    """Parsed YAML being read: what has a wrong shape is said as a problem of the file *where*, and passed over."""

    where: str
    problems: list[Problem]

    def say(self, message: str) -> None:
        self.problems.append(Problem(self.where, message))

    def map(self, value: object, at: str, keys: Sequence[str] | None = None) -> dict[str, Any]:
        """*value* as a map by text; keys other than *keys* are said. None is an empty map."""
        if not isinstance(value, Mapping):
            if value is not None:
                self.say(f"{at} must be a map, not {_kind(value)}")
            return {}
        for key in value:
            if not isinstance(key, str):
                self.say(f"{at}: the key {shown(key)} must be text; put it in quotes")
            elif keys is not None and key not in keys:
                self.say(f"{at}: nothing is called {key[:60]!r} here{near(key, keys)}")
        return {key: item for key, item in value.items() if isinstance(key, str) and (keys is None or key in keys)}

    def fields(self, entry: Mapping[str, Any], keys: Iterable[str], at: str) -> dict[str, Any]:
        """Those of *keys* that *entry* gives, in their right shape; null is "not given", but for values and names."""
        found = {}
        for key in keys:
            if key not in entry:
                continue
            value, (fits, shape) = entry[key], _SHAPES[key]
            if value is None and key not in ("value", "default_value", "original_name", "rosname"):
                continue
            if fits(value):
                found[key] = _NORMAL.get(key, lambda same: same)(value)
            else:
                self.say(f"{at}.{key} must be {shape}, not {_kind(value)}")
        return found


def read_nodes(entry: Mapping[str, Any], reading: Reading, at: str) -> tuple[DeclaredEntity, ...] | None:
    """The ``nodes`` of a configuration in a ground truth; None if they are not given, or in a wrong shape."""
    entries = reading.map(entry.get("nodes"), f"{at}.nodes")
    if not isinstance(entry.get("nodes"), Mapping):
        return None
    nodes = []
    for name, item in entries.items():
        here = f"{at}.nodes.{name}"
        node = reading.map(item, here, (*NODE_KEYS, *LINKS))
        ends = {}
        for kind in LINKS:
            if isinstance(node.get(kind), list):
                ends[kind] = tuple(_ends(node[kind], kind, reading, f"{here}.{kind}"))
            elif node.get(kind) is not None:
                reading.say(f"{here}.{kind} must be a list, not {_kind(node[kind])}")
        fields = reading.fields(node, NODE_KEYS, here)
        if _global(name, reading, here):
            nodes.append(DeclaredEntity(name, fields.get("node_type"), fields, ends))
    return tuple(nodes)


def read_parameters(entry: Mapping[str, Any], reading: Reading, at: str) -> tuple[DeclaredEntity, ...] | None:
    """The ``parameters`` of a configuration in a ground truth, maps unfolded to leaves; None as for ``read_nodes``."""
    all_given = reading.map(entry.get("parameters"), f"{at}.parameters")
    if not isinstance(entry.get("parameters"), Mapping):
        return None
    found = []
    for name, item in all_given.items():
        here = f"{at}.parameters.{name}"
        entry_fields = reading.map(item, here, PARAMETER_KEYS)
        fields = reading.fields(entry_fields, PARAMETER_KEYS, here)
        values = [key for key in ("value", "default_value") if key in entry_fields]
        if not _global(name, reading, here) or not fields.keys() >= set(values):
            continue
        if not values:
            found.append(DeclaredEntity(name, fields.get("param_type"), fields))
            continue
        for full, leaf in unfolded(name, fields[values[0]], reading, here):
            own = {key: value for key, value in fields.items() if key not in ("value", "param_type")}
            own["default_value"] = leaf
            kind = fields.get("param_type") if full == name else value_type(leaf)
            found.append(DeclaredEntity(full, kind, own if kind is None else {**own, "param_type": kind}))
    return tuple(found)


def unfolded(name: str, value: object, reading: Reading, at: str) -> Iterator[tuple[str, Any]]:
    """The leaves of a parameter's value; a map's keys are names below it, an empty map is a leaf."""
    if not isinstance(value, Mapping) or not value:
        yield name, value
        return
    for key, item in reading.map(value, at).items():
        yield from unfolded(key if key.startswith("/") else f"{name.rstrip('/')}/{key}", item, reading, at)


def value_type(value: object) -> str | None:
    """The type of a parameter with *value*; None for null."""
    for kind, name in ((bool, "bool"), (int, "int"), (float, "double"), (str, "str")):
        if isinstance(value, kind):
            return name
    return None if value is None else "yaml"


def place(location: Location | None, packages: Sequence[Package]) -> dict[str, object]:
    """A location as ``traceability`` says it: by the innermost package around it, and the path in that."""
    if location is None:
        return {}
    path, roots = PurePosixPath(location.path), {package.path: package.name for package in packages}
    folder = next((folder for folder in path.parents if str(folder) in roots), None)
    file = str(path.relative_to(folder)) if folder is not None else location.path
    package = roots[str(folder)] if folder is not None else None
    return {"package": package, "file": file, "line": location.line, "column": location.column}


def near(word: str, known: Iterable[str]) -> str:
    """``; did you mean '/odom'?``, or "" if nothing known is near *word*."""
    found = get_close_matches(word[:200], sorted({name for name in known if len(name) <= 200})[:1000], n=1)
    return f"; did you mean {found[0]!r}?" if found else ""


def shown(value: object) -> str:
    """*value* as YAML would write it, cut where it is long."""
    try:
        text = "null" if value is None else str(value).lower() if isinstance(value, bool) else repr(value)
    except (RecursionError, ValueError):  # nested or a number too large
        return "a value too large to show"
    return text if len(text) <= 200 else f"{text[:199]}…"


def is_name(value: object) -> bool:
    """Whether *value* can be a ROS name, ``?`` standing for unknown parts."""
    return isinstance(value, str) and _NAME.fullmatch(value) is not None


def _ends(items: Sequence[object], kind: str, reading: Reading, at: str) -> Iterator[DeclaredEntity]:
    name_key, type_key, value_key, _ = LINKS[kind]
    keys = [type_key, *END_KEYS, *end_keys(kind), *(["value"] if value_key else [])]
    for number, item in enumerate(items):
        here = f"{at}[{number}]"
        entry = reading.map(item, here, (name_key, *keys))
        fields = reading.fields(entry, keys, here)
        name = entry.get(name_key)
        if isinstance(name, str) and _global(name, reading, here):
            yield DeclaredEntity(name, fields.get(type_key), fields)
        elif not isinstance(name, str):
            reading.say(f"{here} needs a {name_key!r}: the full name, as text")


def end_keys(kind: str) -> tuple[str, ...]:
    """The keys that only endpoints of *kind* have."""
    match kind:
        case "publishers":
            return ("queue_size", "latched")
        case "subscribers":
            return ("queue_size",)
        case "getters" | "setters":
            return (LINKS[kind][2],)
        case _:
            return ()


def _global(name: str, reading: Reading, at: str) -> bool:
    if is_name(name) and name.startswith("/"):
        return True
    reading.say(f"{at}: {name[:60]!r} is no full name; write it as /namespace/name")
    return False


def _is_place(value: object) -> bool:
    return isinstance(value, Mapping) and all(
        value[key] is None or (_is_count(value[key]) if key in ("line", "column") else isinstance(value[key], str))
        for key in PLACE
        if key in value
    )


def _present_fields(place: Mapping[str, Any]) -> dict[str, Any]:
    return {key: place[key] for key in PLACE if place.get(key) is not None}


def _is_count(value: object) -> bool:
    return isinstance(value, int) and not isinstance(value, bool) and value >= 0


def _are_conditions(value: object) -> bool:
    return isinstance(value, list) and all(
        isinstance(item, Mapping) and (item.get("location") is None or _is_place(item["location"]))
        for item in _flat(value)
    )


def _flat(conditions: Iterable[Any]) -> list[Any]:
    """Conditions of several call paths are lists in the list."""
    return [item for one in conditions for item in (one if isinstance(one, list) else [one])]


def _condition(item: Mapping[str, Any]) -> dict[str, Any]:
    merged = {**item, **(item.get("location") or {})}
    return {key: merged[key] for key in ("statement", "condition", *PLACE) if key in merged}


def _is_bounded(value: object) -> bool:
    """Whether *value* is nested at most ``_DEEPEST`` deep and has at most ``_MOST`` parts, those of aliases counted."""
    level, count = [value], 0
    for _ in range(_DEEPEST + 1):
        count += len(level)
        if count > _MOST:
            return False
        level = [
            part
            for item in level
            if isinstance(item, (Mapping, list))
            for part in (item.values() if isinstance(item, Mapping) else item)
        ]
    return not level


def _is_text_map(value: object) -> bool:
    return isinstance(value, Mapping) and all(is_name(key) and is_name(item) for key, item in value.items())


def _kind(value: object) -> str:
    names = {bool: "true or false", int: "a number", float: "a number", str: "text", list: "a list", type(None): "null"}
    if isinstance(value, str) and len(value) <= 60:
        return repr(value)
    return "a map" if isinstance(value, Mapping) else names.get(type(value), "that")


_Shape = tuple[Callable[[Any], bool], str]
_TYPE: _Shape = (lambda v: isinstance(v, str) and re.fullmatch(r"\S+", v) is not None, "a type as text")
_FULL: _Shape = (lambda v: isinstance(v, str) and v.count("/") in (1, 2) and v.split() == [v], "a type as package/Name")
_ANY: _Shape = (_is_bounded, f"a value at most {_DEEPEST} levels deep and of at most {_MOST:,} parts")
_SHAPES: dict[str, _Shape] = {
    "node_type": (lambda v: isinstance(v, str) and v.count("/") == 1 and v.split() == [v], "text as package/type"),
    "args": (lambda v: isinstance(v, str) or (isinstance(v, (int, float)) and abs(v) < 2**63), "text"),
    "remaps": (_is_text_map, "a map from name to name"),
    "traceability": (_is_place, "a map of package, file, line and column"),
    "location": (_is_place, "a map of package, file, line and column"),
    "conditions": (_are_conditions, "a list of maps with statement and location"),
    "conditional": (lambda v: isinstance(v, bool), "true or false"),
    "latched": (lambda v: isinstance(v, bool), "true or false"),
    "queue_size": (_is_count, "a number from 0 on"),
    "original_name": (lambda v: v is None or is_name(v), "a name"),
    "rosname": (lambda v: v is None or is_name(v), "a name"),
    "msg_type": _FULL,
    "srv_type": _FULL,
    "action_type": _FULL,
    "param_type": _TYPE,
    "value": _ANY,
    "default_value": _ANY,
}
_NORMAL: dict[str, Callable[[Any], Any]] = {
    "args": lambda value: " ".join(str(value).split()),
    "conditions": lambda value: [_condition(item) for item in _flat(value)],
    "param_type": lambda value: TYPE_ALIASES.get(value, value),
    "traceability": lambda value: _present_fields(value),
    "location": lambda value: _present_fields(value),
}


def listed(entry: Mapping[str, Any], key: str, at: str, reading: Reading) -> Iterator[tuple[object, str]]:
    """The items of the list that *entry* has under *key*, each with its place."""
    items = entry.get(key)
    if isinstance(items, list):
        yield from ((item, f"{at}.{key}[{n}]") for n, item in enumerate(items))
    elif items is not None:
        reading.say(f"{at}.{key} must be a list of maps")


def misfit_of(noun: str, name: str, count: int, known: Sequence[str]) -> str:
    """Why a hint is not for one entity that is called *name*."""
    if count:
        return f"{count} {noun}s are called {name}; a hint must be for one"
    return f"there is no {noun} {name}{near(name, known)}"


def named_entries(
    value: object, at: str, keys: Sequence[str], reading: Reading
) -> Iterator[tuple[str, dict[str, Any], str]]:
    """The hints for named entities, those that fix before those that create."""
    found = []
    for name, item in reading.map(value, at).items():
        here = f"{at}.{name}"
        entry = reading.map(item, here, keys)
        if is_name(name):
            found.append((name, entry, here))
        else:
            reading.say(f"{here}: this is no ROS name; write it as /namespace/name")
    yield from sorted(found, key=lambda one: bool(one[1].get("create")))
