# SPDX-License-Identifier: Apache-2.0
"""Advice that fits the case: sections of nodes in namespaces, numbers for parameters of text, parts of robots."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.api.testing import said
from haros_ci.checking.page import Example
from haros_ci.registry import checks

MANIFEST = (
    '<package format="3"><name>demo</name><version>1.0.0</version><description>d</description><maintainer email="a@b.cd">m</maintainer>'
    "<license>Apache-2.0</license><buildtool_depend>ament_cmake</buildtool_depend><depend>rclcpp</depend>"
    "<export><build_type>ament_cmake</build_type></export></package>\n"
)
CMAKE = (
    "cmake_minimum_required(VERSION 3.8)\nproject(demo)\nfind_package(ament_cmake REQUIRED)\nfind_package(rclcpp REQUIRED)\n"
    "add_executable(walk walk.cpp)\nament_target_dependencies(walk rclcpp)\ninstall(TARGETS walk DESTINATION lib/demo)\n"
    "install(DIRECTORY launch config urdf DESTINATION share/demo)\nament_package()\n"
)
WALK = (
    "#include <rclcpp/rclcpp.hpp>\nint main(int argc, char ** argv)\n{{\n  rclcpp::init(argc, argv);\n"
    '  auto node = std::make_shared<rclcpp::Node>("walk");\n  node->declare_parameter("speed", {});\n  rclcpp::spin(node);\n}}\n'
)
LAUNCH = '<launch><node pkg="demo" exec="walk" name="walk"{}><param from="$(find-pkg-share demo)/config/walk.yaml"/></node></launch>\n'


def messages(check_id: str, files: dict[str, str], folder: Path) -> list[tuple[str, str]]:
    check = next(check for check in checks() if check.id == check_id)
    found = said(check, Example("", True, {"package.xml": MANIFEST, "CMakeLists.txt": CMAKE, **files}), folder)
    return [(result.level.value, result.message) for result in found]


@pytest.mark.parametrize(
    ("space", "section", "words"),
    [
        (
            ' namespace="left"',
            "walk",
            "/left/walk is in a namespace, so it gets none of these parameters; write /**/walk (or /left/walk) here",
        ),
        ("", "wallk", "/walk is called otherwise, so it gets none of these parameters; write walk or /** here"),
        (' namespace="left"', "/**/walk", ""),
        (' namespace="left"', "left/walk", ""),
        (' namespace="left"', "/left/walk", ""),
        (' namespace="left"', "/**", ""),
        ("", "walk", ""),
        ("", "/walk", ""),
    ],
)
def test_a_section_for_a_node_in_a_name_space(space: str, section: str, words: str, tmp_path: Path) -> None:
    files = {
        "walk.cpp": WALK.format("1.0"),
        "launch/a.launch.xml": LAUNCH.format(space),
        "config/walk.yaml": f"{section}:\n  ros__parameters:\n    speed: 2.0\n",
    }
    found = messages("parameter-section-unmatched", files, tmp_path)
    assert len(found) == bool(words) and all(words in message for _, message in found)


@pytest.mark.parametrize(
    ("default", "value", "words"),
    [
        ('"1.0"', "0.1", "; declare it as double if a number is meant, else give it as text"),
        ('"1"', "3", "; declare it as int if a number is meant, else give it as text"),
        ('"on"', "true", "; put the value in quotes"),
        ("1.0", "3", "; write 3.0"),
        ("1.0", "3.0", ""),
        ('"1.0"', "'0.1'", ""),
    ],
)
def test_a_number_for_a_text(default: str, value: str, words: str, tmp_path: Path) -> None:
    files = {
        "walk.cpp": WALK.format(default),
        "launch/a.launch.xml": LAUNCH.format(""),
        "config/walk.yaml": f"walk:\n  ros__parameters:\n    speed: {value}\n",
    }
    found = messages("parameter-type-mismatch", files, tmp_path)
    assert len(found) == bool(words) and all(words in message for _, message in found), found


ROBOT = "<robot name='r'>{}<link name='box'/><joint name='j' type='fixed'><parent link='{}'/><child link='{}'/></joint></robot>\n"
SHOWN = (
    '<launch><node pkg="robot_state_publisher" exec="robot_state_publisher" name="rsp">'
    '<param name="robot_description" value="$(command \'cat $(find-pkg-share demo)/urdf/r.urdf\')"/></node></launch>\n'
)


@pytest.mark.parametrize(
    ("robot", "launch", "levels"),
    [
        (ROBOT.format("", "base", "box"), "", ["note"]),
        (ROBOT.format("", "base", "box"), SHOWN, ["error"]),
        (ROBOT.format("<link name='base'/>", "base", "bax"), "", ["error"]),
        (ROBOT.format("<link name='base'/>", "base", "box"), "", []),
        (ROBOT.format("<link name='base'/>", "base", "box"), SHOWN, []),
    ],
)
def test_a_part_for_another_robot(robot: str, launch: str, levels: list[str], tmp_path: Path) -> None:
    files = {
        "walk.cpp": WALK.format("1.0"),
        "urdf/r.urdf": robot,
        **({"launch/a.launch.xml": launch} if launch else {}),
    }
    found = messages("broken-robot-model", files, tmp_path)
    assert [level for level, _ in found] == levels
    assert all(("it may be a part for another robot" in message) == (level == "note") for level, message in found)
