# SPDX-License-Identifier: Apache-2.0
"""Values and a small robot for the tests of queries."""

from __future__ import annotations

from dataclasses import replace
from operator import attrgetter
from typing import Any, ClassVar

from haros_ci.model.architecture import Architecture, Condition, Configuration, Endpoint, Node, Parameter, Qos
from haros_ci.model.location import Location
from haros_ci.model.package import Package, SourceFile
from haros_ci.query.engine import Query
from haros_ci.query.fault import QueryError
from haros_ci.query.queries import VARIABLES, Scenes
from haros_ci.query.values import QueryEntity, QueryList, QueryRecord, Value


class Thing(QueryEntity):
    """An entity with whatever attributes a test wants; queries see those that ATTRIBUTES lists."""

    KIND = "Thing"
    ATTRIBUTES: ClassVar[dict[str, Any]] = {name: attrgetter(name) for name in ("name", "a", "b", "s", "parts", "map")}
    secret = "not for queries"

    def __init__(self, **fields: Value) -> None:
        self.name = self.a = self.b = self.s = None
        self.parts = QueryList.of(())
        self.map = QueryRecord({})
        self.__dict__.update(fields)

    def words(self) -> str:
        return str(self.name)


def asked(text: str, **variables: Value) -> tuple[Value, ...]:
    """What the query gives; lists of Python are lists there."""
    own = {name: QueryList.of(value) if isinstance(value, list) else value for name, value in variables.items()}
    return Query(text, own).matches(own)


def plainly(value: Value) -> Any:
    """A value of a query as Python has it: entities by name, lists as lists."""
    if isinstance(value, Thing):
        return value.name
    if isinstance(value, (QueryList, tuple)):
        return [plainly(item) for item in value]
    return {key: plainly(item) for key, item in value.items()} if isinstance(value, QueryRecord) else value


def given(text: str, **variables: Value) -> Any:
    return plainly(asked(text, **variables))


def fault(text: str, **variables: Value) -> str:
    """The message of a query that is wrong."""
    try:
        found = asked(text, **variables)
    except QueryError as err:
        return err.explained(text)
    raise AssertionError(f"no error, but {found}")


CPP = "src/walker/src/walker.cpp"
IF = Condition("if", "is_fast", Location(CPP, 30, 3))


def end(kind: str, name: str, written: str, line: int, type: str | None = "std_msgs/String", **more: Any) -> Endpoint:
    fields = {"original_name": name, "location": Location(CPP, line, 5), **more}
    return Endpoint(kind=kind, name=name, written=written, type=type, **fields)


WALKER = Node(
    name="/walker",
    kind="node",
    package="walker",
    type="walker_node",
    remaps=(("/vel", "/cmd_vel"),),
    location=Location("src/walker/launch/walk.launch", 3, 3),
    source="launch",
    endpoints=(
        end(
            "publishers",
            "/cmd_vel",
            "vel",
            10,
            "geometry_msgs/Twist",
            original_name="/vel",
            queue_size=0,
            latched=False,
        ),
        end("publishers", "/tf", "/tf", 11, "tf2_msgs/TFMessage", queue_size=100, latched=False, source="hint"),
        end("publishers", "/rosout", "/rosout", 1, "rosgraph_msgs/Log", implicit=True),
        end("subscribers", "/walker/bumper", "~bumper", 12, "std_msgs/Empty", queue_size=1, conditions=(IF,)),
        end("servers", "/walker/stop", "stop", 13, "std_srvs/Empty"),
        end("getters", "/walker/speed", "speed", 14, "double", value=0.5),
        end("setters", "/speed_now", "/speed_now", 15, "double", value=None),
    ),
)
BASE = Node(
    name="/base",
    kind="nodelet",
    package="base",
    type="BaseNodelet",
    location=Location("src/walker/launch/walk.launch", 4, 3),
    source="launch",
    endpoints=(
        end("subscribers", "/cmd_vel", "cmd_vel", 20, "geometry_msgs/TwistStamped", queue_size=10, source="known-node"),
        end("publishers", "/scan", "scan", 21, None, queue_size=None, source="known-node", location=None),
        end("publishers", "/base/?", "?", 22, queue_size=1),
        end("publishers", "/base/?", "?", 23, queue_size=1),
        end("clients", "/walker/stop", "/walker/stop", 24, "std_srvs/Empty"),
    ),
)
WALK = Configuration(
    name="walk",
    launch=("walker/launch/walk.launch",),
    nodes=(WALKER, BASE),
    parameters=(
        Parameter(
            name="/walker/speed", type="double", value=1.5, location=Location("src/walker/launch/walk.launch", 5, 5)
        ),
    ),
)
TALKER = Node(
    name="/talker",
    kind="component",
    package="walker",
    type="ns::Talker",
    ros=2,
    location=Location("src/walker/launch/talk.launch.py", 7, 5),
    endpoints=(
        end(
            "publishers",
            "/chat",
            "chat",
            40,
            "std_msgs/msg/String",
            qos=Qos(history="keep_last", depth=5, reliability="best_effort", durability="transient_local"),
        ),
        end("publishers", "/all", "all", 41, "std_msgs/msg/String", qos=Qos(history="keep_all", depth=1)),
        end("action_servers", "/move", "move", 42, "demo/action/Move"),
        end("parameters", "/talker:rate", "rate", 43, "int", value=5, effective=10, read_only=True, range=(1, 9, None)),
    ),
)
TALK = Configuration(name="talk", launch=("walker/launch/talk.launch.py",), nodes=(TALKER,))
FILES = (
    SourceFile("src/walker/launch/walk.launch", "launch", 10, "0", "walker", 6),
    SourceFile(CPP, "cpp", 2000, "1", "walker", 80),
    SourceFile("src/walker/msg/Step.msg", "interface", 20, "2", "walker", 2),
    SourceFile("notes/plan.yaml", "yaml", 5, "3"),
)
PACKAGES = (Package("walker", "src/walker", version="1.0.0"), Package("base", "src/base"))
ROBOT = Architecture(configurations=(WALK, TALK), packages=PACKAGES)


def scene(scope: str = "configuration", name: str = "walk", robot: Architecture = ROBOT) -> dict[str, Value]:
    """The variables of the first scene of that scope."""
    names = (name,) if scope == "configuration" else None
    return next(iter(Scenes(robot, FILES, {}).of(scope, names)))[1]


def about(text: str, scope: str = "configuration", name: str = "walk", robot: Architecture = ROBOT) -> list[str]:
    """What a query of the robot gives, in words."""
    from haros_ci.query.values import words

    variables = scene(scope, name, robot)
    assert set(VARIABLES[scope]) == set(variables)
    return [words(match) for match in Query(text, VARIABLES[scope]).matches(variables)]


def robot_with(*nodes: Node) -> Architecture:
    return replace(ROBOT, configurations=(replace(WALK, nodes=nodes),))
