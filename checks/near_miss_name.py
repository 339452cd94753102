# SPDX-License-Identifier: Apache-2.0
"""Two ends of one type whose names are nearly the same, and of which one or both have nobody else to connect to."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import (
    ACTION,
    SERVICE,
    TOPIC,
    Channel,
    Check,
    Decidability,
    End,
    Finding,
    Level,
    Location,
    System,
    SystemNode,
    can_meet,
    is_moved,
    is_slip,
    may_be,
    named_at,
    rule_of,
    way_to,
)

#: Nodes connect to these in every system, or tools do.
COMMON = frozenset({"tf", "tf_static", "clock", "rosout", "parameter_events", "diagnostics", "robot_description"})
#: More of one type than this say that the type tells nothing.
MOST = 40


def check(system: System) -> Iterator[Finding]:
    if not system.is_launched:
        return
    found: dict[tuple[Location, str], list[tuple[Channel, Channel, End, End]]] = {}
    for channels, kinds in ((system.topics, TOPIC), (system.services, SERVICE), (system.actions, ACTION)):
        unknown = tuple(end for end in system.ends if end.kind in kinds and not end.known)
        for giver, taker in _lonely(channels, unknown):
            if any(_is_value_elsewhere(channel, system) for channel in (giver, taker)):
                continue
            pair = next((pair for pair in can_meet(giver.givers, taker.takers) if _fit(*pair)), None)
            if pair is not None:
                wrong = _wrong(*pair)
                found.setdefault((named_at(wrong), wrong.original_name), []).append((giver, taker, *pair))
    is_open = bool(found) and any(map(_is_open, system.nodes))
    for item in found.values():
        yield _finding(item, is_open)


def _is_value_elsewhere(channel: Channel, system: System) -> bool:
    """Whether a parameter of another node has the channel's name for its value: that node may be the partner."""
    nodes = {end.node.name for end in channel.ends}
    own = tuple(f"{node}{sign}" for node in nodes for sign in ":/")
    return any(
        isinstance(parameter.value, str)
        and parameter.value not in ("", "/")
        and (parameter.value == channel.name or channel.name.endswith(f"/{parameter.value}"))
        and not parameter.name.startswith(own)
        for parameter in system.parameters
    )


def _is_open(node: SystemNode) -> bool:
    """Whether a node may have unknown ends, or has one of which neither the name nor the type is known."""
    kinds = (*TOPIC, *SERVICE, *ACTION)
    return (
        not node.ends
        or any(unknown.field == "endpoints" for unknown in node.raw.unknowns)
        or any(not end.known and not _is_informative(end) for end in node.of(*kinds))
    )


def _lonely(channels: tuple[Channel, ...], unknown: tuple[End, ...]) -> Iterator[tuple[Channel, Channel]]:
    """Pairs of one that gives and one that only takes, of the same type and nearly the same name.

    The one that gives has no taker either, or the names differ by a slip of the pen: a taker that is left out is seen, a giver that nobody
    takes from is common. Names that instances of one program share are reported by namespace-leak. No end of an *unknown* name may be the
    partner of either.
    """
    givers: dict[tuple[str, bool], list[Channel]] = {}
    takers: list[Channel] = []
    for channel in channels:
        if channel.name.rpartition("/")[2] in COMMON or len(channel.types) != 1:
            continue
        if any(end.implicit or end.type is None for end in channel.ends):
            continue
        if any(
            end.type in (None, channel.types[0]) and _is_informative(end) and may_be(end.name, channel.name)
            for end in unknown
        ):
            continue
        if channel.givers and len({end.location for end in channel.givers}) == len(channel.givers):
            givers.setdefault((channel.types[0], bool(channel.takers)), []).append(channel)
        elif channel.takers and not channel.givers:
            takers.append(channel)
    for taker in takers:
        for is_connected in (False, True):
            alike = givers.get((taker.types[0], is_connected), [])
            for giver in alike if len(alike) <= MOST else ():
                if (not is_connected and is_moved(giver.name, taker.name)) or _is_misspelt(giver.name, taker.name):
                    yield giver, taker


def _is_informative(end: End) -> bool:
    """Whether anything is known of an end: of one without a type and without a part of its own name, nothing speaks for it."""
    return end.type is not None or end.name.rpartition("/")[2] != "?"


def _is_misspelt(one: str, other: str) -> bool:
    segments, others = one.split("/"), other.split("/")
    if len(segments) != len(others):
        return False
    differing = [pair for pair in zip(segments, others) if pair[0] != pair[1]]
    return len(differing) == 1 and is_slip(*differing[0])


def _fit(giver: End, taker: End) -> bool:
    """Whether two ends may be meant for each other.

    A topic in another namespace is one for somebody else as a rule. It is meant for this one if somebody chose its name: by a remapping
    rule, or as a global name where the other end has a relative one, or if it is the one that robot_state_publisher waits for.
    """
    if giver.node is taker.node or not (giver.in_source or taker.in_source):
        return False
    if giver.kind != "publishers" or not is_moved(giver.name, taker.name):
        return True
    if rule_of(giver) is not None or rule_of(taker) is not None:
        return True
    if taker.node.package == "robot_state_publisher" and taker.name.endswith("/joint_states"):
        return giver.node.package != "joint_state_publisher"  # it has nothing else to listen to
    written = [end.raw.written or "?" for end in (giver, taker)]
    return sum(path.startswith("/") for path in written) == 1 and not any(
        item.startswith(("?", "~")) for item in written
    )


def _wrong(giver: End, taker: End) -> End:
    """The one whose name was chosen against the other: remapped, or written as a global name."""
    for end in (taker, giver):
        if rule_of(end) is not None:
            return end
    for end, other in ((giver, taker), (taker, giver)):
        if (end.raw.written or "").startswith("/") and not (other.raw.written or "/").startswith("/"):
            return end
    return taker


def _finding(found: list[tuple[Channel, Channel, End, End]], is_open: bool) -> Finding:
    """One finding for all pairs; a note where a node *is open*, so that it may be a partner."""
    giver_name, taker_name, giver, taker = found[0]
    wrong = _wrong(giver, taker)
    other = taker if wrong is giver else giver
    more = f" ({len(found) - 1} more such pairs)" if len(found) > 1 else ""
    hint = ""
    if rule_of(wrong) is not None:
        hint = f"; {wrong.original_name} is remapped here"
    elif (wrong.raw.written or "").startswith("/") and wrong is giver:
        hint = "; the name is global in the code, so namespaces and relative remappings have no effect on it"
    alone = (
        "no partner is seen, and not all nodes are known"
        if is_open
        else f"nobody else has {taker_name}"
        if found[0][0].takers
        else "neither has another partner"
    )
    return Finding(
        at=named_at(wrong),
        message=(
            f"{giver.word} {giver_name} of {giver.node} and {taker.word} {taker_name} of {taker.node} do not connect, "
            f"although they have the same type and nearly the same name: {alone}{more}; use one name for both{hint}"
        ),
        about=tuple(dict.fromkeys(part for item in found for part in item)),
        related=tuple(
            (named_at(end), f"{end.word} {end.name} of {end.node}")
            for item in found
            for end in item[2:]
            if end is not wrong
        ),
        flow=way_to(wrong) or way_to(other),
        level=Level.NOTE if is_open else None,
    )


CHECK = Check(
    id="near-miss-name",
    summary="Nearly equal names of a publisher and a subscriber that do not connect.",
    level=Level.WARNING,
    decidability=Decidability.HEURISTIC,
    catalogue="G04",
    tags=("names",),
    run=check,
)
