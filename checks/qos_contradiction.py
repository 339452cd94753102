# SPDX-License-Identifier: Apache-2.0
"""Policies of one quality of service that undo each other, or have no effect."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, End, Finding, Level, Qos, System, can_meet, qos_in_words


def check(system: System) -> Iterator[Finding]:
    for end in system.ends:
        if end.qos is None or end.implicit or not end.in_source:
            continue
        problems = [*_contradictions(end, end.qos), *_not_kept(end, end.qos, system)]
        if problems:
            yield Finding(
                at=end.location,
                message=f"the quality of service of {end.name} ({qos_in_words(end.qos)}) contradicts itself: {'; '.join(problems)}",
                about=(end,),
            )


def _contradictions(end: End, qos: Qos) -> Iterator[str]:
    if qos.history == "keep_last" and qos.depth == 0:
        yield (
            "keep last with depth 0 keeps no message, so ROS 2 uses the default depth of the middleware instead; set "
            "a depth"
        )
    if end.kind == "subscribers" and isinstance(qos.lifespan, float):
        yield "lifespan is a policy of publishers and has no effect on a subscriber; set it on the publisher"
    if qos.liveliness == "manual_by_topic" and qos.lease is None and end.kind == "publishers":
        yield (
            "manual liveliness without a lease duration never expires; set a lease duration, or use automatic "
            "liveliness"
        )
    if isinstance(qos.lifespan, float) and isinstance(qos.deadline, float) and qos.lifespan < qos.deadline:
        if end.kind == "publishers":
            yield "messages expire before the next one is due; set the lifespan to at least the deadline"


def _not_kept(end: End, qos: Qos, system: System) -> Iterator[str]:
    """What best effort makes of transient local; a subscriber is reliable only where every publisher is, else it hears nothing."""
    if qos.durability != "transient_local" or qos.reliability != "best_effort" or _is_of_px4(end):
        return
    if end.kind == "subscribers":
        publishers = [
            giver for topic in system.topics if end in topic.takers for giver, _ in can_meet(topic.givers, (end,))
        ]
        if not publishers or any(
            publisher.qos is None or publisher.qos.reliability != "reliable" for publisher in publishers
        ):
            return
    what = "what transient local keeps for late subscribers is sent again with reliable delivery only"
    takers = [taker for topic in system.topics if end in topic.givers for _, taker in can_meet((end,), topic.takers)]
    if (
        end.kind == "publishers"
        and takers
        and all(taker.qos is not None and taker.qos.reliability == "best_effort" for taker in takers)
    ):
        yield f"{what}; leave out transient local, as every subscriber here asks for best effort, or make both sides reliable"
    else:
        yield f"{what}; make it reliable, or leave out transient local"


def _is_of_px4(end: End) -> bool:
    """Whether it talks to PX4, whose guide (ROS 2 User Guide, "ROS 2 Subscriber QoS Settings") asks for this profile."""
    return (end.type or "").startswith("px4_msgs/") or "/fmu/" in f"/{end.original_name}/{end.name}"


CHECK = Check(
    id="qos-contradiction",
    summary="Quality of service policies that contradict each other.",
    level=Level.WARNING,
    catalogue="Q09",
    tags=("topics", "qos"),
    run=check,
)
