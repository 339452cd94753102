# SPDX-License-Identifier: Apache-2.0
"""ROS 2, Python: what the methods of a library's class make that nothing in the workspace calls."""

from __future__ import annotations

import pytest
from follow_kit import explicit, follow

from haros_ci.systems.ros2_library import CALLED

SETUP = "from setuptools import setup\nsetup(name='p', packages=['p'], entry_points={'console_scripts': ['n = p.n:main']})\n"
BASE = (
    "import rclpy.node\nclass BaseNode(rclpy.node.Node):\n    def __init__(self, name, ns='m'):\n        super().__init__(name)\n"
    "        self._ns = ns\n    def topic(self, *args):\n        return '/'.join((self._ns,) + args)\n"
    "class Module:\n    def __init__(self, parent: BaseNode):\n        self._node = parent\n"
    "    def create(self, kind, name):\n        return self._node.create_publisher(kind, self._node.topic(*name), 1)\n"
)
PLUG = (
    "from functools import cached_property\nfrom std_msgs.msg import String\nfrom .base import Module\nclass Plug(Module):\n"
    "    @cached_property\n    def pub(self):\n        return self.create(String, ('a', 'b'))\n"
    "    def sub(self, callback, qos=1):\n        return self._node.create_subscription(String, '/s', callback, qos)\n"
    "    def _own(self):\n        self._node.create_client(String, '/own')\n"
    "    def size(self):\n        return 3\n"
)
USER = "import rclpy\nfrom .base import BaseNode\nfrom .mod import Plug\ndef main():\n    rclpy.init()\n    n = BaseNode('n')\n    p = Plug(n)\n    %s\n    rclpy.spin(n)\n"


def told(mod: str, user: str = "", base: str = BASE) -> dict[str, list[str]]:
    """What each configuration of a library has."""
    files = {"p/setup.py": SETUP, "p/p/__init__.py": "", "p/p/base.py": base, "p/p/mod.py": mod}
    found = follow(files | ({"p/p/n.py": USER % user} if user else {}), 2)
    libraries = [one for one in found.configurations if one.name.endswith(" (library)")]
    for one in libraries:
        ends = [end for end in explicit(one.nodes[0], "publishers") if end.name != "/first"]
        assert all(CALLED in [u.reason for u in end.unknowns if u.field == "conditions"] for end in ends)
    kinds = ("publishers", "subscribers", "clients")
    return {one.name: [e.name for kind in kinds for e in explicit(one.nodes[0], kind)] for one in libraries}


def test_methods_and_properties_that_nothing_calls() -> None:
    assert told(PLUG) == {"p/p.mod.Plug (library)": ["/?/a/b", "/s"]}


def test_beside_what_the_constructor_makes() -> None:
    own = "    def __init__(self, node: BaseNode):\n        self._node = node\n        node.create_publisher(String, '/first', 1)\n"
    found = told(
        PLUG.replace("(Module):\n", ":\n" + own)
        .replace("import Module", "import BaseNode")
        .replace("self.create(String, ('a', 'b'))", "1")
    )
    assert found == {"p/p.mod.Plug (library)": ["/first", "/s"]}


def test_of_methods_that_are_called_those_that_are_not() -> None:
    assert told(PLUG, "p.sub(print)") == {"p/p.mod.Plug (library)": ["/?/a/b"]}


@pytest.mark.parametrize(
    ("mod", "user"),
    [
        (PLUG.replace("def pub", "def _pub"), "p.sub(print)"),
        (PLUG.replace("def pub", "def _pub").replace("def sub", "def _sub"), ""),
        (PLUG.replace("self._node.create_subscription(String, '/s', callback, qos)", "0").replace("self.create(String, ('a', 'b'))", "0"), ""),
        (PLUG.replace("(Module)", ""), ""),
        (PLUG + "class Below(Plug):\n    pass\n", ""),
        ("", ""),
    ],
)  # fmt: skip
def test_classes_of_which_nothing_is_told(mod: str, user: str) -> None:
    found = told(mod, user)
    assert found.get("p/p.mod.Plug (library)") is None
