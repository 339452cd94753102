# SPDX-License-Identifier: Apache-2.0
"""Parameters that nodes are given: which of them a node has, which are at the wrong place, which are meant."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import pytest

from haros_ci.checking.given import Given, misplaced, near
from haros_ci.checking.system import System, systems
from haros_ci.model.architecture import Architecture, Configuration, Endpoint, Node, Parameter, Unknown
from haros_ci.model.location import Location
from haros_ci.model.presence import Choice


def declared(name: str, kind: str = "parameters") -> Endpoint:
    full = f"/ns/n:{name}"
    return Endpoint(kind=kind, name=full, original_name=full, type="int", location=Location("n.cpp", 1))


def node(*names: str, **more: Any) -> Node:
    ends = tuple(map(declared, names))
    return Node(name="/ns/n", kind="node", package="p", type="n", ros=2, endpoints=ends, source="launch", **more)


def system(nodes: Sequence[Node], *keys: str, line: int = 1) -> System:
    given = tuple(
        Parameter(name=f"/ns/n:{key}", type="int", value=1, origin=Location("p.yaml", line + at))
        for at, key in enumerate(keys)
    )
    made = Configuration(name="c", launch=("p/l",), nodes=tuple(nodes), parameters=given)
    return next(systems(Architecture(configurations=(made,))))


@pytest.mark.parametrize("key", ("a", "a.b", "use_sim_time", "qos_overrides./t.publisher.depth", "image.jpeg_quality"))
def test_a_node_has(key: str) -> None:
    assert system([node("a", "a.b")]).nodes[0].names.has(key) is True


@pytest.mark.parametrize("key", ("c", "a.c", "ns.a", "A", "format"))
def test_a_node_has_not(key: str) -> None:
    assert system([node("a", "a.b")]).nodes[0].names.has(key) is False


@pytest.mark.parametrize(
    ("made", "key"),
    (
        (node("a", takes_undeclared=True), "b"),
        (node("a", unknowns=(Unknown("endpoints", "it is not followed"),)), "b"),
        (node("a", "?.topic"), "front.topic"),
        (node("a", "x.?"), "x.y.z"),
        (node("a", "?"), "b"),
        (node(), "b"),
    ),
)
def test_it_is_not_known_whether_a_node_has(made: Node, key: str) -> None:
    assert system([made]).nodes[0].names.has(key) is None


@pytest.mark.parametrize("key", ("front.type", "x", "topic"))
def test_names_known_in_parts_are_not_those_that_do_not_fit(key: str) -> None:
    assert system([node("a", "?.topic", "x.?")]).nodes[0].names.has(key) is False


def test_what_one_system_takes_is_taken_in_all() -> None:
    first, second = system([node("a")], "a", "b"), system([node("b")], "a", "b")
    pair = Architecture(configurations=(first.raw, replace(second.raw, name="d")))
    one, other = systems(pair)
    assert {key for _, key in one.taken} == {"a"} and {key for _, key in other.taken} == {"b"}
    assert {key for _, key in one.whole.taken} == {"a", "b"} == {key for _, key in other.whole.taken}


def test_parameters_of_contradictory_presence_are_not_given() -> None:
    yes, no = (Choice("sim", "true"),), (Choice("sim", "false"),)
    made = system([node("a", presence=no)], "a", "b")
    raw = replace(made.raw, parameters=(replace(made.raw.parameters[0], presence=yes), made.raw.parameters[1]))
    again = next(systems(Architecture(configurations=(raw,))))
    assert [each.key for each in again.nodes[0].given] == ["b"]


@pytest.mark.parametrize(
    ("key", "meant"),
    (
        ("n.a.b", "a.b"),
        ("ns.n.a.b", "a.b"),
        ("a.a.b", "a.b"),
        ("a/b", "a.b"),
        ("~/a/b", "a.b"),
        ("ros__parameters.c", "c"),
        ("a.b", None),
        ("c", None),
        ("n.c", None),
        ("m.a.b", None),
        ("a.b.c", None),
    ),
)
def test_names_at_the_wrong_place(key: str, meant: str | None) -> None:
    (given,) = system([node("a.b")], key).given
    found = misplaced(given)
    assert (found and found[0]) == meant
    assert isinstance(given, Given)


@pytest.mark.parametrize(
    ("key", "known", "meant"),
    (
        ("max_sped", ("max_speed", "frame"), "max_speed"),
        ("maxSpeed", ("max_speed", "frame"), "max_speed"),
        ("limits.rate", ("rate", "frame"), "rate"),
        ("rate", ("a.rate", "b.rate"), None),
        ("x0", ("robot.x0", "robot.y0"), "robot.x0"),
        ("x0", ("robot.x0", "arm.x0"), None),
        ("arm.x0", ("robot.x0", "robot.y0"), None),
        ("speed", ("frame", "rate"), None),
        ("abc", ("abd",), None),
        ("front.topic", ("?.topic",), None),
        ("use_sim_tim", ("use_sim_time",), None),
    ),
)
def test_the_name_that_is_meant(key: str, known: tuple[str, ...], meant: str | None) -> None:
    assert near(key, known) == meant
