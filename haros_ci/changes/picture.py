# SPDX-License-Identifier: Apache-2.0
"""The part of the node-topic graph that a change touches."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from haros_ci.changes.change import Difference
from haros_ci.changes.names import is_known
from haros_ci.model.architecture import Architecture, Configuration, Node
from haros_ci.model.changes import ADDED, REMOVED, RENAMED, Edge

_ENDS = {
    "publisher": ("topic", True, "publishers", "subscribers"),
    "subscriber": ("topic", False, "publishers", "subscribers"),
    "service server": ("service", True, "servers", "clients"),
    "service client": ("service", False, "servers", "clients"),
    "action server": ("action", True, "action_servers", "action_clients"),
    "action client": ("action", False, "action_servers", "action_clients"),
}
#: Kind and whether it gives, by the names of endpoints in the model.
_SIDES = {ends[2 + number]: (ends[0], number == 0) for ends in _ENDS.values() for number in (0, 1)}


def edges(found: Iterable[Difference], head: Architecture, base: Architecture) -> Iterator[Edge]:
    """The ends that come, go or have a new name, with all others at the same topics, services and actions; once each."""
    states: dict[tuple[str, str, str, bool], str] = {}
    touched: dict[tuple[str, str], None] = {}
    for difference in sorted(found, key=lambda item: (item.configuration, item.name)):
        if difference.what == "node" and difference.action in (ADDED, REMOVED):
            changed = [
                (key, difference.action) for key in _ends(difference, head if difference.action == ADDED else base)
            ]
        else:
            changed = list(_changed(difference))
        for key, state in changed:
            if state:
                states.setdefault(key, state)
            touched[key[2], key[1]] = None
    for configuration in head.configurations:
        for key in _around(configuration, touched):
            states.setdefault(key, "")
    for (node, channel, kind, is_giver), state in sorted(states.items()):
        yield Edge(node=node, channel=channel, kind=kind, is_giver=is_giver, state=state)


def _changed(difference: Difference) -> Iterator[tuple[tuple[str, str, str, bool], str]]:
    """The end of a difference, under its old and new name, with what becomes of it; "" if it stays, of another type."""
    kind, is_giver, _, _ = _ENDS.get(difference.what, ("", False, "", ""))
    if not kind or not is_known(difference.name + difference.old_name + difference.node) or not difference.node:
        return
    if difference.action in (REMOVED, RENAMED):
        yield (difference.node, difference.old_name or difference.name, kind, is_giver), REMOVED
    if difference.action in (ADDED, RENAMED):
        yield (difference.node, difference.name, kind, is_giver), ADDED
    if difference.aspect == "type":
        yield (difference.node, difference.name, kind, is_giver), ""


def _ends(difference: Difference, side: Architecture) -> Iterator[tuple[str, str, str, bool]]:
    """All ends of a node that comes or goes, on the *side* that has it."""
    for configuration in side.configurations:
        if configuration.name == difference.configuration:
            for node in configuration.nodes:
                if node.name == difference.name and is_known(node.name):
                    yield from (key for key in _of(node, implicit=False) if is_known(key[1]))


def _around(configuration: Configuration, touched: dict[tuple[str, str], None]) -> Iterator[tuple[str, str, str, bool]]:
    for node in configuration.nodes:
        if is_known(node.name):
            yield from (key for key in _of(node) if (key[2], key[1]) in touched)


def _of(node: Node, *, implicit: bool = True) -> Iterator[tuple[str, str, str, bool]]:
    """Node, channel, kind and whether it gives, of each end that is not ruled out; those that every node has only if *implicit*."""
    for end in node.endpoints:
        kind, is_giver = _SIDES.get(end.kind, ("", False))
        if kind and not end.is_ruled_out and (implicit or not end.implicit):
            yield node.name, end.name, kind, is_giver
