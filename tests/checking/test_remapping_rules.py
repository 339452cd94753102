# SPDX-License-Identifier: Apache-2.0
"""Where an end has its name from, and what a closed system tells for sure."""

from __future__ import annotations

from collections.abc import Iterable

import pytest

from haros_ci.checking.closed import is_certainly_absent
from haros_ci.checking.remapping import named_at, rule_of, way_to
from haros_ci.checking.system import System
from haros_ci.model.architecture import Architecture, Configuration, Endpoint, Node, RemapRule, Unknown
from haros_ci.model.location import Location

TAG = Location("launch/all.launch.xml", 3)
CALL = Location("src/talker.cpp", 7)


def rule(source: str, target: str, line: int) -> RemapRule:
    return RemapRule(
        source=source.lstrip("/"),
        target=target.lstrip("/"),
        location=Location(TAG.path, line),
        source_name=source,
        target_name=target,
    )


def node(name: str, *ends: Endpoint, rules: Iterable[RemapRule] = (), unknowns: Iterable[Unknown] = ()) -> Node:
    return Node(
        name=name,
        kind="node",
        package="demo",
        type="talker",
        location=TAG,
        endpoints=ends,
        source="launch",
        ros=2,
        rules=tuple(rules),
        unknowns=tuple(unknowns),
    )


def end(kind: str, name: str, original: str = "") -> Endpoint:
    return Endpoint(kind=kind, name=name, original_name=original or name, type="a/msg/B", location=CALL)


def system(*nodes: Node) -> System:
    configuration = Configuration(name="all", launch=("demo/launch/all.launch.xml",), nodes=nodes, closed=True)
    return System(configuration, Architecture(configurations=(configuration,)))


def test_a_remapped_end_is_named_at_the_rule() -> None:
    rules = (rule("/other", "/b", 4), rule("/a", "/b", 5), rule("/a", "/c", 6))
    found = system(node("/talker", end("publishers", "/b", "/a"), rules=rules)).ends[0]
    assert rule_of(found) is rules[1]
    assert named_at(found) == rules[1].location
    assert [place for place, _ in way_to(found)] == [TAG, rules[1].location, CALL]


@pytest.mark.parametrize(
    "rules",
    [
        pytest.param((), id="a remapping that no rule tells"),
        pytest.param((rule("/a", "/c", 4),), id="a rule with another target"),
        pytest.param((rule("/x", "/b", 4),), id="a rule of another name"),
    ],
)
def test_without_a_rule_an_end_is_named_at_its_call(rules: tuple[RemapRule, ...]) -> None:
    found = system(node("/talker", end("publishers", "/b", "/a"), rules=rules)).ends[0]
    assert rule_of(found) is None
    assert named_at(found) == CALL


def test_an_end_under_its_own_name_has_no_rule() -> None:
    found = system(node("/talker", end("publishers", "/a"), rules=(rule("/a", "/a", 4),))).ends[0]
    assert rule_of(found) is None
    assert [place for place, _ in way_to(found)] == [TAG, CALL]


def test_a_closed_system_tells_what_is_not_there() -> None:
    found = system(node("/listener", end("subscribers", "/a")), node("/talker", end("publishers", "/b")))
    assert is_certainly_absent(found, found.topics[0], "givers")


@pytest.mark.parametrize(
    "other",
    [
        pytest.param(node("/talker", end("publishers", "/?")), id="a name that may be it"),
        pytest.param(node("/talker", end("publishers", "?")), id="any name"),
        pytest.param(node("/talker"), id="a node of no known end"),
        pytest.param(
            node("/talker", end("publishers", "/b"), unknowns=(Unknown("endpoints", "not here"),)), id="a node not told"
        ),
    ],
)
def test_a_closed_system_does_not_tell_what_may_be_there(other: Node) -> None:
    found = system(node("/listener", end("subscribers", "/a")), other)
    assert not is_certainly_absent(found, next(topic for topic in found.topics if topic.takers), "givers")


@pytest.mark.parametrize("name", ["/b?", "/?/c", "/x"])
def test_names_that_cannot_be_it_do_not_matter(name: str) -> None:
    found = system(node("/listener", end("subscribers", "/a")), node("/talker", end("publishers", name)))
    assert is_certainly_absent(found, next(topic for topic in found.topics if topic.takers), "givers")
