# SPDX-License-Identifier: Apache-2.0
"""A name that a change gives up on one side, and that the other side still uses, in whatever launch file it runs."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, End, Finding, Level, Location, Project, named_at
from haros_ci.api.changes import LeftBehind, left_behind

#: What an end that is alone does, who is missing, and what comes of it.
ALONE = {
    "subscribers": ("subscribes to", "publishes", "it gets no messages"),
    "publishers": ("publishes", "subscribes to", "no node receives its messages"),
    "clients": ("calls", "serves", "its calls get no answer"),
    "servers": ("serves", "calls", "no node calls it"),
    "action_clients": ("sends goals to", "serves", "its goals are never accepted"),
    "action_servers": ("serves", "sends goals to", "it gets no goals"),
}
SHOWN = 10


def check(project: Project) -> Iterator[Finding]:
    for left in left_behind(project):
        places: dict[object, list[End]] = {}
        for end in left.ends:
            places.setdefault(_at(left, end), []).append(end)
        for ends in places.values():
            yield _finding(left, ends)


def _finding(left: LeftBehind, ends: list[End]) -> Finding:
    end = min(ends, key=lambda end: (len(end.node.name), end.node.name))
    does, missing, result = ALONE[end.kind]
    others = len({end.node.name for end in ends}) - 1
    who = f"{end.node}{f' and {others} more' if others else ''}"
    at = _at(left, end)
    place = _at(left, left.now) if left.now is not None else None
    if left.now is None:
        hint = (
            f"which this change removes from {left.before.node} ({left.before.node.type}): no other node here "
            f"{missing} it"
        )
        remedy = f"remove the {end.word}, or use an existing name"
    elif left.action == "moved away":
        return _moved_away(left, end)
    elif left.action == "retyped":
        hint = (
            f"as {end.type}, but {left.now.node} ({place}) uses {left.now.type} since this change: the two do not "
            "connect"
        )
        result, remedy = "no data passes", f"use {left.now.type} here, too"
    else:
        hint = (
            f"but this change renames the {left.before.word} of {left.now.node} to {left.now.name} ({place}): no "
            f"other node here {missing} {left.name}"
        )
        remedy = f"write {left.now.name} here, too, or remap one of the two"
    related = (
        ((place, f"{left.now} has the new name {left.now.name} here"),)
        if left.now is not None and place is not None
        else ()
    )
    shown = {end.location: (end.location, str(end)) for end in ends if end.location != at}
    return Finding(
        at=at,
        message=f"{who} still {does} {left.name}, {hint}, so {result}; {remedy}",
        about=(left.name, end.kind, *sorted({end.node.type for end in ends})[:SHOWN]),
        related=(*related, *list(shown.values())[:SHOWN]),
        level=Level.ERROR if left.action != "removed" and (left.together or left.certain) else Level.WARNING,
    )


def _moved_away(left: LeftBehind, end: End) -> Finding:
    """The end that has the new name is the one without anybody: its partner has others, or is in another launch file."""
    does, missing, result = ALONE[end.kind]
    partner = left.now if left.now is not None else left.before
    return Finding(
        at=named_at(end),
        message=(
            f"{end.node} {does} {end.name} since this change, before it was {left.name}: no node here {missing} "
            f"{end.name}, while {partner.node} still uses {left.name} ({named_at(partner)}), so {result}; write "
            f"{left.name}, or rename both"
        ),
        about=(left.name, end.kind, end.node.type),
        related=((named_at(partner), f"{partner.word} {partner.name} of {partner.node}"),),
        level=Level.ERROR if left.together else Level.WARNING,
    )


def _at(left: LeftBehind, end: End) -> Location:
    """Where the name is given to *end*, or its type."""
    return end.location if left.action == "retyped" else named_at(end)


CHECK = Check(
    id="stale-name",
    summary="Old name or type of a renamed or retyped topic, service or action.",
    level=Level.ERROR,
    tags=("topics", "services", "actions", "change"),
    project=check,
)
