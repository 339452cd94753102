# SPDX-License-Identifier: Apache-2.0
"""Changes of interfaces as they are reported beside those of the graph."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace

from haros_ci.changes.interfaces import InterfaceChange, in_words
from haros_ci.model.architecture import Architecture
from haros_ci.model.build import Interface
from haros_ci.model.changes import ADDED, CHANGED, REMOVED, RENAMED, Change


def interface_changes_shown(
    found: Iterable[InterfaceChange], containing: Callable[[str], tuple[Interface, ...]]
) -> Iterator[Change]:
    """Each change of interfaces, once where several have the same; *containing* gives the interfaces that have a message in them."""
    alike: dict[tuple[object, ...], list[Change]] = {}
    for change in _one_by_one(found, containing):
        own = change.names if change.action != CHANGED else ()
        alike.setdefault((change.action, change.aspect, change.before, change.after, *own), []).append(change)
    for same in alike.values():
        first = same[0]
        if len(same) > 1:
            phrases = (f"{change.name}: {word}" for change in same for word in change.details)
            first = replace(
                first,
                names=tuple(change.name for change in same),
                users=tuple(dict.fromkeys(user for change in same for user in change.users)),
                details=tuple(phrases),
            )
        yield first


def _one_by_one(
    found: Iterable[InterfaceChange], containing: Callable[[str], tuple[Interface, ...]]
) -> Iterator[Change]:
    for interface_change in found:
        action = interface_change.what if interface_change.what in (ADDED, REMOVED, RENAMED) else CHANGED
        users = (
            [f"{other.name} ({other.kind})" for other in containing(interface_change.name)]
            if interface_change.kind == "msg"
            else []
        )
        name = interface_change.after if action == RENAMED else interface_change.name
        yield Change(
            what="interface",
            action=action,
            names=(_typed(name, interface_change),),
            aspect=in_words(interface_change) if action == CHANGED else interface_change.kind,
            before=interface_change.before or None,
            after=interface_change.after or None,
            base=None if interface_change.is_in_head else interface_change.location,
            head=interface_change.location if interface_change.is_in_head else None,
            users=tuple(users),
            details=_details(interface_change),
            old_names=(_typed(interface_change.before, interface_change),) if action == RENAMED else (),
        )


def _typed(name: str, change: InterfaceChange) -> str:
    """As types of ends are written: ``pkg/msg/T`` in ROS 2."""
    return name.replace("/", f"/{change.kind}/", 1) if change.ros == 2 else name


def with_nodes(changes: Sequence[Change], *architectures: Architecture) -> Iterator[Change]:
    """Each change of an interface with the nodes that have an end of that type, at the base or at head."""
    names = {name for change in changes for name in (*change.names, *change.old_names)}
    found: dict[str, set[str]] = {}
    for architecture in architectures:
        for configuration in architecture.configurations if names else ():
            for node in configuration.nodes:
                for end in node.endpoints:
                    if end.type in names and "?" not in node.name:
                        found.setdefault(end.type, set()).add(node.name)
    for change in changes:
        nodes = set().union(*(found.get(name, set()) for name in (*change.names, *change.old_names)))
        short = sorted(nodes, key=lambda name: (len(name), name))
        yield replace(change, users=(*short, *change.users))


def _details(change: InterfaceChange) -> tuple[str, ...]:
    """The wire hashes, and whether nodes of before and after no longer understand each other."""
    parts = []
    if change.hash_before != change.hash_after:
        parts.append(f"wire hash {change.hash_before or 'not known'} → {change.hash_after or 'not known'}")
    if change.is_breaking:
        parts.append("breaks what was built before")
    return tuple(parts)
