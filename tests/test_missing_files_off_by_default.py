# SPDX-License-Identifier: Apache-2.0
"""Files that launch files name where they do nothing by default: they are looked for, and the message says which arguments lead there."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.config.settings import Settings
from haros_ci.pipeline import analyse
from haros_ci.workspace.cache import MemoryCache

MANIFEST = (
    '<package format="3"><name>demo</name><version>1.0.0</version><description>d</description>'
    '<maintainer email="a@b.cd">m</maintainer><license>Apache-2.0</license><buildtool_depend>{0}</buildtool_depend>'
    "{1}</package>\n"
)
ROS2 = {
    "package.xml": MANIFEST.format("ament_cmake", "<export><build_type>ament_cmake</build_type></export>"),
    "CMakeLists.txt": "cmake_minimum_required(VERSION 3.8)\nproject(demo)\nfind_package(ament_cmake REQUIRED)\n"
    "install(DIRECTORY launch DESTINATION share/demo)\nament_package()\n",
    "launch/here.launch.xml": "<launch/>\n",
}
ROS1 = {
    "package.xml": MANIFEST.format("catkin", ""),
    "CMakeLists.txt": "cmake_minimum_required(VERSION 3.0.2)\nproject(demo)\nfind_package(catkin REQUIRED)\ncatkin_package()\n",
    "launch/here.launch": "<launch/>\n",
}
ARGUMENTS = '<arg name="sim" default="false"/><arg name="kind" default="real"/>'


def messages(files: dict[str, str], tmp_path: Path) -> list[str]:
    for name, text in files.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text, encoding="utf-8")
    report, _ = analyse(Settings(root=tmp_path, profile="architecture"), MemoryCache())
    return [each.message for each in report.results if each.rule == "missing-launch-file"]


def ros2(condition: str, file: str = "gone.launch.xml") -> dict[str, str]:
    include = f'<include file="$(find-pkg-share demo)/launch/{file}" {condition}/>'
    return {**ROS2, "launch/a.launch.xml": f"<launch>{ARGUMENTS}{include}</launch>\n"}


def ros1(condition: str, file: str = "gone.launch") -> dict[str, str]:
    include = f'<include file="$(find demo)/launch/{file}" {condition}/>'
    return {**ROS1, "launch/a.launch": f"<launch>{ARGUMENTS}{include}</launch>\n"}


@pytest.mark.parametrize(
    ("files", "command"),
    [
        (ros2('if="$(var sim)"'), "ros2 launch demo a.launch.xml sim:=true"),
        (ros2('unless="$(not $(var sim))"'), "ros2 launch demo a.launch.xml sim:=true"),
        (ros2('if="$(equals $(var kind) bag)"'), "ros2 launch demo a.launch.xml kind:=bag"),
        (ros2('if="$(and $(var sim) $(equals $(var kind) bag))"'), "ros2 launch demo a.launch.xml kind:=bag sim:=true"),
        (ros1('if="$(arg sim)"'), "roslaunch demo a.launch sim:=true"),
        (ros1("if=\"$(eval arg('kind') == 'bag')\""), "roslaunch demo a.launch kind:=bag"),
    ],
)
def test_the_arguments_that_lead_there_are_told(files: dict[str, str], command: str, tmp_path: Path) -> None:
    (message,) = messages(files, tmp_path)
    assert message.endswith(f"; seen with {command}")


@pytest.mark.parametrize(
    "files",
    [
        ros2('if="$(var sim)"', "here.launch.xml"),
        ros2('if="$(var sim)"', "$(var kind)_$(env ROBOT).launch.xml"),
        ros2('if="false"'),
        ros2('if="$(equals bag tape)"'),
        ros1('if="$(arg sim)"', "here.launch"),
        ros1('if="0"'),
        ros1('if="$(arg sim)"', "$(env ROBOT).launch"),
    ],
)
def test_files_that_are_there_or_that_no_argument_leads_to(files: dict[str, str], tmp_path: Path) -> None:
    assert messages(files, tmp_path) == []
