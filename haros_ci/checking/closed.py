# SPDX-License-Identifier: Apache-2.0
"""What can be said of a system that is closed: what nothing in it has is not there at all."""

from __future__ import annotations

from haros_ci.checking.kinds import ACTION, SERVICE, TOPIC
from haros_ci.checking.likeness import may_be
from haros_ci.checking.system import Channel, System

_KINDS = {"topic": TOPIC, "service": SERVICE, "action": ACTION}


def told(system: System, channel: Channel, side: str) -> bool:
    """Whether it is certain that no node of *system* is on this *side* of *channel*, ``givers`` or ``takers``, unseen.

    No node may have ends that are not told, and none of those whose names are partly unknown may be this one.
    """
    kind = _KINDS[channel.kind][0 if side == "givers" else 1]
    for node in system.nodes:
        if not node.ends or any(unknown.field == "endpoints" for unknown in node.raw.unknowns):
            return False
        if any(not end.known and may_be(end.name, channel.name) for end in node.of(kind)):
            return False
    return True
