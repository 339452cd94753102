# SPDX-License-Identifier: Apache-2.0
"""What a change does to the system, as the page has it: the table of ``haros-ci diff`` and the part of the graph that it touches."""

from __future__ import annotations

from typing import Any

from haros_ci.html_page.elements import Drawn, Elements
from haros_ci.html_page.layout import laid_out
from haros_ci.html_page.pool import NONE, Pool
from haros_ci.model.architecture import Endpoint, Node
from haros_ci.model.changes import ADDED, REMOVED, Changes
from haros_ci.report.channels import Channel
from haros_ci.report.diff_text import headline, title

#: What an edge of the picture is at an end, by what it leads to and whether the node gives.
ENDS = {
    ("topic", True): "publishers",
    ("topic", False): "subscribers",
    ("service", True): "servers",
    ("service", False): "clients",
    ("action", True): "action_servers",
    ("action", False): "action_clients",
}
#: What stands before a name in the picture, so that there is room for it.
_SIGN = "~ "


def changed(pool: Pool, found: Changes) -> dict[str, Any]:
    """The changes as rows, and the picture of the edges that came, went or stand beside them."""
    rows = [
        (
            change.what,
            change.action,
            pool.text(title(change)),
            pool.texts(change.names),
            pool.texts(change.old_names),
            pool.text(change.before),
            pool.text(change.after),
            pool.texts(change.nodes),
            pool.texts(change.programs),
            pool.texts(change.configurations),
            pool.texts(change.users),
            pool.texts(change.details),
            pool.place(change.location),
        )
        for change in found.changes
    ]
    return {
        "headline": pool.text(headline(found)) if found.changes else NONE,
        "rows": rows,
        "not_known": found.not_known,
        "picture": _picture(pool, found),
    }


def _picture(pool: Pool, found: Changes) -> dict[str, Any] | None:
    """The nodes and channels of the edges with their states; None where there are none, or too many."""
    if not found.edges:
        return None
    names = sorted({edge.node for edge in found.edges})
    made, states = _elements(found, names)
    layout = laid_out(made)
    if layout is None:
        return None
    node_state = _states(found, names)
    return {
        "size": layout.size,
        "nodes": [(pool.text(name), node_state[name], *place) for name, place in zip(names, layout.nodes, strict=True)],
        "channels": [
            (channel.channel.what, pool.text(channel.channel.name.removeprefix(_SIGN)), *place)
            for channel, place in zip(made.channels, layout.channels, strict=True)
        ],
        "edges": [
            (node, channel, int(gives), states.get((node, channel, gives), ""), points)
            for node, channel, gives, points in layout.edges
        ],
    }


def _elements(found: Changes, names: list[str]) -> tuple[Elements, dict[tuple[int, int, bool], str]]:
    """The nodes *names* with the channels of the edges, and the state of each edge: by node, channel and direction."""
    index = {name: number for number, name in enumerate(names)}
    made = Elements(tuple(Node(name=name, kind="node", package="", type=name) for name in names))
    made.box_of = [-1] * len(names)
    made.own = [[] for _ in names]
    channels: dict[tuple[str, str], list[tuple[int, bool, str]]] = {}
    for edge in found.edges:
        is_out = edge.is_giver if edge.kind == "topic" else not edge.is_giver
        channels.setdefault((edge.kind, edge.channel), []).append((index[edge.node], is_out, edge.state))
    states: dict[tuple[int, int, bool], str] = {}
    for number, ((kind, name), ends) in enumerate(sorted(channels.items())):
        pairs = dict.fromkeys((node, is_out) for node, is_out, _ in ends)
        end = Endpoint(kind=ENDS[kind, True], name=name, original_name=name, type=None, location=None)
        channel = Channel(f"{kind}s", f"{_SIGN}{name}", tuple((made.nodes[node], end) for node, _ in pairs))
        made.channels.append(Drawn(channel, tuple(pairs), ""))
        states.update({(node, number, is_out): state for node, is_out, state in ends})
    return made, states


def _states(found: Changes, names: list[str]) -> dict[str, str]:
    """The state of each node: added or removed as a whole, changed, or "" for one that is only beside what has changed."""
    states = dict.fromkeys(names, "")
    for change in found.changes:
        whole = change.what == "node" and change.action in (ADDED, REMOVED)
        for name in change.names if whole else change.nodes:
            if name in states and states[name] not in (ADDED, REMOVED):
                states[name] = change.action if whole else "changed"
    return states
