# SPDX-License-Identifier: Apache-2.0
"""Instances of one node in different namespaces that share a topic by a global name in the code."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Channel, Check, Decidability, End, Finding, Level, Location, System, can_meet

#: Topics that are one for all, whoever publishes them.
SHARED = frozenset(
    {
        "tf",
        "tf_static",
        "clock",
        "rosout",
        "parameter_events",
        "diagnostics",
        "diagnostics_agg",
        "initialpose",
        "map",
        "bond",
    }
)
#: The namespace of a simulator, of which there is one for all: its topics take what every robot sends, and name the robot in the message.
SIMULATOR = "/gazebo/"
#: Kinds of which two with one name get into each other's way.
KINDS = ("publishers", "servers", "action_servers")


def check(system: System) -> Iterator[Finding]:
    if not system.is_launched:
        return
    for channel in (*system.topics, *system.services, *system.actions):
        if channel.name.rpartition("/")[2] in SHARED or (
            channel.kind == "topic" and channel.name.startswith(SIMULATOR)
        ):
            continue
        by_call: dict[Location, list[End]] = {}
        for end in channel.givers:
            if end.kind in KINDS and _is_global(end):
                by_call.setdefault(end.location, []).append(end)
        for ends in by_call.values():
            pair = next(((a, b) for a, b in can_meet(ends, ends) if _are_instances(a, b)), None)
            if pair is not None and not _is_of_all(channel, *pair):
                yield _finding(channel, ends, *pair)


def _is_global(end: End) -> bool:
    """Whether its code gives it a global name that nothing remaps, in a node that has a namespace and relative names besides."""
    if (
        not (end.raw.written or "").startswith("/")
        or end.implicit
        or not end.in_source
        or end.name != end.original_name
        or _may_be_another(end)
    ):
        return False
    space = _namespace(end)
    if space == "/" or _is_beside_its_own(end, space):
        return False
    return any(
        not (other.raw.written or "/").startswith(("/", "~", "?")) and other.original_name.startswith(f"{space}/")
        for other in end.node.of("publishers", "subscribers", "servers", "clients", "action_servers", "action_clients")
    )


def _may_be_another(end: End) -> bool:
    """Whether it has another name besides, for the same call: one way of the code may give it its number, the other one that of the node."""
    others = end.node.of(end.kind) if any(one.field == "conditions" for one in end.raw.unknowns) else ()
    return any(other.location == end.location and other.original_name != end.original_name for other in others)


def _is_beside_its_own(end: End, space: str) -> bool:
    """Whether the node has the same name in its namespace, too: then the global one is meant to be one for all."""
    relative = (end.raw.written or "").lstrip("/")
    return any(other.original_name == f"{space}/{relative}" for other in end.node.of(end.kind))


def _is_of_all(channel: Channel, *instances: End) -> bool:
    """Whether the instances hear each other on the topic: by a relative name each of them would hear itself alone."""
    heard = {id(taker.node) for taker in channel.takers if taker.kind == "subscribers" and _written_globally(taker)}
    return channel.kind == "topic" and all(id(one.node) in heard for one in instances)


def _written_globally(end: End) -> bool:
    return (end.raw.written or "").startswith("/") and end.in_source and end.name == end.original_name


def _are_instances(one: End, other: End) -> bool:
    return (
        one.node.type == other.node.type
        and one.node.known
        and other.node.known
        and _namespace(one) != _namespace(other)
    )


def _namespace(end: End) -> str:
    return end.node.name.rpartition("/")[0] or "/"


def _finding(channel: Channel, ends: list[End], first: End, second: End) -> Finding:
    spaces = " and ".join(sorted({_namespace(first), _namespace(second)}))
    does = "their messages mix" if channel.kind == "topic" else "calls to one also reach the other"
    word = f"publish {channel}" if channel.kind == "topic" else f"offer the {channel.kind} {channel}"
    return Finding(
        at=first.location,
        message=(
            f"{first.node} and {second.node} are in the namespaces {spaces}, but both {word}, a global name in the "
            f"code: {does}; write the relative name {(first.raw.written or '').lstrip('/')}"
        ),
        about=(channel, *ends),
        related=tuple((end.node.location, f"{end.node} is started here") for end in ends),
    )


CHECK = Check(
    id="namespace-leak",
    summary="Global name shared by nodes in different namespaces.",
    level=Level.WARNING,
    decidability=Decidability.HEURISTIC,
    tags=("names", "namespaces"),
    run=check,
)
