# SPDX-License-Identifier: Apache-2.0
"""Findings that are notes where nothing uses what they are about."""

from __future__ import annotations

from pathlib import Path

import pytest
from test_check_levels import CATKIN, ROS1, levels

from haros_ci.checking.page import filled
from haros_ci.results.rule import Level

NODE = "import rclpy\nfrom std_srvs.srv import Trigger\nrclpy.init()\nnode = rclpy.create_node({0!r})\n{1}\nrclpy.spin(node)\n"
SERVER = NODE.format("server", "node.create_service(Trigger, 'reset', print)")
CLIENT = NODE.format("client", "node.create_client(Trigger, 'reset')")
TWO = '<node pkg="demo" exec="server.py" name="one"/><node pkg="demo" exec="server.py" name="two"/>'


@pytest.mark.parametrize(
    ("files", "expected"),
    [
        ({"all": TWO + '<node pkg="demo" exec="client.py"/>'}, Level.ERROR),
        ({"all": TWO, "other": '<node pkg="demo" exec="client.py"/>'}, Level.WARNING),
        ({"all": TWO, "other": '<executable cmd="ros2 service call /reset std_srvs/srv/Trigger"/>'}, Level.WARNING),
        ({"all": TWO}, Level.NOTE),
    ],
)
def test_two_servers(files: dict[str, str], expected: Level, tmp_path: Path) -> None:
    launches = {f"launch/{name}.launch.xml": f"<launch>{text}</launch>\n" for name, text in files.items()}
    code = {"server.py": SERVER} | (
        {"client.py": CLIENT} if any("client.py" in text for text in files.values()) else {}
    )
    assert levels("several-servers", filled(launches | code), tmp_path) == [expected]


RVIZ = '<launch><node pkg="rviz" type="rviz" name="rviz" args="-d $(find demo)/rviz/{}.rviz"/></launch>\n'


@pytest.mark.parametrize(
    ("installed", "expected"),
    [("scripts", Level.NOTE), ("launch", Level.WARNING)],
)
def test_a_directory_that_only_launch_files_need(installed: str, expected: Level, tmp_path: Path) -> None:
    install = f"install(DIRECTORY {installed} DESTINATION ${{CATKIN_PACKAGE_SHARE_DESTINATION}})\n"
    files = {
        "package.xml": ROS1,
        "CMakeLists.txt": CATKIN + install,
        "launch/a.launch": RVIZ.format("a"),
        "scripts/a.sh": "#!/bin/sh\ntrue\n",
        "rviz/a.rviz": "Panels: []\n",
    }
    assert levels("directory-not-installed", files, tmp_path) == [expected]


@pytest.mark.parametrize(
    ("is_installed", "expected"), [(True, [Level.WARNING, Level.WARNING]), (False, [Level.NOTE] * 2)]
)
def test_what_a_model_needs_that_is_not_installed(is_installed: bool, expected: list[Level], tmp_path: Path) -> None:
    install = "install(DIRECTORY {} DESTINATION ${{CATKIN_PACKAGE_SHARE_DESTINATION}})\n"
    files = {
        "package.xml": ROS1,
        "CMakeLists.txt": CATKIN + install.format("launch" if is_installed else "scripts"),
        "launch/a.launch": '<launch><param name="robot_description" textfile="$(find demo)/urdf/a.urdf"/></launch>\n',
        "scripts/a.sh": "#!/bin/sh\ntrue\n",
        "urdf/a.urdf": '<robot name="a"><link name="b"><visual><geometry><mesh filename="package://demo/meshes/b.dae"/></geometry>'
        "</visual></link></robot>\n",
        "meshes/b.dae": "<COLLADA/>\n",
    }
    assert levels("directory-not-installed", files, tmp_path) == expected
