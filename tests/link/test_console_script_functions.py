# SPDX-License-Identifier: Apache-2.0
"""Console scripts begin with what their name means in the module: a function, what it imports or computes, a method."""

from __future__ import annotations

import pytest
from follow_kit import explicit, follow

from haros_ci.model.architecture import Architecture

HEAD = "import functools\nimport rclpy\nfrom rclpy.node import Node\nfrom std_msgs.msg import String\n"
NODE = "class N(Node):\n    def __init__(self, name='n'):\n        super().__init__(name)\n        self.create_publisher(String, 'a', 1)\n"
RUN = "def run(made=N):\n    rclpy.init()\n    rclpy.spin(made())\n"
METHOD = "    {}\n    def run({}):\n        rclpy.init()\n        rclpy.spin({}())\n"


def scripts(line: str, text: str, **modules: str) -> Architecture:
    """The architecture of the package ``p`` with this console script and module ``p.n``; *modules* are others, with ``__init__``."""
    setup = f"from setuptools import setup\nsetup(name='p', packages=['p'], entry_points={{'console_scripts': ['{line}']}})\n"
    files = {"p/setup.py": setup, "p/p/__init__.py": "", "p/p/n.py": text}
    return follow(files | {f"p/p/{name}.py": code for name, code in modules.items()}, 2)


def made(found: Architecture, name: str = "p/n") -> list[str]:
    """The publishers of the configuration of that *name*, each with its node."""
    (started,) = [each for each in found.configurations if each.name == name]
    return [f"{node.name} {end.name}" for node in started.nodes for end in explicit(node)]


BEGINS = {
    "a function": ("n = p.n:run", NODE + RUN, {}),
    "another name for it": ("n = p.n:main", NODE + RUN + "main = run\n", {}),
    "one that is imported": ("n = p.n:run", "from p.base import run\n", {"base": HEAD + NODE + RUN}),
    "one that is imported under another name": (
        "n = p.n:go",
        "from .base import run as go\n",
        {"base": HEAD + NODE + RUN},
    ),
    "one that the package passes on": ("n = p:run", NODE + RUN, {"__init__": "from .n import run\n"}),
    "a method of the class": ("n = p.n:N.run", NODE + METHOD.format("@classmethod", "cls", "cls"), {}),
    "a static method": ("n = p.n:N.run", NODE + METHOD.format("@staticmethod", "", "N"), {}),
    "a method beside a function": (
        "n = p.n:N.run",
        NODE + METHOD.format("@classmethod", "cls", "cls") + "def run():\n    pass\n",
        {},
    ),
    "what a function gives": (
        "n = p.n:main",
        NODE + "def of(k):\n    def f():\n        rclpy.init()\n        rclpy.spin(k())\n    return f\nmain = of(N)\n",
        {},
    ),
    "a partial function": ("n = p.n:main", NODE + RUN + "main = functools.partial(run, N)\n", {}),
    "a lambda": ("n = p.n:main", NODE + RUN + "main = lambda: run()\n", {}),
    "a bound method": (
        "n = p.n:main",
        NODE + "class A:\n    def go(self):\n        rclpy.init()\n        rclpy.spin(N())\nmain = A().go\n",
        {},
    ),
    "a method of a module": ("n = p.n:base.run", "from . import base\n", {"base": HEAD + NODE + RUN}),
}
QUIET = {
    "a function of the module that is not named": ("n = p.n:main", NODE + RUN + "def main():\n    rclpy.init()\n", {}),
    "a name that the module has not": ("n = p.n:main", NODE + RUN, {}),
    "a variable that is no function": ("n = p.n:main", NODE + RUN + "main = 3\n", {}),
    "a function of a library": ("n = p.n:main", NODE + RUN + "from other import main\n", {}),
    "a function of the standard library": ("n = p.n:main", NODE + RUN + "from sys import exit as main\n", {}),
    "a method that the class has not": ("n = p.n:N.main", NODE + RUN, {}),
    "a method of a class that is not here": ("n = p.n:M.run", NODE + RUN, {}),
    "a function of a method's name": (
        "n = p.n:M.run",
        NODE + RUN + "class M:\n    @staticmethod\n    def run():\n        pass\n",
        {},
    ),
    "a method of a function's name": (
        "n = p.n:run",
        NODE + METHOD.format("@staticmethod", "", "N") + "def run():\n    pass\n",
        {},
    ),
    "a module that is not here": ("n = p.other:main", NODE + RUN, {}),
    "a module of another package": ("n = q.n:run", NODE + RUN, {}),
    "a module under the guard": (
        "n = p.n:main",
        NODE + RUN + "main = None\nif __name__ == '__main__':\n    run()\n",
        {},
    ),
    "a function that is not called": (
        "n = p.n:main",
        NODE + RUN + "def of(f):\n    return lambda: None\nmain = of(run)\n",
        {},
    ),
}


@pytest.mark.parametrize(("line", "text", "modules"), BEGINS.values(), ids=BEGINS)
def test_a_console_script_begins_with_what_its_name_means(line: str, text: str, modules: dict[str, str]) -> None:
    assert made(scripts(line, HEAD + text, **modules)) == ["/n /a"]


@pytest.mark.parametrize(("line", "text", "modules"), QUIET.values(), ids=QUIET)
def test_nothing_else_of_the_module_runs(line: str, text: str, modules: dict[str, str]) -> None:
    found = scripts(line, HEAD + text, **modules)
    assert not any(
        end for each in found.configurations if each.name == "p/n" for node in each.nodes for end in explicit(node)
    )
