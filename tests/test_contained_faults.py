# SPDX-License-Identifier: Apache-2.0
"""A fault of haros-ci in one file, package or node is named there; the rest of the workspace is analysed."""

from __future__ import annotations

import re
import traceback
from dataclasses import dataclass, replace
from pathlib import Path

import pytest

from haros_ci.analysis.architecture import architecture
from haros_ci.config.settings import Settings
from haros_ci.model.architecture import Architecture
from haros_ci.model.faults import FAULTS
from haros_ci.model.workspace import Reader
from haros_ci.workspace.cache import MemoryCache
from haros_ci.workspace.discover import discover

MANIFEST = "<package format='3'><name>{}</name><version>1.0.0</version><description>d</description><maintainer email='a@b.c'>m</maintainer><license>MIT</license><depend>rclpy</depend><export><build_type>ament_python</build_type></export></package>"
SETUP = "from setuptools import setup\nsetup(name='{0}', packages=['{0}'], data_files=[('share/{0}', ['p.yaml'])], entry_points={{'console_scripts': ['go = {0}.go:main']}})\n"
NODE = (
    "import rclpy\nfrom std_msgs.msg import String\n"
    "def main():\n    rclpy.init()\n    node = rclpy.create_node('{0}')\n    node.create_publisher(String, '{0}', 1)\n"
)
LAUNCH = (
    "from launch import LaunchDescription\nfrom launch_ros.actions import Node\n"
    "from launch.substitutions import PathJoinSubstitution\nfrom launch_ros.substitutions import FindPackageShare\n"
    "def generate_launch_description():\n    return LaunchDescription([Node(package='{0}', executable='go', name='{0}',\n"
    "        parameters=[PathJoinSubstitution([FindPackageShare('{0}'), 'p.yaml'])])])\n"
)


@dataclass(frozen=True)
class Faulty:
    """The files of a workspace: of one, what the function *within* does comes to an end that nobody has thought of."""

    reader: Reader
    path: str
    within: str

    def text(self, path: str) -> str:
        if path == self.path and any(frame.name == self.within for frame in traceback.extract_stack()):
            raise AssertionError("nobody has thought of this")
        return self.reader.text(path)

    def data(self, path: str) -> bytes | None:
        return self.reader.data(path)

    def head(self, path: str, length: int) -> bytes:
        return self.reader.head(path, length)


def linked(root: Path, path: str, within: str) -> Architecture:
    for name in ("one", "two"):
        package = root / name
        (package / name).mkdir(parents=True)
        (package / "launch").mkdir()
        (package / "package.xml").write_text(MANIFEST.format(name))
        (package / "p.yaml").write_text(f"{name}:\n  ros__parameters:\n    rate: 1.0\n")
        (package / "setup.py").write_text(SETUP.format(name))
        (package / name / "__init__.py").write_text("")
        (package / name / "go.py").write_text(NODE.format(name))
        (package / "launch" / f"{name}.launch.py").write_text(LAUNCH.format(name))
    found = discover(root, ())
    return architecture(replace(found, reader=Faulty(found.reader, path, within)), Settings(root=root), MemoryCache())


ROS1 = "<launch><rosparam command='load' file='$(find one)/p.yaml'/><node pkg='one' type='go' name='go'/></launch>"


def launched(root: Path, within: str) -> Architecture:
    """A launch file of ROS 1, of which one tag comes to an end within such a function."""
    (root / "one").mkdir()
    (root / "one" / "package.xml").write_text(
        "<package><name>one</name><version>1.0.0</version><description>d</description><maintainer email='a@b.c'>m</maintainer>"
        "<license>MIT</license><buildtool_depend>catkin</buildtool_depend></package>"
    )
    (root / "one" / "p.yaml").write_text("rate: 1.0\n")
    (root / "one" / "a.launch").write_text(ROS1)
    found = discover(root, ())
    faulty = replace(found, reader=Faulty(found.reader, "one/p.yaml", within))
    return architecture(faulty, Settings(root=root), MemoryCache())


def topics(found: Architecture) -> set[str]:
    ends = (end for one in found.configurations for node in one.nodes for end in node.endpoints)
    return {end.name for end in ends if end.kind == "publishers" and not end.implicit}


@pytest.mark.parametrize(
    ("path", "within", "named", "expected"),
    [
        ("one/one/go.py", "read_facts", "the file could not be read into the model", {"/two"}),
        ("one/setup.py", "build_of", "the build files of the package could not be read", {"/two"}),
        ("one/launch/one.launch.py", "read_python", "the launch file could not be read", {"/one", "/two"}),
        ("one/p.yaml", "launch_system", "what this does could not be followed", {"/one", "/two"}),
        ("none.py", "read_facts", "", {"/one", "/two"}),
    ],
)
def test_one_fault_does_not_end_the_run(tmp_path: Path, path: str, within: str, named: str, expected: set[str]) -> None:
    found = linked(tmp_path, path, within)
    assert topics(found) == expected
    faults = [problem for problem in found.problems if "a fault of haros-ci" in problem.message]
    assert bool(faults) is bool(named)
    for problem in faults:
        assert named in problem.message and "(AssertionError)" in problem.message
        assert problem.path.startswith("one/")


def test_a_tag_of_a_launch_file_of_ros_1(tmp_path: Path) -> None:
    found = launched(tmp_path, "evaluate")
    assert [node.name for one in found.configurations for node in one.nodes] == ["/go"]
    faults = [problem for problem in found.problems if "a fault of haros-ci" in problem.message]
    assert {(problem.path, problem.line) for problem in faults} == {("one/a.launch", 1)}


def test_a_tag_without_a_fault(tmp_path: Path) -> None:
    found = launched(tmp_path, "nobody")
    assert [problem for problem in found.problems if "a fault of haros-ci" in problem.message] == []


@pytest.mark.parametrize("err", [AssertionError, KeyError, RecursionError, UnicodeDecodeError, re.error])
def test_what_is_a_fault_of_ours(err: type[Exception]) -> None:
    assert issubclass(err, FAULTS)


@pytest.mark.parametrize("err", [MemoryError, OSError, KeyboardInterrupt, SystemExit])
def test_what_the_machine_or_the_user_ends_is_no_fault_of_ours(err: type[BaseException]) -> None:
    assert not issubclass(err, FAULTS)
