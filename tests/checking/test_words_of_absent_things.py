# SPDX-License-Identifier: Apache-2.0
"""Words for what is not there: files that install() names, programs without their ending, slips of released packages."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.api.testing import said
from haros_ci.checking.page import Example
from haros_ci.registry import checks

MANIFEST = (
    '<package format="3"><name>demo</name><version>1.0.0</version><description>d</description><maintainer email="a@b.cd">m</maintainer>'
    "<license>Apache-2.0</license><buildtool_depend>{0}</buildtool_depend>{1}<export><build_type>{0}</build_type></export></package>\n"
)
CMAKE = "cmake_minimum_required(VERSION 3.8)\nproject(demo)\nfind_package({0} REQUIRED)\n{1}\n"


def messages(check_id: str, files: dict[str, str], folder: Path) -> list[tuple[str, str]]:
    check = next(check for check in checks() if check.id == check_id)
    return [(result.level.value, result.message) for result in said(check, Example("", True, files), folder)]


@pytest.mark.parametrize(
    ("tool", "line", "words"),
    [
        (
            "ament_cmake",
            "install(DIRECTORY maps DESTINATION share/demo)",
            "demo installs maps, which is not there: colcon build stops with an error; remove it from the line, or add a file to maps: "
            "git stores no directory that is empty",
        ),
        (
            "catkin",
            "install(FILES a.yaml DESTINATION share/demo)",
            "demo installs a.yaml, which is not there: catkin_make install stops with an error; remove the name, or add the file",
        ),
    ],
)
def test_what_install_names_and_is_not_there(tool: str, line: str, words: str, tmp_path: Path) -> None:
    files = {"package.xml": MANIFEST.format(tool, ""), "CMakeLists.txt": CMAKE.format(tool, line)}
    assert messages("missing-install-source", files, tmp_path) == [("error", words)]


NODE = '#!/usr/bin/env python3\nimport rclpy\n\nif __name__ == "__main__":\n    rclpy.init()\n'


def test_a_program_without_its_ending(tmp_path: Path) -> None:
    install = "install(PROGRAMS scripts/columns.py DESTINATION lib/demo RENAME columns)\ninstall(DIRECTORY launch DESTINATION share/demo)"
    files = {
        "package.xml": MANIFEST.format("ament_cmake", "<depend>rclpy</depend>"),
        "CMakeLists.txt": CMAKE.format("ament_cmake", install),
        "scripts/columns.py": NODE,
        "scripts/walls.py": NODE,
        "launch/a.launch.xml": '<launch><node pkg="demo" exec="walls"/></launch>\n',
    }
    ((level, message),) = messages("unknown-executable", files, tmp_path)
    assert level == "error"
    assert message.endswith(
        "the package has walls.py: start it by that name if it is installed so, or install it with RENAME walls"
    )


@pytest.mark.parametrize(
    ("tool", "name", "files", "expected"),
    [
        ("catkin", "trajectoy_msgs", {}, "did you mean trajectory_msgs?"),
        ("ament_cmake", "geometry_msg", {}, "did you mean geometry_msgs?"),
        ("ament_cmake", "sensor_msgs_py", {}, ""),  # it is a package
        ("ament_cmake", "our_company_gears", {}, ""),
        ("ament_cmake", "turtlebot9_msgs", {}, ""),  # digits tell packages apart
        ("ament_cmake", "trajectoy_msgs", {"src/a.cpp": "#include <trajectoy_msgs/msg/a.hpp>\n"}, ""),
        ("ament_cmake", "trajectoy_msgs", {"launch/a.launch.py": "A = 'trajectoy_msgs'\n"}, ""),
        ("ament_cmake", "trajectoy_msgs", {"README.md": "git clone https://github.com/our/trajectoy_msgs\n"}, ""),
        ("ament_cmake", "trajectoy_msgs", {"our.repos": "repositories: {}\n"}, ""),
        ("ament_cmake", "gmaping", {}, ""),  # of ROS 1 alone
    ],
)
def test_a_slip_of_a_released_package(
    tool: str, name: str, files: dict[str, str], expected: str, tmp_path: Path
) -> None:
    all_files = {
        "package.xml": MANIFEST.format(tool, f"<depend>{name}</depend>"),
        "CMakeLists.txt": CMAKE.format(tool, f"find_package({name} REQUIRED)"),
        **files,
    }
    found = messages("misspelt-dependency", all_files, tmp_path)
    assert [level for level, _ in found] == ["warning"] * bool(expected)
    assert all(expected in message for _, message in found)
