# SPDX-License-Identifier: Apache-2.0
"""Policies of one quality of service that undo each other, or have no effect."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, End, Finding, Level, Qos, System, qos_in_words


def check(system: System) -> Iterator[Finding]:
    for end in system.ends:
        if end.qos is None or end.implicit or not end.in_source:
            continue
        said = [*_contradictions(end, end.qos)]
        if said:
            yield Finding(
                at=end.location,
                message=f"the quality of service of {end.name} ({qos_in_words(end.qos)}) contradicts itself: {'; '.join(said)}",
                about=(end,),
            )


def _contradictions(end: End, qos: Qos) -> Iterator[str]:
    if qos.history == "keep_last" and qos.depth == 0:
        yield "the last 0 messages are none, so ROS 2 takes the depth of the middleware instead; say how many"
    if qos.durability == "transient_local" and qos.reliability == "best_effort":
        yield "what transient local keeps for late subscribers is sent again with reliable delivery only; make it reliable"
    if end.kind == "subscribers" and isinstance(qos.lifespan, float):
        yield "a lifespan is of publishers, and has no effect on a subscriber; set it there"
    if qos.liveliness == "manual_by_topic" and qos.lease is None and end.kind == "publishers":
        yield "manual liveliness without a lease is never missed; set a lease, or leave it automatic"
    if isinstance(qos.lifespan, float) and isinstance(qos.deadline, float) and qos.lifespan < qos.deadline:
        if end.kind == "publishers":
            yield "a message expires before the next one is due; let it live as long as the deadline"


CHECK = Check(
    id="qos-contradiction",
    summary="The policies of a quality of service go together.",
    level=Level.WARNING,
    catalogue="Q09",
    tags=("topics", "qos"),
    run=check,
)
