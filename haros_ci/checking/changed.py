# SPDX-License-Identifier: Apache-2.0
"""Systems at the base revision and now: what was connected and is no more, and which change has done it."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.changes.names import may_be_same
from haros_ci.checking.project import Project
from haros_ci.checking.system import Channel, End, System, SystemNode
from haros_ci.checking.wording import line_of
from haros_ci.model.changes import REMOVED, RENAMED, Change
from haros_ci.records import dataclass

#: How changes name the ends of kinds.
WHATS = {
    "publishers": "publisher",
    "subscribers": "subscriber",
    "servers": "service server",
    "clients": "service client",
    "action_servers": "action server",
    "action_clients": "action client",
}


@dataclass(frozen=True, slots=True)
class Lost:
    """Ends that are left over at a topic, service or action *name*, as the *change* has taken away the other side.

    *is_new_name* says that they have been renamed themselves, and that the others are still where they were, under *name*.
    """

    name: str
    kind: str
    left: tuple[End, ...]
    change: Change
    system: System
    is_new_name: bool = False


def both(project: Project) -> Iterator[tuple[System, System]]:
    """The systems that are there at the base revision and now."""
    if project.base is not None:
        before = {system.name: system for system in project.base.systems}
        for system in project.systems:
            if system.name in before:
                yield before[system.name], system


def same_end(change: Change, project: Project) -> Iterator[tuple[End, End, System]]:
    """The ends that have changed, before and now, with the system that they are in now, by the places that *change* names."""
    for old, new in both(project):
        if new.name in change.configurations:
            before = {(end.kind, end.name): end for end in old.ends if end.raw.location == change.base}
            for end in new.ends:
                if end.raw.location == change.head and (end.kind, end.name) in before:
                    yield before[end.kind, end.name], end, new


def lost_in(project: Project) -> Iterator[Lost]:
    """What was connected at the base, and is no more because of a change that took away or renamed an end, or its node."""
    changes = Causes(project)
    if not changes:
        return
    for old, new in both(project):
        if changes.touches(new):
            yield from _lost_in(old, new, changes)


def _lost_in(old: System, new: System, changes: Causes) -> Iterator[Lost]:
    now = {(channel.kind, channel.name): channel for channel in _channels(new)}
    for channel in _channels(old):
        if not channel.givers or not channel.takers:
            continue
        kinds = (channel.givers[0].kind, channel.takers[0].kind)
        here = now.get((channel.kind, channel.name))
        takers = tuple(end for end in here.takers if not end.implicit) if here is not None else ()
        if (
            takers
            and here is not None
            and not here.givers
            and not _may_have(new, old, kinds[0], channel.name, channel.types)
        ):
            change = changes.of(channel.givers, channel.name, new)
            if change is not None:
                yield Lost(channel.name, channel.kind, takers, change, new)
        elif here is not None and here.givers and not here.takers:
            yield from _renamed_away(channel, now, changes, new, old)


def _renamed_away(
    channel: Channel, now: dict[tuple[str, str], Channel], changes: Causes, system: System, old: System
) -> Iterator[Lost]:
    """Takers that have another name now, under which nobody gives anything."""
    change = changes.of(channel.takers, channel.name, system)
    if change is None or change.action != RENAMED or change.what == "node":
        return
    for name in change.names:
        other = now.get((channel.kind, name))
        if other is not None and other.takers and not other.givers:
            if not _may_have(system, old, channel.givers[0].kind, name, channel.types):
                yield Lost(channel.name, channel.kind, other.takers, change, system, is_new_name=True)


def _channels(system: System) -> tuple[Channel, ...]:
    return (*system.topics, *system.services, *system.actions)


def _may_have(system: System, old: System, kind: str, name: str, types: tuple[str, ...]) -> bool:
    """Whether a node may have an end of that name, of one of *types*, whose name was known in the *old* system and is not any more."""
    if has_unseen(system, old):
        return True
    before = {(end.node.name, end.name, end.type) for node in old.nodes for end in node.of(kind)}
    vague = (end for node in system.nodes for end in node.of(kind) if not end.known)
    return any(
        (end.type is None or end.type in types)
        and (end.node.name, end.name, end.type) not in before
        and may_be_same(end.name, name)
        for end in vague
    )


def is_unseen(node: SystemNode) -> bool:
    """Whether nothing is known of what *node* has: its program is misspelt, or not in the workspace."""
    is_open = any(unknown.field == "endpoints" for unknown in node.raw.unknowns)
    return is_open and all(end.implicit for end in node.ends)


def has_unseen(system: System, old: System) -> bool:
    """Whether *system* has a node that may have anything, which the *old* one did not have.

    A program that is not found is a finding of its own, not the removal of what it had.
    """
    before = {(node.name, node.type) for node in old.nodes if is_unseen(node)}
    return any(is_unseen(node) and (node.name, node.type) not in before for node in system.nodes)


class Causes:
    """The changes by which something may be missed: ends, nodes and parameters that have gone or have another name."""

    def __init__(self, project: Project) -> None:
        self.all = tuple(c for c in project.changes.changes if c.action in (REMOVED, RENAMED))
        self._systems = {name for change in self.all for name in change.configurations}
        self._by_name: dict[tuple[str, str], list[Change]] = {}
        for change in self.all:
            for name in change.old_names if change.action == RENAMED else change.names:
                self._by_name.setdefault((change.what, name), []).append(change)

    def __bool__(self) -> bool:
        return bool(self.all)

    def touches(self, system: System) -> bool:
        return system.name in self._systems

    def of(self, ends: tuple[End, ...], name: str, system: System) -> Change | None:
        """The change that took away one of *ends* of *name*, or its node, in *system*."""
        for end in ends:
            found = self.named(WHATS[end.kind], name, system) if not end.implicit else None
            found = found or self.named("node", end.node.name, system)
            if found is not None:
                return found
        return None

    def named(self, what: str, name: str, system: System) -> Change | None:
        """The change of what was called *name* at the base."""
        for change in self._by_name.get((what, name), ()):
            if system.name in change.configurations:
                return change
        return None


def in_words(change: Change, name: str) -> str:
    """What has become of *name*: ``renamed to /new in this change``."""
    if change.action == RENAMED:
        new = change.names[change.old_names.index(name)] if name in change.old_names else change.name
        where = f" ({line_of(change.head)})" if change.head is not None else ""
        return f"renamed to {new} in this change{where}"
    return "removed in this change"
