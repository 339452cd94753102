# SPDX-License-Identifier: Apache-2.0
"""Quality of service that a change makes narrower: ends that it connected before are refused now."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, End, Finding, Level, Project, Qos, System, qos_in_words, refused_pairs, refuses
from haros_ci.api.changes import Change, same_end

GIVERS = ("publishers", "servers")
POLICIES = ("reliability", "durability", "deadline", "liveliness")
WORDS = {
    "publishers": "subscribers that request the old policies, as those with default settings may, receive no messages",
    "subscribers": "it no longer receives from publishers that offer only the old policies",
    "servers": "clients that request the old policies get no answer",
    "clients": "it no longer answers servers that offer only the old policies",
}


def check(project: Project) -> Iterator[Finding]:
    for change in project.changes.changes:
        if change.what == "QoS" and change.action == "changed":
            yield from _narrowed(project, change)


def _narrowed(project: Project, change: Change) -> Iterator[Finding]:
    for old, new, system in same_end(change, project):
        policies = [policy for policy in POLICIES if _is_narrower(policy, new, old.qos, new.qos)]
        if policies and not _is_refused(new, system):
            yield Finding(
                at=new.location,
                message=(
                    f"{_end(new)} is now {qos_in_words(new.qos)}, before it was "
                    f"{qos_in_words(old.qos)}: {WORDS[new.kind]}"
                ),
                about=(new.name, new.kind, new.node.type, *policies),
            )
            return


def _end(end: End) -> str:
    if "?" in end.name:
        return f"a {end.word} in {end.node}, whose name is not known,"
    return f"the {end.word} of {end.name} in {end.node}"


def _is_narrower(policy: str, end: End, old: Qos | None, new: Qos | None) -> bool:
    """Whether an end that was as this one is now would be refused by one as it was, but not the other way round."""
    if old is None or new is None:
        return False
    return refuses(policy, new, old) if end.kind in GIVERS else refuses(policy, old, new)


def _is_refused(end: End, system: System) -> bool:
    """Whether an end of the workspace is refused: the checks of mismatches tell that, as an error."""
    channels = (*system.topics, *system.services)
    here = [channel for channel in channels if channel.name == end.name and end in channel.ends]
    return any(
        end in (pair.giver, pair.taker) for c in here for policy in POLICIES for pair in refused_pairs(c, policy)
    )


CHECK = Check(
    id="qos-change",
    summary="Changed quality of service that disconnects existing publishers or subscribers.",
    level=Level.WARNING,
    tags=("topics", "qos", "change"),
    project=check,
)
