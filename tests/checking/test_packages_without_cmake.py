# SPDX-License-Identifier: Apache-2.0
"""wrong-build-type: packages of catkin that have no CMakeLists.txt."""

from __future__ import annotations

from pathlib import Path

import pytest
from test_names_to_write import messages

MANIFEST = (
    '<package format="2"><name>{}</name><version>1.0.0</version><description>d</description><maintainer email="a@b.cd">m</maintainer>'
    "<license>MIT</license>{}</package>\n"
)
CATKIN = "<buildtool_depend>catkin</buildtool_depend><exec_depend>rospy</exec_depend>"
SCRIPT = "#!/usr/bin/env python3\nimport rospy\nrospy.init_node('a')\nrospy.spin()\n"


def said_of(files: dict[str, str], folder: Path) -> list[str]:
    return messages("wrong-build-type", files, folder)


def test_one_that_has_none(tmp_path: Path) -> None:
    (message,) = said_of({"demo/package.xml": MANIFEST.format("demo", CATKIN), "demo/scripts/a.py": SCRIPT}, tmp_path)
    assert message == (
        "demo is built with catkin, but has no CMakeLists.txt: its build fails, and catkin_make that of all packages; add it"
    )


@pytest.mark.parametrize("line", ["CMakeLists.txt", "*.txt", "**CMakeLists.txt", "demo/CMakeLists.txt"])
def test_one_whose_file_git_leaves_out(line: str, tmp_path: Path) -> None:
    files = {"demo/package.xml": MANIFEST.format("demo", CATKIN), ".gitignore": f"build\n{line}\n"}
    (message,) = said_of(files, tmp_path)
    assert message.endswith("; a line of .gitignore has git leave it out: correct that, and add the file")


def test_several_for_one_line_of_gitignore_are_one(tmp_path: Path) -> None:
    files = {f"{name}/package.xml": MANIFEST.format(name, CATKIN) for name in "abc"}
    assert len(said_of(files, tmp_path / "each")) == 3
    (message,) = said_of({**files, ".gitignore": "CMakeLists.txt\n"}, tmp_path / "one")
    assert message.startswith("a, b and c are built with catkin, but have no CMakeLists.txt: their builds fail")


@pytest.mark.parametrize(
    ("needs", "more"),
    [
        (CATKIN, {"demo/CMakeLists.txt": "project(demo)\nfind_package(catkin REQUIRED)\ncatkin_package()\n"}),
        (CATKIN, {"demo/CMakelists.txt": "project(demo)\n"}),  # misspelt-build-file tells of it
        (CATKIN + "<export><metapackage/></export>", {}),
        (CATKIN + "<buildtool_depend>ament_cmake</buildtool_depend>", {}),
        (CATKIN + "<export><build_type>cmake</build_type></export>", {"demo/CMakeLists.txt": "project(demo)\n"}),
        (CATKIN.replace("rospy", "rclpy").replace("catkin", "ament_cmake"), {}),
        ("<buildtool_depend>ament_python</buildtool_depend><exec_depend>rospy</exec_depend>", {}),
        ("<build_depend>catkin</build_depend><exec_depend>rospy</exec_depend>", {}),
        ("<exec_depend>rospy</exec_depend>", {}),
        ("<exec_depend>rclpy</exec_depend>", {"demo/setup.py": "from setuptools import setup\nsetup(name='demo')\n"}),
        (CATKIN, {"demo/CATKIN_IGNORE": ""}),
    ],
)
def test_one_that_has_it_or_needs_none(needs: str, more: dict[str, str], tmp_path: Path) -> None:
    files = {"demo/package.xml": MANIFEST.format("demo", needs), "demo/scripts/a.py": SCRIPT, **more}
    assert not [message for message in said_of(files, tmp_path) if "built with catkin" in message]
