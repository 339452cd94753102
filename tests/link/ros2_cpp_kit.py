# SPDX-License-Identifier: Apache-2.0
"""Views of the one component that the tests of ROS 2 C++ libraries follow."""

from __future__ import annotations

from typing import Any

from follow_kit import ends, ros2_cpp

from haros_ci.model.architecture import Configuration, Endpoint, Node

PUB = "create_publisher<String>"
SUB = "create_subscription<String>"


def component(body: str, members: str = "", before: str = "") -> Node:
    """The component's node, without those that libraries make for themselves."""
    found = ros2_cpp(body, members, before)
    return next(node for node in found.nodes if node.name == "/n")


def explicit(found: Node, kind: str = "publishers") -> list[Endpoint]:
    """The endpoints that the node's own code makes, by name."""
    return sorted((end for end in ends(found, kind) if not end.implicit), key=lambda end: end.name)


def by_name(found: Configuration) -> dict[str, Node]:
    return {node.name: node for node in found.nodes}


def only(found: Node, kind: str = "publishers") -> Endpoint:
    (end,) = explicit(found, kind)
    return end


def policies(end: Endpoint) -> tuple[Any, ...]:
    """History, depth, reliability, durability."""
    assert end.qos is not None
    return end.qos.history, end.qos.depth, end.qos.reliability, end.qos.durability


def last(depth: Any, reliability: Any = "reliable", durability: Any = "volatile") -> tuple[Any, ...]:
    return "keep_last", depth, reliability, durability


BEST, KEPT = "best_effort", "transient_local"
