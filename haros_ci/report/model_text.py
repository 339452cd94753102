# SPDX-License-Identifier: Apache-2.0
"""The architecture for a person at a terminal: what runs in each configuration, and how much of it is unknown."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import astuple

from haros_ci.model.architecture import KINDS, Architecture, Configuration, Endpoint, Node
from haros_ci.model.location import Location
from haros_ci.records import dataclass
from haros_ci.report.channels import CHANNELS, channels, endpoints_of, is_known, nodes_of
from haros_ci.report.escape import terminal
from haros_ci.report.message import shorten
from haros_ci.report.model_dependence import lines as dependence_lines
from haros_ci.report.model_rates import lines
from haros_ci.report.summary import plural

MAX_REASONS = 10
MAX_PLACES = 3
NOUNS = dict(
    zip(
        KINDS,
        (
            *("publisher", "subscriber", "server", "client", "action server", "action client", "getter", "setter"),
            "parameter",
        ),
        strict=True,
    )
)


@dataclass(frozen=True, slots=True)
class Reason:
    """Why names or types are unknown (*field*), how often, and where, first places first."""

    field: str
    text: str
    count: int
    places: tuple[Location, ...]


@dataclass(frozen=True, slots=True)
class Gaps:
    """How much of the endpoints is unknown, implicit ones left out; *qos* of the *topic_ends* of ROS 2 nodes."""

    endpoints: int
    names: int
    types: int
    reasons: tuple[Reason, ...]
    topic_ends: int = 0
    qos: int = 0


def render(architecture: Architecture) -> str:
    """A block for each configuration: its launch files, counts, nodes, and the rate of unknown names and types."""
    blocks = [tuple(_block(item)) for item in sorted(architecture.configurations, key=lambda item: item.name)]
    if not blocks:
        return "No configurations: no launch file and no node was found.\n"
    return "\n".join("".join(f"{line}\n" for line in block) for block in blocks)


def gaps(configuration: Configuration) -> Gaps:
    """What is unknown among the endpoints of *configuration* but those ruled out; a name or QoS is if any part of it is."""
    found_ends = [(node, end) for node in nodes_of(configuration) for end in endpoints_of(node) if _counts(end)]
    ends = [end for _, end in found_ends]
    topic_ends = [end for node, end in found_ends if node.ros == 2 and end.kind in ("publishers", "subscribers")]
    causes: dict[tuple[str, str], list[Location | None]] = {}
    for node, end in found_ends:
        for field, text, place in _causes(end, node.ros):
            causes.setdefault((field, text), []).append(place)
    reasons = [
        Reason(field, text, len(found), tuple(sorted({p for p in found if p is not None}, key=lambda p: p.sort_key)))
        for (field, text), found in causes.items()
    ]
    return Gaps(
        endpoints=len(ends),
        names=sum(not is_known(end.name) for end in ends),
        types=sum(_type_is_unknown(end) for end in ends),
        reasons=tuple(sorted(reasons, key=lambda reason: (-reason.count, reason.field, reason.text))),
        topic_ends=len(topic_ends),
        qos=sum(_qos_is_unknown(end) for end in topic_ends),
    )


def _counts(end: Endpoint) -> bool:
    return not (end.implicit or end.is_ruled_out)


def _type_is_unknown(end: Endpoint) -> bool:
    """Whether the type is missing where the call has one: asking whether a parameter is there has none."""
    if end.type is None and end.kind in ("getters", "setters", "parameters"):
        return any(why.field == "type" for why in end.unknowns)
    return not is_known(end.type)


def _qos_is_unknown(end: Endpoint) -> bool:
    return end.qos is None or "?" in astuple(end.qos)


def _causes(end: Endpoint, ros: int) -> Iterator[tuple[str, str, Location | None]]:
    """Field, reason and place of an unknown name, type and QoS."""
    qos = ros == 2 and end.kind in ("publishers", "subscribers") and _qos_is_unknown(end)
    for field, unknown in (("name", not is_known(end.name)), ("type", _type_is_unknown(end)), ("QoS", qos)):
        if unknown:
            messages = [why for why in end.unknowns if why.field.partition(".")[0] == field.lower()]
            for why in messages:
                exact = why.location if why.location and why.location.line else None
                yield field, why.reason, exact or end.location or why.location
            if not messages:
                yield field, "no reason given", end.location


def _block(configuration: Configuration) -> Iterator[str]:
    nodes = nodes_of(configuration)
    shown = Counter(item.what for item in channels(configuration) if not item.implicit)
    counts = [plural(len(nodes), "node"), *(plural(shown[what], what[:-1]) for what in CHANNELS)]
    known = sum(is_known(parameter.name) for parameter in configuration.parameters)
    counts.append(f"{plural(known, 'parameter')} set{'' if known == len(configuration.parameters) else ', and more'}")
    yield f"configuration {terminal(configuration.name)}: {', '.join(counts)}"
    for path in configuration.launch:
        yield f"  launch {terminal(path)}"
    for name, value in configuration.arguments:
        yield f"    arg {terminal(name)}:={terminal(str(value))}"
    for node in nodes:
        yield f"  node {_node(node)}"
    yield from _unknown(gaps(configuration))
    if configuration.rates is not None:
        yield from lines(configuration.rates)
    if configuration.dependence is not None:
        yield from dependence_lines(configuration.dependence)


def _node(node: Node) -> str:
    ends = Counter(end.kind for end in node.endpoints if _counts(end))
    has = [plural(ends[kind], NOUNS[kind]) for kind in KINDS if ends[kind]]
    kind = "" if node.kind == "node" else f" ({terminal(node.kind)})"
    condition = " [conditional]" if node.conditions else ""
    what = f"{terminal(node.name)} {terminal(f'{node.package}/{node.type}')}{kind}{condition}"
    missing = next((why.reason for why in node.unknowns if why.field == "endpoints"), None)
    if missing is not None:
        return f"{what}: {', '.join(has) or '?'} ({terminal(missing)})"
    return f"{what}: {', '.join(has) or 'no endpoints'}"


def _unknown(found: Gaps) -> Iterator[str]:
    if not found.endpoints:
        return
    rates = [("names", found.names, found.endpoints), ("types", found.types, found.endpoints)]
    rates += [("QoS", found.qos, found.topic_ends)] if found.topic_ends else []
    yield "  " + "; ".join(f"unknown {what}: {_rate(part, whole)}" for what, part, whole in rates)
    for reason in found.reasons[:MAX_REASONS]:
        places = ", ".join(terminal(str(place)) for place in reason.places[:MAX_PLACES])
        more = f" and {len(reason.places) - MAX_PLACES:,} more" if len(reason.places) > MAX_PLACES else ""
        text = shorten(terminal(reason.text), 200)
        count = f"{reason.count:,} QoS" if reason.field == "QoS" else plural(reason.count, reason.field)
        yield f"    {count}: {text}{f' ({places}{more})' if places else ''}"
    if len(found.reasons) > MAX_REASONS:
        yield f"    and {len(found.reasons) - MAX_REASONS:,} more reasons"


def _rate(part: int, whole: int) -> str:
    return f"{part:,} of {whole:,} ({part / whole:.1%})"
