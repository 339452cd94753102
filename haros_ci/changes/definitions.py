# SPDX-License-Identifier: Apache-2.0
"""Changes of interfaces as they are told beside those of the graph."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace

from haros_ci.changes.interfaces import InterfaceChange, in_words
from haros_ci.model.architecture import Architecture
from haros_ci.model.build import Interface
from haros_ci.model.changes import ADDED, CHANGED, REMOVED, RENAMED, Change


def told(found: Iterable[InterfaceChange], containing: Callable[[str], tuple[Interface, ...]]) -> Iterator[Change]:
    """Each change of interfaces, once where several have the same; *containing* gives the interfaces that have a message in them."""
    alike: dict[tuple[object, ...], list[Change]] = {}
    for change in _one_by_one(found, containing):
        own = change.names if change.action != CHANGED else ()
        alike.setdefault((change.action, change.aspect, change.before, change.after, *own), []).append(change)
    for same in alike.values():
        first = same[0]
        if len(same) > 1:
            said = (f"{each.name}: {word}" for each in same for word in each.details)
            first = replace(
                first,
                names=tuple(each.name for each in same),
                users=tuple(dict.fromkeys(user for each in same for user in each.users)),
                details=tuple(said),
            )
        yield first


def _one_by_one(
    found: Iterable[InterfaceChange], containing: Callable[[str], tuple[Interface, ...]]
) -> Iterator[Change]:
    for each in found:
        action = each.what if each.what in (ADDED, REMOVED, RENAMED) else CHANGED
        users = [f"{other.name} ({other.kind})" for other in containing(each.name)] if each.kind == "msg" else []
        name = each.after if action == RENAMED else each.name
        yield Change(
            what="interface",
            action=action,
            names=(_typed(name, each),),
            aspect=in_words(each) if action == CHANGED else each.kind,
            before=each.before or None,
            after=each.after or None,
            base=None if each.is_in_head else each.location,
            head=each.location if each.is_in_head else None,
            users=tuple(users),
            details=_details(each),
            old_names=(_typed(each.before, each),) if action == RENAMED else (),
        )


def _typed(name: str, change: InterfaceChange) -> str:
    """As types of ends are written: ``pkg/msg/T`` in ROS 2."""
    return name.replace("/", f"/{change.kind}/", 1) if change.ros == 2 else name


def with_nodes(changes: Sequence[Change], *architectures: Architecture) -> Iterator[Change]:
    """Each change of an interface with the nodes that have an end of that type, at the base or at head."""
    wanted = {name for change in changes for name in (*change.names, *change.old_names)}
    found: dict[str, set[str]] = {}
    for architecture in architectures:
        for configuration in architecture.configurations if wanted else ():
            for node in configuration.nodes:
                for end in node.endpoints:
                    if end.type in wanted and "?" not in node.name:
                        found.setdefault(end.type, set()).add(node.name)
    for change in changes:
        nodes = set().union(*(found.get(name, set()) for name in (*change.names, *change.old_names)))
        short = sorted(nodes, key=lambda name: (len(name), name))
        yield replace(change, users=(*short, *change.users))


def _details(change: InterfaceChange) -> tuple[str, ...]:
    """The wire hashes, and whether nodes of before and after no longer understand each other."""
    said = []
    if change.hash_before != change.hash_after:
        said.append(f"wire hash {change.hash_before or 'not known'} → {change.hash_after or 'not known'}")
    if change.is_breaking:
        said.append("breaks what was built before")
    return tuple(said)
