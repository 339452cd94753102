# SPDX-License-Identifier: Apache-2.0
"""What is compatible with what, and which of several calls is to be changed."""

from __future__ import annotations

from dataclasses import replace

import pytest

from haros_ci.checking.compatibility import Mismatch, in_words, mismatches, override_place, refuses
from haros_ci.checking.incompatible import incompatible
from haros_ci.checking.system import System
from haros_ci.model.architecture import Architecture, Condition, Configuration, Endpoint, Node, Parameter, Qos
from haros_ci.model.location import Location

PLAIN = Qos(history="keep_last", depth=10, reliability="reliable", durability="volatile")
SENSOR = replace(PLAIN, depth=5, reliability="best_effort")
KEPT = replace(PLAIN, durability="transient_local")
MANUAL = replace(PLAIN, liveliness="manual_by_topic")


@pytest.mark.parametrize(
    ("policy", "offered", "asked"),
    (
        ("reliability", SENSOR, PLAIN),
        ("reliability", replace(SENSOR, durability="?"), KEPT),
        ("durability", PLAIN, KEPT),
        ("durability", SENSOR, KEPT),
        ("deadline", PLAIN, replace(PLAIN, deadline=1.0)),
        ("deadline", replace(PLAIN, deadline=1.5), replace(PLAIN, deadline=1.0)),
        ("liveliness", PLAIN, MANUAL),
        ("liveliness", replace(PLAIN, liveliness="automatic"), MANUAL),
        ("liveliness", PLAIN, replace(PLAIN, lease=1.0)),
        ("liveliness", replace(MANUAL, lease=3.0), replace(MANUAL, lease=1.0)),
    ),
)
def test_refused(policy: str, offered: Qos, asked: Qos) -> None:
    assert refuses(policy, offered, asked)
    assert not refuses(policy, asked, offered), "who offers more is heard"


@pytest.mark.parametrize(
    ("policy", "offered", "asked"),
    (
        ("reliability", PLAIN, PLAIN),
        ("reliability", SENSOR, SENSOR),
        ("reliability", SENSOR, replace(PLAIN, reliability="?")),
        ("reliability", SENSOR, replace(PLAIN, reliability=None)),
        ("reliability", SENSOR, replace(PLAIN, reliability="best_available")),
        ("reliability", replace(PLAIN, reliability="?"), PLAIN),
        ("reliability", Qos(), PLAIN),
        ("reliability", None, PLAIN),
        ("reliability", SENSOR, None),
        ("durability", KEPT, KEPT),
        ("durability", PLAIN, PLAIN),
        ("durability", Qos(), KEPT),
        ("durability", replace(PLAIN, durability="?"), KEPT),
        ("durability", PLAIN, replace(PLAIN, durability="best_available")),
        ("deadline", PLAIN, PLAIN),
        ("deadline", replace(PLAIN, deadline=1.0), replace(PLAIN, deadline=1.0)),
        ("deadline", replace(PLAIN, deadline="?"), replace(PLAIN, deadline=1.0)),
        ("deadline", PLAIN, replace(PLAIN, deadline="?")),
        ("deadline", PLAIN, replace(PLAIN, deadline="best_available")),
        ("liveliness", PLAIN, PLAIN),
        ("liveliness", MANUAL, MANUAL),
        ("liveliness", replace(PLAIN, liveliness="?"), MANUAL),
        ("liveliness", PLAIN, replace(PLAIN, liveliness="automatic")),
        ("liveliness", PLAIN, replace(PLAIN, liveliness="?", lease="?")),
        ("liveliness", replace(PLAIN, lease="best_available"), replace(PLAIN, lease=1.0)),
    ),
)
def test_compatible_or_not_known(policy: str, offered: Qos | None, asked: Qos | None) -> None:
    assert not refuses(policy, offered, asked)


def end(kind: str, line: int, qos: Qos | None, **more: object) -> Endpoint:
    given = {"name": "/a", "original_name": "/a", "type": "std_msgs/msg/String", "location": Location("a.cpp", line)}
    return Endpoint(kind=kind, qos=qos, **{**given, **more})  # type: ignore[arg-type]


def pub(line: int, qos: Qos | None, **more: object) -> Endpoint:
    return end("publishers", line, qos, **more)


def sub(line: int, qos: Qos | None, **more: object) -> Endpoint:
    return end("subscribers", line, qos, **more)


def system(*nodes: tuple[Endpoint, ...], parameters: tuple[Parameter, ...] = ()) -> System:
    made = tuple(
        Node(
            name=f"/n{number}",
            kind="node",
            package="demo",
            type=f"n{number}",
            endpoints=ends,
            ros=2,
            process=f"/n{number}",
        )
        for number, ends in enumerate(nodes)
    )
    return System(Configuration(name="demo", nodes=made, parameters=parameters), Architecture())


def told(*nodes: tuple[Endpoint, ...], fix: str = "taker", policy: str = "reliability") -> list[tuple[int, int, bool]]:
    """The line to change, the number of other calls, and whether somebody gets nothing."""
    found: list[Mismatch] = list(mismatches(system(*nodes), policy, fix))
    return sorted((each.end.location.line or 0, len(each.others), each.is_starved) for each in found)


WHICH = (
    ("the usual end", [(pub(1, SENSOR),), (sub(2, PLAIN),)], "taker", [(2, 1, True)]),
    ("the other usual end", [(pub(1, SENSOR),), (sub(2, PLAIN),)], "giver", [(1, 1, True)]),
    ("one publisher for two", [(pub(1, SENSOR),), (sub(2, PLAIN),), (sub(3, PLAIN),)], "taker", [(1, 2, True)]),
    ("one subscriber for two", [(pub(1, SENSOR),), (pub(2, SENSOR),), (sub(3, PLAIN),)], "giver", [(3, 2, True)]),
    (
        "two and two",
        [(pub(1, SENSOR), pub(2, SENSOR)), (sub(3, PLAIN),), (sub(4, PLAIN),)],
        "taker",
        [(3, 2, True), (4, 2, True)],
    ),
    ("one of two is heard", [(pub(1, SENSOR),), (pub(2, PLAIN),), (sub(3, PLAIN),)], "taker", [(3, 1, False)]),
    ("one may be heard", [(pub(1, SENSOR),), (pub(2, None),), (sub(3, PLAIN),)], "taker", [(3, 1, False)]),
    ("the same call in two nodes", [(pub(1, SENSOR),), (sub(2, PLAIN),), (sub(2, PLAIN),)], "taker", [(2, 1, True)]),
    ("what is not in the source", [(pub(1, SENSOR),), (sub(2, PLAIN, source="known-node"),)], "taker", [(1, 1, True)]),
    (
        "another type beside",
        [(pub(1, SENSOR), pub(3, PLAIN, type="a/msg/B")), (sub(2, PLAIN),)],
        "taker",
        [(2, 1, True)],
    ),
)


@pytest.mark.parametrize(("nodes", "fix", "expected"), [case[1:] for case in WHICH], ids=[case[0] for case in WHICH])
def test_which_call_is_to_be_changed(
    nodes: list[tuple[Endpoint, ...]], fix: str, expected: list[tuple[int, int, bool]]
) -> None:
    assert told(*nodes, fix=fix) == expected


def branch(statement: str, line: int = 9) -> tuple[Condition, ...]:
    return (Condition(statement, "ok", Location("a.cpp", line)),)


QUIET = (
    ("types differ", [(pub(1, SENSOR, type="a/msg/A"),), (sub(2, PLAIN, type="a/msg/B"),)]),
    ("other topics", [(pub(1, SENSOR, name="/b"),), (sub(2, PLAIN),)]),
    ("a name is not known", [(pub(1, SENSOR, name="/?"),), (sub(2, PLAIN, name="/?"),)]),
    ("an implicit end", [(pub(1, SENSOR, implicit=True),), (sub(2, PLAIN),)]),
    ("both are data on known nodes", [(pub(1, SENSOR, source="known-node"),), (sub(2, PLAIN, source="known-node"),)]),
    ("a twin on a branch fits", [(pub(1, SENSOR),), (sub(2, PLAIN, conditions=branch("if")), sub(3, SENSOR))]),
    ("a twin of the publisher fits", [(pub(1, SENSOR, conditions=branch("else")), pub(2, PLAIN)), (sub(3, PLAIN),)]),
    ("a twin may fit", [(pub(1, SENSOR, conditions=branch("if")), pub(2, None)), (sub(3, PLAIN),)]),
)


@pytest.mark.parametrize("nodes", [case[1] for case in QUIET], ids=[case[0] for case in QUIET])
def test_stays_quiet(nodes: list[tuple[Endpoint, ...]]) -> None:
    assert told(*nodes) == []


def test_a_twin_in_a_loop_is_no_choice() -> None:
    assert told((pub(1, SENSOR),), (sub(2, PLAIN, conditions=branch("for")), sub(3, SENSOR))) == [(2, 1, True)]


def test_services_are_kept_apart_either_way() -> None:
    for offered, asked, line in ((SENSOR, PLAIN, 1), (PLAIN, SENSOR, 2)):
        nodes = (end("servers", 1, offered),), (end("clients", 2, asked),)
        assert told(*nodes) == [(line, 1, True)]
        assert told(*nodes, policy="durability") == []
    assert told((end("servers", 1, PLAIN),), (end("clients", 2, PLAIN),)) == []


def test_where_a_parameter_overrides() -> None:
    line = Location("a.yaml", 4)
    given = Parameter(name="/n0:qos_overrides./a.publisher.reliability", type="str", value="reliable", origin=line)
    found = system((pub(1, SENSOR),), parameters=(given,))
    assert override_place(found, found.ends[0], "reliability") == line
    assert override_place(found, found.ends[0], "durability") is None


def test_words() -> None:
    assert in_words(SENSOR) == "best effort, volatile, keep last 5"
    assert in_words(Qos(history="keep_all", reliability="?", deadline=0.5)) == (
        "unknown reliability, default durability, keep all, deadline 0.5 s"
    )
    assert in_words(replace(MANUAL, depth="?", lease="?")) == (
        "reliable, volatile, keep last an unknown number, lease unknown, liveliness manual by topic"
    )
    assert in_words(None) == "unknown"


def test_one_call_is_one_finding_in_all_configurations() -> None:
    """Whoever else is there: the related places differ, the call to change does not."""
    few = system((pub(1, SENSOR),), (sub(2, PLAIN),))
    more = system((pub(1, SENSOR),), (pub(3, SENSOR),), (sub(2, PLAIN),))
    found = [next(incompatible(each, "reliability", "taker", {"subscribers": "change it"})) for each in (few, more)]
    assert [len(each.related) for each in found] == [1, 2]
    assert len({(each.at, each.apart) for each in found}) == 1
