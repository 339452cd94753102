# SPDX-License-Identifier: Apache-2.0
"""Parameters that nodes are given from outside, and which of them a node has: what it declares (ROS 2) or reads (ROS 1)."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from functools import cached_property
from typing import TYPE_CHECKING

from haros_ci.checking.whole import is_in
from haros_ci.model.architecture import Condition, Parameter, Unknown
from haros_ci.model.location import Location
from haros_ci.model.presence import ALWAYS, Presence, together
from haros_ci.model.slips import equally_near

if TYPE_CHECKING:
    from haros_ci.checking.system import End, System, SystemNode

#: Parameters that client libraries declare on every node, and names below which libraries declare those of their own
#: (rclcpp/node.cpp, time_source.cpp, qos_overriding_options.hpp; diagnostic_updater.hpp; rclcpp_lifecycle, bond).
EVERY_NODE = frozenset(("use_sim_time", "start_type_description_service", "bond_disable_heartbeat_timeout"))
LIBRARIES = ("qos_overrides.", "diagnostic_updater.", "service_introspection.")
#: Words in the names of parameters that transports declare for a topic, ``image.compressed.jpeg_quality``
#: (image_transport, point_cloud_transport and their plug-ins).
TRANSPORTS = frozenset(
    "compressed compressedDepth theora zstd ffmpeg draco zlib raw enable_pub_plugins disable_pub_plugins image_transport "
    "point_cloud_transport".split()
)
#: Last words of parameters that older transports declare below a topic: ``image.jpeg_quality``.
OF_TRANSPORTS = frozenset("format jpeg_quality png_level tiff".split())


class Given:
    """A parameter that *node* is given: its *key* is dotted in ROS 2, below the node's name in ROS 1."""

    __slots__ = ("key", "node", "raw")

    def __init__(self, node: SystemNode, key: str, raw: Parameter) -> None:
        self.node = node
        self.key = key
        self.raw = raw

    @property
    def at(self) -> Location:
        """The line of YAML that says it, else the tag or call of the launch file."""
        return self.raw.origin or self.raw.location or self.node.location

    @property
    def tag(self) -> Location:
        """The tag or call of the launch file that gives it."""
        return self.raw.location or self.node.location

    @property
    def type(self) -> str | None:
        return None if self.unknown else self.raw.type

    @property
    def value(self) -> object:
        return None if self.unknown else self.raw.value

    @property
    def conditions(self) -> tuple[Condition, ...]:
        return self.raw.conditions

    @property
    def unknown(self) -> tuple[Unknown, ...]:
        return self.raw.unknowns

    @property
    def presence(self) -> Presence:
        return getattr(self.raw, "presence", ALWAYS)

    @property
    def place(self) -> tuple[Location, str]:
        """Where it is said, and its key: the same for all nodes that are given it there."""
        return self.at, self.key


def give(system: System) -> tuple[Given, ...]:
    """What the ROS 2 nodes of *system* are given whose names are wholly known; each node has its own, too."""
    nodes: dict[str, list[SystemNode]] = {}
    for node in system.nodes:
        if node.ros == 2 and node.known:
            nodes.setdefault(node.name, []).append(node)
    found = []
    for parameter in system.parameters:
        name, colon, key = parameter.name.partition(":")
        if colon and "?" not in parameter.name:
            made = [Given(node, key, parameter) for node in nodes.get(name, ())]
            found += [
                other_parameter
                for other_parameter in made
                if together(other_parameter.presence, other_parameter.node.presence) is not None
            ]
    by_node: dict[int, list[Given]] = {}
    for other_parameter in found:
        by_node.setdefault(id(other_parameter.node), []).append(other_parameter)
    for every in by_node.values():
        every[0].node.given = tuple(every)
    return tuple(found)


class Names:
    """The names of the parameters of a ROS 2 *node*: *declared* by the key, with all their declarations."""

    def __init__(self, node: SystemNode) -> None:
        self.node = node
        self.declared: Mapping[str, tuple[End, ...]] = _by_key(node, "parameters")

    @cached_property
    def read(self) -> Mapping[str, tuple[End, ...]]:
        return _by_key(self.node, "getters")

    @cached_property
    def set(self) -> Mapping[str, tuple[End, ...]]:
        return _by_key(self.node, "setters")

    @cached_property
    def is_whole(self) -> bool:
        """Whether it has no parameters but those that it is seen to declare, though perhaps some of unknown names."""
        return self.node.complete and not self.node.raw.takes_undeclared

    @cached_property
    def _shapes(self) -> re.Pattern[str] | None:
        """What the names are like of which only parts are known; None if all are known."""
        vague = sorted({name for names in (self.declared, self.set) for name in names if "?" in name})
        return re.compile("|".join(".*".join(map(re.escape, name.split("?"))) for name in vague)) if vague else None

    @cached_property
    def sections(self) -> frozenset[str]:
        """What stands before the dots in the names of its parameters: ``a`` and ``a.b`` of ``a.b.c``."""
        parts = [name.split(".") for names in (self.declared, self.set) for name in names]
        return frozenset(".".join(part[:count]) for part in parts for count in range(1, len(part)))

    @cached_property
    def texts(self) -> frozenset[str]:
        """The texts, and the items of lists of texts, that its parameters have."""
        values = [end.raw.effective for ends in self.declared.values() for end in ends]
        values += [parameter.value for parameter in self.node.given]
        items = (item for value in values for item in (value if isinstance(value, list) else (value,)))
        return frozenset(item for item in items if isinstance(item, str))

    def has(self, key: str) -> bool | None:
        """Whether the node has the parameter *key*; None where that is not known."""
        if key in self.declared or key in self.set or is_of_library(key):
            return True
        if not self.is_whole or (self._shapes is not None and self._shapes.fullmatch(key)):
            return None
        return False


def _by_key(node: SystemNode, kind: str) -> dict[str, tuple[End, ...]]:
    found: dict[str, list[End]] = {}
    for end in node.of(kind):
        found.setdefault(end.name.partition(":")[2], []).append(end)
    return {key: tuple(ends) for key, ends in found.items()}


def is_of_library(key: str) -> bool:
    """Whether a library may declare the parameter *key* on the node that uses it."""
    *above, last = key.split(".")
    words = {*above, last}
    return (
        key in EVERY_NODE
        or key.startswith(LIBRARIES)
        or not words.isdisjoint(TRANSPORTS)
        or (bool(above) and last in OF_TRANSPORTS)
    )


def taken_in(system: System) -> frozenset[tuple[Location, str]]:
    """The places and keys that give something which some node of *system* has, or may have."""
    return frozenset(
        parameter.place for parameter in system.given if parameter.node.names.has(parameter.key) is not False
    )


def near(key: str, known: Iterable[str], *, dot: str = ".") -> str | None:
    """The name among *known* that is meant by *key*: spelt alike, or the same below another prefix; None if there is none."""
    names = sorted({name for name in known if "?" not in name and not is_of_library(name)})
    plain = {_plain(name): name for name in reversed(names)}
    if _plain(key) in plain:
        return plain[_plain(key)]
    last = key.rpartition(dot)[2]
    same = [name for name in names if name.rpartition(dot)[2] == last]
    if len(same) == 1 and (len(last) > 3 or last == key):  # a short name alone: x0 for robot.x0, not a.x for b.x
        return same[0]
    if len(key) > 3:
        found = equally_near(key[:200], names[:1000], 0.84)
        return found[0] if len(found) == 1 else None
    return None


def _plain(name: str) -> str:
    return name.lower().replace("_", "").replace("-", "")


def misplaced(parameter: Given) -> tuple[str, str] | None:
    """The name that is meant by one that stands at the wrong place, and what is wrong; None if that is not what is wrong.

    The node has a parameter of the name once what is doubled, or stands before it, is taken away.
    """
    key, names = parameter.key, parameter.node.names
    parts = key.split(".")
    if "ros__parameters" in parts:
        at = len(parts) - parts[::-1].index("ros__parameters")
        return ".".join(parts[at:]), "ros__parameters stands below ros__parameters"
    spaces = parameter.node.name.strip("/").split("/")
    for own in (spaces, spaces[-1:]):
        if parts[: len(own)] == own and names.has(rest := ".".join(parts[len(own) :])):
            return rest, "the name of the node stands before it"
    for at in range(1, len(parts)):
        if parts[at] == parts[at - 1] and names.has(rest := ".".join((*parts[:at], *parts[at + 1 :]))):
            return rest, f"{parts[at]} stands there twice"
    if "/" in key and names.has(rest := key.strip("~/").replace("/", ".")):
        return rest, "names of parameters have dots, not slashes"
    return None


def is_mentioned(system: System, node: SystemNode, name: str) -> bool:
    """Whether the source of *node* has the text *name*, though nothing in it is seen to declare it: then something may.

    The files are those of its package and of the packages in which it declares parameters; launch files are none of them. Of a
    name with dots the last part may stand there alone, with its dot, as in ``prefix + ".name"``.
    """
    if system.workspace is None:
        return False
    folders = {package.path for package in system.packages.values() if package.name == node.package}
    places = {end.location.path for ends in node.names.declared.values() for end in ends if end.in_source}
    folders |= {
        package.path for package in system.packages.values() if any(is_in(path, package.path) for path in places)
    }
    if any(is_in(path, folder) for path in system.whole.declared.get(name, ()) for folder in folders):
        return False
    texts = (text for folder in sorted(folders) for text in system.whole.sources(folder, system))
    above, dot, last = name.rpartition(".")
    pieces = tuple(f"{start}.{last}{end}" for start in ('"', "'", "}", "%s") for end in "\"'") if above and dot else ()
    return any(
        any(f'"{name}{end}' in text or f"'{name}{end}" in text for end in ('"', "'", "."))
        or any(piece in text for piece in pieces)
        for text in texts
    )
