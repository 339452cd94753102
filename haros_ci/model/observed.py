# SPDX-License-Identifier: Apache-2.0
"""A recording held against a configuration: which topics, types and rates either has and the other lacks.

A recording does not have everything: what it lacks is no mistake of the model, and is said apart.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

from haros_ci.model.architecture import Configuration
from haros_ci.model.rates import Rate

#: Topics that ROS itself makes.
OF_ROS = frozenset(("/rosout", "/rosout_agg", "/parameter_events", "/events/read_split", "/events/write_split"))
#: What actions add to their name (actionlib; rcl_action/names.h: hidden topics).
OF_ACTIONS = ("/goal", "/cancel", "/status", "/feedback", "/result", "/_action/feedback", "/_action/status")
#: Messages of a topic that make a mean rate, and the part by which it may lie beside the model's.
FEWEST, TOLERANCE = 10, 0.2


@dataclass(slots=True)
class ObservedTopic:
    """A topic of a recording: its *types*, *count* messages, the times of the first and last one in nanoseconds."""

    name: str
    types: frozenset[str] = frozenset()
    count: int = 0
    first: int = 0
    last: int = 0

    @property
    def rate(self) -> float | None:
        """The mean rate in hertz; None for too few messages."""
        span = (self.last - self.first) / 1e9
        return (self.count - 1) / span if self.count >= FEWEST and span > 0 else None


@dataclass(frozen=True, slots=True)
class ComparedTopic:
    """A topic of the recording beside the model: *lacks* says what the model does not have of it."""

    observed: ObservedTopic
    publishers: tuple[str, ...] = ()
    subscribers: tuple[str, ...] = ()
    types: tuple[str, ...] = ()
    rate: Rate | None = None
    lacks: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Comparison:
    """*topics* are those of the recording; *unrecorded* those of the model that it lacks, with their publishers."""

    configuration: str
    recording: str
    topics: tuple[ComparedTopic, ...]
    unrecorded: tuple[tuple[str, tuple[str, ...]], ...] = ()
    notes: tuple[str, ...] = ()


@dataclass(slots=True)
class _Ends:
    publishers: dict[str, set[str]] = field(default_factory=dict)
    subscribers: dict[str, set[str]] = field(default_factory=dict)
    types: dict[str, set[str]] = field(default_factory=dict)
    unknown: set[str] = field(default_factory=set)


def compare(
    configuration: Configuration, recording: str, observed: Mapping[str, ObservedTopic], notes: Iterable[str]
) -> Comparison:
    """What a *recording* has of a *configuration* and the reverse."""
    ends = _ends(configuration)
    rates = dict(configuration.rates.topics) if configuration.rates is not None else {}
    actions = {
        f"{end.name}{part}"
        for node in configuration.nodes
        for end in node.endpoints
        if end.kind in ("action_servers", "action_clients")
        for part in OF_ACTIONS
    }
    topics = [
        _compared(one, ends, rates.get(name), is_of_action=name in actions)
        for name, one in sorted(observed.items())
        if name not in OF_ROS
    ]
    unrecorded = sorted(
        (name, tuple(sorted(nodes)))
        for name, nodes in ends.publishers.items()
        if name not in observed and name not in OF_ROS and "?" not in name
    )
    return Comparison(configuration.name, recording, tuple(topics), tuple(unrecorded), tuple(notes))


def _ends(configuration: Configuration) -> _Ends:
    found = _Ends()
    for node in configuration.nodes:
        for end in node.endpoints:
            if end.kind not in ("publishers", "subscribers") or end.is_ruled_out:
                continue
            side = found.publishers if end.kind == "publishers" else found.subscribers
            side.setdefault(end.name, set()).add(node.name)
            if "?" in end.name and end.kind == "publishers":
                found.unknown.add(node.name)
            if end.type is not None and "?" not in end.type:
                found.types.setdefault(end.name, set()).add(plain(end.type))
            elif end.type is None:
                found.types.setdefault(end.name, set()).add("?")
    return found


def _compared(one: ObservedTopic, ends: _Ends, rate: Rate | None, *, is_of_action: bool) -> ComparedTopic:
    publishers = tuple(sorted(ends.publishers.get(one.name, ())))
    subscribers = tuple(sorted(ends.subscribers.get(one.name, ())))
    known = ends.types.get(one.name, set())
    lacks = []
    if not is_of_action and not publishers:
        what = "no node of the model publishes it" if subscribers else "the model does not have it"
        if ends.unknown:
            what += f"; of {', '.join(sorted(ends.unknown)[:3])} the name of a topic is not known"
        lacks.append(what)
    recorded = {plain(name) for name in one.types}
    if recorded and known and "?" not in known and not recorded & known:
        lacks.append(f"the model has the type {', '.join(sorted(known))}, the recording {', '.join(sorted(recorded))}")
    if rate is not None and rate.is_known and rate.high > 0 and one.rate is not None:
        is_within = rate.low * (1 - TOLERANCE) <= one.rate <= rate.high * (1 + TOLERANCE)
        if not is_within:
            lacks.append(f"the model has {rate}, the recording {one.rate:.3g} Hz")
    return ComparedTopic(one, publishers, subscribers, tuple(sorted(known - {"?"})), rate, tuple(lacks))


def plain(type: str) -> str:
    """``std_msgs/String`` for ``std_msgs/msg/String``."""
    return type.replace("/msg/", "/")
