# SPDX-License-Identifier: Apache-2.0
"""Graphs of nodes and topics, ways through them and through the code: what is written, and what is read back."""

from __future__ import annotations

import json
from dataclasses import replace
from typing import Any

import pytest
from report_samples import (
    ARCHITECTURE,
    HOSTILE,
    LAUNCH,
    MISMATCH,
    MISMATCH_RESULT,
    ODOM_EDGES,
    ODOM_GRAPH,
    OWN_RUN,
    PLAIN,
    SHAPES,
)
from report_samples import hostile as hostile_report

from haros_ci.model.location import Location
from haros_ci.report import sarif
from haros_ci.report.sarif_graphs import ways
from haros_ci.report.sarif_limits import Limits
from haros_ci.results.known import identity_of, known_from
from haros_ci.results.result import BaselineState, Graph, Related, Report, Result, Run, Vertex
from haros_ci.results.sarif_reader import read_sarif


def report(*results: Result, graphs: tuple[Graph, ...] = OWN_RUN.graphs) -> Report:
    return Report((replace(OWN_RUN, results=results, graphs=graphs),))


def written(made: Report, audience: sarif.Audience = "archive") -> dict[str, Any]:
    """The first run."""
    run = json.loads(sarif.render(made, audience=audience))["runs"][0]
    assert isinstance(run, dict)
    return run


def read_back(made: Report) -> Run:
    return read_sarif(sarif.render(made).encode(), "x.sarif")[0]


def edge_of(graph: dict[str, Any], id: str) -> tuple[str, str]:
    [edge] = [edge for edge in graph["edges"] if edge["id"] == id]
    return edge["sourceNodeId"], edge["targetNodeId"]


class TestGraphs:
    def test_nodes_edges_and_where_nodes_start(self) -> None:
        [graph] = written(ARCHITECTURE)["graphs"]
        assert graph["description"] == {"text": "base/launch/base.launch"}
        assert {n["id"]: n["label"]["text"] for n in graph["nodes"]} == {v.id: v.label for v in ODOM_GRAPH.vertices}
        places = {n["id"]: n["location"]["physicalLocation"] for n in graph["nodes"] if "location" in n}
        assert set(places) == {"node:/base", "node:/teleop"}
        assert places["node:/base"]["artifactLocation"]["uri"] == LAUNCH
        assert places["node:/base"]["region"] == {"startLine": 3}
        assert {(e["sourceNodeId"], e["targetNodeId"]) for e in graph["edges"]} == set(ODOM_GRAPH.edges)
        assert len({e["id"] for e in graph["edges"]}) == 4

    def test_a_result_traverses_them_end_to_end(self) -> None:
        run = written(ARCHITECTURE)
        [traversal] = run["results"][0]["graphTraversals"]
        graph = run["graphs"][traversal["runGraphIndex"]]
        assert [edge_of(graph, step["edgeId"]) for step in traversal["edgeTraversals"]] == list(ODOM_EDGES)

    def test_only_graphs_that_a_result_refers_to(self) -> None:
        run = written(report(replace(MISMATCH_RESULT, edges=(), graph="")))
        assert "graphs" not in run and "graphTraversals" not in run["results"][0]

    def test_a_finding_that_is_gone_refers_to_none(self) -> None:
        gone = replace(MISMATCH_RESULT, state=BaselineState.ABSENT, edges=())
        assert "graphs" not in written(report(gone))

    def test_edges_and_graphs_that_are_not_there(self) -> None:
        odd = replace(MISMATCH_RESULT, edges=(("node:/base", "topic:/none"), *ODOM_EDGES))
        [traversal] = written(report(odd))["results"][0]["graphTraversals"]
        assert len(traversal["edgeTraversals"]) == 2
        [lost] = written(report(replace(MISMATCH_RESULT, graph="other")))["results"]
        assert "graphTraversals" not in lost

    def test_an_edge_without_its_node_is_left_out(self) -> None:
        graph = Graph(ODOM_GRAPH.name, ODOM_GRAPH.vertices, (("node:/none", "topic:/odom"), *ODOM_GRAPH.edges))
        assert len(written(report(MISMATCH_RESULT, graphs=(graph,)))["graphs"][0]["edges"]) == 4

    def test_names_that_look_alike_when_harmless_stay_apart(self) -> None:
        ends = (Vertex("topic:/a\x00", "/a", "topic"), Vertex("topic:/a\x01", "/a", "topic"))
        edge = (ends[0].id, ends[1].id)
        result = replace(MISMATCH_RESULT, graph="g", edges=(edge,))
        [graph] = written(report(result, graphs=(Graph("g", ends, (edge,)),)))["graphs"]
        assert len({node["id"] for node in graph["nodes"]}) == 2
        assert graph["edges"][0]["sourceNodeId"] != graph["edges"][0]["targetNodeId"]

    @pytest.mark.parametrize("made", SHAPES.values(), ids=SHAPES)
    def test_github_gets_none(self, made: Report) -> None:
        text = sarif.render(made, audience="github")
        assert '"graphs"' not in text and '"graphTraversals"' not in text

    @pytest.mark.parametrize("name", [name for name in SHAPES if name != "architecture"])
    def test_logs_of_linters_have_none(self, name: str) -> None:
        text = sarif.render(SHAPES[name])
        assert '"graphs"' not in text and '"codeFlows"' not in text and "harosCiSubject" not in text


class TestFlow:
    @pytest.mark.parametrize("audience", ["archive", "github"])
    def test_one_thread_with_words_at_each_place(self, audience: sarif.Audience) -> None:
        [flow] = written(ARCHITECTURE, audience)["results"][0]["codeFlows"]
        [thread] = flow["threadFlows"]
        steps = [step["location"] for step in thread["locations"]]
        assert [step["message"]["text"] for step in steps] == [
            "starts /base.", "remaps odom to /odom.", "subscribes to odom."]  # fmt: skip
        assert [step["physicalLocation"]["region"]["startLine"] for step in steps] == [3, 4, 6]
        assert [step.get("importance", "important") for step in thread["locations"]] == [
            "essential", "important", "essential"]  # fmt: skip

    def test_a_finding_without_one(self) -> None:
        assert "codeFlows" not in written(PLAIN)["results"][0]

    def test_a_step_without_words_or_line(self) -> None:
        bare = replace(MISMATCH_RESULT, flow=(Related(Location(LAUNCH), ""),))
        [step] = written(report(bare))["results"][0]["codeFlows"][0]["threadFlows"][0]["locations"]
        assert step["location"]["message"]["text"] and "region" not in step["location"]["physicalLocation"]

    def test_long_ones_keep_their_end(self) -> None:
        flow = tuple(Related(Location(LAUNCH, n), f"step {n}") for n in range(1, 51))
        text, [note] = sarif.log(report(replace(MISMATCH_RESULT, flow=flow)), limits=Limits(steps=10))
        [thread] = json.loads(text)["runs"][0]["results"][0]["codeFlows"][0]["threadFlows"]
        lines = [step["location"]["physicalLocation"]["region"]["startLine"] for step in thread["locations"]]
        assert lines == [*range(1, 10), 50]
        assert note.message == "Steps of the flow past the first 9 and the last are left out of 1 results."

    def test_the_limit_itself_fits(self) -> None:
        flow = tuple(Related(Location(LAUNCH, n), f"step {n}") for n in range(1, 11))
        _, notes = sarif.log(report(replace(MISMATCH_RESULT, flow=flow)), limits=Limits(steps=10))
        assert notes == ()


def test_graphs_go_before_results_do() -> None:
    vertices = tuple(Vertex(f"topic:/{n * 2654435761 % 2**32:x}", f"/{n}", "topic") for n in range(3000))
    graph = Graph(ODOM_GRAPH.name, (*ODOM_GRAPH.vertices, *vertices), ODOM_GRAPH.edges)
    made = report(MISMATCH_RESULT, graphs=(graph,))
    text, [note] = sarif.log(made, limits=Limits(bytes=8_000))
    [run] = json.loads(text)["runs"]
    assert len(run["results"]) == 1 and "graphs" not in run and "graphTraversals" not in run["results"][0]
    assert note.message.startswith("The graphs of nodes and topics are not in this log") and note.message in text
    assert sarif.log(made)[1] == ()


def test_a_rule_has_its_id_in_the_catalogue() -> None:
    rules = {rule["id"]: rule for rule in written(ARCHITECTURE)["tool"]["driver"]["rules"]}
    assert rules["topic-type-mismatch"]["properties"]["catalogueId"] == "G06"
    assert rules["topic-type-mismatch"]["properties"]["precision"] == "high"
    assert "catalogueId" not in written(PLAIN)["tool"]["driver"]["rules"][0]["properties"]


def test_the_page_of_a_check_is_its_help() -> None:
    page = "# topic-type-mismatch\n\n## What it finds\n\nA topic with two types.\n\n## Limits\n\nNone.\n"
    made = replace(ARCHITECTURE, runs=(replace(OWN_RUN, rules=(replace(MISMATCH, help=page),)),))
    [rule] = written(made)["tool"]["driver"]["rules"]
    assert rule["fullDescription"]["text"] == "A topic with two types."
    assert rule["help"]["markdown"].startswith("## What it finds\n\nA topic")
    assert rule["help"]["text"].endswith("None.")


class TestRoundTrip:
    def test_all_that_a_finding_is_about(self) -> None:
        run = read_back(ARCHITECTURE)
        [found] = run.results
        made = MISMATCH_RESULT
        assert (found.subject, found.roles, found.graph, found.edges) == (
            made.subject, made.roles, made.graph, made.edges)  # fmt: skip
        assert [step.location for step in found.flow] == [step.location for step in made.flow]
        assert (identity_of(found).names, identity_of(found).roles) == ("12" * 8, "34" * 8)
        assert known_from(found).names == known_from(made).names
        assert run.rules[0].catalogue == "G06"
        assert found.scope == "", "a ROS name is no scope"

    def test_the_graph(self) -> None:
        [graph] = read_back(ARCHITECTURE).graphs
        assert (graph.name, graph.vertices, graph.edges) == (ODOM_GRAPH.name, ODOM_GRAPH.vertices, ODOM_GRAPH.edges)

    def test_written_again_it_is_the_same(self) -> None:
        run = read_back(ARCHITECTURE)
        assert written(Report((run,)))["graphs"] == written(ARCHITECTURE)["graphs"]

    def test_a_github_log_keeps_the_identity(self) -> None:
        [run, _] = read_sarif(sarif.render(ARCHITECTURE, audience="github").encode(), "x.sarif")
        assert known_from(run.results[0]).names == known_from(MISMATCH_RESULT).names
        assert run.results[0].subject == MISMATCH_RESULT.subject

    @pytest.mark.parametrize("text", HOSTILE)
    def test_hostile_names(self, text: str) -> None:
        run = read_back(hostile_report(text))
        assert all(len(result.edges) == 1 and result.subject for result in run.results)


#: Edges, and how they are joined.
WAYS: list[tuple[str, list[str]]] = [
    ("", []),
    ("ab", ["ab"]),
    ("ab bc", ["ab bc"]),
    ("bc ab", ["ab bc"]),
    ("ab bc ab", ["ab bc"]),
    ("ac bc cd", ["ac cd", "bc"]),
    ("ab cd", ["ab", "cd"]),
    ("ab ac", ["ab", "ac"]),
    ("ab ba", ["ab ba"]),
    ("aa", ["aa"]),
    ("ca ab bc", ["ca ab bc"]),
]


@pytest.mark.parametrize(("edges", "joined"), WAYS)
def test_ways(edges: str, joined: list[str]) -> None:
    found = ways((edge[0], edge[1]) for edge in edges.split())
    assert [" ".join(map("".join, way)) for way in found] == joined
    assert sum(map(len, found)) == len(set(edges.split()))
