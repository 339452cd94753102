# SPDX-License-Identifier: Apache-2.0
"""Python programs that no build installs: in the model by themselves, and not in what checks see."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.analysis.architecture import varied
from haros_ci.checking.system import systems
from haros_ci.config.settings import Settings
from haros_ci.workspace.cache import MemoryCache
from haros_ci.workspace.discover import discover

MANIFEST = (
    "<package format='3'><name>demo</name><version>1.0.0</version><description>d</description>"
    "<maintainer email='a@example.com'>a</maintainer><license>MIT</license>{}</package>"
)
AMENT = MANIFEST.format("<export><build_type>ament_cmake</build_type></export>")
CATKIN = MANIFEST.format("<buildtool_depend>catkin</buildtool_depend>")
TWO = """import rclpy
from std_msgs.msg import String
def main():
    rclpy.init()
    node = rclpy.create_node('talker')
    node.create_publisher(String, 'chatter', 1)
"""
ONE = """import rospy
from std_msgs.msg import String
def main():
    rospy.init_node('talker')
    rospy.Publisher('chatter', String)
"""
START = "if __name__ == '__main__':\n    main()\n"
INSTALL = "find_package(ament_cmake REQUIRED)\ninstall(PROGRAMS scripts/talk.py DESTINATION lib/demo)\n"


def names(root: Path, manifest: str, files: dict[str, str]) -> tuple[list[str], int]:
    """The configurations of the model, and how many of them checks see."""
    for path, text in {"package.xml": manifest, "CMakeLists.txt": "project(demo)\n", **files}.items():
        (root / path).parent.mkdir(parents=True, exist_ok=True)
        (root / path).write_text(text)
    workspace = discover(root, (".",))
    made = varied(workspace, Settings(root=root), MemoryCache(), alternatives=False)
    found = [
        one.name
        for one in made.architecture.configurations
        if [end for node in one.nodes for end in node.endpoints if end.name == "/chatter"]
    ]
    return found, len(list(systems(made.architecture, workspace)))


@pytest.mark.parametrize(("manifest", "text"), [(AMENT, TWO + START), (CATKIN, ONE + START)])
def test_a_program_that_is_started_by_its_path(tmp_path: Path, manifest: str, text: str) -> None:
    assert names(tmp_path, manifest, {"scripts/talk.py": text}) == (["demo/talk.py (script)"], 0)


def test_two_of_one_name_are_told_apart(tmp_path: Path) -> None:
    files = {"a/talk.py": TWO + START, "b/talk.py": TWO + START}
    assert names(tmp_path, AMENT, files)[0] == ["demo/talk.py (script)", "demo/b/talk.py (script)"]


@pytest.mark.parametrize(
    ("manifest", "files", "expected"),
    [
        (AMENT, {"scripts/talk.py": TWO}, ([], 0)),
        (AMENT, {"test/talk.py": TWO + START}, ([], 0)),
        (AMENT, {"scripts/test_talk.py": TWO + START}, ([], 0)),
        (AMENT, {"setup.py": TWO + START}, ([], 0)),
        (AMENT, {"launch/talk.launch.py": TWO + START}, ([], 1)),
        (AMENT, {"scripts/talk.py": ONE + START}, ([], 0)),
        (CATKIN, {"scripts/talk.py": TWO + START}, ([], 0)),
        (AMENT, {"scripts/talk.py": "import os\ndef main(): pass\n" + START}, ([], 0)),
        (AMENT, {"scripts/talk.py": "#!/usr/bin/env python3\n" + TWO + START}, (["demo/talk.py"], 1)),
        (AMENT, {"scripts/talk.py": TWO + START, "CMakeLists.txt": "project(demo)\n" + INSTALL}, (["demo/talk.py"], 1)),
    ],
)
def test_what_is_none_or_started_otherwise(
    tmp_path: Path, manifest: str, files: dict[str, str], expected: tuple[list[str], int]
) -> None:
    assert names(tmp_path, manifest, files) == expected
