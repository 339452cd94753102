# SPDX-License-Identifier: Apache-2.0
"""Suites of tests, made of texts in HPL and of types in words, without a workspace."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from haros_ci.behaviour.meaning import bindings
from haros_ci.behaviour.messages import Constant, Messages, Scene
from haros_ci.behaviour.parser import parse_property
from haros_ci.behaviour.text import canonical
from haros_ci.behaviour.tree import Event, Expression
from haros_ci.interfaces.common import definition
from haros_ci.interfaces.definitions import Definitions
from haros_ci.test_files.suite import LaunchFile, Suite, Tested, Topic

#: Types of the tests: as ``interfaces/common_ros1.txt`` has them.
TYPES = (
    "demo/msg/Command\tfloat64 speed\tfloat32 turn\tfloat64 MAX=1.5\tstring mode",
    "demo/msg/Bumper\tbool left\tbool right",
    "demo/msg/Scan\tstd_msgs/Header header\tfloat32[] ranges\tuint8[3] colour\tdemo/Command[] commands",
    "demo/msg/Deep\tdemo/Scan scan\ttime at\tduration took\tint8 level\tint8 LOW=-3\tint8 HIGH=7",
)
TOPICS = {
    "/level": "std_msgs/Int8",
    "/command": "demo/Command",
    "/bumper": "demo/Bumper",
    "/scan": "demo/Scan",
    "/deep": "demo/Deep",
    "/out": "std_msgs/Int8",
    "/stop": "std_msgs/Empty",
}


def messages(types: Iterable[str] = TYPES, ros: int = 1) -> Messages:
    return Messages(Definitions(map(definition, types), ros))


def tested(text: str, known: Messages, topics: Mapping[str, str] = TOPICS) -> Tested:
    """A property over these topics."""
    parsed = parse_property(text)
    scenes: dict[int, Scene] = {}
    for event, others in bindings(parsed):
        own = known.named(topics[event.topic])
        aliases = {name: known.named(topics[other.topic]) for name, other in others.items()}
        if event.alias is not None:
            aliases[event.alias] = own
        scenes[id(event)] = Scene(known, own, aliases)

    def constant(event: Event, expression: Expression) -> Any:
        typed = scenes[id(event)].typed(expression)
        return typed.value if isinstance(typed, Constant) else None

    return Tested(canonical(parsed), canonical(parsed), "haros.yaml:1:1", parsed, scenes, constant)


def suite(
    *properties: str,
    assumptions: tuple[str, ...] = (),
    inputs: tuple[str, ...] = ("/level", "/bumper"),
    known: Messages | None = None,
    topics: Mapping[str, str] = TOPICS,
    ros: int = 1,
    node: str = "/node",
) -> Suite:
    """A suite of one node; what is no input is an output."""
    known = known or messages(ros=ros)
    outputs = tuple(name for name in topics if name not in inputs)
    return Suite(
        "robot",
        node,
        ros,
        (LaunchFile("demo", "launch/demo.launch", ("a:=1",)),),
        (node,),
        (f"{node} (demo/node)",),
        tuple(Topic(name, topics[name]) for name in inputs),
        tuple(Topic(name, topics[name]) for name in outputs),
        tuple((node, name, name in outputs) for name in topics),
        tuple(tested(text, known, topics) for text in properties),
        tuple(tested(text, known, topics) for text in assumptions),
        known,
    )
