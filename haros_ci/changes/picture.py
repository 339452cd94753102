# SPDX-License-Identifier: Apache-2.0
"""The part of the node-topic graph that a change touches."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from haros_ci.changes.change import Difference
from haros_ci.changes.names import is_known
from haros_ci.model.architecture import Architecture, Configuration
from haros_ci.model.changes import ADDED, REMOVED, RENAMED, Edge

_ENDS = {
    "publisher": ("topic", True, "publishers", "subscribers"),
    "subscriber": ("topic", False, "publishers", "subscribers"),
    "service server": ("service", True, "servers", "clients"),
    "service client": ("service", False, "servers", "clients"),
    "action server": ("action", True, "action_servers", "action_clients"),
    "action client": ("action", False, "action_servers", "action_clients"),
}


def edges(found: Iterable[Difference], head: Architecture, base: Architecture) -> Iterator[Edge]:
    """The ends that come, go or have a new name, with all others at the same topics, services and actions; once each."""
    states: dict[tuple[str, str, str, bool], str] = {}
    touched: dict[tuple[str, str], None] = {}
    for difference in sorted(found, key=lambda item: (item.configuration, item.name)):
        kind, is_giver, _, _ = _ENDS.get(difference.what, ("", False, "", ""))
        if not kind or not is_known(difference.name + difference.old_name + difference.node) or not difference.node:
            continue
        if difference.action in (REMOVED, RENAMED):
            name = difference.old_name or difference.name
            states.setdefault((difference.node, name, kind, is_giver), REMOVED)
            touched[kind, name] = None
        if difference.action in (ADDED, RENAMED):
            states.setdefault((difference.node, difference.name, kind, is_giver), ADDED)
            touched[kind, difference.name] = None
        if difference.aspect == "type":
            touched[kind, difference.name] = None
    for configuration in head.configurations:
        for key in _around(configuration, touched):
            states.setdefault(key, "")
    for (node, channel, kind, is_giver), state in sorted(states.items()):
        yield Edge(node=node, channel=channel, kind=kind, is_giver=is_giver, state=state)


def _around(configuration: Configuration, touched: dict[tuple[str, str], None]) -> Iterator[tuple[str, str, str, bool]]:
    kinds = {ends[2 + number]: (ends[0], number == 0) for ends in _ENDS.values() for number in (0, 1)}
    for node in configuration.nodes:
        for end in node.endpoints:
            kind, is_giver = kinds.get(end.kind, ("", False))
            if kind and (kind, end.name) in touched and is_known(node.name) and not end.is_ruled_out:
                yield node.name, end.name, kind, is_giver
