# SPDX-License-Identifier: Apache-2.0
"""The changed part of the node-topic graph as a Mermaid flowchart: added green, removed red and dashed, the rest grey."""

from __future__ import annotations

from collections.abc import Iterable

from haros_ci.model.changes import ADDED, REMOVED, Changes, Edge
from haros_ci.report.model_mermaid import BRACKETS, label

#: Edges that are drawn; those that have not changed are the first to be left out.
MOST = 60
STYLES = ("classDef added stroke:#1a7f37,stroke-width:2px", "classDef removed stroke:#cf222e,stroke-dasharray:5 5")
_COLOURS = {ADDED: "stroke:#1a7f37,stroke-width:2px", REMOVED: "stroke:#cf222e,stroke-dasharray:5 5"}


def diagram(found: Changes) -> str:
    """The flowchart without a fence; "" if no end of a topic, service or action has changed."""
    edges = drawn(found.edges)
    if not any(edge.state for edge in edges):
        return ""
    nodes = {name: f"n{number}" for number, name in enumerate(dict.fromkeys(edge.node for edge in edges))}
    channels = dict.fromkeys((edge.kind, edge.channel) for edge in edges)
    ids = {key: f"{key[0][0]}{number}x" for number, key in enumerate(channels)}
    lines = [f"{id}[{label(name)}]" for name, id in nodes.items()]
    for kind, name in channels:
        opening, closing = BRACKETS[f"{kind}s"]
        lines.append(f"{ids[kind, name]}{opening}{label(name)}{closing}")
    for edge in edges:
        ends = (nodes[edge.node], ids[edge.kind, edge.channel])
        tail, tip = ends if edge.is_giver else ends[::-1]
        lines.append(f"{tail} {'-.->' if edge.state == REMOVED else '-->'} {tip}")
    lines += (f"linkStyle {number} {_COLOURS[edge.state]}" for number, edge in enumerate(edges) if edge.state)
    states = {id: {e.state for e in edges if (e.kind, e.channel) == key} for key, id in ids.items()}
    lines += (f"class {id} {min(found)}" for id, found in states.items() if len(found) == 1 and min(found))
    return "\n".join(("flowchart LR", *(f"  {line}" for line in (*lines, *STYLES)))) + "\n"


def drawn(edges: Iterable[Edge]) -> tuple[Edge, ...]:
    """The edges to draw: of those that differ in namespaces alone, one; changed ones first where there are too many."""
    alike: dict[tuple[object, ...], Edge] = {}
    for edge in sorted(edges, key=lambda edge: (len(edge.node), len(edge.channel), edge.node, edge.channel)):
        node, channel = edge.node.rpartition("/")[2], edge.channel.rpartition("/")[2]
        alike.setdefault((node, channel, edge.kind, edge.is_giver, edge.state), edge)
    chosen = sorted(alike.values(), key=lambda edge: not edge.state)[:MOST]
    return tuple(sorted(chosen, key=lambda edge: (edge.kind, edge.channel, not edge.is_giver, edge.node, edge.state)))
