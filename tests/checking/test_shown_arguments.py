# SPDX-License-Identifier: Apache-2.0
"""Pages that give a launch argument give it to the launch file that they name."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.api.testing import said
from haros_ci.checking.page import Example
from haros_ci.registry import checks
from haros_ci.results.rule import Level

MANIFEST = (
    '<package format="2"><name>heron</name><version>1.0.0</version><description>d</description>'
    '<maintainer email="a@example.org">m</maintainer><license>MIT</license><buildtool_depend>catkin</buildtool_depend></package>\n'
)
EMPTY = '<launch><param name="/world" value="$(arg hall)"/></launch>\n'
#: It chooses empty.launch where somebody says so, and gives it no argument.
ROBOT = '<launch><arg name="hall"/><include file="$(find heron)/launch/$(arg hall).launch">{}</include></launch>\n'
GIVES = '<arg name="hall" value="$(arg hall)"/>'


@pytest.mark.parametrize(
    ("page", "robot", "level"),
    [
        ("roslaunch heron robot.launch hall:=empty", ROBOT.format(""), Level.ERROR),
        ("roslaunch heron robot.launch \\\n  hall:=empty", ROBOT.format(""), Level.ERROR),
        ("roslaunch heron robot.launch speed:=1", ROBOT.format(""), Level.ERROR),
        # it is given
        ("roslaunch heron empty.launch hall:=a", ROBOT.format(""), Level.NOTE),
        ("roslaunch heron empty.launch \\\n  hall:=a", ROBOT.format(""), Level.NOTE),
        ("Give hall:=a.", ROBOT.format(""), Level.NOTE),
        ("roslaunch heron robot.launch and empty.launch hall:=a", ROBOT.format(""), Level.NOTE),
        ("roslaunch heron robot.launch hall:=empty", ROBOT.format(GIVES), Level.NOTE),
        ("roslaunch heron robot.launch hall:=empty", ROBOT.format('<arg value="a" name="hall"/>'), Level.NOTE),
        ("roslaunch heron robot.launch hall:=empty", ROBOT.replace("{}", "").replace('">', '" pass_all_args="true">'), Level.NOTE),
        ("roslaunch other outside.launch hall:=empty", ROBOT.format(""), Level.NOTE),
    ],
)  # fmt: skip
def test_an_argument_that_a_page_gives(page: str, robot: str, level: Level, tmp_path: Path) -> None:
    files = {
        "package.xml": MANIFEST,
        "CMakeLists.txt": "project(heron)\nfind_package(catkin REQUIRED)\ncatkin_package()\n",
        "README.md": f"{page}\n",
        "launch/robot.launch": robot,
        "launch/empty.launch": EMPTY,
    }
    check = next(check for check in checks() if check.id == "unset-launch-argument")
    found = [one for one in said(check, Example("", True, files), tmp_path) if "empty" in one.location.path]
    assert [one.level for one in found] == [level]
