# SPDX-License-Identifier: Apache-2.0
"""Nodes of one system of which some take their time from /clock and others do not."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Decidability, End, Finding, Level, System, SystemNode, regex, together

CLOCK = "/clock"
#: Words of code that reads a clock or a stamp, or looks up transforms.
_TIME = regex(
    r"\bnow\s*\(|[cC]lock|\bstamps?\b|\btf2\b|tf2_(?!msgs)\w+|[tT]ransform(?:Listener|er|Broadcaster)|lookup|message_filters|Synchronizer|\bTime\b"
)
_COMMENTS = regex(r"#(?!include)[^\n]*|//[^\n]*")


def check(system: System) -> Iterator[Finding]:
    if not system.is_launched or any(node.raw.unknowns for node in system.nodes if not node.known):
        return
    clocks = {id(node): _clock(node) for node in system.nodes if node.ros == 2 and node.is_launched}
    simulated = [node for node in system.nodes if clocks.get(id(node)) is True]
    if not simulated:
        return
    for node in system.nodes:
        if clocks.get(id(node)) is not False or not _takes_part(node) or not _may_read_time(node, system):
            continue
        others = [other_node for other_node in simulated if together(node.presence, other_node.presence) is not None]
        partner = next((other for other in others if _are_linked(system, node, other)), None)
        if partner is not None:
            yield Finding(
                at=node.location,
                message=(
                    f"{node} uses system time, but {partner}, with which it exchanges messages, uses simulated time (/clock): "
                    f"their time stamps do not match; set use_sim_time for {node}, too"
                ),
                about=(node, partner, "use_sim_time"),
            )


def _clock(node: SystemNode) -> bool | None:
    """Whether the node takes its time from /clock; None if that is not known."""
    ends = node.names.declared.get("use_sim_time", ())
    if len(ends) != 1 or ends[0].raw.unknowns:
        return None
    value = ends[0].raw.effective
    return value if isinstance(value, bool) else None


def _takes_part(node: SystemNode) -> bool:
    """Whether the time of the node matters to others: it is complete, makes no clock itself, and sends or gets messages."""
    return node.complete and not any(end.name == CLOCK for end in node.of("publishers"))


def _may_read_time(node: SystemNode, system: System) -> bool:
    """Whether the files that make its ends have a word of clocks, stamps or transforms; of what comes from elsewhere that is not known."""
    paths = {end.location.path for end in node.ends if end.in_source}
    if system.workspace is None or not paths:
        return True
    return any(_TIME.search(_COMMENTS.sub("", system.workspace.text(path))) for path in paths)


def _are_linked(system: System, one: SystemNode, other: SystemNode) -> bool:
    """Whether one of the nodes publishes what the other subscribes to, a clock apart."""
    return bool(_topics(one, "publishers") & _topics(other, "subscribers")) or bool(
        _topics(other, "publishers") & _topics(one, "subscribers")
    )


def _topics(node: SystemNode, kind: str) -> set[str]:
    return {end.name for end in node.of(kind) if end.known and not end.implicit and _has_time(end)}


def _has_time(end: End) -> bool:
    """Whether its messages have a time stamp, for all that is known of common types."""
    package, _, name = (end.type or "").replace("/msg/", "/").partition("/")
    return name.endswith("Stamped") or package in STAMPED or name in ("TFMessage",)


#: Packages of which nearly all messages that are published on their own have a header.
STAMPED = frozenset(("sensor_msgs", "nav_msgs", "tf2_msgs", "visualization_msgs", "stereo_msgs", "vision_msgs"))

CHECK = Check(
    id="use-sim-time-on-some",
    summary="Simulated and real time mixed between nodes that exchange messages.",
    level=Level.WARNING,
    decidability=Decidability.CLOSED_WORLD,
    catalogue="P10",
    tags=("parameters",),
    run=check,
)
