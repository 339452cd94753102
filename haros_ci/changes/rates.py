# SPDX-License-Identifier: Apache-2.0
"""How often nodes publish, compared: a change counts once, where it begins, with all nodes that it reaches.

A node that publishes in a callback has the rate of what it receives. Such a change belongs to the one that it comes from.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from haros_ci.changes.change import CHANGED, Difference
from haros_ci.changes.nodes import program
from haros_ci.model.architecture import Architecture, Configuration, Node
from haros_ci.model.location import Location
from haros_ci.model.rates import NEVER, Rate, total
from haros_ci.records import dataclass, field

#: A node and a topic that it publishes.
Key = tuple[str, str]


@dataclass(frozen=True, slots=True)
class ComparedRates:
    """The *differences*, and how many are not said as one side is *not_known*."""

    differences: tuple[Difference, ...] = ()
    not_known: int = 0


@dataclass(slots=True)
class _Published:
    """What one node publishes on one topic: from all publishers together."""

    rate: Rate = NEVER
    location: Location | None = None
    inputs: set[str] = field(default_factory=set)


@dataclass(frozen=True, slots=True)
class _Changed:
    before: _Published
    after: _Published


def paces_differ(base: Architecture, head: Architecture) -> bool:
    """Whether a node of a configuration that both have has a timer or rate with another period, or one more or less."""
    left = {configuration.name: _paces(configuration) for configuration in base.configurations}
    return any(
        name in before and before[name] != paces
        for configuration in head.configurations
        for before in (left.get(configuration.name, {}),)
        for name, paces in _paces(configuration).items()
    )


def _paces(configuration: Configuration) -> dict[str, list[tuple[str, str]]]:
    """The kinds and periods of the timers and rates of each node."""
    return {node.name: sorted((one.kind, repr(one.period)) for one in node.paces) for node in configuration.nodes}


def compare_rates(base: Configuration, head: Configuration, renamed: Mapping[str, str]) -> ComparedRates:
    """The rates that are others in *head* than in *base*, if both have them; *renamed* are new names of nodes.

    Each difference names as its users the nodes that the topic reaches, directly or through topics that inherit its rate.
    """
    left, right = _published(base, renamed), _published(head, {})
    changed: dict[Key, _Changed] = {}
    not_known = 0
    for key in sorted(left.keys() & right.keys()):
        before, after = left[key], right[key]
        if "?" in "".join(key) or before.rate == after.rate:
            continue
        if not (before.rate.is_known and after.rate.is_known):
            not_known += before.rate.is_known != after.rate.is_known
            continue
        changed[key] = _Changed(before, after)
    takers = _takers(head)
    nodes = {node.name: node for node in head.nodes}
    found = []
    left_over = dict(changed)
    for key in [*_first(changed), *changed]:  # what is in a circle has no beginning
        if key in left_over:
            found.append(_difference(key, right, left_over, takers, nodes, head.name))
    return ComparedRates(tuple(found), not_known)


def _first(changed: Mapping[Key, _Changed]) -> list[Key]:
    """What does not inherit a rate that has changed itself."""
    topics = {topic for _, topic in changed}
    return [key for key, one in changed.items() if topics.isdisjoint(one.after.inputs | one.before.inputs)]


def _published(configuration: Configuration, renamed: Mapping[str, str]) -> dict[Key, _Published]:
    found: dict[Key, _Published] = {}
    for one in configuration.rates.published if configuration.rates is not None else ():
        here = found.setdefault((renamed.get(one.node, one.node), one.topic), _Published())
        here.rate = total((here.rate, one.rate))
        here.location = here.location or one.location
        here.inputs |= set(one.inputs)
    return found


def _takers(configuration: Configuration) -> dict[str, set[str]]:
    """The nodes that subscribe to each topic."""
    found: dict[str, set[str]] = {}
    for node in configuration.nodes:
        for end in node.endpoints:
            if end.kind == "subscribers" and not end.is_ruled_out and not end.implicit and "?" not in node.name:
                found.setdefault(end.name, set()).add(node.name)
    return found


def _difference(
    key: Key,
    published: Mapping[Key, _Published],
    left_over: dict[Key, _Changed],
    takers: Mapping[str, Iterable[str]],
    nodes: Mapping[str, Node],
    configuration: str,
) -> Difference:
    """The change of *key*, with the nodes that it reaches; what comes from it is taken out of *left_over*."""
    name, topic = key
    one = left_over.pop(key)
    affected: set[str] = set()
    details: list[str] = []
    waiting, seen = [topic], {topic}
    while waiting:
        here = waiting.pop(0)
        affected |= set(takers.get(here, ()))
        for follower, found in sorted(published.items()):
            if here not in found.inputs:
                continue
            if follower in left_over:
                change = left_over.pop(follower)
                details.append(f"{follower[1]} of {follower[0]}: {change.before.rate} → {change.after.rate}")
            if follower[1] not in seen:
                seen.add(follower[1])
                waiting.append(follower[1])
    return Difference(
        what="rate",
        action=CHANGED,
        name=topic,
        before=str(one.before.rate),
        after=str(one.after.rate),
        node=name,
        program=program(nodes[name]) if name in nodes else "",
        configuration=configuration,
        base=one.before.location,
        head=one.after.location,
        users=tuple(sorted(affected - {name})),
        details=tuple(details),
    )
