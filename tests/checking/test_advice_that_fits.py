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
#: One more joint on a link of another robot, and the configuration of that one, which takes the file in.
SECOND = "<link name='lid'/><joint name='k' type='fixed'><parent link='mount'/><child link='lid'/></joint>"
YAML = "platform:\n  extras:\n    urdf:\n      package: demo\n      path: urdf/r.urdf\n"
SHOWN = (
    '<launch><node pkg="robot_state_publisher" exec="robot_state_publisher" name="rsp">'
    '<param name="robot_description" value="$(command \'cat $(find-pkg-share demo)/urdf/r.urdf\')"/></node></launch>\n'
)


@pytest.mark.parametrize(
    ("robot", "launch", "levels"),
    [
        (ROBOT.format("", "base", "box"), "", ["note"]),
        (ROBOT.format("", "base", "box"), SHOWN, ["error"]),
        (ROBOT.format("", "base", "box").replace(" name='r'", ""), YAML, ["note"]),
        (ROBOT.format(SECOND, "base", "box").replace(" name='r'", ""), YAML, ["note", "note"]),
        (ROBOT.format(SECOND, "base", "box"), YAML, ["error", "error"]),
        (ROBOT.format("", "base", "bax").replace(" name='r'", ""), YAML, ["error", "error"]),
        (ROBOT.format("<link name='base'/>", "base", "bax"), "", ["error"]),
        (ROBOT.format("<link name='base'/>", "base", "box"), "", []),
        (ROBOT.format("<link name='base'/>", "base", "box"), SHOWN, []),
    ],
)
def test_a_part_for_another_robot(robot: str, launch: str, levels: list[str], tmp_path: Path) -> None:
    files = {
        "walk.cpp": WALK.format("1.0"),
        "urdf/r.urdf": robot,
        **({"config/robot.yaml" if launch == YAML else "launch/a.launch.xml": launch} if launch else {}),
    }
    found = messages("broken-robot-model", files, tmp_path)
    assert [level for level, _ in found] == levels
    assert all(("it may be a part for another robot" in message) == (level == "note") for level, message in found)


TALKER = (
    "import rclpy\nfrom rclpy.node import Node\n\n\nclass Talker(Node):\n    def __init__(self):\n        super().__init__('talker')\n"
    "        self.declare_parameter('prefix', 'hello')\n\n\ndef main():\n    rclpy.init()\n    rclpy.spin(Talker())\n\n\nmain()\n"
)
PYTHON = (
    "from launch import LaunchDescription\nfrom launch.actions import DeclareLaunchArgument\nfrom launch.substitutions import LaunchConfiguration, PathJoinSubstitution\n"
    "from launch_ros.actions import Node\nfrom launch_ros.substitutions import FindPackageShare\nfrom launch_ros.parameter_descriptions import ParameterValue\n\n\n"
    "def generate_launch_description():\n    given = PathJoinSubstitution([\n        FindPackageShare('demo'),\n        'config',\n        'walk.yaml',\n    ])\n"
    "    return LaunchDescription([\n        DeclareLaunchArgument('prefix', default_value='{}'),\n"
    "        Node(package='demo', executable='talker.py', parameters=[{}]),\n    ])\n"
)
OF_SCRIPT = CMAKE.replace(
    "install(TARGETS walk DESTINATION lib/demo)",
    "install(TARGETS walk DESTINATION lib/demo)\ninstall(PROGRAMS talker.py DESTINATION lib/demo)",
)


@pytest.mark.parametrize(
    ("text", "value", "words"),
    [
        (
            "[a]",
            "{'prefix': LaunchConfiguration('prefix')}",
            "; launch reads a text here as YAML, ParameterValue(…, value_type=str) keeps it a text",
        ),
        (
            "12",
            "{'prefix': LaunchConfiguration('prefix')}",
            "; declare it as int if a number is meant; launch reads a text here as YAML, ParameterValue(…, value_type=str) keeps it a text",
        ),
        (
            "true",
            "{'prefix': LaunchConfiguration('prefix')}",
            "; declare it as bool if a switch is meant; launch reads a text here as YAML, ParameterValue(…, value_type=str) keeps it a text",
        ),
        ("[a]", "{'prefix': ParameterValue(LaunchConfiguration('prefix'), value_type=str)}", ""),
        ("hello", "{'prefix': LaunchConfiguration('prefix')}", ""),
    ],
)
def test_a_text_that_is_read_as_yaml(text: str, value: str, words: str, tmp_path: Path) -> None:
    files = {
        "talker.py": TALKER,
        "CMakeLists.txt": OF_SCRIPT,
        "walk.cpp": WALK.format("1.0"),
        "launch/a.launch.py": PYTHON.format(text, value),
    }
    found = messages("parameter-type-mismatch", files, tmp_path)
    assert len(found) == bool(words) and all(words in message for _, message in found)


@pytest.mark.parametrize(("more", "line"), [("", 13), ("# 'walk.yaml'\n", 17)])
def test_a_missing_file_is_shown_where_its_name_is(more: str, line: int, tmp_path: Path) -> None:
    check = next(check for check in checks() if check.id == "parameter-file-missing")
    launch = PYTHON.format("a", "given") + more
    files = {
        "talker.py": TALKER,
        "CMakeLists.txt": OF_SCRIPT,
        "walk.cpp": WALK.format("1.0"),
        "launch/a.launch.py": launch,
        "config/other.yaml": "",
    }
    (result,) = said(check, Example("", True, {"package.xml": MANIFEST, **files}), tmp_path)
    assert result.location.line == line
    assert result.message.startswith("the parameter file $(find-pkg-share demo)/config/walk.yaml does not exist")


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ("ParameterFile(given, allow_substs=True)", "launch stops here, as it opens the file"),
        ("ParameterFile(given)", "launch prints a warning and starts"),
        ("ParameterFile(given, allow_substs=False)", "launch prints a warning and starts"),
        ("given", "launch prints a warning and starts"),
    ],
)
def test_what_launch_does_without_a_file(given: str, words: str, tmp_path: Path) -> None:
    launch = PYTHON.format("a", given).replace(
        "from launch_ros.actions import Node",
        "from launch_ros.actions import Node\nfrom launch_ros.parameter_descriptions import ParameterFile",
    )
    files = {
        "talker.py": TALKER,
        "CMakeLists.txt": OF_SCRIPT,
        "walk.cpp": WALK.format("1.0"),
        "launch/a.launch.py": launch,
        "config/other.yaml": "",
    }
    ((_, message),) = messages("parameter-file-missing", files, tmp_path)
    assert words in message


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ('allow_substs="true" ', "launch stops here, as it opens the file"),
        ('allow_substs="false" ', "launch prints a warning and starts"),
        ("", "launch prints a warning and starts"),
    ],
)
def test_what_launch_does_without_a_file_in_xml(text: str, words: str, tmp_path: Path) -> None:
    launch = LAUNCH.format("").replace("from=", f"{text}from=")
    files = {"walk.cpp": WALK.format("1.0"), "launch/a.launch.xml": launch, "config/other.yaml": ""}
    ((_, message),) = messages("parameter-file-missing", files, tmp_path)
    assert words in message


@pytest.mark.parametrize(
    ("finds", "words"),
    [
        ("find_package(PkgConfig REQUIRED)\npkg_check_modules(YAML REQUIRED yaml-cpp)\n", "<depend>yaml-cpp</depend>"),
        ("find_package(yaml-cpp REQUIRED)\n", "<depend>yaml-cpp</depend>"),
        ("", "<depend>yaml_cpp_vendor</depend>"),
        (
            "find_package(PkgConfig REQUIRED)\npkg_check_modules(XML REQUIRED libxml-2.0)\n",
            "<depend>yaml_cpp_vendor</depend>",
        ),
        ("# find_package(yaml-cpp)\n", "<depend>yaml_cpp_vendor</depend>"),
    ],
)
def test_what_cmake_asks_the_system_for(finds: str, words: str, tmp_path: Path) -> None:
    files = {
        "CMakeLists.txt": CMAKE.replace("add_executable", f"{finds}add_executable"),
        "walk.cpp": f"#include <yaml-cpp/yaml.h>\n{WALK.format('1.0')}",
    }
    found = [message for _, message in messages("undeclared-dependency", files, tmp_path)]
    assert len(found) == 1 and words in found[0]
