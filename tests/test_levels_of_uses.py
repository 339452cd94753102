# SPDX-License-Identifier: Apache-2.0
"""Findings that are notes where nothing uses what they are about."""

from __future__ import annotations

from pathlib import Path

import pytest
from test_check_levels import levels

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
    code = {"server.py": SERVER} | ({"client.py": CLIENT} if any("client.py" in text for text in files.values()) else {})
    assert levels("several-servers", filled(launches | code), tmp_path) == [expected]
