# SPDX-License-Identifier: Apache-2.0
"""Findings that are less grave than their check: what is left over and not installed, and what is documented and at times meant."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.api.testing import said
from haros_ci.checking.page import Example
from haros_ci.registry import checks
from haros_ci.results.rule import Level

PACKAGE = (
    '<package format="3"><name>demo</name><version>1.0.0</version><description>d</description>'
    '<maintainer email="a@b.cd">m</maintainer><license>Apache-2.0</license>'
    "<buildtool_depend>{0}</buildtool_depend><depend>{1}</depend>{2}</package>\n"
)
ROS2 = PACKAGE.format("ament_cmake", "rclcpp", "<export><build_type>ament_cmake</build_type></export>")
ROS1 = PACKAGE.format("catkin", "rospy", "")
CMAKE = "cmake_minimum_required(VERSION 3.8)\nproject(demo)\nfind_package(ament_cmake REQUIRED)\n{}\nament_package()\n"
CATKIN = "cmake_minimum_required(VERSION 3.0)\nproject(demo)\nfind_package(catkin REQUIRED)\ncatkin_package()\n"
OLD = '<launch><arg name="x" default="1"/><node pkg="demo" type="n" name="n" args="$(arg x)"/></launch>\n'


def levels(name: str, files: dict[str, str], tmp_path: Path) -> list[Level]:
    check = next(check for check in checks() if check.id == name)
    return [result.level for result in said(check, Example("", True, files), tmp_path)]


@pytest.mark.parametrize(
    ("install", "expected"),
    [
        ("install(DIRECTORY launch DESTINATION share/demo)", Level.WARNING),
        ("install(FILES launch/a.launch DESTINATION share/demo)", Level.WARNING),
        ("install_my_files(launch/a.launch)", Level.WARNING),
        ("install(DIRECTORY config DESTINATION share/demo)", Level.NOTE),
        ("", Level.NOTE),
    ],
)
def test_a_launch_file_of_ros1_that_is_left_over(install: str, expected: Level, tmp_path: Path) -> None:
    files = {"package.xml": ROS2, "CMakeLists.txt": CMAKE.format(install), "launch/a.launch": OLD}
    assert levels("foreign-launch-construct", files, tmp_path) == [expected]


INSTALLED = CMAKE.format("install(DIRECTORY launch DESTINATION share/demo)")


@pytest.mark.parametrize(
    ("path", "expected"),
    [
        ("launch/ros1_tf.launch", Level.NOTE),
        ("launch/tf_ros1.launch", Level.NOTE),
        ("launch/Noetic.launch", Level.NOTE),
        ("launch/melodic/a.launch", Level.NOTE),
        ("launch/a-ros_1.launch", Level.NOTE),
        ("launch/ros2_tf.launch", Level.WARNING),
        ("launch/humble.launch", Level.WARNING),
        ("launch/ros10.launch", Level.WARNING),
        ("launch/kros1.launch", Level.WARNING),
        ("launch/ros.launch", Level.WARNING),
    ],
)
def test_a_launch_file_that_is_meant_for_ros1(path: str, expected: Level, tmp_path: Path) -> None:
    files = {"package.xml": ROS2, "CMakeLists.txt": INSTALLED, path: OLD}
    assert levels("foreign-launch-construct", files, tmp_path) == [expected]
    other = path.replace("launch/", "launch/x/")
    assert levels("foreign-launch-construct", {**files, other: OLD}, tmp_path / "two") == [expected]


def test_a_launch_file_that_is_half_ported_is_not_meant_for_ros1(tmp_path: Path) -> None:
    half = '<launch><node pkg="demo" exec="n"><param name="x" value="$(find demo)"/></node></launch>\n'
    files = {"package.xml": ROS2, "CMakeLists.txt": INSTALLED, "launch/ros1.launch.xml": half}
    assert levels("foreign-launch-construct", files, tmp_path) == [Level.WARNING]


@pytest.mark.parametrize(
    ("call", "expected"),
    [
        ("Publisher('a', String)", Level.NOTE),
        ("Publisher('a', String, queue_size=0)", Level.NOTE),
        ("Subscriber('a', String, print, queue_size=0)", Level.ERROR),
    ],
)
def test_queues_without_a_size(call: str, expected: Level, tmp_path: Path) -> None:
    node = f"import rospy\nfrom std_msgs.msg import String\nrospy.init_node('n')\nrospy.{call}\nrospy.spin()\n"
    files = {
        "package.xml": ROS1,
        "CMakeLists.txt": "cmake_minimum_required(VERSION 3.0)\nproject(demo)\nfind_package(catkin REQUIRED)\n"
        "catkin_package()\ncatkin_install_python(PROGRAMS n.py DESTINATION lib/demo)\n",
        "n.py": "#!/usr/bin/env python3\n" + node,
    }
    assert levels("queue-without-size", files, tmp_path) == [expected]


DESCRIPTION = (
    '<class_libraries><library path="gear">'
    '<class name="demo/Gear" type="demo::Gear" base_class_type="nav2_core::Controller"/>'
    '<class name="demo/Brake" type="demo::Brake" base_class_type="nav2_core::Controller"/>'
    "</library></class_libraries>\n"
)
GEAR = (
    "#include <pluginlib/class_list_macros.hpp>\n#include <nav2_core/controller.hpp>\nnamespace demo {{ {0} }}\n"
    "PLUGINLIB_EXPORT_CLASS(demo::Gear, nav2_core::Controller)\n{1}"
)
CLASS = "class {0} : public nav2_core::Controller {{}};"


@pytest.mark.parametrize(
    ("classes", "macros", "more", "expected"),
    [
        (("Gear",), "", {}, Level.WARNING),
        (("Gear",), "", {"config/a.yaml": "follow: {plugin: demo/Brakes}\n"}, Level.WARNING),
        (("Gear",), "", {"config/a.yaml": "follow: {plugin: demo/Brake}\n"}, Level.ERROR),
        (("Gear",), "", {"config/a.yaml": 'follow: {plugin: "demo::Brake"}\n'}, Level.ERROR),
        (("Gear",), "", {"other.cpp": 'auto name = "demo/Brake";\n'}, Level.ERROR),
        (("Gear", "Brake"), "", {}, Level.ERROR),
        (("Gear", "Stop"), "PLUGINLIB_EXPORT_CLASS(demo::Stop, nav2_core::Controller)\n", {}, Level.ERROR),
    ],
)
def test_a_description_that_is_left_over(
    classes: tuple[str, ...], macros: str, more: dict[str, str], expected: Level, tmp_path: Path
) -> None:
    cmake = "add_library(gear SHARED gear.cpp)\ninstall(TARGETS gear DESTINATION lib)\n"
    cmake += "pluginlib_export_plugin_description_file(nav2_core plugins.xml)"
    files = {
        "package.xml": ROS2.replace("rclcpp", "nav2_core"),
        "CMakeLists.txt": CMAKE.format(cmake),
        "plugins.xml": DESCRIPTION,
        "gear.cpp": GEAR.format(" ".join(CLASS.format(name) for name in classes), macros),
        **more,
    }
    assert levels("plugin-not-loadable", files, tmp_path) == [expected]


def test_a_description_beside_a_class_of_the_same_last_name(tmp_path: Path) -> None:
    cmake = "add_library(gear SHARED gear.cpp)\ninstall(TARGETS gear DESTINATION lib)\n"
    cmake += "pluginlib_export_plugin_description_file(nav2_core plugins.xml)"
    text = (
        '<class_libraries>\n<library path="gear"><class type="gear::Plugin" base_class_type="nav2_core::Controller"/></library>\n'
        '<library path="brake"><class type="brake::Plugin" base_class_type="nav2_core::Controller"/></library>\n</class_libraries>\n'
    )
    code = GEAR.replace("demo", "gear").replace("Gear", "Plugin").format(CLASS.format("Plugin"), "")
    files = {
        "package.xml": ROS2.replace("rclcpp", "nav2_core"),
        "CMakeLists.txt": CMAKE.format(cmake),
        "plugins.xml": text,
        "gear.cpp": code,
    }
    check = next(check for check in checks() if check.id == "plugin-not-loadable")
    (result,) = said(check, Example("", True, files), tmp_path / "a")
    assert (result.level, result.location.line) == (Level.WARNING, 3)
    assert "no class of the package has this name: build it, or remove the description" in result.message
    files["gear.cpp"] = code + "namespace brake {{ class Plugin : public nav2_core::Controller {{}}; }}\n".format()
    (result,) = said(check, Example("", True, files), tmp_path / "b")
    assert result.level is Level.ERROR


@pytest.mark.parametrize(
    ("target", "expected"),
    [
        ("add_executable(n n.cpp)\ninstall(TARGETS n DESTINATION lib/demo)", Level.NOTE),
        ("add_library(l SHARED n.cpp)\ninstall(TARGETS l DESTINATION lib)", Level.NOTE),
        ("add_library(l n.cpp)\ninstall(TARGETS l DESTINATION lib)\nament_export_libraries(l)", Level.WARNING),
        (
            "add_library(l n.cpp)\nadd_executable(n n.cpp)\ninstall(TARGETS l n DESTINATION lib)\nament_export_libraries(l)",
            Level.WARNING,
        ),
        ("", Level.WARNING),
    ],
)
def test_headers_that_are_exported_and_not_installed(target: str, expected: Level, tmp_path: Path) -> None:
    files = {
        "package.xml": ROS2,
        "CMakeLists.txt": CMAKE.format(f"{target}\nament_export_include_directories(include)"),
        "n.cpp": '#include "demo/n.hpp"\nint main() {}\n',
        "include/demo/n.hpp": "#pragma once\n",
    }
    assert levels("directory-not-installed", files, tmp_path) == [expected]


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        ("import matplotlib", [Level.ERROR]),
        ("import carla", [Level.NOTE]),
        ("import rclpy", []),
    ],
)
def test_modules_that_pip_alone_has(line: str, expected: list[Level], tmp_path: Path) -> None:
    files = {
        "package.xml": ROS2.replace("rclcpp", "rclpy"),
        "CMakeLists.txt": CMAKE.format("install(PROGRAMS n.py DESTINATION lib/demo)"),
        "n.py": f"#!/usr/bin/env python3\n{line}\n",
    }
    assert levels("undeclared-import", files, tmp_path) == expected


@pytest.mark.parametrize(
    ("code", "more", "expected"),
    [
        ("#include <rclcpp/rclcpp.hpp>\nint main(int c, char ** v) { rclcpp::init(c, v); }\n", "", Level.WARNING),
        ('#include <cstdio>\nint main() { std::puts("grid"); }\n', "", Level.NOTE),
        ("int main() {}\n", '<launch><node pkg="demo" exec="n"/></launch>\n', Level.ERROR),
    ],
)
def test_an_executable_that_is_not_installed(code: str, more: str, expected: Level, tmp_path: Path) -> None:
    cmake = "add_executable(n n.cpp)\ninstall(DIRECTORY launch DESTINATION share/demo)"
    files = {"package.xml": ROS2, "CMakeLists.txt": CMAKE.format(cmake), "n.cpp": code}
    files["launch/a.launch.xml"] = more or "<launch/>\n"
    assert levels("target-not-installed", files, tmp_path) == [expected]


SLEEPER = """import time
import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger

class Arm(Node):
    def __init__(self):
        super().__init__("arm")
        self.create_service(Trigger, "home", self.home)
        self.create_timer(0.1, self.tick)

    def home(self, request, response):
        {}
        return response

rclpy.init()
rclpy.spin(Arm())
"""


@pytest.mark.parametrize(
    ("path", "body", "expected"),
    [
        ("arm.py", "time.sleep(0.5)", [Level.WARNING]),
        ("arm.py", "time.sleep(self.pause)", [Level.WARNING]),
        ("arm.py", "while not self.ready:\n            time.sleep(0.5)", [Level.WARNING]),
        ("stool.py", "time.sleep(0.5)", [Level.WARNING]),
        ("arm.py", "time.sleep(0.1)", [Level.WARNING]),
        ("arm.py", "time.sleep(0.05)", [Level.NOTE]),
        ("arm.py", "time.sleep(0.05)\n        time.sleep(0.5)", [Level.WARNING]),
        ("arm.py", "for i in range(3):\n            time.sleep(0.5)", [Level.NOTE]),
        ("arm_calibration.py", "time.sleep(0.5)", [Level.NOTE]),
        ("arm_bringup.py", "time.sleep(0.5)", [Level.NOTE]),
        ("map_saver.py", "time.sleep(0.5)", [Level.NOTE]),
        ("arm.py", "time.sleep(0.01)", []),
    ],
)
def test_sleeps_in_callbacks(path: str, body: str, expected: list[Level], tmp_path: Path) -> None:
    files = {
        "package.xml": ROS2.replace("rclcpp", "rclpy"),
        "CMakeLists.txt": CMAKE.format(f"install(PROGRAMS {path} DESTINATION lib/demo)"),
        path: "#!/usr/bin/env python3\n" + SLEEPER.format(body),
    }
    assert levels("sleep-in-callback", files, tmp_path) == expected


@pytest.mark.parametrize(
    ("ignored", "expected"),
    [
        ("", Level.ERROR),
        ("# config/made.yaml\n", Level.ERROR),
        ("/made.yaml\n", Level.ERROR),
        ("*.yaml\n!config/*.yaml\n", Level.ERROR),
        ("madely.yaml\nbuild/\n", Level.ERROR),
        ("config/made.yaml\n", Level.NOTE),
        ("/config/made.yaml\n", Level.NOTE),
        ("made.yaml\n", Level.NOTE),
        ("*.yaml\n", Level.NOTE),
        ("config/\n", Level.NOTE),
        ("**/made.*\n", Level.NOTE),
        ("!other.yaml\n*.y?ml\n", Level.NOTE),
    ],
)
@pytest.mark.parametrize(
    ("check", "tag"),
    [
        (
            "parameter-file-missing",
            '<node pkg="demo" exec="n"><param from="$(find-pkg-share demo)/config/made.yaml"/></node>',
        ),
        ("missing-launch-file", '<include file="$(find-pkg-share demo)/config/made.yaml"/>'),
    ],
)
def test_a_file_that_git_ignores_is_made_elsewhere(
    ignored: str, expected: Level, check: str, tag: str, tmp_path: Path
) -> None:
    files = {
        "package.xml": ROS2,
        "CMakeLists.txt": CMAKE.format("install(DIRECTORY launch config DESTINATION share/demo)"),
        "config/other.yaml": "/**:\n  ros__parameters:\n    a: 1\n",
        "launch/a.launch.xml": f"<launch>{tag}</launch>\n",
        **({".gitignore": ignored} if ignored else {}),
    }
    assert levels(check, files, tmp_path) == [expected]


OWN = '<arg name="robot" default="$(var robot)"/>'
READS = '<launch><node pkg="demo" exec="n" namespace="$(var robot)"/></launch>\n'
SIMILAR = READS.replace("<node", '<arg name="robots" default=""/><node')


@pytest.mark.parametrize(
    ("files", "expected"),
    [
        ({}, Level.WARNING),
        ({"README.md": "ros2 launch demo a.launch.xml my_robot:=r1\n"}, Level.WARNING),
        ({"README.md": "ros2 launch demo a.launch.xml robot:=r1\n"}, Level.NOTE),
        ({"run.sh": "ros2 launch demo a.launch.xml robot:=$1\n"}, Level.NOTE),
        ({"launch/a.launch.xml": f"<!-- robot:=NAME is needed -->\n{READS}"}, Level.NOTE),
        ({"launch/a.launch.xml": f"<!--\n  Copyright 2016 The Mapping Authors\n-->\n{READS}"}, Level.NOTE),
        (
            {"launch/a.launch.xml": f"<?xml version='1.0'?>\n<!-- Copyright (c) 2016, Mapping, Inc. -->\n{READS}"},
            Level.NOTE,
        ),
        ({"launch/a.launch.xml": f"<!-- Copyright 2016 The Robot Authors -->\n{READS}"}, Level.WARNING),
        ({"launch/a.launch.xml": f"<!-- Copyright 2016 The Rclcpp Authors -->\n{READS}"}, Level.WARNING),
        ({"launch/a.launch.xml": f"<!-- Maps. -->\n{READS}<!-- Copyright 2016 Mapping -->\n"}, Level.WARNING),
        ({"launch/a.launch.xml": f"<!-- Copyright 2016 Mapping, 2020 -->\n{SIMILAR}"}, Level.ERROR),
        ({"launch/a.launch.xml": READS.replace("<node", '<arg name="robots" default=""/><node')}, Level.ERROR),
        ({"launch/a.launch.xml": READS.replace("</launch>", '<arg name="robot" default=""/></launch>')}, Level.ERROR),
        ({"launch/a.launch.xml": READS.replace("<node", f"{OWN}<node")}, Level.WARNING),
        (
            {
                "launch/a.launch.xml": READS.replace("<node", f"{OWN}<node"),
                "run.sh": "ros2 launch demo a.launch.xml robot:=$1\n",
            },
            Level.NOTE,
        ),
        (
            {"launch/a.launch.xml": READS.replace("<node", f"{OWN.replace('(var robot)', '(var robots)')}<node")},
            Level.ERROR,
        ),
    ],
)
def test_a_launch_configuration_that_the_command_line_can_give(
    files: dict[str, str], expected: Level, tmp_path: Path
) -> None:
    cmake = CMAKE.format("install(DIRECTORY launch DESTINATION share/demo)")
    every = {"package.xml": ROS2, "CMakeLists.txt": cmake, "launch/a.launch.xml": READS, **files}
    assert levels("unset-launch-argument", every, tmp_path) == [expected]


OLD_READS = '<launch><node pkg="demo" type="n" name="n" ns="$(arg robot)"/></launch>\n'


@pytest.mark.parametrize(
    ("files", "expected"),
    [
        ({}, Level.ERROR),
        ({"launch/a.launch": OLD_READS.replace("<node", '<arg name="rate" default="1"/><node')}, Level.ERROR),
        ({"launch/a.launch": OLD_READS.replace("<node", '<param name="robot" value="r1"/><node')}, Level.ERROR),
        ({"README.md": "roslaunch demo b.launch robot:=r1\n", "launch/b.launch": "<launch/>"}, Level.ERROR),
        # what the command line is meant to give, or a file that others include
        ({"README.md": "roslaunch demo a.launch robot:=r1\n"}, Level.NOTE),
        ({"launch/a.launch": f"<!-- Copyright 2016 The Mapping Authors -->\n{OLD_READS}"}, Level.NOTE),
        ({"launch/a.launch": OLD_READS.replace("robot", "bag_filename")}, Level.WARNING),
        ({"launch/a.launch": OLD_READS.replace("robot", "file")}, Level.WARNING),
        ({"launch/a.launch": OLD_READS.replace("robot", "log_path")}, Level.WARNING),
        ({"launch/a.launch": OLD_READS.replace("robot", "robot_ip")}, Level.WARNING),
        ({"launch/a.launch": OLD_READS.replace("robot", "port")}, Level.WARNING),
        ({"launch/a.launch": OLD_READS.replace("robot", "transport")}, Level.ERROR),
        ({"launch/a.launch": OLD_READS.replace("ns=", 'args="$(arg robot)" ns=')}, Level.ERROR),
        ({"launch/a.launch": OLD_READS.replace("ns=", "if=")}, Level.ERROR),
        (
            {"launch/a.launch": OLD_READS.replace("<node", '<arg name="is_on"/><node if="$(arg is_on)"')},
            Level.WARNING,
        ),
        ({"launch/a.launch": "<launch/>", "launch/include/b.launch": OLD_READS}, Level.WARNING),
        ({"launch/a.launch": "<launch/>", "launch/b.launch.xml": OLD_READS}, Level.WARNING),
    ],
)
def test_an_argument_without_which_roslaunch_stops(files: dict[str, str], expected: Level, tmp_path: Path) -> None:
    every = {"package.xml": ROS1, "CMakeLists.txt": CATKIN, "launch/a.launch": OLD_READS, **files}
    assert levels("unset-launch-argument", every, tmp_path) == [expected]


def test_arguments_beside_one_that_the_command_line_is_to_give(tmp_path: Path) -> None:
    play = '<launch><node pkg="demo" type="n" name="n" args="$(arg bag_filename) --rate $(arg rate)"/></launch>\n'
    every = {"package.xml": ROS1, "CMakeLists.txt": CATKIN, "launch/a.launch": play}
    assert levels("unset-launch-argument", every, tmp_path) == [Level.WARNING, Level.WARNING]


@pytest.mark.parametrize(
    ("packages", "uses", "declares", "expected"),
    [
        (2, "joy", "", [Level.WARNING, Level.WARNING]),
        (3, "joy", "", [Level.NOTE] * 3),
        (3, "joy", "<exec_depend>joy</exec_depend>", [Level.WARNING, Level.WARNING]),
        (1, "rqt_graph", "", [Level.NOTE]),
        (1, "moveit_setup_assistant", "", [Level.NOTE]),
    ],
)
def test_dependencies_of_launch_files_from_a_generator(
    packages: int, uses: str, declares: str, expected: list[Level], tmp_path: Path
) -> None:
    """*declares* is what the last package of several has."""
    files = {}
    for number in range(packages):
        more = declares if number + 1 == packages else ""
        build = "<export><build_type>ament_cmake</build_type></export>"
        manifest = PACKAGE.format("ament_cmake", "rclcpp", more + build)
        files[f"p{number}/package.xml"] = manifest.replace("demo", f"p{number}")
        files[f"p{number}/CMakeLists.txt"] = CMAKE.format("install(DIRECTORY launch DESTINATION share/demo)")
        files[f"p{number}/launch/a.launch.xml"] = f'<launch><node pkg="{uses}" exec="x"/></launch>\n'
    assert levels("undeclared-launch-dependency", files, tmp_path) == expected


@pytest.mark.parametrize(
    ("sources", "expected"),
    [
        ("words.hpp", Level.WARNING),
        ("words.hpp more.h", Level.WARNING),
        ("words.hpp words.cpp", Level.ERROR),
        ("words.cpp", Level.ERROR),
    ],
)
def test_a_shared_library_that_has_only_headers(sources: str, expected: Level, tmp_path: Path) -> None:
    cmake = f"add_library(words SHARED {sources})\nset_target_properties(words PROPERTIES LINKER_LANGUAGE CXX)\n"
    cmake += "add_executable(talker talker.cpp)\ntarget_link_libraries(talker words)\n"
    cmake += "install(TARGETS talker DESTINATION lib/demo)"
    texts = dict.fromkeys(sources.split(), "int word();\n")
    files = {"package.xml": ROS2, "CMakeLists.txt": CMAKE.format(cmake), "talker.cpp": "int main() {}\n", **texts}
    assert levels("target-not-installed", files, tmp_path) == [expected]


@pytest.mark.parametrize(
    ("declared", "asked", "expected"),
    [
        ("nav2_controller", "", [Level.WARNING]),
        ("nav2_controller", "ament_index_python.get_packages_with_prefixes()\n    ", [Level.NOTE]),
        ("house_of_robots_stack", "", [Level.NOTE]),
        ("nav2_dwb_controller", "", []),
        ("navigation2", "", []),
    ],
)
def test_plugins_of_packages_that_are_not_declared(
    declared: str, asked: str, expected: list[Level], tmp_path: Path
) -> None:
    launch = (
        "import ament_index_python\n"
        "from launch import LaunchDescription\nfrom launch_ros.actions import Node\n\n\n"
        f"def generate_launch_description():\n    {asked}return LaunchDescription([Node(package='nav2_controller',\n"
        "        executable='controller_server', parameters=[{'FollowPath.plugin': 'dwb_core::DWBLocalPlanner'}])])\n"
    )
    files = {
        "package.xml": ROS2.replace("<export>", f"<exec_depend>{declared}</exec_depend><export>"),
        "CMakeLists.txt": CMAKE.format("install(DIRECTORY launch DESTINATION share/demo)"),
        "launch/a.launch.py": launch,
    }
    assert levels("undeclared-plugin-dependency", files, tmp_path) == expected


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("nav.yaml", [Level.WARNING]),
        ("latest.yaml", [Level.WARNING]),
        ("contest_nav.yaml", [Level.WARNING]),
        ("test_nav.yaml", [Level.NOTE]),
        ("nav_test.yaml", [Level.NOTE]),
        ("nav_test_params.yaml", [Level.NOTE]),
    ],
)
def test_plugins_in_parameters_for_tests(name: str, expected: list[Level], tmp_path: Path) -> None:
    launch = (
        "from launch import LaunchDescription\nfrom launch_ros.actions import Node\n"
        "from launch_ros.substitutions import FindPackageShare\nfrom launch.substitutions import PathJoinSubstitution\n\n\n"
        f"def generate_launch_description():\n    params = PathJoinSubstitution([FindPackageShare('demo'), 'config', {name!r}])\n"
        "    return LaunchDescription([Node(package='nav2_controller', executable='controller_server', parameters=[params])])\n"
    )
    files = {
        "package.xml": ROS2.replace("<export>", "<exec_depend>nav2_controller</exec_depend><export>"),
        "CMakeLists.txt": CMAKE.format("install(DIRECTORY launch config DESTINATION share/demo)"),
        "launch/a.launch.py": launch,
        f"config/{name}": 'controller_server:\n  ros__parameters:\n    FollowPath:\n      plugin: "dwb_core::DWBLocalPlanner"\n',
    }
    assert levels("undeclared-plugin-dependency", files, tmp_path) == expected


@pytest.mark.parametrize(
    ("places", "expected"),
    [
        (("launch/a.launch",), [Level.WARNING]),
        (("test/a.launch",), [Level.NOTE]),
        (("test/urdf/a.launch", "tests/b.launch"), [Level.NOTE]),
        (("launch/test_a.launch",), [Level.WARNING]),
        (("test/a.launch", "README.md"), [Level.WARNING]),
        (("test/a.launch", "launch/a.launch"), [Level.WARNING]),
        (("launch/latest.launch",), [Level.WARNING]),
    ],
)
def test_a_dependency_of_launch_files_for_tests(places: tuple[str, ...], expected: list[Level], tmp_path: Path) -> None:
    launch = '<launch><node pkg="joy" type="joy_node" name="joy"/></launch>\n'
    files = {"package.xml": ROS1, "CMakeLists.txt": CATKIN, **dict.fromkeys(places, launch)}
    if "README.md" in files:
        files["README.md"] = "Start it with `roslaunch demo a.launch`.\n"
    assert levels("undeclared-launch-dependency", files, tmp_path) == expected


@pytest.mark.parametrize(
    ("readme", "expected"),
    [("", Level.WARNING), ("For ROS 2 Foxy.\n", Level.NOTE), ("For ROS 2 Foxy and Humble.\n", Level.WARNING)],
)
def test_keywords_that_old_distributions_have(readme: str, expected: Level, tmp_path: Path) -> None:
    launch = (
        "from launch import LaunchDescription\nfrom launch_ros.actions import Node\n\n\ndef generate_launch_description():\n"
        "    return LaunchDescription([Node(package='joy', node_executable='joy_node')])\n"
    )
    files = {"package.xml": ROS2, "CMakeLists.txt": CMAKE.format(""), "launch/a.launch.py": launch, "README.md": readme}
    assert levels("deprecated-launch-keyword", files, tmp_path) == [expected]


BOTH = "cmake_minimum_required(VERSION 3.8)\nproject(demo)\n{}\n  find_package(ament_cmake REQUIRED)\n  ament_package()\nendif()\n"
CONDITION = '<depend condition="$ROS_VERSION == 2">rclcpp</depend>'


@pytest.mark.parametrize(
    ("more", "start", "expected"),
    [
        (CONDITION, "if($ENV{ROS_VERSION} EQUAL 1)\ncatkin_package()\nelse()", True),
        ("", 'if("$ENV{ROS_VERSION}" STREQUAL "1")\ncatkin_package()\nelse()', True),
        (CONDITION, "if(TRUE)", True),
        ("", "if(TRUE)", False),
        (f"<!-- {CONDITION} -->", "if(TRUE) # ROS_VERSION", False),
    ],
)
def test_a_build_type_for_one_of_two_ros(more: str, start: str, expected: bool, tmp_path: Path) -> None:
    files = {"package.xml": PACKAGE.format("ament_cmake", "rclcpp", more), "CMakeLists.txt": BOTH.format(start)}
    check = next(check for check in checks() if check.id == "wrong-build-type")
    (result,) = said(check, Example("", True, files), tmp_path)
    condition = ' condition="$ROS_VERSION == 2"' if expected else ""
    assert f"<build_type{condition}>ament_cmake</build_type>" in result.message
    assert (result.level, bool(result.fixes)) == (Level.WARNING if expected else Level.ERROR, not expected)


@pytest.mark.parametrize(
    ("made", "exported", "expected"),
    [
        (
            "add_executable(demo_node a.cpp)",
            "catkin_package(LIBRARIES demo)",
            "the package builds none: remove the name",
        ),
        (
            "add_executable(demo_node a.cpp)",
            "catkin_package(LIBRARIES demo_nod)",
            "the package builds none: remove the name",
        ),
        ("add_library(demo_core a.cpp)", "catkin_package(LIBRARIES demo_cor)", "; did you mean demo_core?"),
        (
            "add_library(demo_core a.cpp)\nadd_executable(demo_node a.cpp)",
            "catkin_package(LIBRARIES demo_nod)",
            "; the package builds demo_core",
        ),
        ("", "catkin_package(LIBRARIES demo)", "; remove the name"),
    ],
)
def test_an_exported_library_is_no_executable(made: str, exported: str, expected: str, tmp_path: Path) -> None:
    files = {
        "package.xml": PACKAGE.format("catkin", "roscpp", ""),
        "CMakeLists.txt": f"project(demo)\nfind_package(catkin REQUIRED COMPONENTS roscpp)\n{exported}\n{made}\n",
        "a.cpp": "int main() {}\n",
    }
    check = next(check for check in checks() if check.id == "unknown-target")
    (result,) = said(check, Example("", True, files), tmp_path)
    assert result.message.endswith(expected)
    assert "did you mean demo_node" not in result.message


USER = "<package format='2'><name>user</name><version>1.0.0</version><description>d</description><maintainer email='a@b.c'>a</maintainer>"
USER += "<license>MIT</license><buildtool_depend>catkin</buildtool_depend>{}</package>\n"


@pytest.mark.parametrize(
    ("depends", "level"),
    [
        ("<depend>demo</depend>", Level.ERROR),
        ("<build_depend>demo</build_depend>", Level.ERROR),
        ("<exec_depend>demo</exec_depend>", Level.WARNING),
        ("<test_depend>demo</test_depend>", Level.WARNING),
        ("", Level.WARNING),
    ],
)
def test_exported_libraries_that_are_not_built_fail_in_packages_that_are_built_against_them(
    tmp_path: Path, depends: str, level: Level
) -> None:
    files = {
        "demo/package.xml": ROS1,
        "demo/CMakeLists.txt": "project(demo)\nfind_package(catkin REQUIRED)\ncatkin_package(INCLUDE_DIRS include LIBRARIES demo_a demo_b)\n",
        "demo/include/demo/a.h": "int a();\n",
        "user/package.xml": USER.format(depends),
        "user/CMakeLists.txt": "project(user)\nfind_package(catkin REQUIRED)\ncatkin_package()\n",
    }
    check = next(check for check in checks() if check.id == "unknown-target")
    (result,) = said(check, Example("", True, files), tmp_path)
    assert result.level is level and "demo_a and demo_b are not targets of demo" in result.message
    assert ("no package here is built against it" in result.message) == (level is Level.WARNING)
    assert result.subject == ("demo", "demo_a", "demo_b")


@pytest.mark.parametrize(
    ("cmake", "level"),
    [
        ("catkin_package(CATKIN_DEPENDS demo)", Level.ERROR),
        ("catkin_package(LIBRARIES user_a CATKIN_DEPENDS roscpp demo)", Level.ERROR),
        ("catkin_package(DEPENDS demo)", Level.ERROR),
        ("catkin_package(CATKIN_DEPENDS roscpp)\nfind_package(demo)", Level.ERROR),
        ("catkin_package(LIBRARIES demo)", Level.WARNING),
        ("catkin_package(INCLUDE_DIRS demo LIBRARIES demo CATKIN_DEPENDS roscpp)", Level.WARNING),
        ("catkin_package(CATKIN_DEPENDS roscpp EXPORTED_TARGETS demo)", Level.WARNING),
        ("catkin_package(CFG_EXTRAS demo)", Level.WARNING),
        ("catkin_package()\nmessage(demo)", Level.WARNING),
    ],
)
def test_a_library_that_another_package_exports_under_the_name_of_this_one_is_no_use_of_it(
    tmp_path: Path, cmake: str, level: Level
) -> None:
    files = {
        "demo/package.xml": ROS1,
        "demo/CMakeLists.txt": "project(demo)\nfind_package(catkin REQUIRED)\ncatkin_package(INCLUDE_DIRS include LIBRARIES demo_a)\n",
        "demo/include/demo/a.h": "int a();\n",
        "user/package.xml": USER.format("<exec_depend>demo</exec_depend>"),
        "user/CMakeLists.txt": f"project(user)\nfind_package(catkin REQUIRED)\n{cmake}\n",
    }
    check = next(check for check in checks() if check.id == "unknown-target")
    found = [result for result in said(check, Example("", True, files), tmp_path) if result.subject[0] == "demo"]
    assert [result.level for result in found] == [level]


PROGRAM = "add_executable(walk a.cpp)\n"


def test_a_program_that_is_exported_as_a_library_fails_who_is_built_against_it(tmp_path: Path) -> None:
    files = {
        "demo/package.xml": ROS1,
        "demo/CMakeLists.txt": f"project(demo)\nfind_package(catkin REQUIRED)\n{PROGRAM}catkin_package(LIBRARIES walk)\n",
        "demo/a.cpp": "int main() { return 0; }\n",
        "user/package.xml": USER.format("<depend>demo</depend>"),
        "user/CMakeLists.txt": "project(user)\nfind_package(catkin REQUIRED COMPONENTS demo)\ncatkin_package()\n",
    }
    check = next(check for check in checks() if check.id == "unknown-target")
    found = [result for result in said(check, Example("", True, files), tmp_path) if result.subject[0] == "demo"]
    assert [result.level for result in found] == [Level.ERROR]


@pytest.mark.parametrize(
    ("cmake", "told"),
    [
        ("catkin_package(LIBRARIES walk)\n" + PROGRAM, "walk is a program of demo, and no library: no package here is built against it yet; one that is will not find the library; LIBRARIES takes libraries, and the package builds none: remove the name"),
        (PROGRAM + "catkin_package(LIBRARIES walk)\n", "remove the name"),
        ("catkin_package(LIBRARIES ${PROJECT_NAME})\nadd_executable(${PROJECT_NAME} a.cpp)", "demo is a program of demo, and no library"),
        (PROGRAM + "add_executable(run a.cpp)\ncatkin_package(LIBRARIES walk run)", "walk and run are programs of demo, and no libraries: no package here is built against it yet; one that is will not find the libraries; remove the names"),
        (PROGRAM + "add_library(walks a.cpp)\ncatkin_package(LIBRARIES walk)", "; did you mean walks?"),
        (PROGRAM + "add_library(walks a.cpp)\ncatkin_package(LIBRARIES walks walk)", "; LIBRARIES takes libraries: remove the name"),
    ],
)  # fmt: skip
def test_programs_that_are_exported_as_libraries(tmp_path: Path, cmake: str, told: str) -> None:
    files = {
        "package.xml": ROS1,
        "CMakeLists.txt": f"project(demo)\nfind_package(catkin REQUIRED)\n{cmake}\n",
        "a.cpp": "int main() { return 0; }\n",
    }
    check = next(check for check in checks() if check.id == "unknown-target")
    (result,) = said(check, Example("", True, files), tmp_path)
    assert result.message.endswith(told) or (told.startswith("demo is") and told in result.message)
    assert result.level is Level.NOTE  # nobody is built against the package


@pytest.mark.parametrize(
    "cmake",
    [
        PROGRAM + "catkin_package()",
        "add_library(walk a.cpp)\ncatkin_package(LIBRARIES walk)",
        "add_library(walk SHARED a.cpp)\nadd_executable(walk_node a.cpp)\ncatkin_package(LIBRARIES walk)",
        PROGRAM + "add_library(walker a.cpp)\nset_target_properties(walker PROPERTIES OUTPUT_NAME walk)\ncatkin_package(LIBRARIES walk)",
        PROGRAM + "set_target_properties(walk PROPERTIES ENABLE_EXPORTS TRUE)\ncatkin_package(LIBRARIES walk)",
        PROGRAM + "set_property(TARGET walk PROPERTY ENABLE_EXPORTS ON)\ncatkin_package(LIBRARIES walk)",
        "set(CMAKE_ENABLE_EXPORTS ON)\n" + PROGRAM + "catkin_package(LIBRARIES walk)",
        PROGRAM + "add_library(run a.cpp)\ntarget_link_libraries(run walk)\ncatkin_package(LIBRARIES walk)",
        "find_package(X)\nif(X_FOUND)\n" + PROGRAM + "else()\nadd_library(walk a.cpp)\nendif()\ncatkin_package(LIBRARIES walk)",
        PROGRAM + "a_macro_of_somebody(walk)\ncatkin_package(LIBRARIES walk)",
        PROGRAM + "add_custom_command(OUTPUT libwalk.so COMMAND make)\ncatkin_package(LIBRARIES walk)",
        PROGRAM + "catkin_package(CATKIN_DEPENDS roscpp CFG_EXTRAS walk)",
        PROGRAM + "catkin_package(LIBRARIES walk)\ncatkin_package()",
    ],
)  # fmt: skip
def test_what_is_exported_may_be_a_library(tmp_path: Path, cmake: str) -> None:
    files = {
        "package.xml": PACKAGE.format("catkin", "roscpp", ""),
        "CMakeLists.txt": f"project(demo)\nfind_package(catkin REQUIRED)\n{cmake}\n",
        "a.cpp": "int main() { return 0; }\n",
    }
    check = next(check for check in checks() if check.id == "unknown-target")
    assert not [result.message for result in said(check, Example("", True, files), tmp_path)]


@pytest.mark.parametrize(
    ("cmake", "told"),
    [
        (
            "add_library(demo_one a.cpp)\nadd_library(demo_two a.cpp)\ncatkin_package(LIBRARIES demo_ones demo_twos)",
            "demo_one and demo_two?",
        ),
        (
            "add_library(filters a.cpp)\ncatkin_package(LIBRARIES demo_ones demo_twos)",
            "the package builds filters: write the right ones",
        ),
        ("catkin_package(LIBRARIES demo_ones demo_twos)", "; remove the names"),
        ("catkin_package(LIBRARIES demo_ones)\ncatkin_package(LIBRARIES demo_twos)", "demo_twos is not a target"),
        ("catkin_package(LIBRARIES demo_ones)\ncatkin_package()", None),
        ("find_package(X)\ncatkin_package(LIBRARIES demo_ones)\nif(X_FOUND)\ncatkin_package()\nendif()", None),
    ],
)
def test_what_to_export_instead(tmp_path: Path, cmake: str, told: str | None) -> None:
    files = {
        "package.xml": ROS1,
        "CMakeLists.txt": f"project(demo)\nfind_package(catkin REQUIRED)\n{cmake}\n",
        "a.cpp": "int a;\n",
    }
    check = next(check for check in checks() if check.id == "unknown-target")
    found = [result.message for result in said(check, Example("", True, files), tmp_path)]
    assert len(found) == (told is not None) and all(str(told) in message for message in found), found


def test_a_file_that_is_included_twice_is_one_finding(tmp_path: Path) -> None:
    inner = "".join(f'<node pkg="demo" type="n.py" name="{name}"/>' for name in "abc").join(("<launch>", "</launch>\n"))
    files = {
        "package.xml": ROS1,
        "CMakeLists.txt": CATKIN,
        "n.py": "import rospy\nrospy.init_node('n')\nrospy.spin()\n",
        "launch/inner.launch": inner,
        "launch/all.launch": "<launch>" + '<include file="$(find demo)/launch/inner.launch"/>' * 2 + "</launch>\n",
    }
    check = next(check for check in checks() if check.id == "duplicate-node-name")
    (result,) = said(check, Example("", True, files), tmp_path)
    assert "two nodes are named /a " in result.message
    assert "launch/inner.launch is included twice, so that there are two /b and /c, too" in result.message


def test_an_exported_library_of_a_package_with_nothing_to_build_against_is_a_note(tmp_path: Path) -> None:
    files = {
        "package.xml": ROS1,
        "CMakeLists.txt": CATKIN.replace("catkin_package()", "catkin_package(LIBRARIES demo)"),
    }
    assert levels("unknown-target", files, tmp_path) == [Level.NOTE]


def test_a_library_that_an_ament_package_exports_is_a_warning(tmp_path: Path) -> None:
    """Its headers are not told from its commands for CMake."""
    files = {"package.xml": ROS2, "CMakeLists.txt": CMAKE.format("ament_export_libraries(demo)")}
    assert levels("unknown-target", files, tmp_path) == [Level.WARNING]


def test_nodes_of_one_name_stop_roslaunch(tmp_path: Path) -> None:
    node = '<launch><node pkg="demo" type="n.py" name="n"/></launch>\n'
    files = {
        "package.xml": ROS1,
        "CMakeLists.txt": CATKIN,
        "n.py": "import rospy\nrospy.init_node('n')\nrospy.spin()\n",
        "launch/a.launch": node,
        "launch/b.launch": node,
        "launch/all.launch": "".join(f'<include file="$(find demo)/launch/{each}.launch"/>' for each in "ab").join(
            ("<launch>", "</launch>\n")
        ),
    }
    check = next(check for check in checks() if check.id == "duplicate-node-name")
    (result,) = said(check, Example("", True, files), tmp_path)
    assert (result.level, 'roslaunch refuses to start ("multiple nodes named")' in result.message) == (
        Level.ERROR,
        True,
    )


@pytest.mark.parametrize(
    ("again", "expected"),
    [
        (
            "<link name='world' />\n<joint name = 'j' type='fixed'><parent link='world'/><child link='base'/></joint>",
            "delete them here",
        ),
        ("<link name='world'/>", "delete it here"),
        ("<link name='world'><visual/></link>", "rename one of the two"),
        ("<joint name='j' type='fixed'><parent link='base'/><child link='world'/></joint>", "rename one of the two"),
    ],
)
def test_blocks_of_a_robot_that_are_repeated(again: str, expected: str, tmp_path: Path) -> None:
    first = "<link name='world'/>\n<joint name='j' type='fixed'><parent link='world'/>\n<child link='base'/></joint>"
    files = {
        "package.xml": ROS1,
        "CMakeLists.txt": CATKIN,
        "urdf/a.urdf": f"<robot name='a'>\n<link name='base'/>\n{first}\n{again}\n</robot>\n",
    }
    check = next(check for check in checks() if check.id == "broken-robot-model")
    (result,) = said(check, Example("", True, files), tmp_path)
    assert result.message.endswith(expected)


NODELETS = PACKAGE.format("catkin", "nodelet", '<export><nodelet plugin="${prefix}/nodelets.xml"/></export>')
FILTERS = '<library path="lib/libf"><class name="demo/Filter" type="demo::Filter" base_class_type="{}"/></library>\n'
LIBRARY = (
    CATKIN + "add_library(f SHARED f.cpp)\ninstall(FILES a.yaml DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})\n"
)


@pytest.mark.parametrize(
    ("files", "base", "expected"),
    [
        ({}, "nodelet::Nodelet", Level.NOTE),
        ({"CHANGELOG.rst": "* add demo/Filter\n"}, "nodelet::Nodelet", Level.NOTE),
        ({"README.md": "It filters.\n"}, "nodelet::Nodelet", Level.NOTE),
        ({}, "filters::FilterBase<double>", Level.WARNING),
        ({"README.md": "    rosrun nodelet nodelet standalone demo/Filter\n"}, "nodelet::Nodelet", Level.WARNING),
        (
            {
                "launch/a.launch": '<launch><node pkg="nodelet" type="nodelet" name="f" args="load demo/Filter m"/></launch>'
            },
            "nodelet::Nodelet",
            Level.WARNING,
        ),
        ({"b.yaml": "plugins: [demo/Filter]\n"}, "nodelet::Nodelet", Level.WARNING),
    ],
)
def test_a_nodelet_that_nothing_loads(files: dict[str, str], base: str, expected: Level, tmp_path: Path) -> None:
    package = {"package.xml": NODELETS, "nodelets.xml": FILTERS.format(base), "f.cpp": "", "a.yaml": "a: 1\n"}
    package["CMakeLists.txt"] = LIBRARY
    assert levels("target-not-installed", {**package, **files}, tmp_path) == [expected]
    assert levels("directory-not-installed", {**package, **files}, tmp_path / "other") == []


PYTHON = "catkin_install_python(PROGRAMS scripts/b.py DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})\n"
A_FILE = "install(FILES a.yaml DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})\n"


@pytest.mark.parametrize(
    ("installs", "expected"),
    [(PYTHON, Level.NOTE), (A_FILE, Level.WARNING), (PYTHON + A_FILE, Level.WARNING), ("", Level.NOTE)],
)
def test_a_package_of_ros1_that_installs_scripts_alone(installs: str, expected: Level, tmp_path: Path) -> None:
    files = {
        "package.xml": ROS1,
        "CMakeLists.txt": f"{CATKIN}add_executable(speed a.cpp)\n{installs}",
        "a.cpp": "int main() { ros::init(); }\n",
        "a.yaml": "",
        "scripts/b.py": "#!/usr/bin/env python3\n",
        "launch/a.launch": '<launch><node pkg="demo" type="speed" name="s"/></launch>\n',
    }
    assert levels("target-not-installed", files, tmp_path) == [expected]


@pytest.mark.parametrize(
    ("launch", "comment", "expected"),
    [
        ("benchmark.launch", "## Add the non-installed benchmark", []),
        ("test_speed.launch", "# not installed", []),
        ("speed.launch", "## Add the non-installed benchmark", [Level.WARNING]),
        ("benchmark.launch", "## Add the benchmark", [Level.WARNING]),
        ("benchmark.launch", "## FIXME: not installed", [Level.WARNING]),
        ("benchmark.launch", "# a\n\n# not installed\n\n", [Level.WARNING]),
    ],
)
def test_a_program_that_is_not_to_be_installed(
    launch: str, comment: str, expected: list[Level], tmp_path: Path
) -> None:
    text = f"{comment}\nadd_executable(speed a.cpp)\ninstall(FILES a.yaml DESTINATION ${{CATKIN_PACKAGE_SHARE_DESTINATION}})\n"
    files = {
        "package.xml": ROS1,
        "CMakeLists.txt": CATKIN + text,
        "a.cpp": "int main() { ros::init(); }\n",
        "a.yaml": "",
    }
    started = '<launch><node pkg="demo" type="speed" name="s"/></launch>\n'
    assert levels("target-not-installed", {**files, f"launch/{launch}": started}, tmp_path) == expected


@pytest.mark.parametrize(
    ("tags", "expected", "text"),
    [
        ('<arg name="x" default="1" description="X."/>', Level.NOTE, "ignores it, with a warning; write doc"),
        ('<arg name="x" default="1" description="$(var y)"/>', Level.NOTE, "ignores it, with a warning; write doc"),
        ('<group scoped="true"/>', Level.NOTE, "ignores it, with a warning"),
        ('<node pkg="demo" type="n" exec="n" name="n"/>', Level.NOTE, "ignores it, with a warning; write type"),
        (
            '<node pkg="demo" type="n" name="n" namespace="a"/>',
            Level.WARNING,
            "so what it says does not take effect; write ns",
        ),
        ('<let name="x" value="$(var y)"/>', Level.WARNING, "so what it says does not take effect; write <arg>"),
        (
            '<set_env name="x" value="1"/><let name="x" value="1"/>',
            Level.WARNING,
            "ignores them, with a warning, so what they say",
        ),
        ('<node pkg="demo" exec="n" name="n"/>', Level.WARNING, "`roslaunch` rejects it"),
        ('<node pkg="demo" type="n" name="n" args="$(var x)"/>', Level.WARNING, "rejects the whole file"),
        ('<node pkg="demo" type="n" name="n" if="$(var x)"/>', Level.WARNING, "rejects the whole file"),
        ('<rosparam file="$(find-pkg-share demo)/a.yaml"/>', Level.WARNING, "rejects the whole file"),
        ('<param name="x" from="a.yaml"/>', Level.WARNING, "rejects the whole file"),
        (
            '<let name="x" value="1"/><node pkg="demo" type="n" name="$(var x)"/>',
            Level.WARNING,
            "rejects the whole file",
        ),
    ],
)
def test_what_roslaunch_passes_over_and_what_stops_it(tags: str, expected: Level, text: str, tmp_path: Path) -> None:
    old = '<node pkg="demo" type="n" name="o" ns="b" output="screen"/><param name="p" textfile="$(find demo)/a.txt"/>'
    files = {"package.xml": ROS1, "CMakeLists.txt": CATKIN, "launch/a.launch": f"<launch>{old}{tags}</launch>\n"}
    check = next(check for check in checks() if check.id == "foreign-launch-construct")
    (found,) = said(check, Example("", True, files), tmp_path)
    assert found.level == expected
    assert text in found.message


OF_NODE = (
    "cmake_minimum_required(VERSION 3.0)\nproject(demo)\nfind_package(catkin REQUIRED)\ncatkin_package()\n"
    "add_subdirectory(extern/serial)\nadd_executable(talker talker.cpp)\n"
)
SERIAL = "cmake_minimum_required(VERSION 3.0)\nproject(serial)\nadd_library(serial a.cpp)\ninstall(TARGETS serial DESTINATION lib)\n"


@pytest.mark.parametrize(
    ("manifest", "more", "expected"),
    [
        ("extern/serial/package.xml", "", Level.NOTE),
        ("elsewhere/serial/package.xml", "", Level.WARNING),
        ("extern/serial/package.xml", "install(FILES talker.cpp DESTINATION share/demo)\n", Level.WARNING),
    ],
)
def test_a_package_of_which_a_library_in_it_alone_is_installed(
    manifest: str, more: str, expected: Level, tmp_path: Path
) -> None:
    files = {
        "package.xml": ROS1.replace("rospy", "roscpp"),
        "CMakeLists.txt": OF_NODE + more,
        "talker.cpp": '#include <ros/ros.h>\nint main(int c, char ** v)\n{\n  ros::init(c, v, "t");\n  ros::NodeHandle n;\n}\n',
        "launch/a.launch": '<launch><node pkg="demo" type="talker" name="t"/></launch>\n',
        "extern/serial/CMakeLists.txt": SERIAL,
        "extern/serial/a.cpp": "int a;\n",
        manifest: ROS1.replace("demo", "serial"),
    }
    found = said(next(one for one in checks() if one.id == "target-not-installed"), Example("", True, files), tmp_path)
    assert [one.level for one in found if "talker" in one.message] == [expected]
