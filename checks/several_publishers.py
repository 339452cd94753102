# SPDX-License-Identifier: Apache-2.0
"""Topics that several nodes publish."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Channel, Check, End, Finding, Level, System, can_meet, named_at, rule_of

#: Topics that are there for everybody to publish.
SHARED = frozenset(
    {
        "tf",
        "tf_static",
        "rosout",
        "parameter_events",
        "diagnostics",
        "bond",
        "initialpose",
        "clock",
        "joint_states",
        "marker",
        "markers",
    }
)


def check(system: System) -> Iterator[Finding]:
    for topic in system.topics:
        publishers = [end for end in topic.publishers if not end.implicit]
        if len(publishers) < 2 or topic.name.rpartition("/")[2] in SHARED:
            continue
        pair = next(((a, b) for a, b in can_meet(publishers, publishers) if _are_two(a, b)), None)
        if pair is not None:
            yield _finding(topic, publishers, *pair)


def _are_two(one: End, other: End) -> bool:
    if one.node is other.node:
        return not one.conditions and not other.conditions and one.location != other.location
    return True


def _finding(topic: Channel, publishers: list[End], first: End, second: End) -> Finding:
    wrong = next((end for end in (second, first) if rule_of(end) is not None), second)
    nodes = sorted({end.node.name for end in publishers})
    who = " and ".join(nodes) if len(nodes) < 4 else f"{', '.join(nodes[:2])} and {len(nodes) - 2} more"
    return Finding(
        at=named_at(wrong),
        message=f"{topic} is published {('by ' + who if len(nodes) > 1 else 'twice by ' + who)}: subscribers receive a "
        "mix of their messages; remap one, or publish through one node",
        about=(topic, *publishers),
        related=tuple((named_at(end), f"{end}") for end in publishers),
    )


CHECK = Check(
    id="several-publishers",
    summary="Topic with several publishers.",
    level=Level.WARNING,
    catalogue="G11",
    aliases=("one_publisher_per_topic",),
    tags=("topics",),
    profiles=("strict",),
    run=check,
)
