# SPDX-License-Identifier: Apache-2.0
"""frame-leading-slash names a launch file that starts the program with the frame, and none where no node runs the file."""

from __future__ import annotations

from pathlib import Path

from haros_ci.api.testing import said
from haros_ci.checking.page import Example
from haros_ci.registry import checks

MANIFEST = (
    '<package format="2"><name>demo</name><version>1.0.0</version><description>d</description>'
    '<maintainer email="a@example.org">A</maintainer><license>Apache-2.0</license><buildtool_depend>catkin</buildtool_depend>'
    "<depend>rospy</depend><depend>tf2_ros</depend></package>\n"
)
CMAKE = (
    "cmake_minimum_required(VERSION 3.5)\nproject(demo)\nfind_package(catkin REQUIRED)\ncatkin_package()\n"
    "catkin_install_python(PROGRAMS near.py far.py DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})\n"
    "install(DIRECTORY launch DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})\n"
)
NODE = "#!/usr/bin/env python3\nimport rospy\nfrom std_msgs.msg import Header\nrospy.init_node('{0}')\nout = rospy.Publisher('{0}', Header, queue_size=1)\n"
LAUNCH = '<launch><node pkg="demo" type="{0}.py" name="{0}" ns="{1}"/></launch>\n'
FRAME = "head = Header()\nhead.frame_id = '/map'\nout.publish(head)\n"


def messages(files: dict[str, str], tmp_path: Path) -> list[str]:
    check = next(check for check in checks() if check.id == "frame-leading-slash")
    every = {"package.xml": MANIFEST, "CMakeLists.txt": CMAKE, "near.py": NODE.format("near"), **files}
    every["launch/a.launch"] = LAUNCH.format("near", "a")
    every["launch/b.launch"] = LAUNCH.format("far", "b")
    return [result.message for result in said(check, Example("", True, every), tmp_path)]


def test_the_launch_file_that_starts_the_program(tmp_path: Path) -> None:
    (message,) = messages({"far.py": NODE.format("far") + FRAME}, tmp_path)
    assert "launch/b.launch" in message and "launch/a.launch" not in message


def test_a_module_that_no_node_is_seen_to_run(tmp_path: Path) -> None:
    module = "from std_msgs.msg import Header\n\ndef head():\n    made = Header()\n    made.frame_id = '/map'\n    return made\n"
    (message,) = messages({"far.py": NODE.format("far"), "src/demo/heads.py": module}, tmp_path)
    assert "launch/" not in message
