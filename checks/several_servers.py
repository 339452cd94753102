# SPDX-License-Identifier: Apache-2.0
"""Two servers of one service or action."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Channel, Check, End, Finding, Level, System, can_meet, named_at, way_to


def check(system: System) -> Iterator[Finding]:
    found: dict[tuple[str, str], list[tuple[Channel, End, End]]] = {}
    for channel in (*system.services, *system.actions):
        if len(channel.servers) < 2:
            continue
        servers = [end for end in channel.servers if not end.implicit and not end.conditions]
        pair = next(((a, b) for a, b in can_meet(servers, servers) if _are_two(a, b)), None)
        if pair is not None:
            found.setdefault((pair[0].node.name, pair[1].node.name), []).append((channel, *pair))
    for each in found.values():
        yield _finding(each)


def _are_two(one: End, other: End) -> bool:
    """Whether both exist; of two nodes under one name it is the name that is to be told."""
    return one.location != other.location if one.node is other.node else one.node.name != other.node.name


def _finding(found: list[tuple[Channel, End, End]]) -> Finding:
    channel, first, second = found[0]
    if second.node.ros == 1:
        effect = "the server that registers later takes over, and the other one gets no calls"
    elif channel.kind == "action":
        effect = "both get every goal, and a client sees the answers of both"
    else:
        effect = "both execute each request, and the client takes the first answer"
    is_twice = first.node is not second.node and first.node.type == second.node.type and second.node.is_launched
    whose = f"{first.node} and {second.node}" if first.node is not second.node else f"two places of {first.node}"
    more = f" and {len(found) - 1} more" if len(found) > 1 else ""
    advice = "; remap it for one of them, or start them in different namespaces" if is_twice else ""
    return Finding(
        at=second.node.location if is_twice else named_at(second),
        message=f"{whose} offer the {channel.kind} {channel}{more}: {effect}{advice}",
        about=tuple(part for each in found for part in each),
        related=tuple((end.location, f"{end.word} {end.name}") for _, one, two in found for end in (one, two)),
        flow=way_to(second),
        level=None if first.in_source and second.in_source else Level.WARNING,  # other releases may have other services
    )


CHECK = Check(
    id="several-servers",
    summary="Service or action with several servers.",
    level=Level.ERROR,
    catalogue="G10",
    tags=("services", "actions"),
    run=check,
)
