# SPDX-License-Identifier: Apache-2.0
"""Findings that a workspace evidently does not mind: scripts that builds copy, headers that no reader of the workspace needs."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.api.testing import said
from haros_ci.checking.page import Example
from haros_ci.registry import checks
from haros_ci.results.rule import Level

PACKAGE = (
    '<package format="3"><name>demo</name><version>1.0.0</version><description>d</description>'
    '<maintainer email="a@b.cd">m</maintainer><license>Apache-2.0</license><buildtool_depend>ament_cmake</buildtool_depend>'
    "<depend>rclpy</depend><depend>nav_msgs</depend><export><build_type>ament_cmake</build_type></export></package>\n"
)
CMAKE = (
    "cmake_minimum_required(VERSION 3.8)\nproject(demo)\nfind_package(ament_cmake REQUIRED)\n"
    "install(PROGRAMS {} DESTINATION lib/demo)\nament_package()\n"
)
NODE = "#!/usr/bin/env python3\nimport rclpy\n\nrclpy.init()\nrclpy.spin(rclpy.create_node('n'))\n"
READER = (
    "#!/usr/bin/env python3\nimport rclpy\nfrom nav_msgs.msg import Path\n\nrclpy.init()\nnode = rclpy.create_node('reader')\n"
    "sub = node.create_subscription(Path, 'path', lambda path: print(len(path.poses)), 1)\nrclpy.spin(node)\n"
)
WRITER = (
    "#!/usr/bin/env python3\nimport rclpy\nfrom nav_msgs.msg import Path\n\nrclpy.init()\nnode = rclpy.create_node('writer')\n"
    "pub = node.create_publisher(Path, 'path', 1)\n\n\ndef tick():\n    path = Path()\n    path.poses = []\n    pub.publish(path)\n\n\n"
    "timer = node.create_timer(1.0, tick)\nrclpy.spin(node)\n"
)


def levels(name: str, files: dict[str, str], tmp_path: Path, executables: frozenset[str] = frozenset()) -> list[Level]:
    check = next(check for check in checks() if check.id == name)
    programs = " ".join(path for path in files if path.endswith(".py"))
    every = {"package.xml": PACKAGE, "CMakeLists.txt": CMAKE.format(programs), **files}
    return [result.level for result in said(check, Example("", True, every, executables=executables), tmp_path)]


@pytest.mark.parametrize(
    ("more", "executables", "expected"),
    [
        ({}, {"tools/run.sh"}, [Level.NOTE]),
        ({"README.md": "colcon build\n"}, {"tools/run.sh"}, [Level.NOTE]),
        ({"README.md": "colcon build --symlink-install\n"}, {"tools/run.sh"}, [Level.WARNING]),
        ({"Dockerfile": "RUN colcon build --symlink-install\n"}, {"tools/run.sh"}, [Level.WARNING]),
        ({"colcon/defaults.yaml": "build:\n  symlink-install: true\n"}, {"tools/run.sh"}, [Level.WARNING]),
        ({"c.py": NODE}, {"tools/run.sh", "c.py"}, [Level.WARNING]),
    ],
)
def test_scripts_without_the_execute_bit(
    more: dict[str, str], executables: set[str], expected: list[Level], tmp_path: Path
) -> None:
    files = {"a.py": NODE, "b.py": NODE, "tools/run.sh": "#!/bin/sh\ndate\n", **more}
    assert levels("script-not-runnable", files, tmp_path, frozenset(executables)) == expected


def test_a_single_script_shows_nothing(tmp_path: Path) -> None:
    files = {"a.py": NODE, "tools/run.sh": "#!/bin/sh\ndate\n"}
    assert levels("script-not-runnable", files, tmp_path, frozenset({"tools/run.sh"})) == [Level.WARNING]


@pytest.mark.parametrize(
    ("more", "expected"),
    [
        ({"reader.py": READER}, Level.NOTE),
        ({}, Level.WARNING),
        ({"reader.py": READER, "view.rviz": "Panels: []\n"}, Level.WARNING),
        ({"reader.py": READER.replace("import rclpy\n", "import rclpy\nimport tf2_ros\n")}, Level.WARNING),
    ],
)
def test_a_header_that_no_reader_needs(more: dict[str, str], expected: Level, tmp_path: Path) -> None:
    assert levels("header-not-set", {"writer.py": WRITER, **more}, tmp_path) == [expected]


def test_a_hint_names_what_a_base_has(tmp_path: Path) -> None:
    node = (
        "import rclpy\nfrom rclpy.node import Node\n\n\nclass Talker(Node):\n    def __init__(self):\n"
        "        super().__init__('talker')\n        self.{}()\n\n\nrclpy.init()\nTalker()\n"
    )
    check = next(check for check in checks() if check.id == "undefined-attribute")
    for name, hint in (
        ("shutdown", "define the method, or remove the call"),
        ("get_loger", "did you mean self.get_logger?"),
    ):
        files = {"package.xml": PACKAGE, "CMakeLists.txt": CMAKE.format("talker.py"), "talker.py": node.format(name)}
        (tmp_path / name).mkdir()
        assert [hint in each.message for each in said(check, Example("", True, files), tmp_path / name)] == [True]


def test_an_attribute_in_a_method_that_nothing_calls(tmp_path: Path) -> None:
    node = (
        "import rclpy\nfrom rclpy.node import Node\n\n\nclass Filter(Node):\n    def __init__(self):\n"
        "        super().__init__('filter')\n        {}\n\n    def on_image(self, message):\n        self.process(message)\n\n\n"
        "rclpy.init()\nrclpy.spin(Filter())\n"
    )
    subscription = "self.create_subscription(Image, 'image', self.on_image, 10)"
    for number, (line, expected) in enumerate(((subscription, Level.ERROR), (f"# {subscription}", Level.NOTE))):
        files = {"package.xml": PACKAGE, "CMakeLists.txt": CMAKE.format("filter.py"), "filter.py": node.format(line)}
        (tmp_path / str(number)).mkdir()
        assert levels("undefined-attribute", files, tmp_path / str(number)) == [expected]


@pytest.mark.parametrize(
    ("other", "expected"),
    [
        (
            "class Other:\n    def __init__(self):\n        self.process(1)\n\n    def process(self, x):\n        pass\n",
            Level.NOTE,
        ),
        ("def work(filter):\n    filter.process(1)\n", Level.ERROR),
        ("class Other:\n    def process(self, x):\n        self.inner.process(x)\n", Level.ERROR),
    ],
)
def test_a_method_of_this_name_of_another_class_is_another_one(other: str, expected: Level, tmp_path: Path) -> None:
    node = (
        "import rclpy\nfrom rclpy.node import Node\n\n\nclass Filter(Node):\n    def __init__(self):\n"
        "        super().__init__('filter')\n\n    def process(self, message):\n        self.sent.publish(message)\n\n\n"
        "rclpy.init()\nrclpy.spin(Filter())\n"
    )
    files = {
        "package.xml": PACKAGE,
        "CMakeLists.txt": CMAKE.format("filter.py other.py"),
        "filter.py": node,
        "other.py": other,
    }
    assert levels("undefined-attribute", files, tmp_path) == [expected]


SETUP = "from setuptools import setup\nsetup(name='demo', packages=['demo'], package_dir={'': 'src'})\n"


def test_a_base_calls_what_its_class_defines(tmp_path: Path) -> None:
    base = "class Base:\n    def __init__(self):\n        self.process(1)\n\n    def process(self, x):\n        raise NotImplementedError\n"
    node = "from demo.base import Base\n\n\nclass Filter(Base):\n    def process(self, x):\n        self.sent.publish(x)\n\n\nFilter()\n"
    files = {
        "package.xml": PACKAGE,
        "CMakeLists.txt": CMAKE.format("filter.py"),
        "filter.py": node,
        "src/demo/__init__.py": "",
        "src/demo/base.py": base,
        "setup.py": SETUP,
    }
    assert levels("undefined-attribute", files, tmp_path) == [Level.ERROR]
