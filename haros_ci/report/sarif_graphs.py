# SPDX-License-Identifier: Apache-2.0
"""The node-topic graphs of a SARIF run, and the ways of a result through them and through the code (§3.36–§3.43)."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

from haros_ci.model.location import Location
from haros_ci.records import dataclass, field
from haros_ci.report.escape import terminal
from haros_ci.report.message import label, literal
from haros_ci.report.sarif_objects import om
from haros_ci.results.result import Graph, Related, Result, Run

Edge = tuple[str, str]
#: A place with a message as a SARIF location.
Locate = Callable[[Location, "str | None"], om.Location]

#: Of one result; nobody follows more.
MAX_EDGES = 1_000


@dataclass(frozen=True, slots=True)
class Drawn:
    """The run's graphs as they are written: *indexes* by name, and of each the ids of its edges."""

    graphs: tuple[Graph, ...] = ()
    indexes: dict[str, int] = field(default_factory=dict)
    edges: tuple[dict[Edge, str], ...] = ()


def drawn(run: Run) -> Drawn:
    """Those graphs of *run* that a result of it traverses, in their order."""
    requested = {result.graph for result in run.results if result.graph and result.edges}
    graphs = {graph.name: graph for graph in run.graphs if graph.name in requested}
    edges = tuple(_edge_ids(graph) for graph in graphs.values())
    return Drawn(tuple(graphs.values()), {name: index for index, name in enumerate(graphs)}, edges)


def build_graphs(known: Drawn, locate: Locate) -> list[om.Graph]:
    """§3.39: nodes with a label and, where known, the place that starts them; edges from who gives to who takes."""
    return [_build(graph, edges, locate) for graph, edges in zip(known.graphs, known.edges, strict=True)]


def build_traversals(result: Result, known: Drawn) -> list[om.GraphTraversal]:
    """§3.42: the edges of a result as ways; each edge of a way begins where the one before ends."""
    index = known.indexes.get(result.graph)
    if index is None:
        return []
    ids = known.edges[index]
    return [
        om.GraphTraversal(run_graph_index=index, edge_traversals=[om.EdgeTraversal(edge_id=ids[edge]) for edge in way])
        for way in ways(edge for edge in result.edges[:MAX_EDGES] if edge in ids)
    ]


def build_flow(flow: Sequence[Related], locate: Locate) -> om.CodeFlow:
    """§3.36: the places that lead to a result, in order, as one thread. Its ends are what must be seen (§3.38.13)."""
    last = len(flow) - 1
    return om.CodeFlow(
        thread_flows=[
            om.ThreadFlow(
                locations=[
                    om.ThreadFlowLocation(
                        location=locate(step.location, label(step) + "."),
                        importance="essential" if number in (0, last) else "important",
                    )
                    for number, step in enumerate(flow)
                ]
            )
        ]
    )


def ways(edges: Iterable[Edge]) -> list[list[Edge]]:
    """The edges, each once, joined end to end as far as they go, from those that no other leads to."""
    left = dict.fromkeys(edges)
    after: dict[str, list[Edge]] = {}
    for edge in left:
        after.setdefault(edge[0], []).append(edge)
    targets = {target for _, target in left}
    found = []
    for first in sorted(left, key=lambda edge: edge[0] in targets):
        if first not in left:
            continue
        way = [first]
        del left[first]
        while more := [edge for edge in after.get(way[-1][1], ()) if edge in left]:
            way.append(more[0])
            del left[more[0]]
        found.append(way)
    return found


def _edge_ids(graph: Graph) -> dict[Edge, str]:
    """An id for each edge between vertices of the graph."""
    vertices = {vertex.id for vertex in graph.vertices}
    edges = [edge for edge in dict.fromkeys(graph.edges) if vertices.issuperset(edge)]
    return {edge: f"edge-{number}" for number, edge in enumerate(edges, 1)}


def _build(graph: Graph, edges: dict[Edge, str], locate: Locate) -> om.Graph:
    vertices = {vertex.id: vertex for vertex in graph.vertices}
    ids: dict[str, str] = {}
    taken: set[str] = set()
    for id in vertices:
        ids[id] = _distinct(terminal(id), taken)
    return om.Graph(
        description=om.Message(text=literal(terminal(graph.name)) or "?"),
        nodes=[
            om.Node(
                id=ids[vertex.id],
                label=om.Message(text=literal(terminal(vertex.label)) or "?"),
                location=locate(vertex.location, None) if vertex.location else None,
            )
            for vertex in vertices.values()
        ],
        edges=[
            om.Edge(id=id, source_node_id=ids[source], target_node_id=ids[target])
            for (source, target), id in edges.items()
        ],
    )


def _distinct(id: str, taken: set[str]) -> str:
    """*id*, with a number if another one looks like it once it is harmless."""
    number, made = 1, id
    while made in taken:
        number += 1
        made = f"{id} ({number})"
    taken.add(made)
    return made
