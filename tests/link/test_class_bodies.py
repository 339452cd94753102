# SPDX-License-Identifier: Apache-2.0
"""Python: calls in the body of a class run where it is defined; names that a module has from a library are there by its star."""

from __future__ import annotations

import pytest

from tests.link.follow_kit import follow, names, node, python_files, types

HEAD = "import rospy\nfrom std_msgs.msg import String\n"
RAN = [
    'class A:\n    rospy.init_node("n")\n    def __init__(self):\n        self.p = rospy.Publisher("~t", String, queue_size=1)\nA()\n',
    'class A:\n    rospy.init_node("n")\n    p = rospy.Publisher("~t", String, queue_size=1)\na = A()\na.p\n',
    'rospy.init_node("n")\nclass A:\n    rospy.Publisher("~t", String, queue_size=1)\n',
    'rospy.init_node("n")\ndef make():\n    class A:\n        rospy.Publisher("~t", String, queue_size=1)\nmake()\n',
]
NOT_RAN = [
    'rospy.init_node("n")\nclass A:\n    def go(self):\n        rospy.Publisher("~t", String, queue_size=1)\n',
    'rospy.init_node("n")\nclass A:\n    go = lambda self: rospy.Publisher("~t", String, queue_size=1)\n',
    'rospy.init_node("n")\ndef make():\n    class A:\n        rospy.Publisher("~t", String, queue_size=1)\n',
]


@pytest.mark.parametrize("text", RAN)
def test_calls_in_a_body_run(text: str) -> None:
    assert names(node(follow(python_files(HEAD + text)))) == ["/n/t"]


@pytest.mark.parametrize("text", NOT_RAN)
def test_what_is_only_defined_does_not(text: str) -> None:
    assert names(node(follow(python_files(HEAD + text)))) == []


USED = 'import rospy\nfrom lib.a import *\nrospy.init_node("n")\np = rospy.Publisher("/t", Odometry, queue_size=1)\n'


@pytest.mark.parametrize(
    ("module", "expected"),
    [
        ("from nav_msgs.msg import Odometry\n", "nav_msgs/Odometry"),
        ("from nav_msgs.msg import *\n", "nav_msgs/Odometry"),
        ("from my_msgs.msg import Travelled as Odometry\n", "my_msgs/Travelled"),
        ("import nav_msgs.msg\nOdometry = nav_msgs.msg.Odometry\n", "nav_msgs/Odometry"),
        ("import math\n", None),
        ("from nav_msgs.msg import Path\n", None),
    ],
)
def test_names_of_a_library_by_a_star(module: str, expected: str | None) -> None:
    assert types(node(follow(python_files(USED, a=module)))) == [("/t", expected)]
