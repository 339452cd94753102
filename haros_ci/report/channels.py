# SPDX-License-Identifier: Apache-2.0
"""Topics, services and actions: what the endpoints of a configuration connect, in the order of the output."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import groupby
from typing import TypeGuard

from haros_ci.model.architecture import KINDS, Configuration, Endpoint, Node, Parameter
from haros_ci.model.location import Location
from haros_ci.records import dataclass

UNKNOWN = "?"
#: What endpoints connect: its kinds of ends, those that offer first, each with the key it is listed under.
CHANNELS = {
    "topics": (("publishers", "publishers"), ("subscribers", "subscribers")),
    "services": (("servers", "servers"), ("clients", "clients")),
    "actions": (("action_servers", "servers"), ("action_clients", "clients")),
}
#: Ends whose edge leads from the node to what it connects.
OUTGOING = ("publishers", "clients", "action_clients")
_WHAT = {kind: what for what, kinds in CHANNELS.items() for kind, _ in kinds}


@dataclass(frozen=True, slots=True)
class Channel:
    """A topic, service or action of one configuration with its ends; *what* is a key of ``CHANNELS``."""

    what: str
    name: str
    ends: tuple[tuple[Node, Endpoint], ...]

    @property
    def types(self) -> tuple[str, ...]:
        """The known types of the ends, sorted; more than one is a mismatch."""
        return tuple(sorted({end.type for _, end in self.ends if is_known(end.type)}))

    @property
    def conditional(self) -> bool:
        """Whether every end is conditional, by itself or with its node (as in HAROS)."""
        return all(node.conditions or end.conditions for node, end in self.ends)

    @property
    def implicit(self) -> bool:
        return all(end.implicit for _, end in self.ends)

    def edges(
        self, name: str, ids: Mapping[int, str], rates: Mapping[tuple[str, str], str]
    ) -> dict[tuple[str, str], tuple[bool, str]]:
        """The edges of a drawing by their two ends: whether all of an edge is conditional, and the rate of its publisher, "" if that is not known.

        *name* is what the channel is called there, *ids* what nodes are, by identity; *rates* are those of publishers, by node and topic.
        """
        found: dict[tuple[str, str], tuple[bool, str]] = {}
        for node, end in self.ends:
            if end.implicit:
                continue
            here = ids[id(node)]
            pair = (here, name) if end.kind in OUTGOING else (name, here)
            is_conditional, rate = found.get(pair, (True, ""))
            rate = rates.get((node.name, end.name), rate) if end.kind == "publishers" else rate
            found[pair] = is_conditional and bool(node.conditions or end.conditions), rate
        return found

    def nodes(self, kind: str) -> tuple[str, ...]:
        """The names of the nodes with an end of *kind*, sorted."""
        return tuple(sorted({node.name for node, end in self.ends if end.kind == kind}))


def channels(configuration: Configuration) -> tuple[Channel, ...]:
    """What the endpoints of *configuration* connect, topics first, by name; two unknown names are never one channel.

    What is ruled out as things are connects nothing.
    """
    found = []
    every: dict[str, list[tuple[Node, Endpoint]]] = {what: [] for what in CHANNELS}
    for node in nodes_of(configuration):
        for end in endpoints_of(node):
            if end.kind in _WHAT and not end.is_ruled_out:
                every[_WHAT[end.kind]].append((node, end))
    for what, ends in every.items():
        ends.sort(key=lambda pair: pair[1].name)
        for name, group in groupby(ends, key=lambda pair: pair[1].name):
            together = tuple(group)
            differing = [(end,) for end in together] if UNKNOWN in name else [together]
            found += [Channel(what, name, ends_of_one) for ends_of_one in differing]
    return tuple(found)


def nodes_of(configuration: Configuration) -> tuple[Node, ...]:
    """The nodes by name and place."""
    return tuple(sorted(configuration.nodes, key=lambda node: (node.name, place_key(node.location))))


def endpoints_of(node: Node) -> tuple[Endpoint, ...]:
    """The endpoints by kind, name and place; of an unknown kind are none."""
    known = (end for end in node.endpoints if end.kind in KINDS)
    return tuple(sorted(known, key=lambda end: (KINDS.index(end.kind), end.name, place_key(end.location))))


def parameters_of(configuration: Configuration) -> tuple[Parameter, ...]:
    """The parameters set from outside by name and place."""
    return tuple(sorted(configuration.parameters, key=lambda p: (p.name, place_key(p.location), place_key(p.origin))))


def is_known(value: str | None) -> TypeGuard[str]:
    """Whether a name or type is known in full."""
    return value is not None and UNKNOWN not in value


def place_key(location: Location | None) -> tuple[str, int, int, int, int]:
    return location.sort_key if location else ("", 0, 0, 0, 0)
