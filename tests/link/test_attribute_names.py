# SPDX-License-Identifier: Apache-2.0
"""rclpy: methods that a program finds by their names with ``dir``, ``inspect.getmembers`` and ``getattr`` run."""

from __future__ import annotations

import pytest
from follow_kit import explicit, follow, only

HEAD = (
    "import inspect\nimport rclpy\nfrom rclpy.node import Node\nfrom std_msgs.msg import String\n"
    "class B(Node):\n    def init_b(self):\n        self.create_publisher(String, 'b', 1)\n"
    "class N(B):\n    limit = 1\n    def __init__(self):\n        super().__init__('n')\n        self.named = 'x'\n"
)
MORE = (
    "    def init_c(self):\n        self.create_publisher(String, 'c', 1)\n"
    "    def on_d(self, m=None):\n        self.create_publisher(String, 'd', 1)\n"
)
MAIN = "def main():\n    rclpy.init()\n    rclpy.spin(N())\n"
SETUP = "from setuptools import setup\nsetup(name='p', packages=['p'], entry_points={'console_scripts': ['n = p.n:main']})\n"
WORD = "self.declare_parameter('w', rclpy.Parameter.Type.STRING)\nw = self.get_parameter('w').value\n"


def made(body: str, before: str = "") -> list[str]:
    """The publishers of a node with this in its constructor that are not ruled out."""
    inside = "".join(f"        {line}\n" for line in body.splitlines())
    text = before + HEAD + inside + MORE + MAIN
    found = only(follow({"p/setup.py": SETUP, "p/p/__init__.py": "", "p/p/n.py": text}, 2))
    return sorted(end.name for node in found.nodes for end in explicit(node, "publishers") if not end.is_ruled_out)


FIRES = {
    "a loop over dir": "for x in dir(self):\n    if x.startswith('init_'):\n        getattr(self, x)()\n",
    "dir of the class": "for x in dir(N):\n    if x.startswith('init_'):\n        getattr(self, x)()\n",
    "a list of methods": "for m in [getattr(self, x) for x in dir(self) if x.startswith('init_')]:\n    m()\n",
    "what can be called": "for m in [getattr(self, x) for x in dir(self) if callable(getattr(self, x)) and x[:4] == 'init']:\n    m()\n",
    "a filter": "for x in filter(lambda x: x.startswith('init_'), dir(self)):\n    getattr(self, x)()\n",
    "getmembers": "for x, m in inspect.getmembers(self):\n    if x.startswith('init_'):\n        m()\n",
    "getmembers of methods": "for x, m in inspect.getmembers(self, predicate=inspect.ismethod):\n    if x.startswith('init_'):\n        m()\n",
    "getmembers of the class": "for x, m in inspect.getmembers(N, inspect.isfunction):\n    if x.startswith('init_'):\n        m(self)\n",
    "a beginning that is known": WORD + "getattr(self, 'init_' + w)()\n",
    "a beginning and a default": WORD + "m = getattr(self, f'init_{w}', None)\nif m:\n    m()\n",
}
QUIET = {
    "no loop": "dir(self)\n",
    "no call": "for x in dir(self):\n    getattr(self, x)\n",
    "another beginning": "for x in dir(self):\n    if x.startswith('start_'):\n        getattr(self, x)()\n",
    "attributes that are no methods": "for x in dir(self):\n    if x in ('limit', 'named'):\n        getattr(self, x)\n",
    "private names": "for x in dir(self):\n    if x.startswith('__'):\n        getattr(self, x)()\n",
    "a list that nobody calls": "a = [getattr(self, x) for x in dir(self) if x.startswith('init_')]\n",
    "getmembers of data": "for x, m in inspect.getmembers(self, lambda m: isinstance(m, str)):\n    m()\n",
    "another ending": WORD + "getattr(self, w + '_init')()\n",
    "a beginning that no method has": WORD + "getattr(self, 'stop_' + w)()\n",
    "an attribute that is read": WORD + "m = getattr(self, 'init_' + w)\n",
    "dir of a module": "for x in dir(inspect):\n    getattr(inspect, x)()\n",
    "dir of nothing": "for x in dir():\n    x()\n",
    "a name that is not known": WORD + "getattr(self, w)\n",
    "a text": "for x in dir('init_c'):\n    getattr('init_c', x)\n",
}


@pytest.mark.parametrize("body", FIRES.values(), ids=FIRES)
def test_methods_that_are_found_by_name_run(body: str) -> None:
    assert made(body) == ["/b", "/c"]


@pytest.mark.parametrize("body", QUIET.values(), ids=QUIET)
def test_others_do_not(body: str) -> None:
    assert made(body) == []


def test_a_name_that_is_not_here_may_be_there() -> None:
    body = "if 'create_client' in dir(self):\n    self.init_b()\nif 'x' not in dir(self):\n    self.init_c()\n"
    assert made(body) == ["/b", "/c"]
