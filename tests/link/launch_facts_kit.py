# SPDX-License-Identifier: Apache-2.0
"""Small workspaces of launch files, and the facts of one kind that they give."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TypeVar

from follow_kit import follow

from haros_ci.model.launch_facts import LaunchFact

Kind = TypeVar("Kind", bound=LaunchFact)
CMAKE = (
    "cmake_minimum_required(VERSION 3.8)\nproject(p)\nfind_package(ament_cmake REQUIRED)\n"
    "add_executable(n src/n.cpp)\ninstall(TARGETS n DESTINATION lib/p)\n"
    "install(DIRECTORY launch config DESTINATION share/p)\nament_package()\n"
)
CATKIN = (
    "cmake_minimum_required(VERSION 3.0)\nproject(p)\nfind_package(catkin REQUIRED)\ncatkin_package()\n"
    "add_executable(n src/n.cpp)\n"
)
HEAD = (
    "from launch import LaunchDescription\nfrom launch.actions import *\nfrom launch.conditions import *\n"
    "from launch.substitutions import *\nfrom launch_ros.actions import *\nfrom launch_ros.substitutions import *\n"
    "from ament_index_python.packages import get_package_share_directory\nimport os\n"
    "def generate_launch_description():\n  return LaunchDescription([\n"
)


def facts(
    kind: type[Kind], body: str, files: Mapping[str, str] | None = None, *, name: str = "a.launch.xml", ros: int = 2
) -> list[Kind]:
    """The facts of *kind* of the launch file ``<launch>`` + *body*, or of Python's list *body*, beside *files*."""
    text = (
        f"{HEAD}{body}])\n" if name.endswith(".py") else body if name.endswith(".yaml") else f"<launch>{body}</launch>"
    )
    every = {
        "p/CMakeLists.txt": CMAKE if ros == 2 else CATKIN,
        "p/src/n.cpp": "int main() {}\n",
        "p/config/some.yaml": "n: {ros__parameters: {}}\n",
        f"p/launch/{name}": text,
        **(files or {}),
    }
    found = follow(every, ros).configurations
    configuration = next(each for each in found if each.launch and each.launch[0].endswith(name))
    return [fact for fact in configuration.launch_facts if isinstance(fact, kind)]


def ros1(kind: type[Kind], body: str, files: Mapping[str, str] | None = None) -> list[Kind]:
    return facts(kind, body, files, name="a.launch", ros=1)
