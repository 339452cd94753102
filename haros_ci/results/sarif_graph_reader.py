# SPDX-License-Identifier: Apache-2.0
"""The node-topic graphs of a SARIF run (§3.39), and the edges that a result traverses (§3.42), read as hostile input."""

from __future__ import annotations

from collections.abc import Callable
from typing import Union

from haros_ci.model.location import Location
from haros_ci.records import dataclass
from haros_ci.results.json_shape import items, mapping, natural, string
from haros_ci.results.result import Graph, Vertex

MAX_GRAPHS = 1_000
_MAX_EDGES = 1_000  # of one result

Edge = tuple[str, str]
Placed = Callable[[dict[str, object]], Union[Location, None]]


@dataclass(frozen=True, slots=True)
class ReadGraph:
    """A graph with the ids of its edges, by which results refer to them."""

    graph: Graph
    edges: dict[str, Edge]


def read_graphs(run: dict[str, object], placed: Placed) -> tuple[ReadGraph, ...]:
    """The graphs of a run, in its order, as results refer to them by position."""
    return tuple(_graph(mapping(entry), placed) for entry in items(run, "graphs")[:MAX_GRAPHS])


def traversed(result: dict[str, object], graphs: tuple[ReadGraph, ...]) -> tuple[str, tuple[Edge, ...]]:
    """The name of the graph that the result's first traversal is of, and all edges of it that the result traverses."""
    name, edges = "", dict[Edge, None]()
    for entry in map(mapping, items(result, "graphTraversals")[:_MAX_EDGES]):
        index = natural(entry, "runGraphIndex")
        if index is None or index >= len(graphs) or name not in ("", graphs[index].graph.name):
            continue
        name = graphs[index].graph.name
        for step in map(mapping, items(entry, "edgeTraversals")):
            edge = graphs[index].edges.get(string(step, "edgeId"))
            if edge is not None and len(edges) < _MAX_EDGES:
                edges[edge] = None
    return (name, tuple(edges)) if edges else ("", ())


def _graph(entry: dict[str, object], placed: Placed) -> ReadGraph:
    vertices: dict[str, Vertex] = {}
    for node in map(mapping, items(entry, "nodes")):
        id = string(node, "id")
        if id and id not in vertices:
            name = string(mapping(node, "label"), "text") or id
            place = placed(mapping(node, "location")) if "location" in node else None
            vertices[id] = Vertex(id, name, id.partition(":")[0], place)
    edges: dict[str, Edge] = {}
    for item in map(mapping, items(entry, "edges")):
        ends = string(item, "sourceNodeId"), string(item, "targetNodeId")
        if string(item, "id") and ends[0] in vertices and ends[1] in vertices:
            edges.setdefault(string(item, "id"), ends)
    name = string(mapping(entry, "description"), "text")
    return ReadGraph(Graph(name, tuple(vertices.values()), tuple(dict.fromkeys(edges.values()))), edges)
