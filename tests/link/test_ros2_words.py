# SPDX-License-Identifier: Apache-2.0
"""ROS 2: a Python program that nobody starts with words has its defaults; launch_ros puts ``--ros-args`` behind the words that it gives."""

from __future__ import annotations

import pytest
from follow_kit import explicit, follow

from haros_ci.model.architecture import Node

HEAD = "import argparse\nimport sys\nimport rclpy\nfrom rclpy.node import Node\nfrom std_msgs.msg import String\n"
MAIN = """
def main():
    rclpy.init()
    node = Node("n")
%s
    rclpy.spin(node)
"""
ARGPARSE = 'p = argparse.ArgumentParser()\np.add_argument("--topic", default="b")\n'
LAUNCH = """
from launch import LaunchDescription
from launch.substitutions import EnvironmentVariable
from launch_ros.actions import Node
def generate_launch_description():
    return LaunchDescription([Node(package="p", executable="n"%s)])
"""


def started(body: str, launch: str = "") -> Node:
    lines = "\n".join(f"    {line}" for line in body.splitlines())
    setup = "from setuptools import setup\nsetup(name='p', packages=['p'], data_files=[('share/p/launch', ['launch/l.launch.py'])],\n"
    files = {
        "p/setup.py": setup + "    entry_points={'console_scripts': ['n = p.n:main']})\n",
        "p/p/__init__.py": "",
        "p/p/n.py": HEAD + MAIN % lines,
    }
    files |= {"p/launch/l.launch.py": LAUNCH % launch} if launch else {}
    return follow(files, 2).configurations[0].nodes[0]


def published(found: Node) -> list[tuple[str, bool]]:
    return [(end.name, end.is_ruled_out) for end in explicit(found)]


CHOSEN = 'topic = sys.argv[1] if len(sys.argv) > 1 else "a"\nnode.create_publisher(String, topic, 1)'
FIRST = 'node.create_publisher(String, sys.argv[1], 1)\nnode.create_publisher(String, "x" + sys.argv[1], 1)'
READ = ARGPARSE + "node.create_publisher(String, p.parse_args(%s).topic, 1)"
KNOWN = ARGPARSE + "node.create_publisher(String, p.parse_known_args(%s)[0].topic, 1)"


@pytest.mark.parametrize(
    ("body", "name"),
    [
        (CHOSEN, "/a"),
        ('node.create_publisher(String, (sys.argv + ["c"])[1], 1)', "/c"),
        ('if len(sys.argv) < 2:\n    node.create_publisher(String, "e", 1)', "/e"),
        (READ % "sys.argv[1:]", "/b"),
    ],
)
def test_without_words(body: str, name: str) -> None:
    assert published(started(body)) == [(name, False)]


def test_a_word_that_is_not_there_is_not_known() -> None:
    assert {name for name, _ in published(started(FIRST))} <= {"/?", "/x?"}
    found = started('if len(sys.argv) < 2:\n    return\nnode.create_publisher(String, "f/" + sys.argv[1], 1)')
    assert [name for name, _ in published(found)] == ["/f/?"]


@pytest.mark.parametrize("more", [", name='m'", ", name='n', namespace='s'", ", output='screen'"])
@pytest.mark.parametrize("body", [CHOSEN, FIRST])
def test_words_that_launch_adds_are_no_defaults(body: str, more: str) -> None:
    found = started(body, more)
    assert all("?" in end.name for end in explicit(found))
    assert {unknown.reason for end in explicit(found) for unknown in end.unknowns} == {
        "it is --ros-args, which launch gives"
    }


@pytest.mark.parametrize("body", [CHOSEN, "node.create_publisher(String, sys.argv[1], 1)"])
def test_words_of_a_launch_file(body: str) -> None:
    assert published(started(body, ", arguments=['w']")) == [("/w", False)]


@pytest.mark.parametrize(
    ("more", "expected"),
    [
        (", name='m'", "/b"),
        (", arguments=['--topic', 'w']", "/w"),
        (", arguments=['--topic=w', 'left', '-x'], name='m'", "/w"),
    ],
)
def test_options_that_launch_adds_are_left_over(more: str, expected: str) -> None:
    assert published(started(KNOWN % "", more)) == [(expected, False)]


@pytest.mark.parametrize(
    ("option", "more"),
    [
        ('p.add_argument("file")\n', ", name='m'"),
        ('p.add_argument("--needed", required=True)\n', ", name='m'"),
        ("p.add_subparsers(dest='x', required=True).add_parser('a')\n", ", name='m'"),
        ("", ", arguments=[EnvironmentVariable('X')]"),
    ],
)
def test_options_that_they_may_be(option: str, more: str) -> None:
    body = KNOWN % ""
    assert published(started(body.replace("node.create", option + "node.create"), more)) == [("/?", False)]


@pytest.mark.parametrize(
    ("option", "more"),
    [
        ('p.add_argument("-r", "--rate")\n', ", name='m'"),
        ('p.add_argument("-rate")\n', ", name='m'"),
        ('p.add_argument("where", nargs="?", default="c")\n', ", name='m'"),
        ('p.add_argument("--params-file")\n', ", parameters=['x.yaml']"),
    ],
)
def test_an_option_beside_one_that_they_may_be(option: str, more: str) -> None:
    """Whatever the other one takes of what launch adds, this one has its default."""
    body = KNOWN % ""
    assert published(started(body.replace("node.create", option + "node.create"), more)) == [("/b", False)]
    taken = body.replace("node.create", option + "node.create").replace("topic, 1", f"{NAMED[option]}, 1")
    assert "/?" in {name for name, _ in published(started(taken, more))} or not explicit(started(taken, more))


#: What the options above are called.
NAMED = {
    'p.add_argument("-r", "--rate")\n': "rate",
    'p.add_argument("-rate")\n': "rate",
    'p.add_argument("where", nargs="?", default="c")\n': "where",
    'p.add_argument("--params-file")\n': "params_file",
}


def test_options_of_all_words() -> None:
    """argparse refuses what launch adds; a program that nothing starts has no words."""
    assert published(started(READ % "", ", name='m'")) == [("/?", False)]
    assert published(started(READ % "")) == [("/b", False)]
    assert published(started(KNOWN % "")) == [("/b", False)]
