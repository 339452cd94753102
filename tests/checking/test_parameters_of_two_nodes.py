# SPDX-License-Identifier: Apache-2.0
"""Nodes of one program that a launch file gives one name have parameters of their own; a class and its base are one node."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.api.testing import said
from haros_ci.checking.page import Example
from haros_ci.registry import checks

FILES = {
    "package.xml": (
        '<package format="3"><name>demo</name><version>1.0.0</version><description>d</description><maintainer email="a@b.cd">m</maintainer>'
        "<license>Apache-2.0</license><exec_depend>rclpy</exec_depend><export><build_type>ament_python</build_type></export></package>\n"
    ),
    "setup.py": "from setuptools import setup\nsetup(name='demo', packages=['demo'], entry_points={'console_scripts': ['run = demo.run:main']})\n",
    "demo/__init__.py": "",
    "launch/a.launch.xml": '<launch><node pkg="demo" exec="run" name="robot"/></launch>\n',
}
RUN = """import rclpy
from rclpy.node import Node

class Driver(Node):
    def __init__(self):
        super().__init__("driver")
        self.declare_parameter("speed", 1.0)

class Planner({}):
    def __init__(self):
        super().__init__({})
        {}.declare_parameter("speed", 2.0)

def main():
    rclpy.init()
    driver = Driver()
    planner = Planner()
    rclpy.spin(driver)
    rclpy.spin(planner)
"""


@pytest.mark.parametrize(
    ("program", "count"),
    [
        (RUN.format("Node", "'planner'", "self"), 0),
        (RUN.format("Node", "'planner', use_global_arguments=True", "self"), 0),
        (RUN.format("Driver", "", "self").replace("driver = Driver()", "driver = Planner()"), 1),
        (RUN.replace("super().__init__({})", "self.node = driver").format("", "self.node").replace("__init__(self):\n        self.node", "__init__(self, driver):\n        self.node").replace("Planner()\n    rclpy.spin(driver)", "Planner(driver)\n    rclpy.spin(driver)"), 1),
        (RUN.format("Node", "'planner'", "self").replace('"speed", 1.0)', '"speed", 1.0)\n        self.declare_parameter("speed", 3.0)'), 1),
    ],
)  # fmt: skip
def test_two_nodes_and_one(program: str, count: int, tmp_path: Path) -> None:
    check = next(check for check in checks() if check.id == "parameter-declared-twice")
    assert (
        len({r.location for r in said(check, Example("", True, {**FILES, "demo/run.py": program}), tmp_path)}) == count
    )


MOVEIT = """import rclpy
from {module} import {name}
from rclpy.node import Node

class Server(Node):
    def __init__(self):
        super().__init__("server")
        self.declare_parameter("speed", 1.0)
        self.moveit = {name}(node_name="motion")

def main():
    rclpy.init()
    rclpy.spin(Server())
"""


@pytest.mark.parametrize(
    ("module", "name", "count"),
    [("moveit.planning", "MoveItPy", 0), ("demo.planning", "MoveItPy", 1), ("moveit.planning", "PlanRequest", 1)],
)
def test_a_node_of_moveit_py_takes_what_the_program_is_given(
    module: str, name: str, count: int, tmp_path: Path
) -> None:
    files = {
        **FILES,
        "demo/run.py": MOVEIT.format(module=module, name=name),
        "demo/planning.py": "class MoveItPy:\n    def __init__(self, node_name):\n        self.name = node_name\n",
        "launch/a.launch.xml": '<launch><node pkg="demo" exec="run"><param name="planning_plugin" value="ompl"/></node></launch>\n',
    }
    check = next(check for check in checks() if check.id == "parameter-not-declared")
    assert len(said(check, Example("", True, files), tmp_path)) == count
