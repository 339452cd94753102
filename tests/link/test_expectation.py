# SPDX-License-Identifier: Apache-2.0
"""Architecture conformance: what deviates, what is only unknown, and what stays quiet."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from haros_ci.commands.model import expected
from haros_ci.declared.expectation import Deviation, compare, may_be, problems
from haros_ci.errors import UserError
from haros_ci.model.architecture import Architecture, Condition, Configuration, Endpoint, Node, Parameter, Unknown
from haros_ci.model.location import Location
from haros_ci.model.package import Package

CPP = "src/base/src/odometry.cpp"
PACKAGES = (Package("base", "src/base"),)


def end(kind: str, name: str, type: str | None, line: int = 1, **more: Any) -> Endpoint:
    given = {"kind": kind, "name": name, "original_name": name, "type": type, "location": Location(CPP, line, 2)}
    return Endpoint(**(given | more))


ODOM = end("publishers", "/odom", "nav_msgs/Odometry", 76, original_name="/base/odom", queue_size=50, latched=False)
VELOCITY = end("subscribers", "/cmd_vel", "geometry_msgs/Twist", 80, queue_size=10)
RATE = end("getters", "/base/rate", "double", 90, value=16.5)
RESET = end("servers", "/reset", "std_srvs/Empty", 95, conditions=(Condition("if", "x", Location(CPP, 94, 3)),))
ROSOUT = end("publishers", "/rosout", "rosgraph_msgs/Log", implicit=True)
BASE = Node(
    name="/base",
    kind="node",
    package="base",
    type="base_node",
    arguments="--rate  10",
    remaps=(("/base/odom", "/odom"),),
    location=Location("src/base/launch/base.launch", 8, 3),
    endpoints=(ODOM, VELOCITY, RATE, RESET, ROSOUT),
)
GAIN = Parameter(name="/base/gain", type="double", value=0.5, location=Location("src/base/launch/base.launch", 4, 5))
ROBOT = Configuration(name="robot", launch=("base/launch/base.launch",), nodes=(BASE,), parameters=(GAIN,))

DECLARED: dict[str, Any] = {
    "node_type": "base/base_node",
    "args": "--rate 10",
    "remaps": {"/base/odom": "/odom"},
    "traceability": {"package": "base", "file": "launch/base.launch", "line": 8, "column": 3},
    "publishers": [
        {
            "topic": "/odom",
            "original_name": "/base/odom",
            "msg_type": "nav_msgs/Odometry",
            "queue_size": 50,
            "latched": False,
            "traceability": {"package": "base", "file": "src/odometry.cpp", "line": 76, "column": 2},
        }
    ],
    "subscribers": [{"topic": "/cmd_vel", "msg_type": "geometry_msgs/Twist", "queue_size": 10}],
    "getters": [{"parameter": "/base/rate", "param_type": "float64", "default_value": 16.5}],
    "servers": [
        {
            "service": "/reset",
            "srv_type": "std_srvs/Empty",
            "conditions": [{"statement": "if", "package": "base", "file": "src/odometry.cpp", "line": 94}],
        }
    ],
}


def of(node: Node, declared: dict[str, Any]) -> tuple[Deviation, ...]:
    return compare(replace(ROBOT, nodes=(node,)), {"robot": {"nodes": {"/base": declared}}}, PACKAGES)


def short(found: tuple[Deviation, ...]) -> list[tuple[str, str, str, str]]:
    return [(d.kind, d.entity, d.name, d.attribute) for d in found]


@pytest.mark.parametrize(
    "expected",
    [
        {"robot": {"launch": ["base/launch/base.launch"], "nodes": {"/base": DECLARED}}},
        {"robot": {"nodes": {"/base": {}}}},
        {"robot": {"nodes": {"/base": None}}},
        {"robot": {"nodes": None, "parameters": None}},
        {"robot": {"nodes": ["/base"], "parameters": 5, "launch": 5}},
        {"robot": {"nodes": {"/base": {"publishers": {}, "getters": None, "servers": "x"}}}},
        {"robot": {}},
        {"robot": {"parameters": {"/base/gain": {"default_value": 0.5, "param_type": "double"}}}},
        {"robot": {"parameters": {"/base": {"param_type": "yaml", "default_value": {"gain": 0.5}}}}},
        {"robot": {"parameters": {"/base/gain": {}}}},
        {"other": {"nodes": {}}},
        {},
        None,
        [],
        {"robot": {"nodes": {"/base": {"publishers": [{"topic": "/odom"}, {"topic": "/rosout"}]}}}},
        {"robot": {"nodes": {"/base": {"publishers": [{"topic": "/odom", "queue_size": None, "msg_type": None}]}}}},
        {"robot": {"nodes": {"/base": {"publishers": [{"topic": "/odom", "traceability": {"line": 76}}]}}}},
        {"robot": {"nodes": {"/base": {"clients": [], "setters": None}}}},
        {"robot": {"nodes": {"/base": {"servers": [{"service": "/reset", "conditional": True}]}}}},
        {"robot": {"nodes": {"/base": {"servers": [{"service": "/reset", "conditions": [[{"statement": "if"}]]}]}}}},
    ],
)
def test_what_stays_quiet(expected: object) -> None:
    assert compare(ROBOT, expected, PACKAGES) == ()


def test_a_missing_and_an_unexpected_publisher() -> None:
    found = of(BASE, {"publishers": [{"topic": "/scan", "msg_type": "sensor_msgs/LaserScan"}]})
    assert found == (
        Deviation(
            kind="unexpected",
            rule="architecture-unexpected",
            level="warning",
            entity="publisher",
            node="/base",
            name="/odom",
            message="publisher /odom of node /base was found, but is not declared.",
            location=Location(CPP, 76, 2),
        ),
        Deviation(
            kind="missing",
            rule="architecture-missing",
            level="warning",
            entity="publisher",
            node="/base",
            name="/scan",
            message="publisher /scan of node /base is declared, but was not found.",
        ),
    )


@pytest.mark.parametrize(
    ("kind", "declared", "attribute", "message"),
    [
        (
            "publishers",
            {"topic": "/odom", "msg_type": "nav_msgs/Path"},
            "msg_type",
            "publisher /odom of node /base: msg_type is 'nav_msgs/Odometry', but 'nav_msgs/Path' is declared.",
        ),
        (
            "publishers",
            {"topic": "/odom", "queue_size": 1},
            "queue_size",
            "publisher /odom of node /base: queue_size is 50, but 1 is declared.",
        ),
        (
            "publishers",
            {"topic": "/odom", "latched": True},
            "latched",
            "publisher /odom of node /base: latched is false, but true is declared.",
        ),
        (
            "publishers",
            {"topic": "/odom", "original_name": "/odom"},
            "original_name",
            "publisher /odom of node /base: original_name is '/base/odom', but '/odom' is declared.",
        ),
        (
            "publishers",
            {"topic": "/odom", "traceability": {"file": "src/odometry.cpp", "line": 77}},
            "traceability",
            "publisher /odom of node /base: place is {'file': 'src/odometry.cpp', 'line': 76}, "
            "but {'file': 'src/odometry.cpp', 'line': 77} is declared.",
        ),
        (
            "getters",
            {"parameter": "/base/rate", "default_value": 16},
            "default_value",
            "getter /base/rate of node /base: default_value is 16.5, but 16 is declared.",
        ),
        (
            "getters",
            {"parameter": "/base/rate", "default_value": None},
            "default_value",
            "getter /base/rate of node /base: default_value is 16.5, but null is declared.",
        ),
        (
            "servers",
            {"service": "/reset", "conditional": False},
            "conditional",
            "server /reset of node /base: conditional is true, but false is declared.",
        ),
    ],
)
def test_a_different_attribute(kind: str, declared: dict[str, Any], attribute: str, message: str) -> None:
    (found,) = of(BASE, {kind: [declared]})
    assert (found.kind, found.rule, found.attribute, found.message) == (
        "different",
        "architecture-different",
        attribute,
        message,
    )
    assert found.location == next(e.location for e in BASE.endpoints if e.kind == kind)


def test_other_conditions_differ() -> None:
    for conditions in ([], [{"statement": "else"}], [{"statement": "if", "line": 9}], [{}, {}]):
        found = of(BASE, {"servers": [{"service": "/reset", "conditions": conditions}]})
        assert short(found) == [("different", "server", "/reset", "conditions")]


def test_nodes() -> None:
    expected = {"robot": {"nodes": {"/base": {"node_type": "base/other", "args": "", "remaps": {}}, "/gone": {}}}}
    extra = replace(BASE, name="/extra")
    assert short(compare(replace(ROBOT, nodes=(extra, BASE)), expected, PACKAGES)) == [
        ("different", "node", "/base", "args"),
        ("different", "node", "/base", "node_type"),
        ("different", "node", "/base", "remaps"),
        ("unexpected", "node", "/extra", ""),
        ("missing", "node", "/gone", ""),
    ]


def test_launch_files_and_parameters() -> None:
    expected = {
        "robot": {
            "launch": ["base/launch/other.launch"],
            "parameters": {"/base": {"default_value": {"gain": 0.25, "name": "b"}}, "/a": {"param_type": "int"}},
        }
    }
    assert [
        (d.kind, d.entity, d.name, d.attribute, d.expected, d.found) for d in compare(ROBOT, expected, PACKAGES)
    ] == [
        ("different", "configuration", "robot", "launch", ["base/launch/other.launch"], ["base/launch/base.launch"]),
        ("missing", "parameter", "/a", "", None, None),
        ("different", "parameter", "/base/gain", "default_value", 0.25, 0.5),
        ("missing", "parameter", "/base/name", "", None, None),
    ]


def test_matching_is_one_to_one_by_name_then_type_then_place() -> None:
    twice = replace(BASE, endpoints=(end("publishers", "/a", "p/X", 1), end("publishers", "/a", "p/Y", 2)))
    assert of(twice, {"publishers": [{"topic": "/a", "msg_type": "p/Y"}, {"topic": "/a", "msg_type": "p/X"}]}) == ()
    assert short(of(twice, {"publishers": [{"topic": "/a", "msg_type": "p/Y"}]})) == [
        ("unexpected", "publisher", "/a", "")
    ]
    same = replace(BASE, endpoints=(end("setters", "/a", "str", 1), end("setters", "/a", "str", 2)))
    places = [{"parameter": "/a", "param_type": "str", "traceability": {"line": line}} for line in (2, 1)]
    assert of(same, {"setters": places}) == ()
    assert short(of(same, {"setters": [*places, {"parameter": "/a"}]})) == [("missing", "setter", "/a", "")]


VAGUE = end("publishers", "/base/?", "nav_msgs/Odometry", unknowns=(Unknown("name", "not constant"),))


@pytest.mark.parametrize(
    ("found", "declared", "message"),
    [
        (
            replace(ODOM, type=None, unknowns=(Unknown("type", "behind auto"),)),
            {"topic": "/odom", "msg_type": "a/B"},
            "publisher /odom of node /base: msg_type is not known (behind auto), 'a/B' is declared.",
        ),
        (
            replace(ODOM, queue_size=None),
            {"topic": "/odom", "queue_size": 1},
            "publisher /odom of node /base: queue_size is not known, 1 is declared.",
        ),
        (
            replace(ODOM, latched=None),
            {"topic": "/odom", "latched": True},
            "publisher /odom of node /base: latched is not known, true is declared.",
        ),
        (
            replace(ODOM, location=None),
            {"topic": "/odom", "traceability": {"line": 1}},
            "publisher /odom of node /base: place is not known, {'line': 1} is declared.",
        ),
        (
            VAGUE,
            {"topic": "/base/x", "msg_type": "nav_msgs/Odometry"},
            "publisher /base/? of node /base: name is not known (not constant), '/base/x' is declared.",
        ),
    ],
)
def test_an_unknown_never_differs(found: Endpoint, declared: dict[str, Any], message: str) -> None:
    (difference,) = of(replace(BASE, endpoints=(found,)), {"publishers": [declared]})
    assert (difference.kind, difference.rule, difference.level, difference.message) == (
        "unknown",
        "architecture-unknown",
        "note",
        message,
    )


def test_an_unknown_name_of_another_type_or_place_is_another_endpoint() -> None:
    node = replace(BASE, endpoints=(VAGUE,))
    for declared in ({"topic": "/base/x", "msg_type": "a/B"}, {"topic": "/other", "msg_type": "nav_msgs/Odometry"}):
        assert short(of(node, {"publishers": [declared]})) == [
            ("unknown", "publisher", "/base/?", ""),
            ("missing", "publisher", declared["topic"], ""),
        ]


def test_as_many_unknown_names_as_possible_find_a_declared_one() -> None:
    wide, narrow = replace(VAGUE, name="/?", original_name="/?"), VAGUE
    node = replace(BASE, endpoints=(wide, narrow))
    for topics in (["/base/x", "/odom"], ["/odom", "/base/x"]):
        found = of(node, {"publishers": [{"topic": topic} for topic in topics]})
        assert sorted((d.name, d.expected, d.kind) for d in found) == [
            ("/?", "/odom", "unknown"),
            ("/base/?", "/base/x", "unknown"),
        ]


def test_one_unknown_name_may_stand_for_many() -> None:
    node = replace(BASE, endpoints=(VAGUE,))
    topics = ("/base/x", "/base/y", "/other/z")
    found = of(node, {"publishers": [{"topic": topic, "msg_type": "nav_msgs/Odometry"} for topic in topics]})
    assert [(d.kind, d.name, d.location == VAGUE.location, d.message) for d in found] == [
        (
            "unknown",
            "/base/?",
            True,
            "publisher /base/? of node /base: name is not known (not constant), '/base/x' is declared.",
        ),
        (
            "unknown",
            "/base/y",
            True,
            "publisher /base/y of node /base: whether it is as declared is not known "
            "(/base/? may stand for more than one).",
        ),
        ("missing", "/other/z", False, "publisher /other/z of node /base is declared, but was not found."),
    ]


def test_what_a_value_is_not_known_to_be() -> None:
    blank = replace(RATE, value=None)
    unsure = replace(blank, unknowns=(Unknown("value", "computed"),))
    declared = {"getters": [{"parameter": "/base/rate", "default_value": 1.0}]}
    assert short(of(replace(BASE, endpoints=(blank,)), declared)) == [
        ("different", "getter", "/base/rate", "default_value")
    ]
    assert short(of(replace(BASE, endpoints=(unsure,)), declared)) == [
        ("unknown", "getter", "/base/rate", "default_value")
    ]


def test_a_node_whose_code_was_not_found_misses_nothing() -> None:
    node = replace(BASE, endpoints=(), unknowns=(Unknown("endpoints", "package base is not in the workspace"),))
    (found,) = of(node, {"publishers": [{"topic": "/odom"}]})
    assert found.message == (
        "publisher /odom of node /base: whether it is as declared is not known (package base is not in the workspace)."
    )
    assert found.level == "note"
    (found,) = of(replace(BASE, endpoints=()), {"publishers": [{"topic": "/odom"}]})
    assert found.message == (
        "publisher /odom of node /base: whether it is as declared is not known "
        "(no endpoint of the node was found; its code may not be in the workspace)."
    )


def test_conditions_that_are_not_known_do_not_differ() -> None:
    node = replace(BASE, endpoints=(replace(RESET, unknowns=(Unknown("conditions", "it depends on x"),)),))
    for declared in ({"conditional": False}, {"conditions": []}):
        assert [d.kind for d in of(node, {"servers": [{"service": "/reset", **declared}]})] == ["unknown"]


@pytest.mark.parametrize(
    ("found", "expected", "same"),
    [
        (1, 1.0, True),
        (0.1 + 0.2, 0.3, True),
        (True, 1, False),
        (1, True, False),
        ("1", 1, False),
        ([1, [2.0]], [1.0, [2]], True),
        ([1], [1, 1], False),
        ("/ws/src/base/param/a.yaml", "$(find base)/param/a.yaml", True),
        ("base/param/a.yaml", "$(find base)/param/a.yaml", True),
        ("other_base/param/a.yaml", "$(find base)/param/a.yaml", False),
        ("10", "10", True),
        (10**400, 1.5, False),
    ],
)
def test_values(found: object, expected: object, same: bool) -> None:
    configuration = replace(ROBOT, parameters=(replace(GAIN, value=found),))
    differences = compare(configuration, {"robot": {"parameters": {"/base/gain": {"default_value": expected}}}}, ())
    assert (short(differences) == []) is same


@pytest.mark.parametrize(
    ("unknown", "name", "may"),
    [
        ("/?", "/a", True),
        ("/?", "/a/b", True),
        ("/?/a", "/a", True),
        ("/?/a", "/x/y/a", True),
        ("/a/?/c", "/a/b/c", True),
        ("/a_?", "/a_1", True),
        ("/a/?", "/b/a", False),
        ("/?/a", "/x/b", False),
        ("/ab?ba", "/aba", False),
        ("/a?b?c", "/axbxc", True),
        ("/a?b?c", "/axxxc", False),
        ("/a", "/a", True),
        ("/" + "?a" * 500 + "b", "/" + "a" * 2000, False),
    ],
)
def test_what_an_unknown_name_may_be(unknown: str, name: str, may: bool) -> None:
    assert may_be(unknown, name) is may


@pytest.mark.parametrize(
    ("expected", "messages"),
    [
        ([], ["the file must be a map, not a list"]),
        ({"robots": {}}, ["the model has no configuration 'robots'; did you mean 'robot'?"]),
        ({"robot": 5}, ["robot must be a map, not a number"]),
        ({"robot": {"node": {}}}, ["robot: nothing is called 'node' here; did you mean 'nodes'?"]),
        ({"robot": {"launch": "a/b"}}, ["robot.launch must be a list of package/path"]),
        ({"robot": {"nodes": ["/base"]}}, ["robot.nodes must be a map, not a list"]),
        ({"robot": {"nodes": {5: {}}}}, ["robot.nodes: the key 5 must be text; put it in quotes"]),
        ({"robot": {"nodes": {"base": {}}}}, ["robot.nodes.base: 'base' is no full name; write it as /namespace/name"]),
        (
            {"robot": {"nodes": {"/base": {"publishers": {"topic": "/a"}, "node_type": "base"}}}},
            [
                "robot.nodes./base.publishers must be a list, not a map",
                "robot.nodes./base.node_type must be text as package/type, not 'base'",
            ],
        ),
        (
            {"robot": {"nodes": {"/base": {"publishers": [{"msg_type": "a/B"}, {"topic": "/a", "queue_size": "1"}]}}}},
            [
                "robot.nodes./base.publishers[0] needs a 'topic': the full name, as text",
                "robot.nodes./base.publishers[1].queue_size must be a number from 0 on, not '1'",
            ],
        ),
        (
            {"robot": {"nodes": {"/base": {"publishers": [{"topic": "/a", "msg_typ": "a/B"}]}}}},
            ["robot.nodes./base.publishers[0]: nothing is called 'msg_typ' here; did you mean 'msg_type'?"],
        ),
        (
            {"robot": {"parameters": {"/a": {"traceability": {"line": "x"}}}}},
            ["robot.parameters./a.traceability must be a map of package, file, line and column, not a map"],
        ),
    ],
)
def test_problems(expected: object, messages: list[str]) -> None:
    found = problems(expected, "robot.yaml", ["robot"])
    assert [(p.path, p.message, p.line) for p in found] == [("robot.yaml", message, None) for message in messages]


def test_a_problem_costs_nothing_but_itself() -> None:
    declared = {"publishers": [{"topic": 5}, {"topic": "/odom", "queue_size": "x", "latched": True}], "args": []}
    assert short(of(BASE, declared)) == [("different", "publisher", "/odom", "latched")]


def test_no_problem_in_the_whole_vocabulary() -> None:
    expected = {"robot": {"launch": [], "nodes": {"/base": DECLARED}, "parameters": {"/a": {"value": 1}}}}
    assert problems(expected, "robot.yaml", ["robot"]) == ()


def test_what_is_nested_without_end_is_a_problem() -> None:
    value: Any = 1
    for _ in range(5000):
        value = {"a": value}
    expected = {"robot": {"parameters": {"/p": {"default_value": value}}}}
    assert [p.message for p in problems(expected, "r.yaml", ["robot"])] == [
        "robot.parameters./p.default_value must be a value at most 20 levels deep and of at most 100,000 parts, "
        "not a map"
    ]
    assert short(compare(ROBOT, expected, PACKAGES)) == [("unexpected", "parameter", "/base/gain", "")]


def test_hostile_names_are_only_text() -> None:
    name = '/a\n::error::b\u202e`]"'
    node = replace(BASE, name=name, endpoints=(replace(ODOM, name=name),))
    found = compare(replace(ROBOT, nodes=(node,)), {"robot": {"nodes": {name: {}}}}, PACKAGES)
    assert short(found) == [("unexpected", "node", name, "")]
    assert len(problems({"robot": {"nodes": {name: {}}}}, "r.yaml", ["robot"])) == 1


@pytest.mark.parametrize(
    "text",
    ["a: [", "a: !!bool x", "a: !!int ''", "a: !!timestamp x", "a: 2020-13-01", "? [a]\n: b", "[" * 5000],
)
def test_a_file_that_is_no_yaml_is_refused_with_its_name(text: str, tmp_path: Path) -> None:
    file = tmp_path / "expected.yaml"
    file.write_text(text)
    with pytest.raises(UserError, match=r"expected.yaml(:\d+)? cannot be read: .") as caught:
        expected(Architecture(), str(file))
    assert caught.value.help


def test_what_is_ruled_out_may_be_declared_and_need_not_be() -> None:
    node = replace(BASE, endpoints=(ODOM, end("publishers", "/never", "a/T", is_ruled_out=True)))
    assert of(node, {"publishers": [{"topic": "/odom"}]}) == ()
    assert of(node, {"publishers": [{"topic": "/odom"}, {"topic": "/never"}]}) == ()
    made = replace(node, endpoints=tuple(replace(each, is_ruled_out=False) for each in node.endpoints))
    assert [each.kind for each in of(made, {"publishers": [{"topic": "/odom"}]})] == ["unexpected"]
