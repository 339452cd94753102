# SPDX-License-Identifier: Apache-2.0
"""The model under the names that a running graph shows: what nodelets make is their manager's."""

from __future__ import annotations

from haros_ci.model.architecture import Architecture, Condition, Configuration, Endpoint, Node
from haros_ci.model.location import Location
from haros_ci.model.running import as_running

WHERE = Location("p/launch/l.launch", 3, 1)
GUARD = Condition("if", "arg", WHERE)


def end(name: str) -> Endpoint:
    return Endpoint(
        kind="publishers", name=name, original_name=name, type="std_msgs/String", location=Location("p/n.cpp", 1, 1)
    )


def nodelet(name: str, process: str | None, *names: str, ros: int = 1) -> Node:
    return Node(
        name=name,
        kind="nodelet" if ros == 1 else "component",
        package="p",
        type="C",
        location=WHERE,
        process=process,
        container=process,
        ros=ros,
        conditions=(GUARD,) if name == "/sure" else (),
        endpoints=tuple(map(end, names)),
    )


def told(*nodes: Node) -> list[tuple[str, str, list[str]]]:
    found = as_running(Architecture(configurations=(Configuration(name="c", nodes=nodes),)))
    return [(n.name, n.kind, [e.name for e in n.endpoints]) for n in found.configurations[0].nodes]


MANAGER = Node(name="/m", kind="node", package="nodelet", type="nodelet", process="/m", endpoints=(end("/rosout"),))


def test_what_nodelets_make_is_their_managers() -> None:
    assert told(nodelet("/a", "/m", "/x"), nodelet("/b", "/m", "/y"), MANAGER) == [
        ("/m", "node", ["/rosout", "/x", "/y"])
    ]


def test_a_manager_that_is_started_elsewhere_has_its_name() -> None:
    assert told(nodelet("/a", "/m", "/x"), nodelet("/b", "/m", "/y")) == [("/m", "node", ["/x", "/y"])]


def test_the_conditions_of_a_nodelet_are_those_of_what_it_makes() -> None:
    found = as_running(Architecture(configurations=(Configuration(name="c", nodes=(nodelet("/sure", "/m", "/x"),)),)))
    assert found.configurations[0].nodes[0].endpoints[0].conditions == (GUARD,)


def test_others_stay() -> None:
    alone, open_ = nodelet("/a", "/a", "/x"), nodelet("/b", "/?", "/y")
    component, none = nodelet("/c", "/container", "/z", ros=2), nodelet("/d", None, "/w")
    nodes = (alone, open_, component, none, MANAGER)
    found = Architecture(configurations=(Configuration(name="c", nodes=nodes),))
    assert as_running(found) == found
