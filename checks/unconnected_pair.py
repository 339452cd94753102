# SPDX-License-Identifier: Apache-2.0
"""A publisher that nobody reads and a subscriber that gets nothing, the only ones of their type."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Channel, Check, Decidability, End, Finding, Level, Status, System, can_meet, named_at, way_to

#: Types that say little about what a topic is for.
COMMON = ("std_msgs", "diagnostic_msgs", "visualization_msgs", "rcl_interfaces", "tf2_msgs")


def check(system: System) -> Iterator[Finding]:
    if not system.is_launched:
        return
    sides: dict[str, tuple[list[Channel], list[Channel]]] = {}
    for topic in system.topics:
        kind = topic.types[0] if len(topic.types) == 1 else None
        if kind is None or kind.startswith(COMMON) or any(end.implicit or end.type is None for end in topic.ends):
            continue
        if not topic.takers:
            sides.setdefault(kind, ([], []))[0].append(topic)
        elif not topic.givers:
            sides.setdefault(kind, ([], []))[1].append(topic)
    for kind, (published, taken) in sides.items():
        if len(published) == 1 and len(taken) == 1:
            pair = next((p for p in can_meet(published[0].givers, taken[0].takers) if p[0].node is not p[1].node), None)
            if pair is not None:
                yield _finding(kind, published[0], taken[0], *pair)


def _finding(kind: str, published: Channel, taken: Channel, giver: End, taker: End) -> Finding:
    return Finding(
        at=named_at(taker),
        message=(
            f"{taker.node} subscribes to {taken}, and {giver.node} publishes {published}, both {kind}: the two do not "
            "connect, and neither has another partner; if they belong together, remap one of them"
        ),
        about=(published, taken, giver, taker),
        related=((named_at(giver), f"{giver.word} {published}"),),
        flow=way_to(taker),
    )


CHECK = Check(
    id="unconnected-pair",
    summary="Publisher and subscriber of the same type with different names and no other partner.",
    level=Level.WARNING,
    decidability=Decidability.HEURISTIC,
    status=Status.PREVIEW,
    catalogue="G03",
    tags=("topics",),
    run=check,
)
