# SPDX-License-Identifier: Apache-2.0
"""Time bounds that are shorter than the loop which has to answer."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from haros_ci.api import Check, Finding, Level, System, of_properties

if TYPE_CHECKING:
    from haros_ci.api.hpl import Event, Properties, Stated

#: A period counts as longer from this share of the bound on.
MARGIN = 1.001


def check(properties: Properties) -> Iterator[Finding]:
    from haros_ci.api.hpl import PatternKind, found

    for stated, property in properties.sound:
        pattern, bound = property.pattern, property.pattern.bound
        if bound is None or bound.seconds <= 0 or pattern.kind not in (PatternKind.CAUSES, PatternKind.REQUIRES):
            continue
        # what has to come soon enough, and what it is measured from
        due, other = (
            (pattern.behaviour, pattern.trigger)
            if pattern.kind is PatternKind.CAUSES
            else (pattern.trigger, pattern.behaviour)
        )
        for system in properties.systems(stated.owner):
            rate = _most(properties, stated, system, due, other)
            if rate and 1.0 / rate > bound.seconds * MARGIN:
                names = " and ".join(event.topic for event in due)
                yield found(
                    stated,
                    bound.at,
                    f"{names} comes at most every {1.0 / rate:.6g} s in {system.name}, by a timer or loop of its own, which is longer than "
                    f"'within {bound.written}': it is late whenever {other[0].topic} comes at the wrong moment; allow more time, or publish more often",
                    names,
                )
                break


def _most(
    properties: Properties, stated: Stated, system: System, due: tuple[Event, ...], other: tuple[Event, ...]
) -> float:
    """The most times a second that one of the events *due* comes in *system*, 0.0 where that is not known.

    They have to come from nodes that do not publish *other*, by timers and loops alone.
    """
    from haros_ci.api.rates import rates_in, total

    if not properties.is_complete(stated.owner):
        return 0.0
    code = properties.project.code
    names, apart = _names(properties, stated, due), _names(properties, stated, other)
    every = rates_in(system, code).published
    nodes = {one.node for one in every if one.topic in apart}
    found = [one for one in every if one.topic in names]
    if {one.topic for one in found} != names or any(one.inputs or one.node in nodes for one in found):
        return 0.0
    rate = total(one.rate for one in found)
    return rate.high if rate.is_known else 0.0


def _names(properties: Properties, stated: Stated, events: tuple[Event, ...]) -> set[str]:
    """What the topics of *events* are called in the systems."""
    return {end.name for event in events for end in properties.ends(stated.owner, event.topic)}


CHECK = Check(
    id="hpl-bound-too-short",
    summary="Property whose time bound is shorter than the period of what has to answer.",
    level=Level.WARNING,
    tags=("properties", "rates"),
    project=of_properties(check),
)
