# SPDX-License-Identifier: Apache-2.0
"""The steps of a system from what nodes get to what they send, and slices over them: all that a topic, service or action reaches through the nodes, and all that reaches it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from haros_ci.model.dependence import UNKNOWN, Dependence, Input, NodeDependence, Output, Reached, Slice

#: What the two ends of a topic, service or action are together, by the kinds of inputs and outputs.
MEDIA = {
    "subscription": "topic",
    "publishers": "topic",
    "service": "service",
    "clients": "service",
    "action": "action",
    "action_clients": "action",
}


def edges(dependence: Dependence) -> tuple[Reached, ...]:
    """All steps from an input of a node to an output of it, certain ones before those that may be."""
    found = [edge for node in dependence.nodes for edge in _of_node(node)]
    order = ("direct", "state", "perhaps", UNKNOWN)
    return tuple(sorted(found, key=lambda edge: order.index(edge.how)))


def _of_node(node: NodeDependence) -> Iterator[Reached]:
    for output in node.outputs:
        target = MEDIA[output.kind], output.name
        known = set()
        for cause in output.causes:
            source = MEDIA.get(cause.kind, cause.kind), cause.name
            known.add((cause.kind, cause.name))
            yield Reached(node.node, source, target, cause.how, 0, cause, cause.reason)
        for one in _unknown(node.inputs, output):
            if (one.kind, one.name) not in known:
                source = MEDIA.get(one.kind, one.kind), one.name
                yield Reached(node.node, source, target, UNKNOWN, 0, None, one.reason or output.reason)


def _unknown(inputs: Iterable[Input], output: Output) -> Iterator[Input]:
    return (one for one in inputs if one.reason or output.reason)


def sliced(dependence: Dependence, name: str, is_forward: bool) -> Slice:
    """All that *name* reaches, or that reaches it; certain steps are taken before those that are not."""
    every = edges(dependence)
    by_near: dict[tuple[str, str], list[Reached]] = {}
    for edge in every:
        by_near.setdefault(edge.source if is_forward else edge.target, []).append(edge)
    starts = [medium for medium in ("topic", "service", "action") if (medium, name) in by_near]
    waiting = [((medium, name), 1) for medium in sorted(starts)]
    seen = {place for place, _ in waiting}
    found: list[Reached] = []
    while waiting:
        place, depth = waiting.pop(0)
        for edge in by_near.get(place, ()):
            far = edge.target if is_forward else edge.source
            made = Reached(edge.node, edge.source, edge.target, edge.how, depth, edge.cause, edge.reason)
            found.append(made)
            if far not in seen and far[1]:
                seen.add(far)
                waiting.append((far, depth + 1))
    return Slice(name, is_forward, tuple(found))


def names(dependence: Dependence) -> tuple[str, ...]:
    """All topics, services and actions that nodes are on."""
    found = {one.name for node in dependence.nodes for one in node.inputs}
    found |= {one.name for node in dependence.nodes for one in node.outputs}
    return tuple(sorted(found - {""}))
