# SPDX-License-Identifier: Apache-2.0
"""Notes on nodes that a launch file still names and does not start any more, and on classes that a decorator may replace."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from commandline import commit, haros, write

HEAD = "from launch import LaunchDescription\nfrom launch_ros.actions import Node\n\n\ndef generate_launch_description():\n"
LIST = "    actions = [\n        Node(package='bot', executable='one.py'),\n        Node(package='bot', executable='two.py'),\n    ]\n"
END = "    return LaunchDescription(actions)\n"
CODE = "#!/usr/bin/env python3\nimport rclpy\nfrom rclpy.node import Node\nfrom std_msgs.msg import String\n\n\n"
CLASS = (
    "class {0}(Node):\n    def __init__(self):\n        super().__init__('{1}')\n"
    "        self.out = self.create_publisher(String, '{1}_out', 1)\n\n\nrclpy.init()\nrclpy.spin({0}())\n"
)
FILES = {
    "package.xml": "<package format='3'><name>bot</name><version>1.0.0</version><description>d</description><maintainer email='a@b.cd'>a</maintainer>"
    "<license>x</license><buildtool_depend>ament_cmake</buildtool_depend><exec_depend>rclpy</exec_depend><exec_depend>std_msgs</exec_depend>"
    "<exec_depend>launch</exec_depend><exec_depend>launch_ros</exec_depend><export><build_type>ament_cmake</build_type></export></package>",
    "CMakeLists.txt": "cmake_minimum_required(VERSION 3.8)\nproject(bot)\nfind_package(ament_cmake REQUIRED)\n"
    "install(PROGRAMS one.py two.py DESTINATION lib/${PROJECT_NAME})\ninstall(DIRECTORY launch DESTINATION share/${PROJECT_NAME})\nament_package()\n",
    "one.py": CODE + CLASS.format("One", "one"),
    "two.py": CODE + CLASS.format("Two", "two"),
    "launch/all.launch.py": HEAD + LIST + END,
}


def notes(root: Path, change: dict[str, str]) -> list[tuple[str, int, str]]:
    """Path, line and first words of the notes of graph-change on *change*."""
    write(root, FILES)
    commit(root)
    write(root, change)
    commit(root)
    done = haros("check", ".", "--baseline-rev=HEAD~1", "--profile=architecture", "--output=json=out.json", cwd=root)
    assert done.returncode == 0, done.stdout + done.stderr
    found = json.loads((root / "out.json").read_text())["results"]
    return [(r["path"], r["line"], r["message"].split(" ")[0]) for r in found if r["rule"] == "graph-change"]


@pytest.mark.parametrize(
    ("line", "lost"),
    [
        ("actions = actions[:1]", ["/two"]),
        ("actions.pop()", ["/two"]),
        ("del actions[0]", ["/one"]),
        ("actions.clear()", ["/one", "/two"]),
        ("actions[1:] = []", ["/one", "/two"]),
    ],
)
def test_actions_that_are_left_out_are_named(tmp_path: Path, line: str, lost: list[str]) -> None:
    launch = f"{HEAD}{LIST}    {line}\n{END}"
    expected = [("launch/all.launch.py", 7 if name == "/one" else 8, name) for name in lost]
    assert notes(tmp_path, {"launch/all.launch.py": launch}) == expected


@pytest.mark.parametrize(
    "launch",
    [
        HEAD + LIST.replace("        Node(package='bot', executable='two.py'),\n", "") + END,
        HEAD + LIST.replace("        Node(package='bot', executable='two.py'),", "        # 'two.py'") + END,
        HEAD + LIST.replace("'two.py'", "'two.py', name='another'") + END,
        HEAD + LIST + "    actions.append(LaunchDescription())\n" + END,
        HEAD + LIST.replace("actions", "every") + END.replace("actions", "every[:]"),
        HEAD + LIST + "    actions.reverse()\n" + END,
    ],
)
def test_what_is_taken_away_or_started_is_not(tmp_path: Path, launch: str) -> None:
    assert notes(tmp_path, {"launch/all.launch.py": launch}) == []


def test_a_class_that_a_decorator_may_replace_is_named(tmp_path: Path) -> None:
    swap = "def swap(cls):\n    return type(cls.__name__, (cls,), {})\n\n\n@swap\n"
    assert notes(tmp_path, {"one.py": CODE + swap + CLASS.format("One", "one")}) == [("one.py", 12, "/one")]
    same = "def same(cls):\n    return cls\n\n\n@same\n"
    assert notes(tmp_path / "same", {"one.py": CODE + same + CLASS.format("One", "one")}) == []
