# SPDX-License-Identifier: Apache-2.0
"""The model as JSON: its contract to the letter, its schema, and names that nobody honest writes."""

from __future__ import annotations

import copy
import json
import math
from dataclasses import replace
from datetime import date
from pathlib import Path
from typing import Any

import jsonschema
import pytest
from interface_samples import SYSTEM

from haros_ci.model.architecture import (
    KINDS,
    Architecture,
    Condition,
    Configuration,
    Endpoint,
    Node,
    Parameter,
    Unknown,
)
from haros_ci.model.location import Location
from haros_ci.model.package import Package
from haros_ci.model.workspace import Problem
from haros_ci.report import model_json

SCHEMA = json.loads(Path(model_json.__file__).with_name("model-schema.json").read_text(encoding="utf-8"))
CPP = "src/kobuki/base/src/odometry.cpp"
LAUNCH = "src/kobuki/base/launch/base.launch"
HOSTILE = '/a"b\\c`d]e|f&lt;\n::error::x ##[error]x\u202e\x1b[31m%%{init}%%-->é\ud800'

IF = Condition("if", "x == 0", Location(CPP, 10, 3))
ODOM = Endpoint(
    kind="publishers",
    name="/odom",
    original_name="/base/odom",
    type="nav_msgs/Odometry",
    location=Location(CPP, 76, 20),
    queue_size=50,
    latched=False,
    conditions=(IF,),
)
VAGUE = Endpoint(
    kind="subscribers",
    name="/base/?",
    original_name="/base/?",
    type=None,
    location=Location(CPP, 80, 1),
    unknowns=(
        Unknown("type", "the callback has no declared type", Location(CPP, 80, 5)),
        Unknown("name", "the argument 'topic' is not constant", Location(CPP, 80, 9)),
        Unknown("queue_size", "read from a file"),
    ),
)
RATE = Endpoint(
    kind="getters",
    name="/base/rate",
    original_name="/base/rate",
    type="double",
    location=Location(CPP, 90, 2),
    value=16.5,
)
BASE = Node(
    name="/base",
    kind="nodelet",
    package="base",
    type="BaseNodelet",
    arguments="load base/BaseNodelet manager",
    remaps=(("/base/odom", "/odom"),),
    location=Location(LAUNCH, 8, 3),
    endpoints=(RATE, VAGUE, ODOM),
    class_name="base::BaseNodelet",
    container="/manager",
    process="/manager",
    source="launch",
)
ROSOUT = Endpoint(
    kind="publishers",
    name="/rosout",
    original_name="/rosout",
    type="rosgraph_msgs/Log",
    location=None,
    implicit=True,
    source="known-node",
)
VIEW = Node(
    name="/view",
    kind="node",
    package="tools",
    type="view",
    conditions=(Condition("unless", "$(arg quiet)", Location(LAUNCH, 20, 3)),),
    endpoints=(
        replace(ODOM, kind="subscribers", original_name="/odom", latched=None, conditions=()),
        ROSOUT,
        replace(VAGUE, name="/base/?"),
        Endpoint(kind="clients", name="/reset", original_name="/reset", type="std_srvs/Empty", location=None),
        Endpoint(kind="action_clients", name="/go", original_name="/go", type="nav/Go", location=None, source="hint"),
    ),
)
PUBLISH_TF = Parameter(
    name="/base/publish_tf",
    type="bool",
    value=True,
    location=Location(LAUNCH, 10, 5),
    origin=Location("src/kobuki/base/param/base.yaml", 3, 1),
)
ROBOT = Configuration(
    name="robot",
    launch=("base/launch/base.launch",),
    nodes=(VIEW, BASE),
    parameters=(PUBLISH_TF,),
    arguments=(("quiet", "false"),),
    user_data={"plugin": [1, {"a": None}]},
)
SAMPLE = Architecture(
    configurations=(ROBOT,),
    packages=(
        Package("tools", "src/tools"),
        Package("base", "src/kobuki/base", ros=1),
        Package("kobuki", "src/kobuki"),
    ),
    problems=(Problem("src/x.launch", "not XML\x1b", 3),),
)


def written(architecture: Architecture) -> Any:
    document = json.loads(model_json.render(architecture))
    jsonschema.Draft202012Validator(SCHEMA).validate(document)
    return document


def robot() -> Any:
    return written(SAMPLE)["configurations"][0]


def test_a_node() -> None:
    node = robot()["nodes"][0]
    ends = {kind: node.pop(kind) for kind in KINDS}
    assert node == {
        "name": "/base",
        "kind": "nodelet",
        "package": "base",
        "type": "BaseNodelet",
        "class": "base::BaseNodelet",
        "ros": 1,
        "container": "/manager",
        "process": "/manager",
        "args": "load base/BaseNodelet manager",
        "remaps": {"/base/odom": "/odom"},
        "conditions": [],
        "location": {"package": "base", "file": "launch/base.launch", "path": LAUNCH, "line": 8, "column": 3},
        "source": "launch",
        "unknowns": [],
    }
    assert {kind: len(found) for kind, found in ends.items() if found} == {
        "publishers": 1,
        "subscribers": 1,
        "getters": 1,
    }


def test_endpoints() -> None:
    base, view = robot()["nodes"]
    place = {"package": "base", "file": "src/odometry.cpp", "path": CPP}
    assert base["publishers"] == [
        {
            "name": "/odom",
            "original_name": "/base/odom",
            "type": "nav_msgs/Odometry",
            "queue_size": 50,
            "latched": False,
            "qos": None,
            "implicit": False,
            "conditions": [
                {"statement": "if", "condition": "x == 0", "location": {**place, "line": 10, "column": 3}},
            ],
            "location": {**place, "line": 76, "column": 20},
            "source": "source",
            "unknowns": [],
        }
    ]
    assert base["subscribers"][0]["unknowns"] == [
        {
            "field": "name",
            "reason": "the argument 'topic' is not constant",
            "location": {**place, "line": 80, "column": 9},
        },
        {"field": "queue_size", "reason": "read from a file", "location": None},
        {
            "field": "type",
            "reason": "the callback has no declared type",
            "location": {**place, "line": 80, "column": 5},
        },
    ]
    assert (base["subscribers"][0]["type"], base["subscribers"][0]["queue_size"]) == (None, None)
    assert "latched" not in base["subscribers"][0]
    assert base["getters"][0]["value"] == 16.5 and "queue_size" not in base["getters"][0]
    assert [(end["name"], end["implicit"], end["source"]) for end in view["publishers"]] == [
        ("/rosout", True, "known-node")
    ]


def test_topics_services_and_actions() -> None:
    assert [
        (t["name"], t["types"], t["publishers"], t["subscribers"], t["conditional"], t["implicit"], t["source"])
        for t in robot()["topics"]
    ] == [
        ("/base/?", [], [], ["/base"], False, False, "source"),  # two unknown names are not one topic
        ("/base/?", [], [], ["/view"], True, False, "source"),
        ("/odom", ["nav_msgs/Odometry"], ["/base"], ["/view"], True, False, "source"),
        ("/rosout", ["rosgraph_msgs/Log"], ["/view"], [], True, True, "known-node"),
    ]
    assert [why["field"] for why in robot()["topics"][0]["unknowns"]] == ["name", "type"]
    assert robot()["services"] == [
        {
            "name": "/reset",
            "types": ["std_srvs/Empty"],
            "servers": [],
            "clients": ["/view"],
            "conditional": True,
            "implicit": False,
            "source": "source",
            "unknowns": [],
        }
    ]
    assert [(a["name"], a["clients"], a["servers"], a["source"]) for a in robot()["actions"]] == [
        ("/go", ["/view"], [], "hint")
    ]


def test_a_channel_is_conditional_only_if_all_ends_are() -> None:
    always = replace(VIEW, name="/other", conditions=())
    document = written(Architecture(configurations=(replace(ROBOT, nodes=(BASE, always)),)))
    assert {t["name"]: t["conditional"] for t in document["configurations"][0]["topics"]}["/odom"] is False


def test_two_types_are_listed() -> None:
    other = replace(VIEW, name="/other", endpoints=(replace(ODOM, type="a/Other"),))
    document = written(Architecture(configurations=(replace(ROBOT, nodes=(other, BASE)),)))
    topic = next(t for t in document["configurations"][0]["topics"] if t["name"] == "/odom")
    assert (topic["types"], topic["publishers"]) == (["a/Other", "nav_msgs/Odometry"], ["/base", "/other"])


def test_the_rest() -> None:
    document = written(SAMPLE)
    assert list(document) == ["schema_version", "configurations", "packages", "problems"]
    configuration = document["configurations"][0]
    assert configuration["launch"] == ["base/launch/base.launch"]
    assert configuration["arguments"] == {"quiet": "false"}
    assert configuration["user_data"] == {"plugin": [1, {"a": None}]}
    assert [p["name"] for p in document["packages"]] == ["base", "kobuki", "tools"]
    assert document["problems"] == [{"path": "src/x.launch", "line": 3, "message": "not XML\ufffd"}]
    parameter = configuration["parameters"][0]
    assert (parameter["location"]["line"], parameter["source"]) == (10, "launch")
    assert parameter["origin"]["file"] == "param/base.yaml"


@pytest.mark.parametrize(
    ("packages", "path", "package", "file"),
    [
        ((), "src/a.cpp", None, "src/a.cpp"),
        ((Package("root", "."),), "src/a.cpp", "root", "src/a.cpp"),
        ((Package("root", "."), Package("in", "src")), "src/a.cpp", "in", "a.cpp"),
        ((Package("outer", "src"), Package("inner", "src/b")), "src/b/c/a.cpp", "inner", "c/a.cpp"),
        ((Package("near", "src/ab"),), "src/abc/a.cpp", None, "src/abc/a.cpp"),
    ],
)
def test_the_package_is_the_innermost(packages: tuple[Package, ...], path: str, package: str | None, file: str) -> None:
    assert model_json.Places(packages).split(path) == (package, file)


def test_order_and_bytes_do_not_depend_on_the_order_of_input() -> None:
    turned = replace(
        SAMPLE,
        configurations=(replace(ROBOT, nodes=(replace(BASE, endpoints=(ODOM, VAGUE, RATE)), VIEW)),),
        packages=SAMPLE.packages[::-1],
    )
    assert model_json.render(turned) == model_json.render(SAMPLE)


def test_hostile_names_survive_as_data_and_nowhere_else() -> None:
    end = replace(ODOM, name=HOSTILE, original_name=HOSTILE, type=HOSTILE)
    node = replace(BASE, name=HOSTILE, endpoints=(end,), remaps=((HOSTILE, HOSTILE),))
    text = model_json.render(Architecture(configurations=(replace(ROBOT, name=HOSTILE, nodes=(node,)),)))
    assert text.isascii() and "##[" not in text and "\x1b" not in text
    assert not any(line.lstrip().startswith("::") for line in text.splitlines())
    configuration = json.loads(text)["configurations"][0]
    assert configuration["nodes"][0]["publishers"][0]["name"] == HOSTILE
    assert configuration["nodes"][0]["remaps"] == {HOSTILE: HOSTILE}
    assert configuration["topics"][0]["name"] == HOSTILE


def deep(levels: int) -> object:
    value: object = 1
    for _ in range(levels):
        value = [value]
    return value


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        (True, True),
        (16.5, 16.5),
        (math.nan, "nan"),
        (-math.inf, "-inf"),
        (date(2020, 1, 2), "2020-01-02"),
        (b"\x01\xff", "01ff"),
        ({1: (2, 3)}, {"1": [2, 3]}),
        (10**5000, "?"),
        (deep(3), [[[1]]]),
    ],
    ids=lambda value: type(value).__name__,
)
def test_values(value: object, expected: object) -> None:
    architecture = Architecture(configurations=(replace(ROBOT, parameters=(replace(PUBLISH_TF, value=value),)),))
    assert written(architecture)["configurations"][0]["parameters"][0]["value"] == expected


def test_a_value_nested_without_end_is_cut() -> None:
    assert json.dumps(model_json.plain(deep(100_000))).count("[") == 50
    loop: list[object] = []
    loop.append(loop)
    assert json.dumps(model_json.plain(loop)).count("[") == 50


def test_nothing_at_all() -> None:
    assert written(Architecture()) == {"schema_version": 1, "configurations": [], "packages": [], "problems": []}


def broken(path: str, value: object) -> Any:
    document = copy.deepcopy(written(SAMPLE))
    *parents, last = path.split(".")
    at = document
    for part in parents:
        at = at[int(part) if part.isdigit() else part]
    if value is None:
        del at[last]
    else:
        at[last] = value
    return document


@pytest.mark.parametrize(
    ("path", "value"),
    [
        ("packages", None),
        ("schema_version", 2),
        ("configurations", {}),
        ("configurations.0.name", ""),
        ("configurations.0.topics", None),
        ("configurations.0.arguments", {"a": 1}),
        ("configurations.0.nodes.0.kind", "Node"),
        ("configurations.0.nodes.0.remaps", [["/a", "/b"]]),
        ("configurations.0.nodes.0.getters", None),
        ("configurations.0.nodes.0.source", "guess"),
        ("configurations.0.nodes.0.location", "src/a.cpp:1"),
        ("configurations.0.nodes.0.location.line", 0),
        ("configurations.0.nodes.0.location.package", 7),
        ("configurations.0.nodes.0.publishers.0.queue_size", "50"),
        ("configurations.0.nodes.0.publishers.0.latched", "no"),
        ("configurations.0.nodes.0.publishers.0.qos", {"depth": 1}),
        ("configurations.0.nodes.0.publishers.0.original_name", None),
        ("configurations.0.nodes.0.publishers.0.conditions.0.statement", "elseif"),
        ("configurations.0.nodes.0.subscribers.0.unknowns.0.reason", None),
        ("configurations.0.nodes.0.getters.0.value", None),
        ("configurations.0.topics.0.publishers", "/base"),
        ("configurations.0.services.0.conditional", "yes"),
        ("configurations.0.parameters.0.value", None),
        ("packages.0.ros", 3),
    ],
)
def test_the_schema_refuses(path: str, value: object) -> None:
    assert list(jsonschema.Draft202012Validator(SCHEMA).iter_errors(broken(path, value)))


def test_the_schema_is_one_and_takes_new_keys() -> None:
    jsonschema.Draft202012Validator.check_schema(SCHEMA)
    jsonschema.Draft202012Validator(SCHEMA).validate(broken("configurations.0.nodes.0.parameters", []))


def test_a_ros_2_system_is_as_the_schema_has_it() -> None:
    document = written(SYSTEM)
    lane = document["configurations"][1]["nodes"][0]
    assert (lane["ros"], [item["name"] for item in lane["parameters"]]) == (
        2,
        ["/planning/lane:limits", "/planning/lane:map.frame", "/planning/lane:rate", "/planning/lane:width"],
    )


@pytest.mark.parametrize(
    ("kind", "key", "value"),
    [
        ("parameters", "read_only", "yes"),
        ("parameters", "range", [1.0]),
        ("parameters", "range", ["a", None, None]),
        ("publishers", "qos", {"depth": 1}),
    ],
)
def test_the_schema_refuses_ros_2(kind: str, key: str, value: object) -> None:
    document = copy.deepcopy(written(SYSTEM))
    document["configurations"][1]["nodes"][0][kind][0][key] = value
    assert list(jsonschema.Draft202012Validator(SCHEMA).iter_errors(document))
