# SPDX-License-Identifier: Apache-2.0
"""What each node type of the workspace offers and uses, in the node's own words: as it gives names, not remapped."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator

from haros_ci.model.architecture import KINDS, LIBRARY, Architecture, Endpoint, Node
from haros_ci.model.location import Location
from haros_ci.records import dataclass
from haros_ci.report.channels import is_known

#: The kinds of ends that are part of an interface; a ROS 1 node's getters stand for its parameters.
INTERFACE = ("publishers", "subscribers", "servers", "clients", "action_servers", "action_clients", "parameters")

#: Names that the client libraries' own objects (tf2, diagnostic_updater, clocks, logging) write with a slash in front.
ABSOLUTE = frozenset(
    (
        "/clock",
        "/diagnostics",
        "/diagnostics_agg",
        "/parameter_events",
        "/robot_description",
        "/rosout",
        "/tf",
        "/tf_static",
    )
)


#: What the configurations are called in which a node has every plug-in, or behaviour tree, that it could load.
EVERY_PLUGIN = (" (plug-ins)", " (behaviour trees)")


@dataclass(frozen=True, slots=True)
class Entry:
    """One line of an interface: *kind* is one of ``INTERFACE``; *ends* are its endpoints in all configurations."""

    kind: str
    name: str
    type: str | None
    ends: tuple[Endpoint, ...]


@dataclass(frozen=True, slots=True)
class Interface:
    """A node type: *names* are the last parts of its nodes' names, the most frequent known one first.

    *part* is the name of a node that its process makes beside the first, empty for the first; one that the library
    names itself counts as part of the first.
    *entries* are sorted by kind, name and type; a name or type that is not known in full has ``?`` or is None.
    """

    package: str
    type: str
    ros: int
    names: tuple[str, ...]
    entries: tuple[Entry, ...]
    nodes: tuple[Node, ...]
    part: str = ""

    @property
    def is_library(self) -> bool:
        """Whether it is what a class of a library brings into the node of whoever uses it."""
        return any(node.kind == LIBRARY for node in self.nodes)


def interfaces(architecture: Architecture) -> tuple[Interface, ...]:
    """The node types of the workspace's packages by package and type, each over all its nodes; implicit ends left out.

    A name below the node's own name is private (``~/x``), one below its namespace relative (``x``), any other absolute
    (design.ros2.org, topic and service names; ROS wiki, Names). In the root namespace ``x`` and ``/x`` are one name: it
    is absolute if a node of the same type elsewhere has it so or it is one of ``ABSOLUTE``, else relative. What a node has
    with every plug-in of the workspace at once counts only where it is not seen in any other way.
    """
    ours = {package.name for package in architecture.packages}
    found: dict[tuple[str, str, Location | None], list[Node]] = {}
    seen: set[tuple[str, str]] = set()
    for configuration in sorted(
        architecture.configurations, key=lambda item: (item.name.endswith(EVERY_PLUGIN), item.name)
    ):
        for node in sorted(configuration.nodes, key=lambda item: item.name):
            is_theirs = configuration.name.endswith(EVERY_PLUGIN) and (node.package, node.type) in seen
            if node.package in ours and is_known(node.type) and not is_theirs:
                place = node.location if _is_beside(node) else None
                found.setdefault((node.package, node.type, place), []).append(node)
        if not configuration.name.endswith(EVERY_PLUGIN):
            seen |= {(node.package, node.type) for node in configuration.nodes}
    parts: dict[tuple[str, str, str], list[Node]] = {}
    for (package, type, place), nodes in found.items():
        own = _names(found.get((package, type, None), ()))[:1]
        name = _names(nodes)[0]
        parts.setdefault((package, type, "" if place is None or [name] == own else name), []).extend(nodes)
    return tuple(_interface(package, type, nodes, part) for (package, type, part), nodes in sorted(parts.items()))


def _names(nodes: Iterable[Node]) -> list[str]:
    """The last parts of the nodes' names, known ones and frequent ones first."""
    counts = Counter(node.name.rpartition("/")[2] for node in nodes)
    return sorted(counts, key=lambda name: (not is_known(name) or not name, -counts[name], name))


def _is_beside(node: Node) -> bool:
    """Whether its process makes the node beside the one that is started, under a name that is known."""
    is_made = node.ros == 2 and node.source == "source" and node.process not in (None, "", node.name)
    return is_made and is_known(node.name.rpartition("/")[2])


def own_name(node: str, name: str) -> str:
    """*name*, resolved, as the node *node* (its full name) says it; in the root namespace relative."""
    for below in (f"{node}/", f"{node}:"):
        if name.startswith(below):
            return f"~/{name[len(below) :]}"
    namespace = node.rpartition("/")[0]
    return name[len(namespace) + 1 :] if name.startswith(f"{namespace}/") else name


def _interface(package: str, type: str, nodes: list[Node], part: str) -> Interface:
    ends = [(node, end) for node in nodes for end in node.endpoints if not end.implicit]
    absolute = {name for node, end in ends if (name := own_name(node.name, end.original_name)).startswith("/")}
    absolute |= ABSOLUTE
    grouped: dict[tuple[str, str, str | None], list[Endpoint]] = {}
    for node, end in ends:
        kind = "parameters" if node.ros == 1 and end.kind == "getters" else end.kind
        if kind in INTERFACE:
            name = _spelt(node, end, kind, absolute)
            grouped.setdefault((kind, name, end.type), []).append(end)
    typed = {(kind, name) for kind, name, type in grouped if type is not None}
    entries = [
        Entry(kind, name, type, tuple(group))
        for (kind, name, type), group in grouped.items()
        if type is not None or kind != "parameters" or (kind, name) not in typed
    ]
    entries.sort(key=lambda entry: (KINDS.index(entry.kind), entry.name, entry.type or ""))
    return Interface(package, type, nodes[0].ros, tuple(_names(nodes)), tuple(entries), tuple(nodes), part)


def _spelt(node: Node, end: Endpoint, kind: str, absolute: Iterable[str]) -> str:
    name = own_name(node.name, end.original_name)
    if kind == "parameters" and node.ros != 1:
        return name.removeprefix("~/")  # a ROS 2 parameter always belongs to its node
    return f"/{name}" if node.name.count("/") == 1 and f"/{name}" in absolute else name


def qos_text(entry: Entry, ros: int) -> str:
    """The queue (ROS 1) or quality of service (ROS 2) of a topic's end in words; what differs is parted by ``or``."""
    return " or ".join(sorted({", ".join(_qos(end, ros)) for end in entry.ends}))


def _qos(end: Endpoint, ros: int) -> Iterator[str]:
    if ros == 1:
        yield str(end.queue_size) if end.queue_size is not None else "?"
        if end.latched:
            yield "latched"
        return
    qos = end.qos
    if qos is None:
        yield "?"
        return
    if qos.history == "keep_all":
        yield "keep_all"
    elif qos.depth is not None:
        yield f"depth {qos.depth}"
    elif qos.history == "?":
        yield "history ?"
    for policy, value in (("reliability", qos.reliability), ("durability", qos.durability)):
        if value is not None:
            yield f"{policy} ?" if value == "?" else value
    for policy, seconds in (("deadline", qos.deadline), ("lifespan", qos.lifespan), ("lease", qos.lease)):
        if seconds is not None:
            yield f"{policy} {seconds}" + ("" if seconds == "?" else " s")
    if qos.liveliness is not None and qos.liveliness != "automatic":
        yield "liveliness ?" if qos.liveliness == "?" else qos.liveliness
