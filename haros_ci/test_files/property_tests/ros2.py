# SPDX-License-Identifier: Apache-2.0
"""A system of ROS 2 under test: what launch_testing has started, and the topics of the tests. This module has not been run with ROS 2.

launch_testing starts the launch files once for all tests of a file, so that no fresh system can be had: a failure is replayed on the system
that there is, and ``hooks.reset`` is how its state can be brought back.
"""

from __future__ import annotations

import importlib
import threading
import time
import unittest
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import pytest

from haros_ci.test_files.property_tests.trials import Driver, NotReady

#: Seconds that nodes and their edges have to come.
PATIENCE = 20.0
NAME = "property_tests"


class Launch(NamedTuple):
    """A launch file in its package, with arguments (``name:=value``)."""

    package: str
    path: str
    arguments: Sequence[str] = ()


class Topic(NamedTuple):
    """A type, and the quality of service that suits the ends that the model has."""

    type: str
    reliable: bool = True
    latched: bool = False


class Edge(NamedTuple):
    """*node* subscribes to *topic*, or (*publishes*) publishes on it."""

    node: str
    topic: str
    publishes: bool


def description(launches: Sequence[Launch]) -> Any:
    """The launch description that launch_testing starts: the launch files, and word that the tests may begin."""
    from ament_index_python.packages import get_package_share_directory
    from launch import LaunchDescription
    from launch.actions import IncludeLaunchDescription
    from launch.launch_description_sources import AnyLaunchDescriptionSource
    from launch_testing.actions import ReadyToTest

    included = [
        IncludeLaunchDescription(
            AnyLaunchDescriptionSource(f"{get_package_share_directory(item.package)}/{item.path}"),
            launch_arguments=[tuple(argument.split(":=", 1)) for argument in item.arguments],
        )
        for item in launches
    ]
    return LaunchDescription([*included, ReadyToTest()])


def case(*checks: Callable[[], None]) -> Any:
    """The test case that launch_testing looks for: a method for each of *checks*. Flaky ones are skipped with their reason."""

    def method(check: Callable[[], None]) -> Callable[[unittest.TestCase], None]:
        def run(self: unittest.TestCase) -> None:
            try:
                check()
            except (pytest.skip.Exception, pytest.xfail.Exception) as err:
                self.skipTest(str(err))
            except pytest.fail.Exception as err:
                self.fail(str(err))

        return run

    return type("TestProperties", (unittest.TestCase,), {f"test_{check.__name__}": method(check) for check in checks})


class Ros2(Driver):
    """*inputs* are the topics on which the tests publish, *outputs* those that they watch."""

    restarts = False

    def __init__(self, inputs: dict[str, Topic], outputs: dict[str, Topic], edges: Sequence[Edge]) -> None:
        self.inputs, self.outputs, self.edges = inputs, outputs, edges
        self.node: Any = None
        self.take: Callable[[str, Any], None] | None = None
        self.came = 0.0
        self.publishers: dict[str, Any] = {}

    @property
    def running(self) -> bool:
        return self.node is not None

    def start(self) -> None:
        import rclpy

        if not rclpy.ok():
            rclpy.init()
        node = rclpy.create_node(NAME)
        for topic, asked in self.outputs.items():
            node.create_subscription(class_of(asked.type), topic, self._callback(topic), quality(asked))
        for topic, asked in self.inputs.items():
            self.publishers[topic] = node.create_publisher(class_of(asked.type), topic, quality(asked))
        threading.Thread(target=rclpy.spin, args=(node,), daemon=True).start()
        self._wait(node)
        self.node = node

    def _callback(self, topic: str) -> Callable[[Any], None]:
        def came(message: Any) -> None:
            self.came = time.monotonic()
            take = self.take
            if take is not None:
                take(topic, plain(message))

        return came

    def _wait(self, node: Any) -> None:
        """Wait until every edge is there, in both directions."""
        until = time.monotonic() + PATIENCE
        missing: list[Edge] = list(self.edges)
        while missing:
            missing = [edge for edge in missing if not _is_up(node, edge)]
            if time.monotonic() > until:
                shown = ", ".join(
                    f"{edge.node} {'publishes' if edge.publishes else 'subscribes to'} {edge.topic}" for edge in missing
                )
                raise NotReady(f"not so after {PATIENCE:.0f} s: {shown}")
            time.sleep(0.01)

    def reset(self) -> bool:
        try:
            from hooks import reset  # type: ignore[import-not-found]  # a file of the team's own, beside the tests
        except ImportError:
            return False
        reset(self)
        return True

    def send(self, topic: str, message: Any) -> None:
        self.publishers[topic].publish(filled(class_of(self.inputs[topic].type), message))

    def listen(self, take: Callable[[str, Any], None] | None) -> None:
        self.take = take

    def last(self) -> float:
        return self.came


def _is_up(node: Any, edge: Edge) -> bool:
    """Whether the graph has the end of the node; discovery matches ends of both sides before it shows them."""
    ends = (
        node.get_publishers_info_by_topic(edge.topic)
        if edge.publishes
        else node.get_subscriptions_info_by_topic(edge.topic)
    )
    return any(f"{end.node_namespace.rstrip('/')}/{end.node_name}" == edge.node for end in ends)


def quality(topic: Topic) -> Any:
    """A profile that is compatible with the ends that the model has."""
    from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

    return QoSProfile(
        depth=1000,
        reliability=ReliabilityPolicy.RELIABLE if topic.reliable else ReliabilityPolicy.BEST_EFFORT,
        durability=DurabilityPolicy.TRANSIENT_LOCAL if topic.latched else DurabilityPolicy.VOLATILE,
    )


def class_of(kind: str) -> Any:
    """The class of ``pkg/T`` or ``pkg/msg/T``."""
    package, name = kind.split("/")[0], kind.split("/")[-1]
    return getattr(importlib.import_module(f"{package}.msg"), name)


def filled(kind: Any, values: dict[str, Any]) -> Any:
    """A message of the class *kind* with these values."""
    made = kind()
    for name, written in kind.get_fields_and_field_types().items():
        setattr(made, name, _value(written, values[name]))
    return made


def _value(written: str, value: Any) -> Any:
    base = written.split("[")[0].replace("sequence<", "").split(",")[0].rstrip(">")
    if isinstance(value, list):
        return [_value(base, item) for item in value]
    if isinstance(value, dict):
        return filled(class_of(base), value)
    return bytes([value]) if base == "octet" else value


def plain(message: Any) -> Any:
    """A message as dicts, lists and plain values."""
    if hasattr(message, "get_fields_and_field_types"):
        return {name: plain(getattr(message, name)) for name in message.get_fields_and_field_types()}
    if isinstance(message, bytes) and len(message) == 1:
        return message[0]
    if hasattr(message, "tolist"):
        return message.tolist()
    if isinstance(message, (list, tuple)):
        return [plain(item) for item in message]
    return message
