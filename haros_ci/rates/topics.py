# SPDX-License-Identifier: Apache-2.0
"""The rates of a configuration: of each publish call, of what each node publishes, and of each topic as a whole."""

from __future__ import annotations

from collections.abc import Mapping
from math import inf

from haros_ci.code.codebase import Codebase
from haros_ci.model.architecture import Configuration
from haros_ci.model.location import Location
from haros_ci.model.rates import NEVER, CallRate, Rate, Rates, TopicRate, total, unknown
from haros_ci.rates.flows import Filters, Flow, NodeFlows, scaled
from haros_ci.rates.written import Written
from haros_ci.records import dataclass

#: Rounds after which a rate that still grows has no bound, and all that there are.
WIDEN, ROUNDS = 12, 40
CYCLE = "callbacks publish what calls them again"
NOBODY = "it comes with messages on {}, which no node of the configuration publishes"


@dataclass(frozen=True, slots=True)
class _Published:
    node: str
    topic: str
    location: Location | None
    calls: tuple[tuple[Location, Flow], ...]
    reason: str


def rates_of(configuration: Configuration, code: Codebase, filtered: Filters = lambda location: ()) -> Rates:
    """The rates of a *configuration*, whose programs are in *code*; *filtered* knows what filters of messages pass on."""
    known = {one.name: one for one in configuration.parameters}
    ends = [end for node in configuration.nodes for end in node.endpoints]
    changed = frozenset(end.name for end in ends if end.kind == "setters")
    names = frozenset(end.name for end in ends if end.kind == "publishers")
    nodes = (
        NodeFlows(code, node, Written(code, node, known, changed), filtered, names) for node in configuration.nodes
    )
    published = [one for flows in nodes for one in _of_node(flows)]
    topics = _solved(published)
    found = []
    for one in published:
        calls = tuple(CallRate(location, _at(flow, topics)) for location, flow in one.calls)
        rate = total(call.rate for call in calls)
        rate = rate if not one.reason else unknown(one.reason, rate.low)
        inputs = sorted({name for _, flow in one.calls for name, _, high in flow.topics if high})
        found.append(TopicRate(one.node, one.topic, one.location, rate, calls, tuple(inputs)))
    order = sorted(found, key=lambda one: (one.node, one.topic, one.location.sort_key if one.location else ()))
    return Rates(tuple(order), tuple(sorted(topics.items())))


def _of_node(flows: NodeFlows) -> list[_Published]:
    found, node = [], flows.node
    for end in node.endpoints:
        if end.kind != "publishers" or (end.implicit and end.location is None) or end.is_ruled_out:
            continue
        calls, reason = flows.calls(end)
        placed = tuple((call.location, call.flow) for call in calls)
        found.append(_Published(node.name, end.name, end.location, placed, reason))
    return found


def _solved(published: list[_Published]) -> dict[str, Rate]:
    """The least rates that agree with what is published; one that still grows after some rounds has no bound."""
    by_topic: dict[str, list[_Published]] = {}
    for one in published:
        if "?" not in one.topic:
            by_topic.setdefault(one.topic, []).append(one)
    topics = dict.fromkeys(by_topic, NEVER)
    for turn in range(ROUNDS):
        now = {name: _sum(group, topics) for name, group in by_topic.items()}
        if now == topics:
            break
        if turn >= WIDEN:
            now = {name: _widened(topics[name], rate) for name, rate in now.items()}
        if turn >= WIDEN + len(by_topic):
            now = {name: Rate(min(rate.low, topics[name].low), rate.high, rate.reason) for name, rate in now.items()}
        topics = now
    return topics


def _widened(before: Rate, now: Rate) -> Rate:
    """What still grows has no bound; it stays so when what has gone around the circle has not come back yet."""
    return Rate(before.low, inf, CYCLE) if now.high > before.high or before.reason == CYCLE else now


def _sum(published: list[_Published], topics: Mapping[str, Rate]) -> Rate:
    """The rate of a topic, of all that is *published* on it."""
    rates = ((one, total(_at(flow, topics) for _, flow in one.calls)) for one in published)
    return total(unknown(one.reason, rate.low) if one.reason else rate for one, rate in rates)


def _at(flow: Flow, topics: Mapping[str, Rate]) -> Rate:
    """A flow as a number, under the rates that topics have."""
    inherited = [
        scaled(topics[name] if name in topics else unknown(NOBODY.format(name)), low, high)
        for name, low, high in flow.topics
    ]
    return total((flow.own, *inherited))
