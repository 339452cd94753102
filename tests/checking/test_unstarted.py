# SPDX-License-Identifier: Apache-2.0
"""What would fail in a script that nothing starts is a note; one that anything starts, installs, imports or names keeps its level."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from haros_ci.analysis.architectures import project_of
from haros_ci.api.testing import read, said
from haros_ci.checking.page import Example
from haros_ci.checking.run import run_checks
from haros_ci.checking.unstarted import lowered
from haros_ci.registry import checks
from haros_ci.results.rule import Level

MANIFEST = (
    '<package format="3"><name>demo</name><version>1.0.0</version><description>d</description>'
    '<maintainer email="a@example.org">m</maintainer><license>MIT</license>{0}</package>\n'
)
ROS1 = MANIFEST.format("<buildtool_depend>catkin</buildtool_depend><depend>rospy</depend>")
ROS2 = MANIFEST.format("<depend>rclpy</depend><export><build_type>ament_python</build_type></export>")
CATKIN = "cmake_minimum_required(VERSION 3.0)\nproject(demo)\nfind_package(catkin REQUIRED)\ncatkin_package()\n{}\n"
TALK = "import rospy\nrospy.init_node('n')\npub = rospy.Publisher('a')\nrospy.spin()\n"
SETUP = """from setuptools import setup
setup(name="demo", version="1.0.0", packages=["demo"], entry_points={{"console_scripts": [{}]}})
# glob("demo/*.py")
"""
SPIN = "import rclpy\n\n\ndef main():\n    rclpy.init()\n    rclpy.spin()\n"


def level(files: dict[str, str], tmp_path: Path) -> Level:
    check = next(check for check in checks() if check.id == "missing-argument")
    (result,) = said(check, Example("", True, files), tmp_path)
    assert ("nothing here starts" in result.message) == (result.level is Level.NOTE)
    return result.level


@pytest.mark.parametrize(
    ("more", "expected"),
    [
        ({}, Level.NOTE),
        ({"README.md": "Try it.\n"}, Level.NOTE),
        ({"README.md": "rosrun demo grasp_and_lift.py\n"}, Level.ERROR),
        ({"scripts/start.sh": "rosrun demo grasp_and_lift.py\n"}, Level.ERROR),
        ({"launch/a.launch": '<launch><node pkg="demo" type="grasp_and_lift.py" name="n"/></launch>\n'}, Level.ERROR),
        ({"scripts/other.py": "import grasp_and_lift\n"}, Level.ERROR),
        ({"scripts/other.py": "import grasp_and_lift_twice\n"}, Level.NOTE),
        ({"scripts/other.py": "import importlib\nimportlib.import_module(name)\n"}, Level.ERROR),
        (
            {"CMakeLists.txt": CATKIN.format("install(PROGRAMS scripts/grasp_and_lift.py DESTINATION lib/demo)")},
            Level.ERROR,
        ),
        ({"CMakeLists.txt": CATKIN.format("install(DIRECTORY scripts/ DESTINATION lib/demo)")}, Level.ERROR),
        ({"CMakeLists.txt": CATKIN.format("install_them(scripts)")}, Level.NOTE),
    ],
)
def test_scripts_of_ros1(more: dict[str, str], expected: Level, tmp_path: Path) -> None:
    files = {"package.xml": ROS1, "CMakeLists.txt": CATKIN.format(""), "scripts/grasp_and_lift.py": TALK, **more}
    assert level(files, tmp_path) is expected


@pytest.mark.parametrize("name", ["main.py", "node.py", "a_test.py", "test_a.py", "demo.launch.py", "__main__.py"])
def test_files_that_are_found_by_their_names(name: str, tmp_path: Path) -> None:
    assert (
        level({"package.xml": ROS1, "CMakeLists.txt": CATKIN.format(""), f"scripts/{name}": TALK}, tmp_path)
        is Level.ERROR
    )


@pytest.mark.parametrize(
    ("entry", "expected"),
    [('"lift = demo.grasp_and_lift:main"', Level.ERROR), ('"other = demo.other:main"', Level.NOTE)],
)
def test_modules_of_ros2(entry: str, expected: Level, tmp_path: Path) -> None:
    files = {
        "package.xml": ROS2,
        "setup.py": SETUP.format(entry),
        "demo/__init__.py": "",
        "demo/grasp_and_lift.py": SPIN,
    }
    assert level(files, tmp_path) is expected


@pytest.mark.parametrize(
    ("module", "expected"), [("demo.grasp_and_lift", Level.NOTE), ("demo.old.grasp_and_lift", Level.ERROR)]
)
def test_modules_that_are_set_aside(module: str, expected: Level, tmp_path: Path) -> None:
    files = {
        "package.xml": ROS2,
        "setup.py": SETUP.format(f'"lift = {module}:main"'),
        "demo/__init__.py": "",
        "demo/old/__init__.py": "",
        "demo/old/grasp_and_lift.py": SPIN,
    }
    assert level(files, tmp_path) is expected


READS = (
    "#!/usr/bin/env python3\nimport rclpy\n\nrclpy.init()\nnode = rclpy.create_node('n')\nRATE = node.get_parameter('rate')\n\n\n"
    "def main():\n    rclpy.spin(node)\n\n\nmain()\n"
)


@pytest.mark.parametrize(
    ("entry", "more", "expected"),
    [
        ('"other = demo.other:main"', {}, Level.NOTE),
        ('"lift = demo.grasp_and_lift:main"', {}, Level.ERROR),
        ('"other = demo.other:main"', {"demo/other.py": "from demo import grasp_and_lift\n"}, Level.ERROR),
        ('"other = demo.other:main"', {"README.md": "python3 grasp_and_lift.py\n"}, Level.ERROR),
    ],
)
def test_findings_of_systems(entry: str, more: dict[str, str], expected: Level, tmp_path: Path) -> None:
    files = {
        "package.xml": ROS2,
        "setup.py": SETUP.format(entry).replace('# glob("demo/*.py")', ""),
        "demo/__init__.py": "",
        "demo/grasp_and_lift.py": READS,
        **more,
    }
    workspace, made, every = read(files, tmp_path)
    project = project_of(made, workspace, every)
    check = next(check for check in checks() if check.id == "parameter-read-undeclared")
    (result,) = lowered(project, run_checks((check,), every, "haros-ci").results)
    assert result.level is expected
    assert ("nothing here starts" in result.message) == (expected is Level.NOTE)
    other = replace(result, rule="topic-type-mismatch", level=Level.ERROR)
    assert list(lowered(project, [other])) == [other]


AGAIN = "import rospy\n\n\ndef talk():\n    return rospy.Publisher('a')\n\n\n{}def talk():\n    return 1\n\n\ntalk()\n"


@pytest.mark.parametrize(("between", "count"), [("", 0), ("talk()\n\n\n", 1), ("def other():\n    talk()\n\n\n", 0)])
def test_a_function_that_the_file_defines_again(between: str, count: int, tmp_path: Path) -> None:
    files = {"package.xml": ROS1, "CMakeLists.txt": CATKIN.format(""), "scripts/talk.py": AGAIN.format(between)}
    check = next(check for check in checks() if check.id == "missing-argument")
    assert len(said(check, Example("", True, files), tmp_path)) == count


@pytest.mark.parametrize(("kind", "count"), [("String", 1), ("int", 0), ("float", 0), ("dict", 0)])
def test_a_node_of_a_test_that_takes_any_type(kind: str, count: int, tmp_path: Path) -> None:
    text = f"import rclpy\nfrom std_msgs.msg import String\n\nnode = rclpy.create_node('n')\nnode.create_publisher({kind}, 'a')\n"
    files = {"package.xml": ROS2, "setup.py": SETUP.format(""), "demo/__init__.py": "", "demo/talk.py": text}
    check = next(check for check in checks() if check.id == "missing-argument")
    assert len(said(check, Example("", True, files), tmp_path)) == count
