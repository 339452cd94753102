# SPDX-License-Identifier: Apache-2.0
"""Names that the client library refuses (wiki.ros.org/Names; design.ros2.org, topic and service names)."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.api import ACTION, SERVICE, TOPIC, Check, Finding, Level, Location, System, SystemNode, regex

#: What the whole of a name consists of, by ROS version; ``?`` stands for what is not known.
_CHARACTERS = {1: regex(r"[A-Za-z0-9_/~?]*"), 2: regex(r"[A-Za-z0-9_/~{}?]*")}
#: A part of a name of which the text is empty.
_EMPTY = regex(r"//+")
_BRACES = regex(r"\{(?:node|ns|namespace)\}")


def check(system: System) -> Iterator[Finding]:
    reported: set[tuple[Location, str]] = set()
    for node in system.nodes:
        for place, what, name, why in _wrong(node):
            if (place, name) not in reported:
                reported.add((place, name))
                yield Finding(
                    at=place,
                    message=f"{what} {name!r} is not a valid name in ROS {node.ros}: {why}",
                    about=(node, name),
                )


def _wrong(node: SystemNode) -> Iterator[tuple[Location, str, str, str]]:
    """Place, kind, name and what is wrong with it."""
    for end in node.of(*TOPIC, *SERVICE, *ACTION):
        written = end.raw.written
        if written and end.in_source and not end.implicit:
            why = fault(written, node.ros)
            if why and not (_is_to_be_given(node) and fault(_EMPTY.sub("/x/", written).rstrip("/"), node.ros) == ""):
                yield end.location, f"the {end.word}", written, why
    for rule in node.raw.rules:
        for side, name in (("source", rule.source), ("target", rule.target)):
            bare = name.removeprefix("rostopic://").removeprefix("rosservice://")
            why = fault(bare, node.ros) if "*" not in name else ""
            if why:
                yield rule.location, f"the remapping's {side}", name, why
    if node.is_launched and node.known and node.raw.kind != "library":
        last = node.name.rpartition("/")[2]
        why = fault(last, node.ros, is_node=True)
        if why:
            yield node.location, "the node name", last, why


def _is_to_be_given(node: SystemNode) -> bool:
    """Whether nothing seen starts the node, and it has a parameter that is empty until whoever starts it gives a value."""
    return not node.is_launched and any(
        end.raw.value == "" or end.raw.effective == "" for end in node.of("parameters", "getters")
    )


def fault(name: str, ros: int, is_node: bool = False) -> str:
    """What is wrong with *name* for sure, "" if nothing is."""
    found = _CHARACTERS[ros].match(name)
    end = found.end() if found else 0
    if end < len(name):
        return f"it contains the character {name[end]!r}"
    if "?" in name or not name:
        return ""
    if is_node and "/" in name:
        return "it contains a slash"
    return _ros1(name) if ros == 1 else _ros2(name)


def _ros1(name: str) -> str:
    if "~" in name[1:]:
        return "~ is allowed only at the beginning"
    if not re.match(r"[A-Za-z/~]", name):
        return "it does not begin with a letter, / or ~"
    return ""


def _ros2(name: str) -> str:
    rest = _BRACES.sub("x", name)
    if "{" in rest or "}" in rest:
        return "the only substitutions are {node}, {ns} and {namespace}"
    if "~" in rest[1:]:
        return "~ is allowed only at the beginning"
    if rest.startswith("~") and not rest.startswith("~/") and rest != "~":
        return f"~ must be followed by /; write ~/{rest[1:]}"
    if "//" in rest:
        return "it has two slashes in a row"
    if len(rest) > 1 and rest.endswith("/"):
        return "it ends with a slash"
    if re.search(r"(?:^|/)[0-9]", rest):
        return "one of its parts begins with a digit"
    return ""


CHECK = Check(
    id="invalid-name",
    summary="Invalid ROS name of a topic, service, action, node or remapping.",
    level=Level.ERROR,
    catalogue="G15",
    tags=("names",),
    profiles=("strict",),
    run=check,
)
