# SPDX-License-Identifier: Apache-2.0
"""A recording held against a configuration: which topics, types, publishers, QoS and rates either has and the other lacks.

A recording does not have everything: what it lacks is no mistake of the model, and is said apart.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence

from haros_ci.model.architecture import Configuration, Endpoint, Node, Qos
from haros_ci.model.rates import Rate
from haros_ci.records import dataclass, field

#: Topics that ROS itself makes.
OF_ROS = frozenset(("/rosout", "/rosout_agg", "/parameter_events", "/events/read_split", "/events/write_split"))
#: What actions add to their name (actionlib; rcl_action/names.h: hidden topics).
OF_ACTIONS = ("/goal", "/cancel", "/status", "/feedback", "/result", "/_action/feedback", "/_action/status")
#: Messages of a topic that make a mean rate, and the part by which it may lie beside the model's.
FEWEST, TOLERANCE = 10, 0.2
#: Policies that publishers are found to have (rmw_get_publishers_info_by_topic), and what says nothing of one.
_POLICIES = ("reliability", "durability", "deadline", "lifespan", "liveliness", "lease")
_UNKNOWN = (None, "?", "best_available")


@dataclass(slots=True)
class ObservedTopic:
    """A topic of a recording: its *types*, *count* messages, the times of the first and last one in nanoseconds.

    *nodes* are those that publish it, with whether they latch it, and *qos* what publishers offer, as far as the recording tells.
    """

    name: str
    types: frozenset[str] = frozenset()
    count: int = 0
    first: int = 0
    last: int = 0
    nodes: Mapping[str, bool | None] = field(default_factory=dict)
    qos: tuple[Qos, ...] = ()

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
    qos: tuple[Qos, ...] = ()
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
    #: Ends of publishers with their nodes, by topic.
    made: dict[str, list[tuple[Node, Endpoint]]] = field(default_factory=dict)

    @property
    def doubt(self) -> str:
        """What is said where a publisher may be one of a node of which a topic's name is not known; "" if there is none."""
        return f"; of {', '.join(sorted(self.unknown)[:3])} the name of a topic is not known" if self.unknown else ""


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
            if end.kind == "publishers":
                found.made.setdefault(end.name, []).append((node, end))
                if "?" in end.name:
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
    made = ends.made.get(one.name, [])
    lacks = []
    if not is_of_action and not publishers:
        what = "no node of the model publishes it" if subscribers else "the model does not have it"
        lacks.append(f"{what}{ends.doubt}")
    lacks += [f"{text}{ends.doubt}" for text in (*_other_nodes(one, made), *_other_qos(one, made))] if made else []
    lacks += [*_other_type(one, known), *_other_rate(one, rate)]
    qos = tuple(dict.fromkeys(end.qos for _, end in made if end.qos is not None))
    return ComparedTopic(one, publishers, subscribers, tuple(sorted(known - {"?"})), qos, rate, tuple(lacks))


def _other_type(one: ObservedTopic, known: set[str]) -> Iterator[str]:
    recorded = {plain(name) for name in one.types}
    if recorded and known and "?" not in known and not recorded & known:
        yield f"the model has the type {', '.join(sorted(known))}, the recording {', '.join(sorted(recorded))}"


def _other_rate(one: ObservedTopic, rate: Rate | None) -> Iterator[str]:
    if rate is not None and rate.is_known and rate.high > 0 and one.rate is not None:
        if not rate.low * (1 - TOLERANCE) <= one.rate <= rate.high * (1 + TOLERANCE):
            yield f"the model has {rate}, the recording {one.rate:.3g} Hz"


def _other_nodes(one: ObservedTopic, made: Sequence[tuple[Node, Endpoint]]) -> Iterator[str]:
    """What the model lacks of the nodes that a recording of ROS 1 names: publishers, and their latching.

    A nodelet publishes under the name of its manager.
    """
    known: dict[str, set[bool | None]] = {}
    for node, end in made:
        for name in {node.name, node.container or node.name}:
            known.setdefault(name, set()).add(end.latched)
    if any("?" in name for name in known):
        return
    others = sorted(name for name in one.nodes if name not in known)
    if others:
        yield f"in the recording {', '.join(others[:5])} {'publishes' if len(others) == 1 else 'publish'} it, too"
    for name, is_latched in sorted(one.nodes.items()):
        if is_latched is not None and known.get(name) == {not is_latched}:
            words = ("latches it", "does not") if is_latched else ("does not latch it", "does")
            yield f"in the recording {name} {words[0]}, in the model it {words[1]}"


def _other_qos(one: ObservedTopic, made: Sequence[tuple[Node, Endpoint]]) -> Iterator[str]:
    """The QoS that a publisher of the recording offers, and none of the model can have."""
    models = [end.qos for _, end in made]
    for offered in one.qos:
        if all(qos is not None and differing(offered, qos) for qos in models):
            keys = sorted({key for qos in models if qos is not None for key in differing(offered, qos)})
            theirs = sorted({_words(qos, keys) for qos in models if qos is not None})
            yield f"a publisher of the recording has {_words(offered, keys)}, those of the model {' or '.join(theirs)}"


def differing(one: Qos, other: Qos) -> tuple[str, ...]:
    """The policies that both know, and that differ; depth and history are not compared: DDS does not tell them."""
    return tuple(
        key
        for key in _POLICIES
        if (here := getattr(one, key)) not in _UNKNOWN
        and (there := getattr(other, key)) not in _UNKNOWN
        and here != there
    )


def _words(qos: Qos, keys: Iterable[str]) -> str:
    return ", ".join(f"{key} {getattr(qos, key)}" for key in keys)


def plain(type: str) -> str:
    """``std_msgs/String`` for ``std_msgs/msg/String``."""
    return type.replace("/msg/", "/")
