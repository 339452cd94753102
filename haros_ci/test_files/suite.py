# SPDX-License-Identifier: Apache-2.0
"""What the tests of one file are about: a system, or a node of it, its open topics, and the properties that it is held against."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from haros_ci.behaviour.messages import Messages, Scene
from haros_ci.behaviour.tree import Event, Expression, Property
from haros_ci.records import dataclass, field

#: The value of a constant of a message, by the expression that names it; None for what is none, or not known.
Constants = Callable[[Event, Expression], Any]


@dataclass(frozen=True, slots=True)
class Tested:
    """A property, *parsed*, in the names of the running system. *scenes* are by the identity of its events; *where* is ``file:line``, or "".

    *patience* is the bound in seconds that it was given, None if it has one of its own or needs none.
    """

    title: str
    text: str
    where: str
    parsed: Property
    scenes: Mapping[int, Scene]
    constants: Constants
    patience: float | None = None


@dataclass(frozen=True, slots=True)
class LaunchFile:
    """A launch file at *path* in its *package*, with arguments (``name:=value``)."""

    package: str
    path: str
    arguments: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Topic:
    """A topic of the running system with its *type*, and for ROS 2 what its ends ask for: *reliable*, *latched* (transient local)."""

    name: str
    type: str
    reliable: bool = True
    latched: bool = False


@dataclass(frozen=True, slots=True)
class Suite:
    """*nodes* are those that are started, () for all; *started* says them for people. *edges* are node, topic, and whether the node publishes.

    *inputs* are open topics: nodes under test subscribe, and none of them publishes.
    """

    configuration: str
    node: str
    ros: int
    launches: tuple[LaunchFile, ...]
    nodes: tuple[str, ...]
    started: tuple[str, ...]
    inputs: tuple[Topic, ...]
    outputs: tuple[Topic, ...]
    edges: tuple[tuple[str, str, bool], ...]
    properties: tuple[Tested, ...]
    assumptions: tuple[Tested, ...]
    messages: Messages
    notes: tuple[str, ...] = field(default=())
