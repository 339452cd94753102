# SPDX-License-Identifier: Apache-2.0
"""What can be said of a system that is closed: what nothing in it has is not there at all."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

from haros_ci.checking.check import Finding
from haros_ci.checking.kinds import ACTION, SERVICE, TOPIC
from haros_ci.checking.likeness import may_be
from haros_ci.checking.remapping import named_at, way_to
from haros_ci.checking.system import Channel, System

_KINDS = {"topic": TOPIC, "service": SERVICE, "action": ACTION}


def is_certainly_absent(system: System, channel: Channel, side: str) -> bool:
    """Whether it is certain that *channel* has no unseen end on this *side* (``givers`` or ``takers``) in *system*.

    Every node must have all of its ends known, and no end with a partly unknown name may be at this channel.
    """
    kind = _KINDS[channel.kind][0 if side == "givers" else 1]
    for node in system.nodes:
        if not node.ends or any(unknown.field == "endpoints" for unknown in node.raw.unknowns):
            return False
        if any(not end.known and may_be(end.name, channel.name) for end in node.of(kind)):
            return False
    return True


def unmet(system: System, channels: Iterable[Channel], side: str, what: Callable[[Channel], str]) -> Iterator[Finding]:
    """One finding for each of *channels* with ends, but certainly nobody on *side*, in a closed system that is launched.

    *what* says what the ends do and what comes of it: ``subscribes to /scan, which nothing in the system publishes``.
    """
    if not system.closed or not system.is_launched:
        return
    for channel in channels:
        missing, there = (channel.givers, channel.takers) if side == "givers" else (channel.takers, channel.givers)
        ends = [end for end in there if not end.implicit]
        if not ends or missing or not is_certainly_absent(system, channel, side):
            continue
        more = f" and {len(ends) - 1} more" if len(ends) > 1 else ""
        yield Finding(
            at=named_at(ends[0]),
            message=f"{ends[0].node}{more} {what(channel)}",
            about=(channel, *ends),
            related=tuple((end.location, str(end)) for end in ends[1:]),
            flow=way_to(ends[0]),
        )
