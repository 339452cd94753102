# SPDX-License-Identifier: Apache-2.0
"""What a change does to a system, each effect reported once.

``haros-ci diff --format json`` prints it; names of attributes here are the keys there (docs/diff.md).
"""

from __future__ import annotations

from haros_ci.model.location import Location
from haros_ci.records import dataclass

#: What may change, in the order of reports.
WHATS = (
    "interface",
    "launch file",
    "launch argument",
    "node",
    "publisher",
    "subscriber",
    "service server",
    "service client",
    "action server",
    "action client",
    "remapping",
    "QoS",
    "rate",
    "parameter",
    "value",
)
ADDED, REMOVED, RENAMED, CHANGED = "added", "removed", "renamed", "changed"


@dataclass(frozen=True, slots=True, kw_only=True)
class Change:
    """A change, reported once: *names* are those that it is seen under, *nodes*, *programs* and *configurations* where.

    *old_names* of what is renamed are in the order of *names*. *before* and *after* are texts, None for what is not there; *base* and
    *head* the places on either side. *users* are who else uses it, *details* further words.
    """

    what: str
    action: str
    names: tuple[str, ...]
    aspect: str = ""
    before: str | None = None
    after: str | None = None
    nodes: tuple[str, ...] = ()
    programs: tuple[str, ...] = ()
    configurations: tuple[str, ...] = ()
    base: Location | None = None
    head: Location | None = None
    users: tuple[str, ...] = ()
    details: tuple[str, ...] = ()
    old_names: tuple[str, ...] = ()

    @property
    def name(self) -> str:
        return self.names[0] if self.names else ""

    @property
    def location(self) -> Location | None:
        """Where it is to be seen: at head, of what is removed at the base."""
        return self.head if self.head is not None else self.base

    @property
    def sort_key(self) -> tuple[object, ...]:
        order = WHATS.index(self.what) if self.what in WHATS else len(WHATS)
        place = self.location.sort_key if self.location is not None else ("",)
        return (
            order,
            place[0],
            self.programs[:1],
            self.names,
            self.action,
            self.aspect,
            place,
            self.before or "",
            self.after or "",
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class Edge:
    """One end in the picture of what has changed: *node* gives to, or takes from, the topic, service or action *channel*.

    *state* is added, removed, or "" for what is there on both sides.
    """

    node: str
    channel: str
    kind: str
    is_giver: bool
    state: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Changes:
    """All changes from one revision to the other; *edges* are the part of the graph that has changed."""

    changes: tuple[Change, ...] = ()
    edges: tuple[Edge, ...] = ()
    #: What is not said, as it is not known on one side: how many differences.
    not_known: int = 0

    def __bool__(self) -> bool:
        return bool(self.changes)
