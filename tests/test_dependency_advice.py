# SPDX-License-Identifier: Apache-2.0
"""What messages propose for a manifest: tags that its format has, and each dependency once."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.api.testing import said
from haros_ci.checking.page import Example
from haros_ci.registry import checks

MANIFEST = (
    "<package{0}><name>demo</name><version>1.0.0</version><description>d</description>"
    '<maintainer email="a@b.cd">m</maintainer><license>Apache-2.0</license>{1}</package>\n'
)
ROS1 = "<buildtool_depend>catkin</buildtool_depend><build_depend>roscpp</build_depend>"
ROS2 = "<buildtool_depend>ament_cmake</buildtool_depend>{}<export><build_type>ament_cmake</build_type></export>"
CMAKE = "cmake_minimum_required(VERSION 3.8)\nproject(demo)\n{}\n"


def messages(manifest: str, cmake: str, source: str, tmp_path: Path) -> list[str]:
    check = next(check for check in checks() if check.id == "undeclared-dependency")
    files = {"package.xml": manifest, "CMakeLists.txt": CMAKE.format(cmake), "a.cpp": source}
    return [result.message for result in said(check, Example("", True, files), tmp_path)]


@pytest.mark.parametrize(
    ("format_", "tags"),
    [
        ("", "<build_depend>nav_msgs</build_depend> and <run_depend>nav_msgs</run_depend>"),
        (' format="1"', "<build_depend>nav_msgs</build_depend> and <run_depend>nav_msgs</run_depend>"),
        (' format="2"', "<depend>nav_msgs</depend>"),
        (' format="3"', "<depend>nav_msgs</depend>"),
    ],
)
def test_tags_of_the_format(format_: str, tags: str, tmp_path: Path) -> None:
    cmake = "find_package(catkin REQUIRED COMPONENTS roscpp nav_msgs)\ncatkin_package()\nadd_executable(a a.cpp)"
    found = messages(MANIFEST.format(format_, ROS1), cmake, "#include <nav_msgs/Odometry.h>\n", tmp_path)
    assert len(found) == 1 and found[0].rstrip(".").endswith(f"add {tags}"), found


def test_a_header_and_the_cmake_package_of_one_library(tmp_path: Path) -> None:
    cmake = "find_package(ament_cmake REQUIRED)\nfind_package(Ceres REQUIRED)\nadd_executable(a a.cpp)\nament_package()"
    manifest = MANIFEST.format(' format="3"', ROS2.format(""))
    found = messages(manifest, cmake, "#include <ceres/ceres.h>\n", tmp_path)
    assert len(found) == 1 and "add <depend>libceres-dev</depend>" in found[0], found


@pytest.mark.parametrize(
    ("declared", "cmake"),
    [
        ("<depend>roscpp</depend>", "find_package(rclcpp REQUIRED)"),
        (
            "<member_of_group>rosidl_interface_packages</member_of_group>",
            "find_package(rosidl_default_generators REQUIRED)\nrosidl_generate_interfaces(demo msg/A.msg)",
        ),
    ],
)
def test_what_another_check_says(declared: str, cmake: str, tmp_path: Path) -> None:
    cmake = f"find_package(ament_cmake REQUIRED)\n{cmake}\nadd_executable(a a.cpp)\nament_package()"
    manifest = MANIFEST.format(' format="3"', ROS2.format(declared))
    assert messages(manifest, cmake, "int a;\n", tmp_path) == []


def test_what_no_other_check_says(tmp_path: Path) -> None:
    cmake = "find_package(ament_cmake REQUIRED)\nfind_package(rclcpp REQUIRED)\nadd_executable(a a.cpp)\nament_package()"
    found = messages(MANIFEST.format(' format="3"', ROS2.format("")), cmake, "int a;\n", tmp_path)
    assert len(found) == 1 and "rclcpp" in found[0]
