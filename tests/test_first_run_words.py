# SPDX-License-Identifier: Apache-2.0
"""What a first run says: one finding for one cause, advice that works, and nothing of what is only there to be looked at."""

from __future__ import annotations

from pathlib import Path

import pytest
from test_first_run import AMENT, CATKIN, MANIFEST, ROS1, ROS2, messages

from haros_ci.api.testing import said
from haros_ci.checking.page import Example
from haros_ci.model.similar_files import similar_names
from haros_ci.registry import checks
from haros_ci.results.rule import Level

CONFLICT = "a: 1\n<<<<<<< HEAD\nb: 2\n=======\nb: 3\n>>>>>>> {}\n"


@pytest.mark.parametrize(
    ("files", "count"),
    [
        ({"a.yaml": "main", "b.yaml": "main", "c/d.yaml": "main"}, 1),
        ({"a.yaml": "main", "b.yaml": "topic"}, 2),
        ({"a.yaml": "main"}, 1),
        ({"a.yaml": "main", "b.cmake": "main"}, 2),
    ],
)
def test_the_conflicts_of_one_merge(files: dict[str, str], count: int, tmp_path: Path) -> None:
    texts = {path: CONFLICT.format(name) for path, name in files.items()}
    found = messages("merge-conflict", {"package.xml": MANIFEST.format("demo", ROS1), **texts}, tmp_path)
    assert len(found) == count
    assert any("so do b.yaml and c/d.yaml" in message for message in found) is (len(files) == 3)


@pytest.mark.parametrize(
    ("names", "words"),
    [
        ("DEPENDS system_lib", ["exports system_lib, which catkin_create_pkg writes in the place of a name"]),
        ("DEPENDS Thing", ["exports Thing without a find_package() of it"]),
        ("DEPENDS system_lib Thing", ["exports system_lib, which", "exports Thing without"]),
        ("INCLUDE_DIRS include", []),
        ("# DEPENDS system_lib", []),
    ],
)
def test_a_placeholder_of_the_template(names: str, words: list[str], tmp_path: Path) -> None:
    cmake = f"cmake_minimum_required(VERSION 3.0)\nproject(demo)\nfind_package(catkin REQUIRED)\ncatkin_package(\n  {names}\n)\n"
    files = {"package.xml": MANIFEST.format("demo", ROS1), "CMakeLists.txt": cmake, "include/demo/a.h": "\n"}
    found = messages("unknown-target", files, tmp_path)
    assert len(found) == len(words)
    assert all(any(word in message for message in found) for word in words)


@pytest.mark.parametrize(
    ("awaited", "words"),
    [
        ("demo_messages_cpp", "has a name that no target has"),
        ("demo_generate_message_cpp demo_gen_cpp", "has names that no target has"),
        ("other", "; add add_dependencies(walk"),
        ("", "; add add_dependencies(walk"),
        ("demo_generate_messages_cpp", ""),
        ("demo_gencpp", ""),
        ("${PROJECT_NAME}_generate_messages_cpp", ""),
        ("${${PROJECT_NAME}_EXPORTED_TARGETS}", ""),
    ],
)
def test_a_generation_that_is_awaited_by_a_wrong_name(awaited: str, words: str, tmp_path: Path) -> None:
    program = (
        f"add_executable(walk walk.cpp)\nadd_custom_target(other)\nadd_dependencies(walk {awaited})"
        if awaited
        else "add_executable(walk walk.cpp)"
    )
    files = {
        "package.xml": MANIFEST.format("demo", ROS1),
        "CMakeLists.txt": CATKIN.format("demo", f"add_message_files(FILES A.msg)\ngenerate_messages()\n{program}"),
        "msg/A.msg": "int32 a\n",
        "walk.cpp": "#include <demo/A.h>\nint main() { return 0; }\n",
    }
    found = messages("generation-not-awaited", files, tmp_path)
    assert len(found) == (1 if words else 0)
    assert all(words in message for message in found)


@pytest.mark.parametrize(
    ("declared", "words"),
    [
        ('<arg name="skill"/>', "as it has no default, who includes or starts the file has to set it, for nothing"),
        ('<arg name="skill" default="a"/>', "setting it has no effect"),
        ('<arg name="skill" value="a"/>', "is set to a fixed value, but never read: use it"),
    ],
)
def test_an_argument_that_has_to_be_set_for_nothing(declared: str, words: str, tmp_path: Path) -> None:
    launch = f'<launch>\n  {declared}\n  <node pkg="demo" type="walk" name="walk"/>\n</launch>\n'
    files = {"package.xml": MANIFEST.format("demo", ROS1), "launch/walk.launch": launch}
    (message,) = messages("unused-launch-argument", files, tmp_path)
    assert words in message


CALL = """import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger

class Walk(Node):
    def __init__(self):
        super().__init__("walk")
        self.client = self.create_client(Trigger, "reset")
        self.timer = self.create_timer(1.0, self.tick)

    def tick(self):
        future = self.client.call_async(Trigger.Request())
        {}

rclpy.init()
rclpy.spin(Walk())
"""


@pytest.mark.parametrize(
    ("wait", "words"),
    [
        (
            "rclpy.spin_until_future_complete(self, future, timeout_sec=5.0)",
            "it waits until the timeout ends, each time",
        ),
        ("rclpy.spin_until_future_complete(self, future, None, 5.0)", "it waits until the timeout ends, each time"),
        ("rclpy.spin_until_future_complete(self, future, timeout_sec=None)", "(deadlock)"),
        ("rclpy.spin_until_future_complete(self, future)", "(deadlock)"),
        ("self.client.call(Trigger.Request())", "(deadlock)"),
        ("self.client.call(Trigger.Request(), timeout_sec=1.0)", "it waits until the timeout ends, each time"),
    ],
)
def test_a_wait_that_a_timeout_ends(wait: str, words: str, tmp_path: Path) -> None:
    files = {
        "package.xml": MANIFEST.format("demo", f"{ROS2}<depend>rclpy</depend>"),
        "CMakeLists.txt": AMENT.format("demo", "install(PROGRAMS walk.py DESTINATION lib/demo)"),
        "walk.py": CALL.format(wait),
    }
    (message,) = messages("blocking-wait-in-callback", files, tmp_path)
    assert words in message


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("simple_safety_monitor_depth.py", "simple_depth_safety_monitor.py"),
        ("monitor_simple_safety.py", "simple_safety_monitor.py"),
        ("simple_safety_monitors.py", "simple_safety_monitor.py"),
        ("simple_safety_monitor", "simple_safety_monitor.py"),
    ],
)
def test_a_name_of_the_same_words(name: str, expected: str) -> None:
    assert similar_names(name, ["simple_safety_monitor.py", "simple_depth_safety_monitor.py", "walk.py"])[0] == expected


SCRIPT = '#!/usr/bin/env python3\n{}\nimport rospy\nif __name__ == "__main__":\n    rospy.init_node("walk")\n'


@pytest.mark.parametrize(
    ("head", "count"),
    [
        ("# Walks to the goal.", 1),
        ('"""Walks."""', 1),
        ("", 1),
        ("# A demonstration of the converter, with a test case below.", 0),
        ('"""Example of a node."""', 0),
        ('"""\nShort demo.\n"""', 0),
    ],
)
def test_a_script_that_is_there_to_be_looked_at(head: str, count: int, tmp_path: Path) -> None:
    install = "catkin_install_python(PROGRAMS nodes/talk.py DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})"
    files = {
        "package.xml": MANIFEST.format("demo", f"{ROS1}<depend>rospy</depend>"),
        "CMakeLists.txt": CATKIN.format("demo", install),
        "nodes/talk.py": SCRIPT.format("# Talks."),
        "nodes/walk.py": SCRIPT.format(head),
    }
    assert len(messages("target-not-installed", files, tmp_path)) == count


@pytest.mark.parametrize(
    ("source", "launch", "count"),
    [
        ("src/walk.cpp", "launch/walk.launch", 1),
        ("examples/walk.cpp", "launch/walk.launch", 1),
        ("src/walk.cpp", "examples/walk.launch", 1),
        ("examples/walk.cpp", "examples/launch/walk.launch", 0),
        ("demo/walk.cpp", "demo/walk.launch", 0),
    ],
)
def test_an_example_that_its_own_launch_file_starts(source: str, launch: str, count: int, tmp_path: Path) -> None:
    programs = (
        f"add_executable(talk src/talk.cpp)\ninstall(TARGETS talk DESTINATION lib/base)\nadd_executable(walk {source})"
    )
    files = {
        "base/package.xml": MANIFEST.format("base", f"{ROS1}<depend>roscpp</depend>"),
        "base/CMakeLists.txt": CATKIN.format("base", programs),
        "base/src/talk.cpp": "#include <ros/ros.h>\nint main() { return 0; }\n",
        f"base/{source}": "#include <ros/ros.h>\nint main() { return 0; }\n",
        f"base/{launch}": '<launch><node pkg="base" type="walk" name="walk"/></launch>\n',
    }
    assert len(messages("target-not-installed", files, tmp_path)) == count


PART = '<robot xmlns:xacro="http://www.ros.org/wiki/xacro">\n<link name="imu"/>\n<joint name="j" type="fixed">\n<parent link="base"/>\n<child link="imu"/>\n</joint>\n</robot>\n'
LAUNCH = """import os
from launch import LaunchDescription
from launch.substitutions import Command
from launch_ros.actions import Node

def generate_launch_description():
    part = os.path.join("description", "part.xacro")
    return LaunchDescription([Node(package="robot_state_publisher", executable="robot_state_publisher",
        parameters=[{{"robot_description": Command(["xacro ", {}])}}])])
"""


@pytest.mark.parametrize(
    ("command", "count"),
    [
        ("part", 1),
        ('"robot.xacro", " sim:=false", part', 1),
        ('"robot.xacro", " control:=", part', 0),
        ('"robot.xacro control:=" + part', 0),
        ('"robot.xacro control:=/opt/part.xacro"', 0),
    ],
)
def test_a_part_of_a_robot_that_is_given_as_an_argument(command: str, count: int, tmp_path: Path) -> None:
    files = {
        "package.xml": MANIFEST.format("demo", ROS2),
        "CMakeLists.txt": AMENT.format("demo", ""),
        "description/part.xacro": PART,
        "launch/a.launch.py": LAUNCH.format(command),
    }
    assert len(messages("broken-robot-model", files, tmp_path)) == count


SKETCH = """#include <ros/ros.h>
#include <std_msgs/Int16.h>
class Motor {
  ros::NodeHandle nh;
  ros::Subscriber<std_msgs::Int16, Motor> sub;
  void turn(const std_msgs::Int16 & message);
public:
  Motor();
};
Motor::Motor() { %s }
"""


@pytest.mark.parametrize(
    ("call", "count"),
    [
        ("nh.subscribe(sub);", 0),
        ("nh.subscribe(this->sub);", 0),
        ("nh.advertiseService(sub);", 0),
        ('nh.subscribe("speed", 1, &Motor::turn, this);', 1),
        ("ros::SubscribeOptions options; nh.subscribe(options);", 1),
    ],
)
def test_what_rosserial_keeps(call: str, count: int, tmp_path: Path) -> None:
    files = {
        "package.xml": MANIFEST.format("demo", ROS1),
        "CMakeLists.txt": CATKIN.format("demo", "add_library(motor motor.cpp)"),
        "motor.cpp": SKETCH % call,
    }
    assert len(messages("subscription-not-kept", files, tmp_path)) == count


ROBOT = (
    '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">\n{}\n'
    '<link name="base">\n<visual>\n<origin xyz="${{b}} 0 0"/>\n<geometry><box size="${{a}} 1 1"/></geometry>\n</visual></link>\n</robot>\n'
)


@pytest.mark.parametrize(
    ("defined", "expected"),
    [
        ('<property name="a" value="1"/><property name="b" value="2"/>', ["lacks the prefix"]),
        ('<xacro:property name="a" value="1"/><property name="b" value="2"/>', ["lacks the prefix"]),
        ('<property name="a" value="1"/>', ["is not defined here: xacro stops", "lacks the prefix"]),
        ("", ["is not defined here: xacro stops", "is not defined here: xacro stops"]),
        ('<xacro:property name="a" value="1"/><xacro:property name="b" value="2"/>', []),
    ],
)
def test_properties_without_the_prefix(defined: str, expected: list[str], tmp_path: Path) -> None:
    files = {
        "package.xml": MANIFEST.format("demo", ROS2),
        "CMakeLists.txt": AMENT.format("demo", ""),
        "description/part.xacro": ROBOT.format(defined),
        "launch/a.launch.py": LAUNCH.format("part"),
    }
    found = messages("undefined-in-xacro", files, tmp_path)
    assert len(found) == len(expected)
    assert all(words in message for words, message in zip(expected, found, strict=True))


NAMED = """<launch>
  <arg name="model" default="{}"/>
  <arg name="other" default="$(arg model)"/>
  <rosparam file="$(find demo)/config/$(arg other)_joints.yaml" command="load"/>
</launch>
"""


@pytest.mark.parametrize(
    ("launch", "count"),
    [
        (NAMED.format(""), 0),
        (NAMED.format("").replace("config/$(arg other)_joints", "$(arg other)/config"), 1),
        (NAMED.format("walker"), 1),
        (NAMED.format("").replace("$(arg other)_joints", "joints"), 1),
        (NAMED.format("").replace("$(arg other)_joints", "_joints"), 1),
        (NAMED.format("config").replace("config/$(arg other)_joints", "$(arg other)/_joints"), 1),
    ],
)
def test_a_file_whose_name_is_to_be_given(launch: str, count: int, tmp_path: Path) -> None:
    files = {
        "package.xml": MANIFEST.format("demo", ROS1),
        "CMakeLists.txt": CATKIN.format("demo", ""),
        "launch/a.launch": launch,
    }
    assert len(messages("missing-launch-file", files, tmp_path)) == count


EXPERIMENT = '<launch>\n  <arg name="first" default="a"/>\n  <arg name="second" default="b"/>\n  <node pkg="demo" type="walk" name="$(arg {})"/>\n</launch>\n'


@pytest.mark.parametrize(
    ("names", "count"),
    [
        (("exp1.launch", "exp2.launch"), 0),
        (("run_1_map.launch", "run_2_map.launch"), 0),
        (("exp1.launch",), 1),
        (("exp1.launch", "other2.launch"), 2),
        (("exp_near.launch", "exp_far.launch"), 2),
    ],
)
def test_arguments_of_launch_files_that_differ_in_a_number(names: tuple[str, ...], count: int, tmp_path: Path) -> None:
    texts = zip(names, ("first", "second"), strict=False)
    files = {f"launch/{name}": EXPERIMENT.format(own) for name, own in texts}
    check = next(check for check in checks() if check.id == "unused-launch-argument")
    found = said(check, Example("", True, {"package.xml": MANIFEST.format("demo", ROS1), **files}), tmp_path)
    assert len([result for result in found if result.level is Level.WARNING]) == count


SETUP = "from setuptools import setup\nsetup(name='demo', packages=['demo'], entry_points={'console_scripts': ['walk = demo.walk:main']})\n"


@pytest.mark.parametrize(("build", "count"), [("ament_python", 1), ("ament_cmake", 0)])
def test_a_setup_script_that_is_left_over(build: str, count: int, tmp_path: Path) -> None:
    files = {
        "package.xml": MANIFEST.format("demo", ROS2.replace("ament_cmake", build)),
        "setup.py": SETUP,
        "demo/__init__.py": "",
        "demo/other.py": "",
    }
    if build == "ament_cmake":
        files["CMakeLists.txt"] = AMENT.format("demo", "ament_python_install_package(demo)")
    found = messages("python-package-incomplete", files, tmp_path)
    assert len([message for message in found if "demo.walk does not exist" in message]) == count


RANGED = """#include <rclcpp/rclcpp.hpp>
int main(int argc, char ** argv)
{{
  rclcpp::init(argc, argv);
  auto node = std::make_shared<rclcpp::Node>("walk");
  rcl_interfaces::msg::ParameterDescriptor descriptor;
  rcl_interfaces::msg::{kind} range;
  range.from_value = 1;
  range.to_value = 9;
  descriptor.{field}.push_back(range);
  node->declare_parameter("speed", {default}, descriptor);
  rclcpp::spin(node);
}}
"""


@pytest.mark.parametrize(
    ("kind", "default", "count"),
    [
        ("IntegerRange", "100", 1),
        ("FloatingPointRange", "100.0", 1),
        ("FloatingPointRange", "100", 0),
        ("IntegerRange", "100.0", 0),
        ("IntegerRange", "5", 0),
    ],
)
def test_a_range_for_values_of_another_type(kind: str, default: str, count: int, tmp_path: Path) -> None:
    field = "integer_range" if kind == "IntegerRange" else "floating_point_range"
    files = {
        "package.xml": MANIFEST.format("demo", f"{ROS2}<depend>rclcpp</depend>"),
        "CMakeLists.txt": AMENT.format(
            "demo", "add_executable(walk walk.cpp)\ninstall(TARGETS walk DESTINATION lib/demo)"
        ),
        "walk.cpp": RANGED.format(kind=kind, field=field, default=default),
        "launch/walk.launch.xml": '<launch><node pkg="demo" exec="walk"/></launch>\n',
    }
    assert len(messages("parameter-out-of-range", files, tmp_path)) == count


OLD_FILE = '<launch><arg name="a" default="b"/><node pkg="demo" type="walk" name="$(arg a)"/></launch>\n'
NEW_FILE = '<launch><node pkg="demo" exec="walk"/></launch>\n'


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        (3, 1, ["3 launch files of demo"]),
        (2, 0, ["all 2 launch files of demo"]),
        (4, 0, ["all 4 launch files of demo"]),
        (2, 1, ["ROS 1 launch file in a ROS 2 package", "ROS 1 launch file in a ROS 2 package"]),
        (1, 3, ["ROS 1 launch file in a ROS 2 package"]),
        (0, 3, []),
    ],
)
def test_launch_files_that_are_not_ported(old: int, new: int, words: list[str], tmp_path: Path) -> None:
    files = {"package.xml": MANIFEST.format("demo", ROS2)}
    files |= {f"launch/old{i}.launch": OLD_FILE for i in range(old)}
    files |= {f"launch/new{i}.launch.xml": NEW_FILE for i in range(new)}
    found = messages("foreign-launch-construct", files, tmp_path)
    assert len(found) == len(words)
    assert all(message.startswith(word) for word, message in zip(words, found, strict=True))


MACROS = '#include <rclcpp/rclcpp.hpp>\n{}\nint main(int argc, char ** argv)\n{{\n  rclcpp::init(argc, argv);\n  auto node = std::make_shared<rclcpp::Node>("walk");\n  int a = M0;\n  node->create_publisher<std_msgs::msg::Int32>({}, 1);\n  rclcpp::spin(node);\n}}\n'


def test_macros_with_many_definitions_that_name_each_other(tmp_path: Path) -> None:
    """Twelve to the power of nine ways to expand one: what is beyond a bound is unknown, and the rest is seen."""
    headers = {
        f"kind{kind}.h": "".join(f"#define M{level} (M{level + 1} + {kind})\n" for level in range(9))
        for kind in range(12)
    }
    includes = "\n".join(f'#include "{name}"' for name in headers)
    files = {
        "package.xml": MANIFEST.format("demo", f"{ROS2}<depend>rclcpp</depend>"),
        "CMakeLists.txt": AMENT.format(
            "demo", "add_executable(walk walk.cpp)\ninstall(TARGETS walk DESTINATION lib/demo)"
        ),
        "walk.cpp": MACROS.format(includes, '"a topic"'),
        "launch/walk.launch.xml": '<launch><node pkg="demo" exec="walk"/></launch>\n',
        **headers,
    }
    assert len(messages("invalid-name", files, tmp_path)) == 1
