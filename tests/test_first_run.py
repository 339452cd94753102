# SPDX-License-Identifier: Apache-2.0
"""What a first run says of repositories nobody tuned on: classes of findings that were false or unwelcome there, and what stays."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.api.testing import said
from haros_ci.checking.page import Example
from haros_ci.registry import checks

MANIFEST = (
    '<package format="3"><name>{}</name><version>0.1.0</version><description>d</description>'
    '<maintainer email="a@example.org">A</maintainer><license>MIT</license>{}</package>\n'
)
ROS1 = "<buildtool_depend>catkin</buildtool_depend>"
ROS2 = "<buildtool_depend>ament_cmake</buildtool_depend><export><build_type>ament_cmake</build_type></export>"
CATKIN = "cmake_minimum_required(VERSION 3.0)\nproject({})\nfind_package(catkin REQUIRED)\n{}\ncatkin_package()\n"
AMENT = "cmake_minimum_required(VERSION 3.8)\nproject({})\nfind_package(ament_cmake REQUIRED)\n{}\nament_package()\n"


def messages(name: str, files: dict[str, str], tmp_path: Path) -> list[str]:
    check = next(check for check in checks() if check.id == name)
    return [result.message for result in said(check, Example("", True, files), tmp_path)]


OLD_LAUNCH = '<launch><node pkg="laser" type="{}" name="laser"/></launch>\n'
NEW_LAUNCH = '<launch><node pkg="laser" exec="{}"/></launch>\n'
PROGRAM = "add_executable(laser_node laser.cpp)\ninstall(TARGETS laser_node DESTINATION lib/laser)"


@pytest.mark.parametrize(
    ("starts", "has", "program", "count"),
    [
        (1, 2, "laserNode", 0),
        (2, 1, "laserNode", 0),
        (1, 1, "laserNode", 1),
        (2, 2, "laserNode", 1),
        (1, 1, "laser_node", 0),
        (2, 2, "laser_node", 0),
    ],
)
def test_a_package_for_the_other_ros_says_nothing_of_a_program(
    starts: int, has: int, program: str, count: int, tmp_path: Path
) -> None:
    files = {
        "one/bringup/package.xml": MANIFEST.format("bringup", ROS1 if starts == 1 else ROS2),
        "one/bringup/CMakeLists.txt": (CATKIN if starts == 1 else AMENT).format("bringup", ""),
        "two/laser/package.xml": MANIFEST.format("laser", ROS1 if has == 1 else ROS2),
        "two/laser/CMakeLists.txt": (CATKIN if has == 1 else AMENT).format("laser", PROGRAM),
        "two/laser/laser.cpp": "int main() { return 0; }\n",
    }
    launch = "a.launch" if starts == 1 else "a.launch.xml"
    files[f"one/bringup/launch/{launch}"] = (OLD_LAUNCH if starts == 1 else NEW_LAUNCH).format(program)
    assert len(messages("unknown-executable", files, tmp_path)) == count


GENERATED = ("Action", "Goal", "Result", "Feedback", "ActionGoal", "ActionResult", "ActionFeedback")


@pytest.mark.parametrize(
    ("path", "count"),
    [
        *((f"msg/GoTo{ending}.msg", 0) for ending in GENERATED),
        ("msg/GoToGoals.msg", 1),
        ("msg/GoTo.msg", 1),
        ("msg/Other.msg", 1),
        ("msg/OtherAction.msg", 1),
        ("msg/Action.msg", 1),
    ],
)
def test_messages_that_add_action_files_makes(path: str, count: int, tmp_path: Path) -> None:
    lists = "add_message_files(FILES A.msg)\nadd_action_files(FILES GoTo.action)\ngenerate_messages()"
    files = {
        "package.xml": MANIFEST.format("demo", ROS1),
        "CMakeLists.txt": CATKIN.format("demo", lists),
        "msg/A.msg": "int32 a\n",
        "action/GoTo.action": "int32 a\n---\nint32 b\n---\nint32 c\n",
        path: "int32 a\n",
    }
    assert len(messages("interface-not-generated", files, tmp_path)) == count


TF = '<node pkg="tf2_ros" type="static_transform_publisher" name="a" args="0 0 0 0 0 0 {} {}"/>'
TF1 = '<node pkg="tf" type="static_transform_publisher" name="a" args="0 0 0 0 0 0 {} {} 100"/>'


@pytest.mark.parametrize(
    ("node", "parent", "child", "expected"),
    [
        (TF, "map", "map", "parent and child"),
        (TF1, "map", "map", "parent and child"),
        (TF, "/map", "map", ""),
        (TF1, "/map", "map", ""),
        (TF1, "map", "/map", ""),
        (TF, "map", "odom", ""),
    ],
)
def test_a_frame_in_itself_is_no_circle(node: str, parent: str, child: str, expected: str, tmp_path: Path) -> None:
    files = {
        "package.xml": MANIFEST.format("demo", ROS1),
        "CMakeLists.txt": CATKIN.format("demo", ""),
        "launch/a.launch": f"<launch>{node.format(parent, child)}</launch>\n",
    }
    found = messages("conflicting-transforms", files, tmp_path)
    assert [expected in text and "cycle" not in text for text in found] == [True] * bool(expected)


@pytest.mark.parametrize(
    ("lists", "extra", "is_made"),
    [
        ("generate_messages(DEPENDENCIES std_msgs)", {}, False),
        ("generate_messages()", {"src/a.cpp": "int a;\n"}, False),
        ("add_message_files(FILES A.msg)\ngenerate_messages()", {"msg/A.msg": "int32 a\n"}, True),
        ("generate_messages()", {"msg/A.msg": "int32 a\n"}, True),
        ("add_service_files(FILES A.srv)\ngenerate_messages()", {"srv/A.srv": "---\n"}, True),
        ("add_message_files(DIRECTORY ${where} FILES A.msg)\ngenerate_messages()", {}, True),
    ],
)
def test_generate_messages_without_an_interface(
    lists: str, extra: dict[str, str], is_made: bool, tmp_path: Path
) -> None:
    files = {"package.xml": MANIFEST.format("demo", ROS1), "CMakeLists.txt": CATKIN.format("demo", lists), **extra}
    found = messages("incomplete-interface-package", files, tmp_path)
    assert [("without an interface" in text, "message_runtime" in text) for text in found] == [(not is_made, is_made)]


@pytest.mark.parametrize(
    ("installed", "count"),
    [("scripts/pilot", 0), ("scripts/other", 1), ("scripts/pilot.py", 0), ("scripts/pilot.sh", 1)],
)
def test_a_script_that_install_names_without_its_ending(installed: str, count: int, tmp_path: Path) -> None:
    files = {
        "package.xml": MANIFEST.format("demo", ROS1 + "<depend>rospy</depend>"),
        "CMakeLists.txt": CATKIN.format("demo", "install(PROGRAMS %s DESTINATION lib/demo)" % installed),
        "scripts/pilot.py": "#!/usr/bin/env python3\nimport rospy\nrospy.init_node('pilot')\nrospy.spin()\n",
        "launch/a.launch": '<launch><node pkg="demo" type="pilot.py" name="pilot"/></launch>\n',
    }
    assert len(messages("target-not-installed", files, tmp_path)) == count


@pytest.mark.parametrize(
    ("tags", "count"),
    [
        ("<build_depend>rospy std_msgs</build_depend>", 1),
        ("<build_depend>\n  rospy\n  std_msgs\n</build_depend><exec_depend>rospy std_msgs</exec_depend>", 2),
        ("<build_depend>rospy</build_depend><build_depend>std_msgs</build_depend>", 0),
        ("<build_depend>\n  rospy\n</build_depend>", 0),
        ("<build_depend>${A} ${B}</build_depend>", 0),
        ("<!-- <build_depend>rospy std_msgs</build_depend> -->", 0),
        ("<url>rospy std_msgs</url>", 0),
    ],
)
def test_several_names_in_one_tag(tags: str, count: int, tmp_path: Path) -> None:
    files = {"package.xml": MANIFEST.format("demo", ROS1 + tags), "CMakeLists.txt": CATKIN.format("demo", "")}
    found = messages("misspelt-dependency", files, tmp_path)
    assert len(found) == count and all("2 names, rospy and std_msgs" in text for text in found)


SERVER = """#include <ros/ros.h>
#include <actionlib/server/simple_action_server.h>
#include <demo/GoAction.h>
class Server {
  ros::NodeHandle nh_;
  actionlib::SimpleActionServer<demo::GoAction> as_, other_;
public:
  Server() : nh_(),
    as_(nh_, "go", boost::bind(&Server::run, this, _1), %s), other_(nh_, ros::this_node::getName(), false)
  { %s }
  void run(const demo::GoGoalConstPtr& goal) {}
};
int main(int argc, char** argv) { ros::init(argc, argv, "server"); Server server; ros::spin(); }
"""
PYTHON_SERVER = """import rospy
import actionlib
from demo.msg import GoAction
rospy.init_node("server")
server = actionlib.SimpleActionServer("go", GoAction, execute_cb=print%s)
%s
rospy.spin()
"""


@pytest.mark.parametrize(
    ("code", "auto_start", "body", "count"),
    [
        (SERVER, "false", "as_.start();", 1),
        (SERVER, "true", "", 1),
        (SERVER, "false", "", 0),
        (SERVER, "false", "other_.start();", 0),
        (SERVER, "false", "ros::Time::now();", 0),
        (PYTHON_SERVER, ", auto_start=False", "server.start()", 1),
        (PYTHON_SERVER, "", "", 1),
        (PYTHON_SERVER, ", auto_start=False", "", 0),
        (PYTHON_SERVER, ", auto_start=False", "server.register_preempt_callback(print)", 0),
    ],
)
def test_an_action_server_that_nobody_starts_is_none(
    code: str, auto_start: str, body: str, count: int, tmp_path: Path
) -> None:
    ending = ".cpp" if code is SERVER else ".py"
    programs = "catkin_install_python(PROGRAMS one.py two.py DESTINATION lib/demo)"
    if code is SERVER:
        programs = "add_executable(one one.cpp)\nadd_executable(two two.cpp)"
    files = {
        "package.xml": MANIFEST.format("demo", f"{ROS1}<depend>roscpp</depend><depend>actionlib</depend>"),
        "CMakeLists.txt": CATKIN.format("demo", f"add_action_files(FILES Go.action)\ngenerate_messages()\n{programs}"),
        "action/Go.action": "int32 a\n---\nint32 b\n---\nint32 c\n",
        f"one{ending}": code % (("true" if code is SERVER else ""), ""),
        f"two{ending}": code % (auto_start, body),
        "all.launch": '<launch><node pkg="demo" type="{}" name="one"/><node pkg="demo" type="{}" name="two"/></launch>\n'.format(
            *(("one", "two") if code is SERVER else ("one.py", "two.py"))
        ),
    }
    found = messages("several-servers", files, tmp_path)
    assert len(found) == count
    assert all("both get every goal" in message for message in found)
