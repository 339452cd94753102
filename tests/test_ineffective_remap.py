# SPDX-License-Identifier: Apache-2.0
"""Remapping rules for all that follows in a launch file, where a file of another workspace follows."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.api.testing import said
from haros_ci.checking.page import Example, filled
from haros_ci.registry import checks

TALKER = "#!/usr/bin/env python3\nimport rospy\nfrom std_msgs.msg import String\n\nrospy.init_node('talker')\npub = rospy.Publisher('chatter', String, queue_size=1)\nrospy.spin()\n"
NODE = '<node pkg="demo" type="talker.py" name="talker"/>'
WITH_RULE = '<node pkg="demo" type="talker.py" name="talker"><remap from="scan" to="laser"/></node>'
AWAY = '<include file="$(find turtlebot3_gazebo)/launch/world.launch"/>'
HERE = '<include file="$(find demo)/launch/b.launch"/>'
RULE = '<remap from="scan" to="laser"/>'


def messages(launch: str, tmp_path: Path) -> list[str]:
    check = next(check for check in checks() if check.id == "ineffective-remap")
    files = {
        "talker.py": TALKER,
        "launch/a.launch": f"<launch>\n{launch}\n</launch>\n",
        "launch/b.launch": "<launch/>\n",
    }
    return [result.message for result in said(check, Example("", True, filled(files)), tmp_path)]


@pytest.mark.parametrize("launch", [f"{RULE}\n{AWAY}\n{NODE}", f"{RULE}\n{NODE}\n{AWAY}", f"{RULE}{NODE}\n\n{AWAY}"])
def test_nodes_of_another_workspace_may_have_the_name(launch: str, tmp_path: Path) -> None:
    assert messages(launch, tmp_path) == []


@pytest.mark.parametrize(
    "launch", [f"{RULE}\n{NODE}", f"{AWAY}\n{RULE}\n{NODE}", f"{RULE}\n{HERE}\n{NODE}", f"{WITH_RULE}\n{AWAY}"]
)
def test_no_other_node_has_it(launch: str, tmp_path: Path) -> None:
    (message,) = messages(launch, tmp_path)
    assert "has no topic or service /scan" in message and message.endswith("correct the name, or remove the remapping")
