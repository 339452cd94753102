# SPDX-License-Identifier: Apache-2.0
"""Arguments that are passed to launch files of released packages, whose arguments are known."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.api.testing import said
from haros_ci.checking.outside_arguments import outside_file
from haros_ci.checking.page import Example
from haros_ci.registry import checks

WORLD = "$(find gazebo_ros)/launch/empty_world.launch"
CAMERA = "$(find realsense2_camera)/launch/rs_camera.launch"
NAVIGATION = "$(find-pkg-share nav2_bringup)/launch/navigation_launch.py"
SIM = "$(find-pkg-share ros_gz_sim)/launch/gz_sim.launch.py"


def include(file: str, *passed: str) -> str:
    inside = "".join(f'<arg name="{name}" value="1"/>\n' for name in passed)
    return f'<launch>\n<include file="{file}">\n{inside}</include>\n</launch>\n'


def python(*passed: str) -> str:
    pairs = ", ".join(f"'{name}': '1'" for name in passed)
    return (
        "from launch import LaunchDescription\nfrom launch.actions import IncludeLaunchDescription\n"
        "from launch.substitutions import PathJoinSubstitution\nfrom launch_ros.substitutions import FindPackageShare\n\n\n"
        "def generate_launch_description():\n    return LaunchDescription([\n        IncludeLaunchDescription(\n"
        "            PathJoinSubstitution([FindPackageShare('ros_gz_sim'), 'launch', 'gz_sim.launch.py']),\n"
        f"            launch_arguments={{{pairs}}}.items()),\n    ])\n"
    )


def manifest(ros: int) -> str:
    tool = "catkin" if ros == 1 else "ament_cmake"
    kind = "" if ros == 1 else f"<export><build_type>{tool}</build_type></export>"
    return (
        '<package format="3"><name>demo</name><version>1.0.0</version><description>d</description>'
        f'<maintainer email="a@b.cd">m</maintainer><license>MIT</license><buildtool_depend>{tool}</buildtool_depend>{kind}</package>\n'
    )


def found(name: str, text: str, ros: int, folder: Path) -> list[tuple[str, str]]:
    files = {"package.xml": manifest(ros), "CMakeLists.txt": "project(demo)\n", f"launch/{name}": text}
    check = next(check for check in checks() if check.id == "unused-launch-argument")
    return [(result.level.value, result.message) for result in said(check, Example("", True, files), folder)]


ALL = f"""<launch><arg name="own" default="1"/><include file="{WORLD}" pass_all_args="true"/></launch>\n"""


@pytest.mark.parametrize(
    ("name", "text", "ros", "level", "words"),
    [
        ("a.launch", include(WORLD, "headlss"), 1, "error", "'headlss' to empty_world.launch of gazebo_ros"),
        ("a.launch", include(WORLD, "headlss"), 1, "error", "launch stops here; did you mean 'headless'?"),
        ("a.launch", include(WORLD.replace("empty", "mud"), "paused"), 1, "error", "launch stops here"),
        ("a.launch", include(WORLD, "worldname", "gui"), 1, "error", "did you mean 'world_name'?"),
        ("a.launch", include(CAMERA, "depth_fsp"), 1, "error", "did you mean 'depth_fps'?"),
        ("a.launch.xml", include(SIM, "gz_arg"), 2, "warning", "it has no effect; did you mean 'gz_args'?"),
        ("a.launch.py", python("gz_arg"), 2, "warning", "it has no effect; did you mean 'gz_args'?"),
        ("a.launch.xml", include(SIM, "use_sim_time"), 2, "note", "it has no effect"),
    ],
)
def test_fires(name: str, text: str, ros: int, level: str, words: str, tmp_path: Path) -> None:
    ((said_level, message),) = found(name, text, ros, tmp_path)
    assert said_level == level and words in message


@pytest.mark.parametrize(
    ("name", "text", "ros"),
    [
        ("a.launch", include(WORLD, "headless", "world_name", "gui", "paused", "debug"), 1),
        ("a.launch", include(WORLD), 1),
        ("a.launch", include(WORLD.replace("gazebo_ros", "acme_gazebo"), "headlss"), 1),
        ("a.launch", include(WORLD.replace("empty", "acme"), "headlss"), 1),
        ("a.launch", ALL, 1),
        ("a.launch", include(CAMERA, "external_trigger", "depth_fps"), 1),
        ("a.launch.xml", include(NAVIGATION, "use_lifecycle_mgr", "params_file"), 2),
        ("a.launch.xml", include(SIM, "gz_args", "on_exit_shutdown"), 2),
        ("a.launch.xml", include(SIM.replace("ros_gz_sim", "acme_sim"), "gz_arg"), 2),
        ("a.launch.py", python("gz_args", "ign_version"), 2),
        ("a.launch.py", python(), 2),
    ],
)
def test_quiet(name: str, text: str, ros: int, tmp_path: Path) -> None:
    assert [message for _, message in found(name, text, ros, tmp_path) if "passes" in message] == []


@pytest.mark.parametrize(
    "text",
    [
        "",
        "empty_world.launch",
        "$(find gazebo_ros)",
        "$(find gazebo_ros)/launch/",
        "$(find a)/launch/a.launch",
        "/" * 9000,
    ],
)
def test_what_is_not_known(text: str) -> None:
    assert outside_file(text) is None
