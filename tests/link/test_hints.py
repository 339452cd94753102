# SPDX-License-Identifier: Apache-2.0
"""Hints of HAROS project files: what each does, in which order, and what is said of those that do nothing."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from haros_ci.declared.hints import apply, apply_specifications
from haros_ci.declared.variables import resolved, variables
from haros_ci.model.architecture import Condition, Configuration, Endpoint, Node, Parameter, Unknown
from haros_ci.model.location import Location
from haros_ci.model.package import Package

FILE = "haros.yaml"
CPP = "src/mux/src/mux.cpp"
PACKAGES = (Package("mux", "src/mux"),)
IF = Condition("if", "x", Location(CPP, 3, 5))


def end(kind: str, name: str, line: int = 1, **more: Any) -> Endpoint:
    given = {"kind": kind, "name": name, "original_name": name, "type": "a/T", "location": Location(CPP, line, 2)}
    return Endpoint(**(given | more))


def unknown(field: str, reason: str = "not constant") -> tuple[Unknown, ...]:
    return (Unknown(field, reason),)


OUT = end("publishers", "/cmd", 9, original_name="/mux/out", queue_size=10, latched=False, conditions=(IF,))
VAGUE = end("publishers", "/mux/?", 5, queue_size=1, latched=False, unknowns=unknown("name"))
INPUT = end("subscribers", "/mux/?", 7, type=None, queue_size=None, unknowns=unknown("queue_size", "from a file"))
RATE = end("getters", "/mux/rate", 3, type="double", value=None, unknowns=unknown("value", "computed"))
MUX = Node(
    name="/mux",
    kind="node",
    package="mux",
    type="mux_node",
    remaps=(("/mux/out", "/cmd"), ("/mux/safe", "/safe")),
    location=Location("src/mux/launch/mux.launch", 4, 3),
    endpoints=(OUT, INPUT, VAGUE, RATE),
    source="launch",
)
GAIN = Parameter(name="/mux/gain", type="double", value=None, unknowns=unknown("value"))
ROBOT = Configuration(name="robot", nodes=(MUX,), parameters=(GAIN,))


def applied(hints: Any, configuration: Configuration = ROBOT) -> tuple[Configuration, list[str]]:
    result, problems = apply(configuration, hints, FILE, PACKAGES)
    assert all(problem.path == FILE for problem in problems)
    return result, [problem.message for problem in problems]


def node_of(hints: Any) -> Node:
    result, messages = applied({"nodes": {"/mux": hints}})
    assert messages == []
    return result.nodes[0]


def link_of(kind: str, hint: dict[str, Any], index: int) -> Endpoint:
    return node_of({kind: [hint]}).endpoints[index]


@pytest.mark.parametrize(
    "hints", [{}, None, {"nodes": None}, {"nodes": {"/mux": None}}, {"fix": {}}, {"parameters": {}}]
)
def test_no_hints_change_nothing(hints: Any) -> None:
    assert applied(hints) == (ROBOT, [])


def test_a_hint_that_says_what_is_known_changes_nothing() -> None:
    hint = {"topic": "/cmd", "msg_type": "a/T", "queue_size": 10, "latched": False, "conditional": True}
    assert node_of({"publishers": [hint], "remaps": {"/mux/out": "/cmd", "~safe": "/safe"}}) == MUX


@pytest.mark.parametrize(
    ("kind", "hint", "index", "expected"),
    [
        ("publishers", {"topic": "/cmd", "msg_type": "b/U"}, 0, replace(OUT, type="b/U", source="hint")),
        ("publishers", {"topic": "/cmd", "queue_size": 0}, 0, replace(OUT, queue_size=0, source="hint")),
        ("publishers", {"topic": "/cmd", "latched": True}, 0, replace(OUT, latched=True, source="hint")),
        ("publishers", {"topic": "/cmd", "conditional": False}, 0, replace(OUT, conditions=(), source="hint")),
        (
            "publishers",
            {"topic": "/mux/?", "conditional": True},
            2,
            replace(VAGUE, conditions=(Condition("if", "?", Location(FILE)),), source="hint"),
        ),
        (
            "publishers",
            {"topic": "/mux/?", "original_name": "/mux/safe"},
            2,
            replace(VAGUE, name="/safe", original_name="/mux/safe", unknowns=(), source="hint"),
        ),
        (
            "publishers",
            {"topic": "/mux/?", "original_name": "/mux/plain"},
            2,
            replace(VAGUE, name="/mux/plain", original_name="/mux/plain", unknowns=(), source="hint"),
        ),
        (
            "publishers",
            {"topic": "/cmd", "original_name": None},
            0,
            replace(OUT, name="/?", original_name="/?", source="hint"),
        ),
        (
            "publishers",
            {"topic": "/cmd", "traceability": {"package": "mux", "file": "src/b.cpp", "line": 4, "column": 6}},
            0,
            replace(OUT, location=Location("src/mux/src/b.cpp", 4, 6), source="hint"),
        ),
        (
            "publishers",
            {"topic": "/cmd", "traceability": {"line": 4}},
            0,
            replace(OUT, location=Location(CPP, 4), source="hint"),
        ),
        (
            "subscribers",
            {"topic": "/mux/?", "msg_type": "b/U", "queue_size": 5},
            1,
            replace(INPUT, type="b/U", queue_size=5, unknowns=(), source="hint"),
        ),
        (
            "getters",
            {"parameter": "/mux/rate", "param_type": "float", "default_value": 2.5},
            3,
            replace(RATE, value=2.5, unknowns=(), source="hint"),
        ),
        ("publishers", {"topic": "~?", "latched": True}, 2, replace(VAGUE, latched=True, source="hint")),
    ],
)
def test_a_link_is_fixed(kind: str, hint: dict[str, Any], index: int, expected: Endpoint) -> None:
    assert link_of(kind, hint, index) == expected


def made(kind: str, name: str, type: str, **more: Any) -> Endpoint:
    given = {"kind": kind, "name": name, "original_name": name, "type": type, "location": None, "source": "hint"}
    return Endpoint(**(given | more))


@pytest.mark.parametrize(
    ("kind", "hint", "expected"),
    [
        (
            "publishers",
            {"topic": "/tf", "msg_type": "tf2_msgs/TFMessage", "queue_size": 100},
            made("publishers", "/tf", "tf2_msgs/TFMessage", queue_size=100, latched=False),
        ),
        (
            "publishers",
            {"topic": "tf", "msg_type": "a/T", "queue_size": 1, "latched": True, "conditional": True},
            made(
                "publishers",
                "/tf",
                "a/T",
                queue_size=1,
                latched=True,
                conditions=(Condition("if", "?", Location(FILE)),),
            ),
        ),
        (
            "publishers",
            {"topic": "/mux/out", "msg_type": "a/T", "queue_size": 1},
            made("publishers", "/cmd", "a/T", original_name="/mux/out", queue_size=1, latched=False),
        ),
        (
            "subscribers",
            {"topic": "/a", "original_name": "/mux/a", "msg_type": "a/T", "queue_size": 1},
            made("subscribers", "/a", "a/T", original_name="/mux/a", queue_size=1),
        ),
        ("servers", {"service": "/s", "srv_type": "a/S"}, made("servers", "/s", "a/S")),
        ("clients", {"service": "/s", "srv_type": "a/S"}, made("clients", "/s", "a/S")),
        ("action_servers", {"action": "/s", "action_type": "a/S"}, made("action_servers", "/s", "a/S")),
        (
            "getters",
            {"parameter": "/p", "param_type": "int", "default_value": 3},
            made("getters", "/p", "int", value=3),
        ),
        ("setters", {"parameter": "/p", "param_type": "string", "value": "x"}, made("setters", "/p", "str", value="x")),
        (
            "servers",
            {"service": "/s", "srv_type": "a/S", "traceability": {"package": "mux", "file": "m.cpp", "line": 1}},
            made("servers", "/s", "a/S", location=Location("src/mux/m.cpp", 1)),
        ),
    ],
)
def test_a_link_is_created(kind: str, hint: dict[str, Any], expected: Endpoint) -> None:
    assert node_of({kind: [{**hint, "create": True}]}).endpoints == (*MUX.endpoints, expected)


def test_a_link_is_created_beside_one_of_the_same_name() -> None:
    node = node_of({"publishers": [{"topic": "/cmd", "msg_type": "b/U", "queue_size": 1, "create": True}]})
    assert [e.type for e in node.endpoints if e.name == "/cmd"] == ["a/T", "b/U"]


def test_a_link_that_the_source_has_is_not_created_again() -> None:
    hint = {"topic": "/cmd", "msg_type": "a/T", "queue_size": 3, "create": True}
    result, messages = applied({"nodes": {"/mux": {"publishers": [hint]}}})
    assert result.nodes[0].endpoints == MUX.endpoints
    assert messages == [
        "hints.nodes./mux.publishers[0]: /mux has /cmd without this hint; it adds only what was not known"
    ]


def test_a_link_that_the_source_has_in_part_is_completed() -> None:
    blank = replace(OUT, type=None, queue_size=None, unknowns=(*unknown("type"), *unknown("queue_size")))
    robot = replace(ROBOT, nodes=(replace(MUX, endpoints=(blank,)),))
    hint = {"topic": "/cmd", "msg_type": "a/T", "queue_size": 3, "create": True}
    result, _ = applied({"nodes": {"/mux": {"publishers": [hint]}}}, robot)
    assert result.nodes[0].endpoints == (replace(OUT, queue_size=3, source="hint"),)


def test_a_hint_for_an_unknown_name_finds_the_link_whose_name_is_known_now() -> None:
    hint = {"topic": "/mux/x/?", "original_name": "/mux/out", "conditional": False}
    assert node_of({"publishers": [hint]}).endpoints[0] == replace(OUT, conditions=(), source="hint")


def test_a_hint_for_an_unknown_name_stays_without_effect_where_two_links_may_be_meant() -> None:
    robot = replace(ROBOT, nodes=(replace(MUX, endpoints=(OUT, replace(OUT, type="b/U"))),))
    hint = {"topic": "/mux/x/?", "original_name": "/mux/out", "conditional": False}
    result, messages = applied({"nodes": {"/mux": {"publishers": [hint]}}}, robot)
    assert result == robot
    assert len(messages) == 1


def test_a_name_is_as_its_hint_gives_it_unless_the_call_is_known() -> None:
    node = node_of(
        {
            "publishers": [
                {"topic": "/new", "msg_type": "a/T", "queue_size": 1, "create": True},
                {"topic": "/mux/x/?", "original_name": "/mux/out", "conditional": False},
            ]
        }
    )
    assert [end.written for end in node.endpoints if end.kind == "publishers"] == ["/mux/out", None, "/new"]
    known = replace(ROBOT, nodes=(replace(MUX, endpoints=(replace(OUT, written="out"),)),))
    hint = {"topic": "/cmd", "original_name": "/mux/out", "conditional": False}
    result, _ = applied({"nodes": {"/mux": {"publishers": [hint]}}}, known)
    assert result.nodes[0].endpoints[0].written == "out"


def test_a_full_hint_that_fits_nothing_creates_with_a_notice() -> None:
    hint = {"nodes": {"/mux": {"publishers": [{"topic": "/cmds", "msg_type": "a/T"}]}}}
    result, messages = applied(hint)
    assert result.nodes[0].endpoints[4] == made(
        "publishers",
        "/cmds",
        "a/T",
        latched=False,
        unknowns=(Unknown("queue_size", "the hint gives no queue_size"),),
    )
    assert messages == [
        "hints.nodes./mux.publishers[0]: there is no publisher /cmds; did you mean '/cmd'?; it was created; "
        "write 'create: true' if that is meant"
    ]


def test_hints_match_the_names_from_before_all_of_them() -> None:
    node = node_of(
        {
            "publishers": [
                {"topic": "/mux/?", "original_name": "/cmd"},
                {"topic": "/cmd", "original_name": "/mux/safe"},
                {"topic": "/mux/?", "latched": True},
            ]
        }
    )
    assert [(e.name, e.latched) for e in node.endpoints if e.kind == "publishers"] == [("/safe", False), ("/cmd", True)]


def test_a_node_is_fixed() -> None:
    node = node_of(
        {
            "args": "--x  1",
            "remaps": {"~out": "/other", "in": "/in"},
            "traceability": {"package": "mux", "file": "launch/b.launch", "line": 2},
            "conditional": True,
        }
    )
    assert node == replace(
        MUX,
        arguments="--x 1",
        remaps=(("/mux/out", "/other"), ("/in", "/in")),
        location=Location("src/mux/launch/b.launch", 2),
        conditions=(Condition("if", "?", Location(FILE)),),
        endpoints=(replace(OUT, name="/other", source="hint"), INPUT, VAGUE, RATE),
        source="hint",
    )


def test_a_node_gets_another_name_and_its_private_links_with_it() -> None:
    node = node_of({"rosname": "/front/mux"})
    assert (node.name, node.remaps[0], node.source) == ("/front/mux", ("/front/mux/out", "/cmd"), "hint")
    assert [(e.name, e.original_name) for e in node.endpoints] == [
        ("/cmd", "/front/mux/out"),
        ("/front/mux/?", "/front/mux/?"),
        ("/front/mux/?", "/front/mux/?"),
        ("/front/mux/rate", "/front/mux/rate"),
    ]
    assert node_of({"rosname": None}).name == "/?"


def test_the_links_of_a_node_with_an_unknown_name_stay() -> None:
    vague = replace(MUX, name="/?", endpoints=(end("publishers", "/?/a"),), remaps=())
    result, messages = applied({"nodes": {"/?": {"rosname": "/mux"}}}, replace(ROBOT, nodes=(vague,)))
    assert (result.nodes[0].name, result.nodes[0].endpoints, messages) == ("/mux", vague.endpoints, [])


def test_a_node_is_created() -> None:
    hints = {
        "nodes": {
            "/new": {
                "create": True,
                "node_type": "tools/view",
                "args": "-v",
                "remaps": {"~a": "/a"},
                "traceability": {"package": "mux", "file": "launch/mux.launch", "line": 9, "column": 3},
                "subscribers": [{"topic": "/cmd", "msg_type": "a/T", "queue_size": 2}],
                "servers": [{"service": "/s", "srv_type": "a/S", "create": True}],
            }
        }
    }
    result, messages = applied(hints)
    assert messages == [] and result.nodes[0] == MUX
    assert result.nodes[1] == Node(
        name="/new",
        kind="node",
        package="tools",
        type="view",
        arguments="-v",
        remaps=(("/new/a", "/a"),),
        location=Location("src/mux/launch/mux.launch", 9, 3),
        endpoints=(made("subscribers", "/cmd", "a/T", queue_size=2), made("servers", "/s", "a/S")),
        source="hint",
    )


def test_a_nodelet_is_created() -> None:
    hints = {"nodes": {"/n": {"create": True, "node_type": "mux/Mux", "args": "load mux/Mux manager"}}}
    node = applied(hints)[0].nodes[1]
    assert (node.kind, node.package, node.type, node.container) == ("nodelet", "mux", "Mux", "/manager")


def test_parameters() -> None:
    hints = {
        "parameters": {
            "/mux/gain": {"default_value": 0.5, "conditional": True},
            "/new": {"create": True, "param_type": "integer", "default_value": 3},
            "/map": {"create": True, "param_type": "yaml", "default_value": {"a": 1, "b": {"c": "x", "d": [1]}}},
        }
    }
    result, messages = applied(hints)
    assert messages == []
    assert result.parameters == (
        replace(GAIN, value=0.5, conditions=(Condition("if", "?", Location(FILE)),), unknowns=(), source="hint"),
        Parameter(name="/new", type="int", value=3, source="hint"),
        Parameter(name="/map/a", type="int", value=1, source="hint"),
        Parameter(name="/map/b/c", type="str", value="x", source="hint"),
        Parameter(name="/map/b/d", type="yaml", value=[1], source="hint"),
    )


def test_a_parameter_gets_another_name_type_and_place() -> None:
    place = {"package": "mux", "file": "a.launch", "line": 2}
    hints = {"parameters": {"/mux/gain": {"rosname": "/k", "param_type": "int", "traceability": place}}}
    assert applied(hints)[0].parameters == (
        replace(GAIN, name="/k", type="int", location=Location("src/mux/a.launch", 2), source="hint"),
    )


def test_variables_are_counted_by_key_and_attribute_in_order_of_location() -> None:
    more = (end("publishers", "/?", 2), end("publishers", "/x", 8, type=None, unknowns=unknown("latched")))
    node = replace(MUX, endpoints=(*MUX.endpoints, *more))
    assert [(v.name, v.index, v.reason) for v in variables(node)] == [
        ("advertise@name1", 4, ""),
        ("getParam@default_value1", 3, "computed"),
        ("advertise@name2", 2, "not constant"),
        ("subscribe@name1", 1, ""),
        ("subscribe@type1", 1, ""),
        ("subscribe@queue_size1", 1, "from a file"),
        ("advertise@type1", 5, ""),
        ("advertise@latched1", 5, "not constant"),
    ]
    assert variables(replace(MUX, endpoints=MUX.endpoints[::-1]))[0].name == "getParam@default_value1"


@pytest.mark.parametrize(
    ("fix", "index", "expected"),
    [
        (
            {"advertise@name1": "safe"},
            2,
            replace(VAGUE, name="/safe", original_name="/mux/safe", unknowns=(), source="hint"),
        ),
        (
            {"/mux": {"advertise@name1": "/global"}},
            2,
            replace(VAGUE, name="/global", original_name="/global", unknowns=(), source="hint"),
        ),
        (
            {"advertise@name1": "~private"},
            2,
            replace(VAGUE, name="/mux/private", original_name="/mux/private", unknowns=(), source="hint"),
        ),
        ({"subscribe@type1": "b/U"}, 1, replace(INPUT, type="b/U", source="hint")),
        ({"subscribe@queue_size1": 4}, 1, replace(INPUT, queue_size=4, unknowns=(), source="hint")),
        ({"getParam@default_value1": 1.5}, 3, replace(RATE, value=1.5, unknowns=(), source="hint")),
    ],
)
def test_fix(fix: dict[str, Any], index: int, expected: Endpoint) -> None:
    result, messages = applied({"fix": fix})
    assert messages == []
    assert result.nodes[0].endpoints == (*MUX.endpoints[:index], expected, *MUX.endpoints[index + 1 :])


def test_fix_fills_a_namespace_and_an_entry_in_the_middle() -> None:
    spaced = end("clients", "/?/s", unknowns=unknown("namespace"))
    middle = end("servers", "/a/?/s", unknowns=unknown("name"))
    configuration = replace(ROBOT, nodes=(replace(MUX, endpoints=(spaced, middle)),))
    result, messages = applied(
        {"fix": {"serviceClient@namespace1": "/x/y", "advertiseService@name1": "b"}}, configuration
    )
    assert [e.name for e in result.nodes[0].endpoints] == ["/x/y/s", "/a/b/s"] and messages == []


def test_fix_comes_before_the_hints_for_links() -> None:
    hints = {
        "nodes": {"/mux": {"publishers": [{"topic": "/safe", "latched": True}]}},
        "fix": {"advertise@name1": "safe"},
    }
    result, messages = applied(hints)
    assert (result.nodes[0].endpoints[2].latched, messages) == (True, [])


def test_fix_of_the_same_name_in_two_nodes() -> None:
    two = replace(ROBOT, nodes=(MUX, replace(MUX, name="/b/mux")))
    result, messages = applied({"fix": {"/mux": {"advertise@name1": "x"}}}, two)
    assert (result.nodes[0].endpoints[2].name, result.nodes[1], messages) == ("/mux/x", two.nodes[1], [])
    result, messages = applied({"fix": {"advertise@name1": "x"}}, two)
    assert (result, messages) == (
        two,
        [
            "hints.fix: 2 unknowns are called 'advertise@name1'; there are: "
            "/mux advertise@name1 (src/mux/src/mux.cpp:5:2; not constant), "
            "/b/mux advertise@name1 (src/mux/src/mux.cpp:5:2; not constant); "
            'write for example fix: {"/mux": {"advertise@name1": "/full/name"}}'
        ],
    )


@pytest.mark.parametrize(
    ("hints", "message"),
    [
        (5, "hints must be a map, not a number"),
        ({"node": {}}, "hints: nothing is called 'node' here; did you mean 'nodes'?"),
        ({"/mux": {"subscribe": {"a": "b"}}}, "hints: nothing is called '/mux' here"),
        ({"nodes": ["/mux"]}, "hints.nodes must be a map, not a list"),
        ({"nodes": {"/mix": {"args": "x"}}}, "hints.nodes./mix: there is no node /mix; did you mean '/mux'?"),
        (
            {"nodes": {"/mux": {"arguments": "x"}}},
            "hints.nodes./mux: nothing is called 'arguments' here; did you mean 'args'?",
        ),
        ({"nodes": {"/mux": {"args": ["x"]}}}, "hints.nodes./mux.args must be text, not a list"),
        ({"nodes": {"/mux": {"remaps": ["x"]}}}, "hints.nodes./mux.remaps must be a map from name to name, not a list"),
        ({"nodes": {"/mux": {"conditional": "no"}}}, "hints.nodes./mux.conditional must be true or false, not 'no'"),
        (
            {"nodes": {"/mux": {"node_type": "a/b"}}},
            "hints.nodes./mux: the type of a node that was found cannot be changed; it stays mux/mux_node",
        ),
        (
            {"nodes": {"/new": {"create": True}}},
            "hints.nodes./new: a node to create needs a 'node_type', as package/executable",
        ),
        (
            {"nodes": {"/new": {"create": True, "node_type": "view"}}},
            "hints.nodes./new.node_type must be text as package/type, not 'view'",
        ),
        (
            {"nodes": {"/mux": {"create": True, "node_type": "mux/mux_node"}}},
            "hints.nodes./mux: the node is there already, so it is changed, not created; remove 'create'",
        ),
        ({"nodes": {"/mux": {"publishers": {}}}}, "hints.nodes./mux.publishers must be a list of maps"),
        ({"nodes": {"/mux": {"publishers": [5]}}}, "hints.nodes./mux.publishers[0] must be a map, not a number"),
        (
            {"nodes": {"/mux": {"publishers": [{"msg_type": "a/T"}]}}},
            "hints.nodes./mux.publishers[0] needs a 'topic': a ROS name as text",
        ),
        (
            {"nodes": {"/mux": {"publishers": [{"topic": "/cnd", "latched": True}]}}},
            "hints.nodes./mux.publishers[0]: there is no publisher /cnd; did you mean '/cmd'?; "
            "to make one, it needs a 'msg_type'",
        ),
        (
            {"nodes": {"/mux": {"servers": [{"service": "/s", "create": True}]}}},
            "hints.nodes./mux.servers[0]: a link to create needs a 'srv_type'",
        ),
        (
            {"nodes": {"/mux": {"publishers": [{"topic": "/cmd", "queue_size": "10"}]}}},
            "hints.nodes./mux.publishers[0].queue_size must be a number from 0 on, not '10'",
        ),
        (
            {"nodes": {"/mux": {"publishers": [{"topic": "/cmd", "msg_type": "Twist"}]}}},
            "hints.nodes./mux.publishers[0].msg_type must be a type as package/Name, not 'Twist'",
        ),
        (
            {"nodes": {"/mux": {"publishers": [{"topic": "/cmd", "original_name": "a b"}]}}},
            "hints.nodes./mux.publishers[0].original_name must be a name, not 'a b'",
        ),
        (
            {"nodes": {"/mux": {"publishers": [{"topic": "/cmd", "traceability": {"package": "max", "file": "a"}}]}}},
            "hints.nodes./mux.publishers[0]: there is no package 'max'; did you mean 'mux'?",
        ),
        (
            {"nodes": {"/mux": {"publishers": [{"topic": "/cmd", "traceability": {"file": "../a"}}]}}},
            "hints.nodes./mux.publishers[0]: '../a' must be relative to its package and inside it",
        ),
        (
            {"parameters": {"/mux/gains": {}}},
            "hints.parameters./mux/gains: there is no parameter /mux/gains; did you mean '/mux/gain'?",
        ),
        ({"parameters": {"/p": {"create": True}}}, "hints.parameters./p: a parameter to create needs a 'param_type'"),
        (
            {"parameters": {"/mux/gain": {"create": True, "param_type": "int"}}},
            "hints.parameters./mux/gain: /mux/gain is there already; remove 'create' to change it",
        ),
        ({"parameters": {"/a b": {}}}, "hints.parameters./a b: this is no ROS name; write it as /namespace/name"),
        ({"fix": {"/mix": {"advertise@name1": "x"}}}, "hints.fix: there is no node '/mix'; did you mean '/mux'?"),
        (
            {"fix": {"subscribe@queue_size1": "x"}},
            "hints.fix: subscribe@queue_size1.queue_size must be a number from 0 on, not 'x'",
        ),
        ({"fix": {"advertise@name1": 5}}, "hints.fix: advertise@name1 must be a name as text"),
        (
            {"fix": {"/mux": {"advertise@name2": "x"}}},
            "hints.fix./mux: no unknown is called 'advertise@name2'; did you mean 'advertise@name1'?; there are: "
            "/mux getParam@default_value1 (src/mux/src/mux.cpp:3:2; computed), "
            "/mux advertise@name1 (src/mux/src/mux.cpp:5:2; not constant), "
            "/mux subscribe@name1 (src/mux/src/mux.cpp:7:2), "
            "/mux subscribe@type1 (src/mux/src/mux.cpp:7:2), "
            "/mux subscribe@queue_size1 (src/mux/src/mux.cpp:7:2; from a file); "
            'write for example fix: {"/mux": {"advertise@name1": "/full/name"}}',
        ),
    ],
)
def test_what_does_nothing_is_said(hints: Any, message: str) -> None:
    assert applied(hints) == (ROBOT, [message])


def test_one_wrong_part_costs_nothing_but_itself() -> None:
    hint = {"topic": "/cmd", "queue_size": -1, "latched": True, "colour": 1}
    result, messages = applied({"nodes": {"/mux": {"publishers": [5, hint], "args": "x", "conditional": 1}}})
    assert (result.nodes[0].arguments, result.nodes[0].endpoints[0]) == ("x", replace(OUT, latched=True, source="hint"))
    assert len(messages) == 4


def test_a_name_that_two_links_have_is_said() -> None:
    twice = replace(ROBOT, nodes=(replace(MUX, endpoints=(OUT, OUT)),))
    for hint in ({"topic": "/cmd", "msg_type": "b/U"}, {"topic": "/cmd", "latched": True}):
        assert applied({"nodes": {"/mux": {"publishers": [hint]}}}, twice) == (
            twice,
            ["hints.nodes./mux.publishers[0]: 2 publishers are called /cmd; a hint must be for one"],
        )


def test_two_unknown_parts_need_the_full_name() -> None:
    odd = replace(ROBOT, nodes=(replace(MUX, endpoints=(end("publishers", "/?/a/?"),)),))
    assert applied({"fix": {"advertise@name1": "x"}}, odd) == (
        odd,
        ["hints.fix: advertise@name1: /?/a/? has 2 unknown parts; give the full name, beginning with /"],
    )
    result, _ = applied({"fix": {"advertise@name1": "/x/a/y"}}, odd)
    assert result.nodes[0].endpoints[0].name == "/x/a/y"


def test_nothing_unknown_nothing_to_fix() -> None:
    known = replace(ROBOT, nodes=(replace(MUX, endpoints=(OUT,)),))
    assert applied({"fix": {"advertise@name1": "x"}}, known) == (
        known,
        ["hints.fix: no unknown is called 'advertise@name1': nothing is unknown in any node; remove the entry"],
    )


def test_specifications_add_calls_to_every_node_of_their_type() -> None:
    two = replace(ROBOT, nodes=(MUX, replace(MUX, name="/b/mux", remaps=()), replace(MUX, name="/c", type="other")))
    given = {
        "mux/mux_node": {
            "fix": {"advertise@name1": "filled"},
            "advertise": [{"name": "a", "namespace": "x", "msg_type": "a/T", "queue_size": 1}],
            "getParam": [
                {
                    "name": "p",
                    "namespace": "~",
                    "param_type": "int",
                    "default_value": 2,
                    "location": {"package": "mux", "file": "src/m.cpp", "line": 4, "function": "main"},
                }
            ],
            "hpl": {},
        }
    }
    result, problems = apply_specifications(two, given, FILE, PACKAGES)
    assert problems == () and result.nodes[2] == two.nodes[2]
    assert [node.endpoints[4:] for node in result.nodes[:2]] == [
        (
            made("publishers", f"{space}/x/a", "a/T", queue_size=1, latched=False),
            made("getters", f"{space}/mux/p", "int", value=2, location=Location("src/mux/src/m.cpp", 4)),
        )
        for space in ("", "/b")
    ]
    assert [node.endpoints[2].name for node in result.nodes] == ["/mux/filled", "/mux/filled", "/mux/?"]


@pytest.mark.parametrize(
    ("given", "messages"),
    [
        ([], ["nodes must be a map, not a list"]),
        ({"mux/mux_node": {"advertise": [{"name": "a"}]}}, ["nodes.mux/mux_node.advertise[0] needs a 'msg_type'"]),
        (
            {"mux/mux_node": {"subscribe": [{"msg_type": "a/T"}]}},
            ["nodes.mux/mux_node.subscribe[0] needs a 'name', and takes a 'namespace', both ROS names as text"],
        ),
        (
            {"mux/mux_node": {"advertize": []}},
            ["nodes.mux/mux_node: nothing is called 'advertize' here; did you mean 'advertise'?"],
        ),
        ({"mux/other": {"advertise": 5}}, []),
    ],
)
def test_specifications_of_a_wrong_shape(given: object, messages: list[str]) -> None:
    result, problems = apply_specifications(ROBOT, given, FILE, PACKAGES)
    assert (result, [problem.message for problem in problems]) == (ROBOT, messages)


@pytest.mark.parametrize(
    ("name", "node", "full"),
    [
        ("a", "/n", "/a"),
        ("a/b", "/x/n", "/x/a/b"),
        ("/a", "/x/n", "/a"),
        ("~a", "/x/n", "/x/n/a"),
        ("~/a", "/x/n", "/x/n/a"),
        ("//a//b/", "/n", "/a/b"),
        ("?", "/", "/?"),
    ],
)
def test_names(name: str, node: str, full: str) -> None:
    assert resolved(name, node) == full


def test_values_nested_without_end_and_hostile_names_are_problems() -> None:
    value: Any = 1
    for _ in range(5000):
        value = {"a": value}
    hints = {
        "parameters": {"/mux/gain": {"default_value": value}},
        "nodes": {"/a\n::error::": {"args": "x"}, "/mux": {"publishers": [{"topic": '/a`]"', "msg_type": "a/T"}]}},
    }
    result, messages = applied(hints)
    assert (result.nodes, len(messages)) == (ROBOT.nodes, 3)
