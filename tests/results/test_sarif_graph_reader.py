# SPDX-License-Identifier: Apache-2.0
"""Graphs, flows and names in SARIF logs of others, honest and odd."""

from __future__ import annotations

import json
from typing import Any

import pytest

from haros_ci.model.location import Location
from haros_ci.results.result import Result, Run, Vertex
from haros_ci.results.sarif_reader import read_sarif

NODES: list[Any] = [{"id": "n1", "label": {"text": "One"}}, {"id": "n2"}]
EDGES: list[Any] = [{"id": "e1", "sourceNodeId": "n1", "targetNodeId": "n2"}]
STEP = {"edgeId": "e1"}


def place(line: int = 3, uri: str = "a.cpp") -> dict[str, Any]:
    return {"physicalLocation": {"artifactLocation": {"uri": uri}, "region": {"startLine": line}}}


def read(graphs: object = (), **changes: Any) -> tuple[Run, Result]:
    result = {"ruleId": "r", "message": {"text": "Bad."}, "locations": [place()], **changes}
    run = {"tool": {"driver": {"name": "other"}}, "results": [result], "graphs": graphs}
    [found] = read_sarif(json.dumps({"version": "2.1.0", "runs": [run]}).encode(), "x.sarif")
    return found, found.results[0]


def test_a_plain_graph() -> None:
    graph = {"description": {"text": "all"}, "nodes": NODES, "edges": EDGES}
    run, result = read([graph], graphTraversals=[{"runGraphIndex": 0, "edgeTraversals": [STEP]}])
    [found] = run.graphs
    assert (found.name, [v.id for v in found.vertices], found.edges) == ("all", ["n1", "n2"], (("n1", "n2"),))
    assert [v.label for v in found.vertices] == ["One", "n2"]
    assert (result.graph, result.edges) == ("all", (("n1", "n2"),))


def test_places_of_nodes() -> None:
    nodes = [
        {"id": "node:/a", "location": place(7)},
        {"id": "node:/b", "location": place(1, "../../x")},
        {"id": "c", "location": 3},
    ]
    run, _ = read([{"nodes": nodes}])
    assert run.graphs[0].vertices == (
        Vertex("node:/a", "node:/a", "node", Location("a.cpp", 7)),
        Vertex("node:/b", "node:/b", "node"),
        Vertex("c", "c", "c"),
    )  # fmt: skip


def test_only_the_first_of_two_graphs_is_followed() -> None:
    graphs = [{"description": {"text": name}, "nodes": NODES, "edges": EDGES} for name in ("one", "two")]
    steps = [{"runGraphIndex": n, "edgeTraversals": [STEP]} for n in (1, 0, 1)]
    _, result = read(graphs, graphTraversals=steps)
    assert (result.graph, result.edges) == ("two", (("n1", "n2"),))


ODD_GRAPHS: list[Any] = [
    None, 3, "x", {}, [None], [[]], [{"nodes": 3, "edges": {}}], [{"nodes": [None, 3, {"id": ""}, {"id": 5}]}],
    [{"nodes": NODES, "edges": [None, {}, {"id": "e1"}, {"id": "e1", "sourceNodeId": "n1", "targetNodeId": "n9"}]}],
    [{"nodes": NODES, "edges": EDGES, "description": 7}],
]  # fmt: skip
ODD_TRAVERSALS: list[Any] = [
    None, 3, [None], [{}], [{"runGraphIndex": -1, "edgeTraversals": [STEP]}], [{"runGraphIndex": 99}],
    [{"runGraphIndex": "0", "edgeTraversals": [STEP]}], [{"runGraphIndex": 0, "edgeTraversals": [None, {}, {"edgeId": 3}, {"edgeId": "e9"}]}],
    [{"resultGraphIndex": 0, "edgeTraversals": [STEP]}],
]  # fmt: skip


@pytest.mark.parametrize("graphs", ODD_GRAPHS, ids=str)
@pytest.mark.parametrize("traversals", ODD_TRAVERSALS, ids=str)
def test_odd_shapes_lose_nothing_else(graphs: Any, traversals: Any) -> None:
    run, result = read(graphs, graphTraversals=traversals)
    assert (result.graph, result.edges, run.notifications) == ("", (), ())


def test_a_flow() -> None:
    steps = [{"location": {**place(n), "message": {"text": f"step {n}"}}} for n in (1, 2)]
    _, result = read(codeFlows=[{"threadFlows": [{"locations": steps}, {"locations": steps}]}, {}])
    assert [(step.location.line, step.message) for step in result.flow] == [(1, "step 1"), (2, "step 2")]


ODD_FLOWS: list[Any] = [
    None, 3, [None], [{}], [{"threadFlows": None}], [{"threadFlows": [{"locations": [None, 3, {}, {"location": 4}]}]}],
    [{"threadFlows": [{"locations": [{"location": place(3, "../../../etc/passwd")}]}]}],
]  # fmt: skip


@pytest.mark.parametrize("flows", ODD_FLOWS, ids=str)
def test_odd_flows(flows: Any) -> None:
    assert read(codeFlows=flows)[1].flow == ()


def test_names_and_scope() -> None:
    names = [{"fullyQualifiedName": "C::f", "kind": "function"}, {"fullyQualifiedName": "/a", "kind": "rosName"},
             {"fullyQualifiedName": "", "kind": "rosName"}, {"kind": "rosName"}, {"fullyQualifiedName": "ns", "kind": "namespace"},
             {"fullyQualifiedName": "/b", "kind": "rosName"}]  # fmt: skip
    _, result = read(locations=[{**place(), "logicalLocations": names}])
    assert (result.scope, result.subject) == ("C::f", ("/a", "/b"))
    _, result = read(locations=[{**place(), "logicalLocations": names[1:2]}])
    assert (result.scope, result.subject) == ("", ("/a",))
    _, result = read(locations=[{**place(), "logicalLocations": [None, 3]}], properties={"roles": ["x", 3, ""]})
    assert (result.scope, result.subject, result.roles) == ("", (), ("x",))


@pytest.mark.parametrize("value", [3, None, ["G06"], {}])
def test_a_catalogue_id_that_is_none(value: object) -> None:
    rule = {"id": "r", "properties": {"catalogueId": value}}
    run = {"tool": {"driver": {"name": "other", "rules": [rule]}}, "results": []}
    [found] = read_sarif(json.dumps({"version": "2.1.0", "runs": [run]}).encode(), "x.sarif")
    assert found.rules[0].catalogue == ""
