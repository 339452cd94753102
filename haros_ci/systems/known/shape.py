# SPDX-License-Identifier: Apache-2.0
"""Reads what a data file or a project file says of known nodes; what has a wrong shape is said, and left out."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from difflib import get_close_matches
from typing import Any, TypeVar

from haros_ci.model.architecture import KINDS
from haros_ci.model.workspace import Problem
from haros_ci.records import dataclass
from haros_ci.regex import regex
from haros_ci.systems.known import text
from haros_ci.systems.known.entry import KnownEndpoint, KnownNode, Policies
from haros_ci.systems.known.quality import policies

PACKAGE = r"[A-Za-z][A-Za-z0-9_-]{0,99}"
DISTRIBUTIONS = ("indigo", "jade", "kinetic", "lunar", "melodic", "noetic")
ROS2_DISTRIBUTIONS = ("foxy", "galactic", "humble", "iron", "jazzy", "kilted", "rolling")
PARAMETERS = ("getters", "setters", "parameters")
PARAMETER_TYPES = ("bool", "int", "double", "str", "yaml")
ROS2_PARAMETER_TYPES = ("bool", "int", "double", "str", "bytes", "bool[]", "int[]", "double[]", "str[]")
SCRIPT = "script"
ROS2_KEYS = ("component", "lifecycle", "plugin", "node_name", "parameters")
NODE_KEYS = ("source", SCRIPT, "nodelet", "distributions", "ros", *ROS2_KEYS[:-1], *KINDS)
COMMON_KEYS = ("name", "type", "each", "if", "unless", "implicit", "distributions")
_TYPE = regex(r"[A-Za-z]\w*/(?:(msg|srv|action)/)?[A-Za-z]\w*")
_NAME = regex(r"[~/]?[A-Za-z0-9_?/]*")
_DOTTED = regex(r"~?[A-Za-z0-9_?./-]*")
_CLASS = regex(r"[A-Za-z_]\w*(?:::[A-Za-z_]\w*)*")
#: The middle word of a ROS 2 type, by the kind of endpoint.
SUBFOLDERS = {
    "publishers": "msg",
    "subscribers": "msg",
    "servers": "srv",
    "clients": "srv",
    "action_servers": "action",
    "action_clients": "action",
}
_MOST = 1000
T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class _ShapeReading:
    where: str
    problems: list[Problem]
    ros: int | None = None

    def say(self, at: str, message: str) -> None:
        if len(self.problems) < _MOST:
            self.problems.append(Problem(self.where, f"{at}: {message}"))

    def keys(self, entry: Mapping[Any, Any], allowed: Sequence[str], at: str) -> bool:
        """Whether all keys are *allowed*; others are said."""
        fits = True
        for key in entry:
            if key not in allowed:
                near = get_close_matches(shown(key), allowed, n=1)
                hint = f"; did you mean {near[0]!r}?" if near else f"; it can be one of: {', '.join(allowed)}"
                self.say(at, f"nothing is called {shown(key)!r} here{hint}")
                fits = False
        return fits

    def parsed(self, parser: Callable[[str], T], value: object, at: str) -> T | None:
        """*value* through one of the parsers of the small language."""
        if not isinstance(value, str):
            self.say(at, f"it must be text, not {type(value).__name__}")
            return None
        try:
            return parser(value)
        except ValueError as error:
            self.say(at, f"{value[:80]!r} cannot be read: {error}")
            return None


def read_package(
    data: object, package: str, where: str, at: str = "", ros: int | None = None
) -> tuple[dict[str, KnownNode], list[Problem]]:
    """The known nodes of *package* that *data* (node type -> entry) describes, sorted; then what is wrong with it.

    *where* is the file, *at* the place in it, *ros* the version of nodes that do not tell theirs (None: both). What has
    not the form of docs/known-nodes.md is left out.
    """
    reading = _ShapeReading(where, [], ros)
    nodes: dict[str, KnownNode] = {}
    if not isinstance(data, Mapping):
        reading.say(at.rstrip(".") or where, "it must be a map of node types")
        return nodes, reading.problems
    for type_name in sorted(data, key=shown):
        here = f"{at}{shown(type_name)}"
        node = _node(data[type_name], type_name, package, here, reading)
        if node is not None:
            nodes[node.type] = node
    return nodes, reading.problems


def shown(value: object) -> str:
    """A scalar as text, cut off; what is nested by its type, for it may be large."""
    return str(value)[:100] if value is None or isinstance(value, (str, int, float)) else type(value).__name__


def _node(entry: object, name: object, package: str, at: str, reading: _ShapeReading) -> KnownNode | None:  # noqa: C901 - one branch for each key of an entry
    if not isinstance(name, str) or not re.fullmatch(r"[\w./+:-]{1,200}", name):
        reading.say(at, "this is no node type: write the executable, or the look-up name of a nodelet")
        return None
    if not isinstance(entry, Mapping):
        reading.say(at, f"it must be a map with lists such as publishers, not {type(entry).__name__}")
        return None
    reading.keys(entry, NODE_KEYS, at)
    nodelet = entry.get("nodelet", False)
    if not isinstance(nodelet, bool):
        reading.say(at, "nodelet must be true or false")
        return None
    if nodelet and "/" not in name:
        reading.say(at, f"a nodelet goes by its look-up name, such as {package}/{name}")
        return None
    ros = entry.get("ros", reading.ros)
    if ros not in (1, 2, None) or isinstance(ros, bool):
        reading.say(at, "ros must be 1 or 2; without it the entry is for both")
        return None
    reading = replace(reading, ros=ros)
    for key in ROS2_KEYS if ros == 1 else ():
        if key in entry:
            reading.say(f"{at}.{key}", "it is of ROS 2 only")
    flags = {
        key: _or_test(entry.get(key, False), bool, f"{at}.{key}", reading) is True for key in ("lifecycle", "plugin")
    }
    component = entry.get("component", name if "::" in name else "")
    if not isinstance(component, str) or (component and not _CLASS.fullmatch(component)):
        reading.say(f"{at}.component", "it is the class of the component, such as usb_cam::UsbCamNode")
        component = ""
    node_name = entry.get("node_name", "")
    if not isinstance(node_name, str) or not re.fullmatch(r"\w*", node_name):
        reading.say(f"{at}.node_name", "it is the name that the program gives its node")
        node_name = ""
    source = entry.get("source", "")
    if not isinstance(source, str):
        reading.say(at, "source must be the address of a page")
        source = ""
    endpoints: list[KnownEndpoint] = []
    for kind in KINDS:
        items = entry.get(kind)
        if items is not None and not isinstance(items, list):
            reading.say(f"{at}.{kind}", "it must be a list of maps")
            continue
        if items and len(items) > _MOST:
            reading.say(f"{at}.{kind}", f"only the first {_MOST} are read")
        for n, item in enumerate((items or [])[:_MOST]):
            made = _endpoint(item, kind, f"{at}.{kind}[{n}]", reading)
            if made is not None and made in endpoints:
                reading.say(f"{at}.{kind}[{n}]", "it is there twice")
            elif made is not None:
                endpoints.append(made)
    distributions = _distributions(entry, at, reading)
    if distributions is None:
        return None
    return KnownNode(
        package=package,
        type=name,
        nodelet=nodelet,
        ros=ros,
        component=component,
        node_name=node_name,
        **flags,
        script=_or_test(entry.get(SCRIPT, False), bool, f"{at}.{SCRIPT}", reading) is True,
        source=source,
        distributions=distributions,
        endpoints=tuple(endpoints),
    )


def _endpoint(item: object, kind: str, at: str, reading: _ShapeReading) -> KnownEndpoint | None:
    if not isinstance(item, Mapping):
        reading.say(at, f"it must be a map with a name and a type, not {type(item).__name__}")
        return None
    before = len(reading.problems)
    reading.keys(item, _keys_of(kind, reading.ros), at)
    name = reading.parsed(text.template, item.get("name"), f"{at}.name")
    form = _DOTTED if kind == "parameters" else _NAME
    if name is not None and not all(form.fullmatch(part) for part in name if isinstance(part, str)):
        reading.say(f"{at}.name", f"{str(item['name'])[:80]!r} is no ROS name")
    if name == ():
        reading.say(f"{at}.name", "it is empty")
    type_name, type_reason, type_text = _type(item.get("type"), kind, f"{at}.type", reading)
    value, value_reason = _value(item.get("default"))
    listed = reading.parsed(text.each, item["each"], f"{at}.each") if "each" in item else None
    if listed is None and name is not None and any(not isinstance(p, str) and p.kind == "item" for p in name):
        reading.say(f"{at}.name", "{item} needs an 'each' that tells the list")
    made = KnownEndpoint(
        kind=kind,
        name=name or (),
        type=type_name,
        type_reason=type_reason,
        type_text=type_text,
        queue_size=_or_test(item.get("queue_size"), int, f"{at}.queue_size", reading),
        latched=_or_test(item.get("latched"), bool, f"{at}.latched", reading),
        qos=_qos(item, f"{at}.qos", reading),
        read_only=_or_test(item.get("read_only"), bool, f"{at}.read_only", reading) is True
        if kind == "parameters"
        else None,
        value=value,
        value_reason=value_reason,
        implicit=_or_test(item.get("implicit", False), bool, f"{at}.implicit", reading) is True,
        each=listed,
        present=_tests(item.get("if"), f"{at}.if", reading),
        absent=_tests(item.get("unless"), f"{at}.unless", reading),
        distributions=_distributions(item, at, reading) or (),
    )
    return made if len(reading.problems) == before else None


def _keys_of(kind: str, ros: int | None) -> tuple[str, ...]:
    if kind in PARAMETERS:
        return (*COMMON_KEYS, "default", *(("read_only",) if kind == "parameters" else ()))
    own = {"publishers": ("queue_size", "latched"), "subscribers": ("queue_size",)} if ros != 2 else {}
    topic = kind in ("publishers", "subscribers")
    quality = ("qos",) if (topic and ros != 1) or (kind in ("servers", "clients") and ros == 2) else ()
    return (*COMMON_KEYS, *own.get(kind, ()), *quality)


def _type(value: object, kind: str, at: str, reading: _ShapeReading) -> tuple[str | None, str, text.Template | None]:
    words = ROS2_PARAMETER_TYPES if kind == "parameters" else PARAMETER_TYPES
    if kind in PARAMETERS and value in words:
        return str(value), "", None
    if isinstance(value, str) and value.startswith("{unknown:"):
        return None, _reason(reading.parsed(text.template, value, at)), None
    if kind not in PARAMETERS and isinstance(value, str) and "{" in value:
        return None, "", reading.parsed(text.template, value, at)
    if kind not in PARAMETERS and isinstance(value, str) and (found := _TYPE.fullmatch(value)):
        requested = {1: (None,), 2: (SUBFOLDERS[kind],), None: (None, SUBFOLDERS[kind])}
        if found[1] in requested[reading.ros]:
            return value, "", None
    form = f"one of {', '.join(words)}" if kind in PARAMETERS else "package/Name"
    if kind not in PARAMETERS and reading.ros == 2:
        form = f"package/{SUBFOLDERS[kind]}/Name"
    reading.say(at, f"{shown(value)!r} is no type; write {form}, or {{unknown:the reason}}")
    return None, "", None


def _qos(item: Mapping[Any, Any], at: str, reading: _ShapeReading) -> Policies | None:
    if "qos" not in item:
        return None
    try:
        return policies(item["qos"])
    except ValueError as error:
        reading.say(at, f"it cannot be read: {error}")
        return None


def _value(value: object) -> tuple[Any, str]:
    if isinstance(value, str) and value.startswith("{unknown:") and value.endswith("}"):
        return None, value[len("{unknown:") : -1]
    return value, ""


def _reason(parts: text.Template | None) -> str:
    only = parts[0] if parts else None
    return only.about if isinstance(only, text.Hole) else ""


def _or_test(value: object, plain: type[T], at: str, reading: _ShapeReading) -> T | text.Test | None:
    if value is None or (isinstance(value, plain) and (plain is bool or not isinstance(value, bool))):
        return value
    if isinstance(value, str):
        return reading.parsed(text.test, value, at)
    reading.say(at, f"it must be {plain.__name__}, or a parameter such as ~queue_size|10")
    return None


def _tests(value: object, at: str, reading: _ShapeReading) -> tuple[text.Test, ...]:
    items = value if isinstance(value, list) else [] if value is None else [value]
    return tuple(made for item in items if (made := reading.parsed(text.test, item, at)) is not None)


def _distributions(entry: Mapping[Any, Any], at: str, reading: _ShapeReading) -> tuple[str, ...] | None:
    value = entry.get("distributions")
    if value is None:
        return ()
    known = {1: DISTRIBUTIONS, 2: ROS2_DISTRIBUTIONS, None: DISTRIBUTIONS}[reading.ros]
    if not isinstance(value, list) or not value or any(item not in known for item in value):
        reading.say(f"{at}.distributions", f"it must be a list of some of: {', '.join(known)}")
        return None
    return tuple(value)
