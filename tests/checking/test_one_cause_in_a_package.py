# SPDX-License-Identifier: Apache-2.0
"""What one finding says for several, and what is left to another one; the same transform in several forms; conditions that are switches."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.api.testing import said
from haros_ci.checking.page import Example
from haros_ci.checking.poses import are_same, of_options, of_origin, of_words
from haros_ci.registry import checks

HALF = "3.14159265"
Results = list[tuple[str, str]]


def messages(check_id: str, files: dict[str, str], folder: Path) -> Results:
    check = next(check for check in checks() if check.id == check_id)
    return [(result.level.value, result.message) for result in said(check, Example("", True, files), folder)]


@pytest.mark.parametrize(
    ("one", "other", "expected"),
    [
        (of_words("0 0 0.2 0 0 0".split()), of_origin("0 0 0.2", ""), True),
        (of_words(f"1 2 3 {HALF} 0 0".split()), of_words("1 2 3 0 0 1 0".split()), True),
        (of_words("0 0 0 0 0 1 0".split()), of_words("0 0 0 0 0 -1 0".split()), True),
        (of_options({"--qz": "1", "--qw": "0"}), of_origin("0 0 0", f"0 0 {HALF}"), True),
        (of_options({"--yaw": HALF, "--x": "1"}), of_words("1 0 0 0 0 2 0".split()), True),
        (of_words("0 0 0 1.5707963 0 0".split()), of_origin("0 0 0", "0 0 1.5707963"), True),
        (of_words("0 0 0 0.3 0.2 0.1".split()), of_origin("0 0 0", "0.1 0.2 0.3"), True),
        (of_words("0 0 0.2 0 0 0".split()), of_origin("0 0 0.3", ""), False),
        (of_words("0 0 0 0.1 0 0".split()), of_origin("0 0 0", "0.1 0 0"), False),
        (of_words("0 0 0 0 0 1 0".split()), of_origin("0 0 0", ""), False),
        (of_words("0 0 ? 0 0 0".split()), of_origin("0 0 0", ""), False),
        (of_words("0 0 nan 0 0 0".split()), of_words("0 0 nan 0 0 0".split()), False),
        (of_words("0 0 0 0 0 0 0".split()), of_origin("", ""), False),
        (of_words("0 0 0".split()), of_origin("", ""), False),
        (of_origin(None, ""), of_origin("", ""), False),
        (of_origin("0 0", ""), of_origin("", ""), False),
        (of_options({"--x": "$(var x)"}), of_options({"--x": "$(var x)"}), False),
    ],
)
def test_poses(one: tuple[float, ...] | None, other: tuple[float, ...] | None, expected: bool) -> None:
    assert are_same(one, other) is expected


LISTENER = """import rospy
from std_msgs.msg import String


class Listener:
    def __init__(self):
        rospy.Subscriber("a", String, self.on_a)
        rospy.Subscriber("b", String, self.on_b)
        rospy.sleep(1)
        self.count = 0

    def on_a(self, message):
        self.count += 1

    def on_b(self, message):
        self.count -= 1


rospy.init_node("listener")
Listener()
rospy.spin()
"""


def test_callbacks_of_one_constructor_are_one_finding(tmp_path: Path) -> None:
    ((level, message),) = messages("attribute-set-late", {"listener.py": LISTENER}, tmp_path)
    assert level == "warning"
    assert message.endswith("register it at the end of __init__(); and the same of Listener.on_b()")


def test_one_of_them_stays_alone(tmp_path: Path) -> None:
    one = LISTENER.replace('        rospy.Subscriber("b", String, self.on_b)\n', "")
    ((_, message),) = messages("attribute-set-late", {"listener.py": one}, tmp_path)
    assert message.endswith("register it at the end of __init__()")


PROGRAM = """import launch_ros.actions


def other():
    return launch_ros.actions.Node(package="demo", executable="{}")
"""
LAUNCH = """from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([Node(package="demo", executable="lost")])
"""
PACKAGE = {
    "package.xml": (
        '<package format="3"><name>demo</name><version>1.0.0</version><description>d</description><maintainer email="a@b.cd">m</maintainer>'
        "<license>Apache-2.0</license><buildtool_depend>ament_cmake</buildtool_depend><buildtool_depend>ament_cmake_python</buildtool_depend>"
        "<depend>rclcpp</depend><export><build_type>ament_cmake</build_type></export></package>\n"
    ),
    "CMakeLists.txt": (
        "cmake_minimum_required(VERSION 3.8)\nproject(demo)\nfind_package(ament_cmake REQUIRED)\nfind_package(ament_cmake_python REQUIRED)\n"
        "find_package(rclcpp REQUIRED)\nadd_executable(talker talker.cpp)\nament_target_dependencies(talker rclcpp)\n"
        "install(TARGETS talker DESTINATION lib/demo)\ninstall(DIRECTORY launch DESTINATION share/demo)\n"
        "ament_python_install_package(demo)\nament_package()\n"
    ),
    "talker.cpp": (
        "#include <rclcpp/rclcpp.hpp>\nint main(int argc, char ** argv)\n{\n  rclcpp::init(argc, argv);\n"
        '  rclcpp::spin(std::make_shared<rclcpp::Node>("talker"));\n}\n'
    ),
    "launch/a.launch.py": LAUNCH,
}


@pytest.mark.parametrize(("program", "level"), [("lost", "note"), ("gone", "error")])
def test_a_program_that_a_launch_file_names_already(program: str, level: str, tmp_path: Path) -> None:
    files = {**PACKAGE, "demo/nodes.py": PROGRAM.format(program)}
    ((found, _),) = messages("unknown-executable-in-module", files, tmp_path)
    assert found == level


CONDITION = """from launch import LaunchDescription
from launch.conditions import IfCondition, UnlessCondition
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([Node(package="demo", executable="talker", condition={})])
"""


@pytest.mark.parametrize(
    ("condition", "level"),
    [
        ("IfCondition('false')", "note"),
        ('UnlessCondition("True")', "note"),
        ("IfCondition(predicate_expression='0')", "note"),
        ("IfCondition('no')", "warning"),
    ],
)
def test_a_condition_that_is_a_switch(condition: str, level: str, tmp_path: Path) -> None:
    files = {**PACKAGE, "launch/a.launch.py": CONDITION.format(condition)}
    found = messages("constant-launch-condition", files, tmp_path)
    assert [level for level, _ in found] == [level]


@pytest.mark.parametrize("has_build", [True, False])
def test_a_program_of_a_package_that_nothing_builds(has_build: bool, tmp_path: Path) -> None:
    """The missing CMakeLists.txt is what is wrong: wrong-build-type says it."""
    files = {f"demo/{path}": text for path, text in PACKAGE.items()}
    files |= {
        "demo/launch/a.launch.py": LAUNCH.replace('package="demo"', 'package="lines"'),
        "lines/package.xml": PACKAGE["package.xml"].replace("<name>demo<", "<name>lines<"),
        "lines/install.cmake": "set(LINES 1)\n",
        "lines/include/lines/lines.h": "int lines();\n",
    }
    if has_build:
        files["lines/CMakeLists.txt"] = PACKAGE["CMakeLists.txt"].replace("demo", "lines").replace("talker", "hearer")
        files["lines/hearer.cpp"] = PACKAGE["talker.cpp"]
    assert [level for level, _ in messages("unknown-executable", files, tmp_path)] == ["error"] * has_build
