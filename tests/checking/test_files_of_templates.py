# SPDX-License-Identifier: Apache-2.0
"""missing-launch-file: a file that the launch file makes of a template beside it is a note."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.api.testing import said
from haros_ci.checking.page import Example
from haros_ci.registry import checks

PACKAGE = {
    "package.xml": '<package format="3"><name>demo</name><version>1.0.0</version><description>d</description><maintainer email="a@b.cd">m</maintainer>'
    "<license>Apache-2.0</license><buildtool_depend>ament_cmake</buildtool_depend><export><build_type>ament_cmake</build_type></export></package>\n",
    "CMakeLists.txt": "cmake_minimum_required(VERSION 3.8)\nproject(demo)\nfind_package(ament_cmake REQUIRED)\n"
    "install(DIRECTORY launch config DESTINATION share/demo)\nament_package()\n",
}
LAUNCH = """import os
import subprocess

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import ExecuteProcess


def generate_launch_description():
    world = os.path.join(get_package_share_directory("demo"), "config", "sea.sdf")
    {}
    return LaunchDescription([ExecuteProcess(cmd=["gz", "sim", "-r", world])])
"""
MADE = 'subprocess.run(["empy3", "-o", world, os.path.join(os.path.dirname(world), "sea.sdf.em")])'


@pytest.mark.parametrize(
    ("line", "there", "level"),
    [
        (MADE, "sea.sdf.em", "note"),
        (MADE.replace(".em", ".jinja"), "sea.sdf.jinja", "note"),
        (MADE, "sea.sdf.j2", "warning"),  # it names another one
        ("pass", "sea.sdf.em", "warning"),
        (MADE, "lake.sdf.em", "warning"),
        (MADE.replace(".em", ".old"), "sea.sdf.old", "warning"),
    ],
)
def test_a_file_of_a_template(line: str, there: str, level: str, tmp_path: Path) -> None:
    check = next(check for check in checks() if check.id == "missing-launch-file")
    files = {**PACKAGE, "launch/a.launch.py": LAUNCH.format(line), f"config/{there}": ""}
    (found,) = said(check, Example("", True, files), tmp_path)
    assert found.level.value == level
