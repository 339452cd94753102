# SPDX-License-Identifier: Apache-2.0
"""Findings on ends that incompatible quality of service keeps from connecting."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.checking.check import Finding, Place
from haros_ci.checking.compatibility import Mismatch, in_words, mismatches, override_place
from haros_ci.checking.system import End, System
from haros_ci.checking.wording import line_of
from haros_ci.model.architecture import Qos
from haros_ci.results.rule import Level

#: The most other ends that a finding shows.
SHOWN = 20


def incompatible(system: System, policy: str, fix: str, advice: dict[str, str]) -> Iterator[Finding]:
    """A finding for each call that *policy* keeps from connecting to others; *fix* is as in ``mismatches``.

    *advice* is what to do, for ``publishers``, ``subscribers`` and ``services``. An error where a subscriber or client gets nothing at all, a
    warning where one of several publishers is not heard.
    """
    for found in mismatches(system, policy, fix):
        kind = "services" if found.channel.kind == "service" else found.end.kind
        place = override_place(system, found.end, policy)
        related = tuple((end.location, f"{end}: {in_words(end.qos)}") for end in found.others[:SHOWN])
        yield Finding(
            at=place or found.end.location,
            message=f"{_described(found, policy)}; {advice[kind]}; the {found.other} is at {line_of(found.other.location)}",
            about=(found.channel, found.end, found.other),
            related=(*related, *(((found.end.location, f"{found.end}"),) if place is not None else ())),
            flow=tuple(_flow(found)),
            level=Level.ERROR if found.is_starved else Level.WARNING,
            apart=(policy,),
        )


def _described(found: Mismatch, policy: str) -> str:
    giver, taker = found.giver, found.taker
    if found.channel.kind == "service":
        return (
            f"client {taker.node} of service {found.channel} uses {in_words(taker.qos)}, "
            f"but server {giver.node} uses {in_words(giver.qos)}: no call gets an answer"
        )
    nodes = sorted({end.node.name for end in found.others} - {found.other.node.name})
    more = f" and {len(nodes)} more" if nodes else ""
    asks, gives = _policy(policy, giver.qos, taker.qos)
    many_ask, many_give = more if found.is_giver else "", "" if found.is_giver else more
    lost = "no message arrives" if found.is_starved else f"no message of {giver.node} arrives"
    return (
        f"{taker.node}{many_ask} {'subscribe' if many_ask else 'subscribes'} to {found.channel} {asks} "
        f"({in_words(taker.qos)}), but {giver.node}{many_give} {'publish' if many_give else 'publishes'} it {gives} "
        f"({in_words(giver.qos)}): ROS 2 does not connect the two, so {lost}"
    )


def _policy(policy: str, offered: Qos | None, requested: Qos | None) -> tuple[str, str]:
    """What one end asks for and the other one offers, as a phrase with "subscribes" and "publishes"."""
    if policy == "reliability":
        return "as reliable", "with best effort"
    if policy == "durability":
        return "as transient local", "as volatile"
    if policy == "deadline":
        return _time("deadline", requested and requested.deadline), _time("deadline", offered and offered.deadline)
    if requested is not None and requested.liveliness == "manual_by_topic" and offered is not None:
        if offered.liveliness != "manual_by_topic":
            return "with manual liveliness", "with automatic liveliness"
    return _time("lease duration", requested and requested.lease), _time("lease duration", offered and offered.lease)


def _time(name: str, value: object) -> str:
    return f"with a {name} of {value:g} s" if isinstance(value, float) else f"without a {name}"


def _flow(found: Mismatch) -> Iterator[Place]:
    for end in (found.giver, found.taker):
        yield from _steps(end)


def _steps(end: End) -> Iterator[Place]:
    if end.node.is_launched and end.node.location != end.location:
        yield end.node.location, f"{end.node} is started"
    yield end.location, f"{end}: {in_words(end.qos)}"
