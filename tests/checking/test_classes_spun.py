# SPDX-License-Identifier: Apache-2.0
"""rclpy.spin() of a class in the place of a node."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.api.testing import said
from haros_ci.checking.page import Example
from haros_ci.registry import checks

MANIFEST = (
    '<package format="3"><name>demo</name><version>1.0.0</version><description>d</description><maintainer email="a@b.cd">m</maintainer>'
    "<license>Apache-2.0</license><exec_depend>rclpy</exec_depend><export><build_type>ament_python</build_type></export></package>\n"
)
SETUP = "from setuptools import setup\nsetup(name='demo', version='1.0.0', packages=['demo'], entry_points={'console_scripts': ['run = demo.run:main']})\n"
CLASS = "class Talker(Node):\n    def __init__(self):\n        super().__init__('talker')\n        self.create_timer(1.0, self.tick)\n\n    def tick(self):\n        pass\n\n\n"
HEAD = "import rclpy\nfrom rclpy.node import Node\n\n\n"


def messages(text: str, folder: Path) -> list[str]:
    check = next(check for check in checks() if check.id == "node-never-spun")
    files = {
        "package.xml": MANIFEST,
        "setup.py": SETUP,
        "demo/__init__.py": "",
        "demo/talker.py": HEAD + CLASS,
        "demo/run.py": text,
    }
    return [result.message for result in said(check, Example("", True, files), folder)]


MAIN = "def main():\n    rclpy.init()\n    {}\n    rclpy.shutdown()\n"


@pytest.mark.parametrize(
    "text",
    [
        HEAD + CLASS + MAIN.format("rclpy.spin(Talker)"),
        HEAD + CLASS + MAIN.format("node = Talker()\n    rclpy.spin(Talker)"),
        HEAD + CLASS + MAIN.format("rclpy.spin_once(Talker, timeout_sec=1.0)"),
        HEAD + "from demo.talker import Talker\n\n\n" + MAIN.format("rclpy.spin(Talker)"),
        HEAD + "from .talker import Talker\n\n\n" + MAIN.format("rclpy.spin(Talker)"),
    ],
)
def test_a_class_is_spun(text: str, tmp_path: Path) -> None:
    (message,) = messages(text, tmp_path)
    assert "is given the class Talker, not a node that is made of it" in message and message.endswith(
        "give it the object (Talker())"
    )


@pytest.mark.parametrize(
    "text",
    [
        HEAD + CLASS + MAIN.format("rclpy.spin(Talker())"),
        HEAD + CLASS + MAIN.format("node = Talker()\n    rclpy.spin(node)"),
        HEAD + CLASS + MAIN.format("Talker = make()\n    rclpy.spin(Talker)"),
        HEAD + CLASS + "Talker = Talker()\n\n\n" + MAIN.format("rclpy.spin(Talker)"),
        HEAD + CLASS + MAIN.format("for Talker in nodes():\n        rclpy.spin(Talker)"),
        HEAD + CLASS + "def main(Talker=None):\n    rclpy.spin(Talker)\n",
        HEAD + CLASS + MAIN.format("other.spin(Talker)"),
        HEAD + CLASS + MAIN.format("spin(Talker)"),
        HEAD + "from elsewhere import Talker\n\n\n" + MAIN.format("rclpy.spin(Talker)"),
        HEAD + "def talker():\n    pass\n\n\n" + MAIN.format("rclpy.spin(talker)"),
    ],
)
def test_a_node_is_spun(text: str, tmp_path: Path) -> None:
    assert not any("is given the class" in message for message in messages(text, tmp_path))
