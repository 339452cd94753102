# SPDX-License-Identifier: Apache-2.0
"""Programs of packages outside of the workspace: what a project file knows of them is no slip of what haros-ci knows."""

from __future__ import annotations

from pathlib import Path

import pytest
from commandline import haros, write

MANIFEST = (
    "<package format='3'><name>demo</name><version>1.0.0</version><description>a</description><maintainer email='a@example.org'>A</maintainer>"
    "<license>BSD</license><buildtool_depend>ament_cmake</buildtool_depend><exec_depend>robot_state_publisher</exec_depend>"
    "<export><build_type>ament_cmake</build_type></export></package>"
)
LAUNCH = "<launch><node pkg='robot_state_publisher' exec='robot_state_publishers'/></launch>\n"
KNOWN = "known_nodes:\n  robot_state_publisher:\n    robot_state_publishers:\n      ros: 2\n      source: https://example.org/ours\n"


@pytest.mark.parametrize(("project", "is_said"), [("known_nodes: {}\n", True), (KNOWN, False)])
def test_what_the_project_file_knows_is_there(tmp_path: Path, project: str, is_said: bool) -> None:
    files = {
        "package.xml": MANIFEST,
        "CMakeLists.txt": "cmake_minimum_required(VERSION 3.8)\nproject(demo)\n",
        "launch/a.launch.xml": LAUNCH,
        "haros.yaml": project,
    }
    done = haros("check", ".", "--profile", "architecture", "--no-baseline", cwd=write(tmp_path / "demo", files))
    assert ("unknown-executable" in done.stdout) is is_said, done.stdout
