# SPDX-License-Identifier: Apache-2.0
"""ROS 2: what is declared with a class that is not in the workspace, and called as only a node is, is a node of which more is not known."""

from __future__ import annotations

import pytest
from follow_kit import explicit, follow, only, ros2_main
from ros2_cpp_kit import PUB

from haros_ci.model.architecture import Configuration, Node

SETUP = "from setuptools import setup\nsetup(name='p', packages=['p'], entry_points={'console_scripts': ['n = p.n:main']})\n"
HEAD = (
    "import typing\nimport rclpy\nfrom rclpy.node import Node\nfrom std_msgs.msg import String\nfrom std_srvs.srv import Empty\n"
    "from typing import Any, Optional, TypeVar, Union\nfrom robots.core import Robot, make\nfrom client import Session\n"
    "T = TypeVar('T')\n\n\nclass Own:\n    pass\n\n\nclass Derived(Robot):\n    pass\n\n\n"
)
CLASS = "class Arm:\n    def __init__(self, node: {}):\n        self.node = node\n        {}\n\n    def later(self, *args):\n        self.node.create_publisher(String, 'late', 1)\n"
MAIN = "\n\ndef main():\n    rclpy.init()\n    Arm({})\n"
KINDS = "publishers subscribers servers clients parameters".split()


def arm(annotation: str, body: str, given: str = "make()") -> Configuration:
    """A program that makes an object which is given a node of a class from outside."""
    text = HEAD + CLASS.format(annotation, body.replace("\n", "\n        ")) + MAIN.format(given)
    return only(follow({"p/setup.py": SETUP, "p/p/__init__.py": "", "p/p/n.py": text}, 2))


def made(found: Configuration) -> list[str]:
    """The endpoints that the code makes, by their names."""
    return [f"{kind} {end.name}" for node in found.nodes for kind in KINDS for end in explicit(node, kind)]


def reasons(node: Node) -> list[str]:
    return [unknown.reason for unknown in node.unknowns if unknown.field == "endpoints"]


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("node.create_publisher(String, 'a', 1)", ["publishers /?/a"]),
        ("self.node.create_subscription(String, 'a', self.later, 1)", ["publishers /?/late", "subscribers /?/a"]),
        ("node.create_subscription(String, '/a', self.later, 1)", ["publishers /?/late", "subscribers /a"]),
        ("node.create_service(Empty, 'a', print)", ["servers /?/a"]),
        ("node.create_client(Empty, 'a')", ["clients /?/a"]),
        ("node.declare_parameter('a', 1)", ["parameters /?:a"]),
        ("node.core.create_publisher(String, 'a', 1)", ["publishers /?/a"]),
        ("node.get_core().create_publisher(String, 'a', 1)", ["publishers /?/a"]),
        (
            "node.create_publisher(String, 'a', 1)\nnode.create_timer(1.0, self.later)",
            ["publishers /?/a", "publishers /?/late"],
        ),
    ],
)
def test_methods_that_only_a_node_has(body: str, expected: list[str]) -> None:
    assert sorted(made(arm("Robot", body))) == sorted(expected)


@pytest.mark.parametrize(
    "annotation",
    "Robot 'Robot' Derived Any typing.Any object Optional[Robot] Union[Node,Robot] Optional['Node'] T Node|None".split(),
)
def test_annotations_that_do_not_tell_the_class(annotation: str) -> None:
    assert made(arm(annotation, "node.create_publisher(String, 'a', 1)")) == ["publishers /?/a"]


def test_the_class_is_named() -> None:
    (node,) = arm("Robot", "node.create_publisher(String, 'a', 1)").nodes
    assert any(
        reason.startswith("the class robots.core.Robot, which the node is of, is not in") for reason in reasons(node)
    )
    (publisher,) = explicit(node, "publishers")
    assert [why.field for why in publisher.unknowns] == ["name"]


@pytest.mark.parametrize(
    ("annotation", "body", "given"),
    [
        ("Robot", "node.publish(String())", "make()"),
        ("Robot", "node.create(String, 'a', 1)", "make()"),
        ("Robot", "node.publisher.publish(String())", "make()"),
        ("Robot", "node.get_parameter('a')", "make()"),
        ("Robot", "node.destroy_node()", "make()"),
        ("Session", "node.create_client('s3')", "make()"),
        ("Session", "node.create_service('s3', 2)", "make()"),
        ("String", "node.create_publisher(String, 'a', 1)", "make()"),
        ("threading.Thread", "node.create_publisher(String, 'a', 1)", "make()"),
        ("Robot", "node.create_publisher(String, 'a', 1)", "None"),
        ("Robot", "node.create_publisher(String, 'a', 1)", "3"),
    ],
)
def test_what_is_no_method_of_a_node(annotation: str, body: str, given: str) -> None:
    assert not made(arm(annotation, body, given))


def test_a_node_that_is_known_stays_so() -> None:
    found = arm("Robot", "node.create_publisher(String, 'a', 1)", "Node('n', namespace='s')")
    assert made(found) == ["publishers /s/a"]
    assert not [reason for node in found.nodes for reason in reasons(node)]


@pytest.mark.parametrize(
    ("before", "body", "expected"),
    [
        (f'void f(ext::Node::SharedPtr n) {{ auto p = n->{PUB}("a", 1); }}', "f(ext::make());", ["publishers /?/a"]),
        (
            f'void f(std::shared_ptr<ext::Node> n) {{ auto p = n->{PUB}("a", 1); }}',
            "f(ext::make());",
            ["publishers /?/a"],
        ),
        (f'void f(ext::Node & n) {{ auto p = n.{PUB}("/a", 1); }}', "f(ext::make());", ["publishers /a"]),
        (f'template<typename N> void f(N n) {{ auto p = n->{PUB}("a", 1); }}', "f(ext::make());", ["publishers /?/a"]),
        ('void f(aws::Factory & n) { auto p = n.create_client("a"); }', "f(aws::make());", []),
        ('void f(ext::Node & n) { n.publish("a"); }', "f(ext::make());", []),
    ],
)
def test_cpp(before: str, body: str, expected: list[str]) -> None:
    assert made(ros2_main(body, before)) == expected
