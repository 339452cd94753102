# SPDX-License-Identifier: Apache-2.0
"""Python: members of enumerations by their names, ``E["A"]``, of the workspace and of rclpy's policies."""

from __future__ import annotations

import pytest
from follow_kit import explicit, follow, names, python

ENUM = "from enum import Enum\nclass T(Enum):\n    A = 'first'\n    B = 'second'\n    @property\n    def p(self):\n        return 'p'\n"


@pytest.mark.parametrize(
    ("code", "expected"),
    [
        ("PUB(T['A'].value)", "/first"),
        ("key = 'b'\nPUB(T[key.upper()].value + '/x')", "/second/x"),
        ("PUB(T['A'].name.lower())", "/a"),
        ("t = T['B']\nPUB(t.value)", "/second"),
        ("PUB(T[rospy.get_param('~kind', 'A')].value)", "/first"),
        # no member, no name that is known, no enumeration
        ("PUB(T['C'].value)", "/?"),
        ("PUB(T[other()].value)", "/?"),
        ("PUB(T[0].value)", "/?"),
        ("PUB(T['p'].value)", "/?"),
        ("class K:\n    A = 'k'\nPUB(K['A'].value)", "/?"),
        ("class K:\n    def __class_getitem__(cls, key):\n        return other()\nPUB(K['A'].value)", "/?"),
    ],
)
def test_members(code: str, expected: str) -> None:
    assert names(python(ENUM + code)) == [expected]


HEAD = "import rclpy\nfrom rclpy.node import Node\nfrom std_msgs.msg import String\n"
IMPORTS = ("from rclpy.qos import *\nfrom rclpy.qos import QoSProfile\n", "from rclpy.qos import %s, QoSProfile\n")


@pytest.mark.parametrize("head", IMPORTS)
@pytest.mark.parametrize(
    ("kind", "key", "expected"),
    [
        ("ReliabilityPolicy", "'BEST_EFFORT'", "best_effort"),
        ("QoSReliabilityPolicy", "'best_effort'.upper()", "best_effort"),
        ("ReliabilityPolicy", "'RELIABLE'", "reliable"),
        ("ReliabilityPolicy", "other()", "?"),
        ("Others", "'BEST_EFFORT'", "?"),
    ],
)
def test_policies(head: str, kind: str, key: str, expected: str) -> None:
    setup = "from setuptools import setup\nsetup(name='p', packages=['p'],\n"
    profile = f"QoSProfile(depth=1, reliability={kind}[{key}])"
    main = f"def main():\n    rclpy.init()\n    n = Node('n')\n    n.create_publisher(String, 'a', {profile})\n    rclpy.spin(n)\n"
    files = {
        "p/setup.py": setup + "    entry_points={'console_scripts': ['n = p.n:main']})\n",
        "p/p/__init__.py": "",
        "p/p/n.py": HEAD + head.replace("%s", kind) + main,
    }
    (end,) = explicit(follow(files, 2).configurations[0].nodes[0])
    assert (end.qos.reliability if end.qos is not None else "?") == expected
