# SPDX-License-Identifier: Apache-2.0
"""Ends of a topic or service that ROS 2 does not connect, because one asks for more quality of service than the other offers.

Compatibility follows the tables of "Quality of Service settings" (docs.ros.org) and the request-offered policies of DDS 1.4,
§2.2.3. What the middleware decides (None, best_available) and what is not known (``?``) is compatible with everything.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping

from haros_ci.checking.coexistence import can_meet, is_never_made
from haros_ci.checking.system import Channel, End, System
from haros_ci.model.architecture import Qos
from haros_ci.model.location import Location
from haros_ci.model.presence import together
from haros_ci.records import dataclass

#: Statements of which only one side is taken.
BRANCHES = frozenset(("if", "else", "elif", "switch", "case", "catch", "except", "#if", "unless"))
OVERRIDDEN = {"publishers": "publisher", "subscribers": "subscription"}


def refuses(policy: str, offered: Qos | None, requested: Qos | None) -> bool:
    """Whether *offered* is less than what is *requested* for; *policy* is reliability, durability, deadline or liveliness.

    A deadline and a lease that are not set have no end, and liveliness is automatic where nobody says otherwise.
    """
    if offered is None or requested is None:
        return False
    if policy == "reliability":
        return offered.reliability == "best_effort" and requested.reliability == "reliable"
    if policy == "durability":
        return offered.durability == "volatile" and requested.durability == "transient_local"
    if policy == "deadline":
        return _is_longer(offered.deadline, requested.deadline)
    is_less = requested.liveliness == "manual_by_topic" and offered.liveliness in (None, "automatic")
    return is_less or _is_longer(offered.lease, requested.lease)


def _is_longer(offered: float | str | None, requested: float | str | None) -> bool:
    if requested is None or isinstance(requested, str) or isinstance(offered, str):
        return False
    return offered is None or offered > requested


@dataclass(frozen=True, slots=True)
class Pair:
    """*giver* (a publisher, a server) and *taker* that are not connected; *is_starved*: no other giver is left for the taker."""

    channel: Channel
    giver: End
    taker: End
    is_starved: bool

    @property
    def order(self) -> tuple[object, ...]:
        """What is there by default comes first, then by name."""
        ends = (self.giver, self.taker)
        return (
            not all(end.node.is_default for end in ends),
            len(together(*(end.presence for end in ends)) or ()),
            self.channel.name,
            *(end.node.name for end in ends),
            *(end.location.sort_key for end in ends),
        )


@dataclass(frozen=True, slots=True)
class Mismatch:
    """Pairs with one cause: the *end* that is to be changed, the *other* end, and all *pairs*, the shown one first."""

    pairs: tuple[Pair, ...]
    is_giver: bool

    @property
    def channel(self) -> Channel:
        return self.pairs[0].channel

    @property
    def end(self) -> End:
        return self.pairs[0].giver if self.is_giver else self.pairs[0].taker

    @property
    def other(self) -> End:
        return self.pairs[0].taker if self.is_giver else self.pairs[0].giver

    @property
    def giver(self) -> End:
        return self.pairs[0].giver

    @property
    def taker(self) -> End:
        return self.pairs[0].taker

    @property
    def others(self) -> tuple[End, ...]:
        """The other ends, one of each call."""
        ends = (pair.taker if self.is_giver else pair.giver for pair in self.pairs)
        return tuple({end.location: end for end in reversed(tuple(ends))}.values())[::-1]

    @property
    def is_starved(self) -> bool:
        """Whether some taker gets nothing at all."""
        return any(pair.is_starved for pair in self.pairs)


def mismatches(system: System, policy: str, fix: str) -> Iterator[Mismatch]:
    """The ends in *system* that *policy* keeps from connecting, once per call that has to be changed.

    *fix* is ``giver`` or ``taker``: the end that as a rule has what is the default. Where several calls of that kind are refused
    because of one call of the other kind alone, it is this one.
    """
    channels = (*system.topics, *system.services) if policy in ("reliability", "durability") else system.topics
    text = None if system.workspace is None else system.workspace.text
    pairs = [pair for channel in channels for pair in refused_pairs(channel, policy, text)]
    met: dict[Location, set[Location]] = {}
    for pair in pairs:
        met.setdefault(pair.giver.location, set()).add(pair.taker.location)
        met.setdefault(pair.taker.location, set()).add(pair.giver.location)
    causes: dict[tuple[bool, Location], list[Pair]] = {}
    for pair in pairs:
        is_giver = _is_changed(pair, fix, met)
        causes.setdefault((is_giver, (pair.giver if is_giver else pair.taker).location), []).append(pair)
    for (is_giver, _), alike in causes.items():
        yield Mismatch(tuple(sorted(alike, key=lambda pair: pair.order)), is_giver)


def _is_changed(pair: Pair, fix: str, met: Mapping[Location, set[Location]]) -> bool:
    """Whether the giver of *pair* is the one to change."""
    if pair.channel.kind == "service":
        return pair.giver.in_source and not _is_common(pair.giver.qos)
    usual, other = (pair.giver, pair.taker) if fix == "giver" else (pair.taker, pair.giver)
    calls = met[other.location]
    is_alone = len(calls) > 1 and all(met[call] == {other.location} for call in calls)
    chosen = other if not usual.in_source or (is_alone and other.in_source) else usual
    return chosen is pair.giver


def _is_common(qos: Qos | None) -> bool:
    """Whether a service has the policies that services have by default."""
    return qos is not None and (qos.reliability, qos.durability) == ("reliable", "volatile")


def refused_pairs(channel: Channel, policy: str, text: Callable[[str], str] | None = None) -> Iterator[Pair]:
    """The pairs of *channel* that exist at once, agree on the type, and are kept from connecting by *policy*; *text* as for ``is_never_made``."""
    offers = {end.qos for end in channel.givers if not end.implicit}
    wishes = {end.qos for end in channel.takers if not end.implicit}
    if not any(_are_incompatible(channel, policy, offer, wish) for offer in offers for wish in wishes):
        return
    for taker in channel.takers:
        present = [giver for giver, _ in can_meet(channel.givers, (taker,)) if not _differ(giver, taker)]
        refused = [giver for giver in present if _are_incompatible(channel, policy, giver.qos, taker.qos)]
        for giver in refused:
            if giver.implicit or taker.implicit or not (giver.in_source or taker.in_source):
                continue
            if _is_chosen(giver, [twin for twin in present if twin not in refused]):
                continue
            there = (twin for twin in channel.takers if not is_never_made(twin, text))
            twins = (twin for twin in there if not _are_incompatible(channel, policy, giver.qos, twin.qos))
            if not _is_chosen(taker, [twin for twin in twins if not _differ(giver, twin)]):
                yield Pair(channel, giver, taker, len(refused) == len(present))


def _are_incompatible(channel: Channel, policy: str, offered: Qos | None, requested: Qos | None) -> bool:
    """Whether no message comes from the one to the other; of a service each end offers and asks for the same."""
    # haros: ignore[arguments-out-of-order] a service is looked at both ways
    return refuses(policy, offered, requested) or (channel.kind == "service" and refuses(policy, requested, offered))


def _differ(giver: End, taker: End) -> bool:
    """Whether the types differ, so that no quality of service would connect the two."""
    return giver.type is not None and taker.type is not None and giver.type != taker.type


def _is_chosen(end: End, fitting: list[End]) -> bool:
    """Whether the node of *end* makes, on some path, another end for the same in place of it that is *fitting*."""
    return any(
        twin.node is end.node
        and twin is not end
        and any(condition.statement in BRANCHES for condition in (*end.conditions, *twin.conditions))
        for twin in fitting
    )


def override_place(system: System, end: End, policy: str) -> Location | None:
    """Where a parameter says the *policy* of *end* (``qos_overrides.<topic>.publisher.<policy>``); None if its code does."""
    head = f"{end.node.name}:qos_overrides.{end.name}.{OVERRIDDEN.get(end.kind, '?')}"
    for parameter in system.parameters:
        if parameter.name.startswith(head) and parameter.name.endswith(f".{policy}"):
            return parameter.origin or parameter.location
    return None


def in_words(qos: Qos | None) -> str:
    """``reliable, volatile, keep last 10``: the whole quality of service, for a message."""
    if qos is None:
        return "unknown"
    parts = [_word("reliability", qos.reliability), _word("durability", qos.durability), _history(qos)]
    parts += [
        f"{name} {value:g} s" if isinstance(value, float) else f"{name} {_word('', value)}".strip()
        for name, value in (("deadline", qos.deadline), ("lifespan", qos.lifespan), ("lease", qos.lease))
        if value is not None
    ]
    if qos.liveliness is not None:
        parts.append(f"liveliness {_word('', qos.liveliness)}")
    return ", ".join(parts)


def _word(policy: str, value: object) -> str:
    if value is None:
        return f"default {policy}"
    return f"unknown {policy}".strip() if value == "?" else str(value).replace("_", " ")


def _history(qos: Qos) -> str:
    if qos.history != "keep_last" or qos.depth is None:
        return _word("history", qos.history)
    return f"keep last {'an unknown number' if qos.depth == '?' else qos.depth}"
