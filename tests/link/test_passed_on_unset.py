# SPDX-License-Identifier: Apache-2.0
"""ROS 2: an argument that an including file passes on without a value has none, whatever the included file's default is.

Such a launch file does not start until the user gives the argument (launch: a LaunchConfiguration that is not set, a required argument).
"""

from __future__ import annotations

import pytest
from follow_kit import ROS2_HEAD, ROS2_NODE, follow, ros2_files

HEAD = (
    "import os\nfrom launch import LaunchDescription\nfrom launch.actions import *\nfrom launch.substitutions import *\n"
    "from launch.launch_description_sources import *\nfrom launch_ros.actions import Node\n"
    "from ament_index_python.packages import get_package_share_directory as share\n"
    "def generate_launch_description():\n    return LaunchDescription([%s])\n"
)
FILE = "os.path.join(share('p'), 'config', '%s.yaml')"
INNER_PYTHON = HEAD % (
    f"DeclareLaunchArgument('params_file', default_value={FILE % 'own'}), "
    "Node(package='p', executable='n', name='x', parameters=[LaunchConfiguration('params_file')])"
)
INNER_XML = (
    '<launch><arg name="params_file" default="$(find-pkg-share p)/config/own.yaml"/>'
    '<node pkg="p" exec="n" name="x"><param from="$(var params_file)"/></node></launch>'
)
INCLUDE = (
    "IncludeLaunchDescription(PythonLaunchDescriptionSource(os.path.join(share('p'), 'launch', 'in.launch.py')), %s)"
)
PASSED = "launch_arguments={'params_file': LaunchConfiguration('%s'%s)}.items()"
#: What the including file declares and passes in Python, and the publisher's name.
PYTHON = (
    ("nothing", "", "launch_arguments={}.items()", "/own"),
    ("with a default", f"DeclareLaunchArgument('params_file', default_value={FILE % 'other'})", PASSED % ("params_file", ""), "/other"),
    ("a default where it is read", "", PASSED % ("params_file", f", default={FILE % 'other'}"), "/other"),
    ("not declared", "", PASSED % ("params_file", ""), "/?"),
    ("without a default", "DeclareLaunchArgument('params_file')", PASSED % ("params_file", ""), "/?"),
    ("another without a default", "DeclareLaunchArgument('file')", PASSED % ("file", ""), "/?"),
    ("without a default, not passed", "DeclareLaunchArgument('params_file')", "launch_arguments={}.items()", "/?"),
)  # fmt: skip
#: The same in XML.
XML = (
    ("nothing", "", "", "/own"),
    ("not declared", "", '<arg name="params_file" value="$(var params_file)"/>', "/?"),
    ("without a default", '<arg name="params_file"/>', '<arg name="params_file" value="$(var params_file)"/>', "/?"),
    ("without a default, not passed", '<arg name="params_file"/>', "", "/?"),
    (
        "with a default",
        '<arg name="params_file" default="$(find-pkg-share p)/config/other.yaml"/>',
        '<arg name="params_file" value="$(var params_file)"/>',
        "/other",
    ),
)


def publisher(launch: dict[str, str]) -> str:
    body = 'auto v = declare_parameter("topic", std::string("code")); auto q = create_publisher<String>(v, 1);'
    files = ros2_files(ROS2_HEAD + ROS2_NODE % (body, ""), launch)
    files["p/CMakeLists.txt"] = files["p/CMakeLists.txt"].replace("SHARE launch", "SHARE launch config")
    for name in ("own", "other"):
        files[f"p/config/{name}.yaml"] = f"/**:\n  ros__parameters:\n    topic: {name}\n"
    (found,) = follow(files, 2).configurations
    (name,) = [e.name for n in found.nodes for e in n.endpoints if e.kind == "publishers" and not e.implicit]
    return name


@pytest.mark.parametrize(("declared", "passed", "name"), [row[1:] for row in PYTHON], ids=[row[0] for row in PYTHON])
def test_in_python(declared: str, passed: str, name: str) -> None:
    actions = f"{declared}, " if declared else ""
    assert publisher({"in.launch.py": INNER_PYTHON, "out.launch.py": HEAD % (actions + INCLUDE % passed)}) == name


@pytest.mark.parametrize(("declared", "passed", "name"), [row[1:] for row in XML], ids=[row[0] for row in XML])
def test_in_xml(declared: str, passed: str, name: str) -> None:
    text = f'<launch>{declared}<include file="$(find-pkg-share p)/launch/in.launch.xml">{passed}</include></launch>'
    assert publisher({"in.launch.xml": INNER_XML, "out.launch.xml": text}) == name
