# SPDX-License-Identifier: Apache-2.0
"""Scripts that CMake installs under another name: ROS 2 finds them under that one alone."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from commandline import haros, write

FILES = {
    "package.xml": "<package format='3'><name>bot</name><version>1.0.0</version><description>d</description><maintainer email='a@b.cd'>a</maintainer>"
    "<license>x</license><buildtool_depend>ament_cmake</buildtool_depend><exec_depend>rclpy</exec_depend><export><build_type>ament_cmake</build_type></export></package>",
    "one.py": "#!/usr/bin/env python3\nimport rclpy\n\nrclpy.init()\nrclpy.spin(rclpy.create_node('one'))\n",
    "launch/all.launch.xml": '<launch><node pkg="bot" exec="one.py"/></launch>\n',
}
CMAKE = (
    "cmake_minimum_required(VERSION 3.8)\nproject(bot)\nfind_package(ament_cmake REQUIRED)\n{}"
    "install(DIRECTORY launch DESTINATION share/${{PROJECT_NAME}})\nament_package()\n"
)
TO = "install(PROGRAMS one.py DESTINATION lib/${PROJECT_NAME}"


@pytest.mark.parametrize(
    ("installs", "found"),
    [
        (f"{TO} RENAME two.py)\n", ["unknown-executable"]),
        (f"{TO} RENAME one)\n", ["unknown-executable"]),
        (f"{TO})\n", []),
        (f"{TO} RENAME one.py)\n", []),
        (f"{TO})\n{TO} RENAME two.py)\n", []),
        (f"{TO} RENAME two.py)\nadd_custom_script(one.py)\n", []),
        (f"{TO} RENAME two.py)\ninstall(DIRECTORY scripts DESTINATION lib/${{PROJECT_NAME}})\n", []),
    ],
)
def test_the_name_that_is_installed_counts(tmp_path: Path, installs: str, found: list[str]) -> None:
    write(tmp_path, {**FILES, "CMakeLists.txt": CMAKE.format(installs)})
    haros("check", ".", "--isolated", "--no-cache", "--profile=architecture", "--output=json=out.json", cwd=tmp_path)
    results = json.loads((tmp_path / "out.json").read_text())["results"]
    assert [result["rule"] for result in results if result["rule"] == "unknown-executable"] == found
