# SPDX-License-Identifier: Apache-2.0
"""A missing file that an argument names is a note where the argument is given to a parameter that no code names."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.api.testing import said
from haros_ci.checking.page import Example
from haros_ci.registry import checks
from haros_ci.results.rule import Level

MANIFEST = (
    '<package format="2"><name>demo</name><version>1.0.0</version><description>d</description>'
    '<maintainer email="a@b.cd">m</maintainer><license>MIT</license><buildtool_depend>catkin</buildtool_depend>'
    "<depend>rospy</depend></package>\n"
)
CMAKE = "cmake_minimum_required(VERSION 3.0)\nproject(demo)\nfind_package(catkin REQUIRED)\ncatkin_package()\n"
WALK = "#!/usr/bin/env python3\nimport rospy\n\nrospy.init_node('walk')\nrospy.get_param('~{}')\n"
ARGUMENT = '<arg name="names" {}="$(find demo)/config/names.yaml"/>\n'.format("value")
NODE = '<node pkg="demo" type="walk.py" name="walk"><param name="file" value="$(arg names)"/></node>\n'
ADVICE = "remove the argument and the parameter"


@pytest.mark.parametrize(
    ("parts", "read", "expected"),
    [
        ((ARGUMENT, NODE), "speed", Level.NOTE),
        ((ARGUMENT.replace("value=", "default="), NODE), "speed", Level.NOTE),
        ((ARGUMENT, NODE, NODE.replace('name="walk"', 'name="again"')), "speed", Level.NOTE),
        ((ARGUMENT, NODE, "<!-- $(arg names) -->\n"), "speed", Level.NOTE),
        ((ARGUMENT, NODE.replace('"file"', '"~file"')), "speed", Level.NOTE),
        ((ARGUMENT, NODE), "file", Level.WARNING),
        ((ARGUMENT, NODE.replace("demo", "elsewhere")), "speed", Level.WARNING),
        ((ARGUMENT, '<param name="file" value="$(arg names)"/>\n'), "speed", Level.WARNING),
        ((ARGUMENT, NODE, '<param name="file" value="$(arg names)"/>\n'), "speed", Level.WARNING),
        ((ARGUMENT, NODE.replace("<param", '<env name="N" value="$(arg names)"/><param')), "speed", Level.WARNING),
        ((ARGUMENT, NODE.replace('name="walk"', 'name="walk" args="$(arg names)"')), "speed", Level.WARNING),
        ((ARGUMENT, NODE, NODE.replace('"file"', '"speed"').replace('"walk"', '"w"')), "speed", Level.WARNING),
        ((ARGUMENT, NODE, '<arg name="more" value="$(eval arg(\'names\'))"/>\n'), "speed", Level.WARNING),
        ((ARGUMENT, NODE, '<include file="$(find b)/b.launch" pass_all_args="true"/>\n'), "speed", Level.WARNING),
    ],
)
def test_levels(parts: tuple[str, ...], read: str, expected: Level, tmp_path: Path) -> None:
    files = {
        "package.xml": MANIFEST,
        "CMakeLists.txt": CMAKE,
        "walk.py": WALK.format(read),
        "config/other.yaml": "a: 1\n",
        "launch/a.launch": f"<launch>\n{''.join(parts)}</launch>\n",
    }
    check = next(check for check in checks() if check.id == "missing-launch-file")
    found = [one for one in said(check, Example("", True, files), tmp_path) if "names.yaml" in one.message]
    assert [one.level for one in found] == [expected]
    assert (ADVICE in found[0].message) == (expected is Level.NOTE)


MANIFEST_2 = (
    '<package format="3"><name>demo</name><version>1.0.0</version><description>d</description>'
    '<maintainer email="a@b.cd">m</maintainer><license>MIT</license><buildtool_depend>ament_cmake</buildtool_depend>'
    "<export><build_type>ament_cmake</build_type></export></package>\n"
)
CMAKE_2 = """cmake_minimum_required(VERSION 3.8)
project(demo)
find_package(ament_cmake REQUIRED)
install(DIRECTORY launch DESTINATION share/${PROJECT_NAME})
ament_package()
"""
DECLARED = "    DeclareLaunchArgument('model', default_value=os.path.join(shared, 'urdf', 'arm.urdf')),\n"
ABROAD = (
    "    IncludeLaunchDescription(os.path.join(get_package_share_directory('gz_tools'), 'launch', 'gz.launch.py')),\n"
)
BESIDE = "    IncludeLaunchDescription(os.path.join(shared, 'launch', 'b.launch.py')),\n"
LAUNCH = """import os

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, ExecuteProcess, IncludeLaunchDescription, OpaqueFunction
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

shared = get_package_share_directory('demo')


def late(context):
    return [ExecuteProcess(cmd=['echo', {late}])]


def generate_launch_description():
    return LaunchDescription([
{parts}])
"""
READS = "    ExecuteProcess(cmd=['echo', LaunchConfiguration('model')]),\n"
GIVES = BESIDE.replace("py')", "py'), launch_arguments={'model': 'a.urdf'}.items()")
LATE = "    OpaqueFunction(function=late),\n"
READS_ALL = "str(context.launch_configurations)"
UNREAD = "nothing here reads the argument 'model': remove it"


@pytest.mark.parametrize(
    ("parts", "late", "other", "expected"),
    [
        ((DECLARED,), "'a'", "", Level.NOTE),
        ((DECLARED, ABROAD), "'a'", "", Level.NOTE),
        ((DECLARED.replace("'model'", "name='model'"), ABROAD), "'a'", "", Level.NOTE),
        ((DECLARED, BESIDE), "'a'", "    ExecuteProcess(cmd=['ls']),\n", Level.NOTE),
        ((DECLARED, LATE), "'a'", "", Level.NOTE),
        ((DECLARED, READS), "'a'", "", Level.WARNING),
        ((DECLARED, ABROAD, READS), "'a'", "", Level.WARNING),
        ((DECLARED, BESIDE), "'a'", READS, Level.WARNING),
        ((DECLARED, GIVES), "'a'", READS, Level.WARNING),
        ((DECLARED, LATE), "LaunchConfiguration('model').perform(context)", "", Level.WARNING),
        ((DECLARED, LATE), "context.launch_configurations['model']", "", Level.WARNING),
        ((DECLARED, LATE), READS_ALL, "", Level.WARNING),
        ((DECLARED, ABROAD.replace("py')", "py'), launch_arguments={'model': 'a'}.items()")), "'a'", "", Level.WARNING),
        ((DECLARED.replace("'model'", "MODEL"), ABROAD), "MODEL, LaunchConfiguration(MODEL)", "", Level.WARNING),
    ],
)
def test_ros_2(parts: tuple[str, ...], late: str, other: str, expected: Level, tmp_path: Path) -> None:
    files = {
        "package.xml": MANIFEST_2,
        "CMakeLists.txt": CMAKE_2,
        "launch/a.launch.py": LAUNCH.format(parts="".join(parts), late=late).replace(
            "shared =", "MODEL = 'model'\nshared =" if "MODEL" in late else "shared ="
        ),
    }
    if other:
        files["launch/b.launch.py"] = LAUNCH.format(parts=other, late="'b'")
    check = next(check for check in checks() if check.id == "missing-launch-file")
    found = [one for one in said(check, Example("", True, files), tmp_path) if "arm.urdf" in one.message]
    assert [one.level for one in found] == [expected]
    assert (UNREAD in found[0].message) == (expected is Level.NOTE)


DRIVE = "import rclpy\nfrom rclpy.node import Node\n\n\nclass Drive(Node):\n    def __init__(self):\n        super().__init__('drive')\n{}\n\n\ndef main():\n    rclpy.init()\n    rclpy.spin(Drive())\n"
STARTED = """    Node(package='demo', executable='drive', name='drive', parameters=[{{'{key}': os.path.join(shared, '{path}')}}]),
"""
SETUP = """from setuptools import setup
setup(name='demo', version='0.0.1', packages=['demo'], data_files=[('share/demo', ['package.xml']), ('share/demo/launch', ['launch/a.launch.py'])],
      entry_points={'console_scripts': ['drive = demo.drive:main']})
"""
DECLARES = "        self.declare_parameter('model', '')"


@pytest.mark.parametrize(
    ("body", "key", "is_read"),
    [
        ("", "demo", False),
        ("", "model", False),
        ("        print('model')", "model", False),
        (DECLARES, "models", False),
        (DECLARES, "model", True),
        ("        self.declare_parameter(str(time.time()), '')", "model", True),
        ("        self.declare_parameters('', [('model', '')])", "model", True),
        ("        # takes any", "model", True),
    ],
)
@pytest.mark.parametrize("path", ["demo/drive.py", "config/gone.yaml"])
def test_a_file_that_an_undeclared_parameter_alone_names(
    body: str, key: str, is_read: bool, path: str, tmp_path: Path
) -> None:
    is_there = path == "demo/drive.py"
    files = {
        "package.xml": MANIFEST_2.replace("ament_cmake", "ament_python"),
        "setup.py": SETUP,
        "demo/__init__.py": "",
        "demo/drive.py": DRIVE.format(body).replace(
            "'drive')", "'drive', allow_undeclared_parameters=True)" if "any" in body else "'drive')"
        ),
        "launch/a.launch.py": LAUNCH.format(parts=STARTED.format(key=key, path=path), late="'a'"),
    }
    rule = "directory-not-installed" if is_there else "missing-launch-file"
    check = next(check for check in checks() if check.id == rule)
    found = [one for one in said(check, Example("", True, files), tmp_path) if path.partition("/")[0] in one.message]
    if is_there:
        assert bool(found) == is_read
    else:
        assert [(one.level, "declares the parameter" in one.message) for one in found] == [
            (Level.WARNING, False) if is_read else (Level.NOTE, True)
        ]
