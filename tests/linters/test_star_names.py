# SPDX-License-Identifier: Apache-2.0
"""Names in files that import everything of a module: which of them it may bring."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.linters.star_imports import may_bring
from haros_ci.workspace.discover import discover

MANIFEST = (
    "<package format='2'><name>robot_msgs</name><version>1.0.0</version><description>a</description>"
    "<maintainer email='a@example.org'>A</maintainer><license>BSD</license><buildtool_depend>catkin</buildtool_depend></package>"
)
FILES = {
    "robot_msgs/package.xml": MANIFEST,
    "robot_msgs/msg/Status.msg": "int32 state\n",
    "robot_msgs/msg/old_status.msg": "int32 state\n",
    "robot_msgs/srv/start.srv": "---\n",
    "robot_msgs/action/Drive.action": "---\n---\n",
    "names.py": "speed = 1\n",
    "scripts/enum.py": "speed = 1\n",
}


def is_brought(root: Path, name: str, text: str) -> bool:
    (root / "scripts/node.py").write_text(text)
    return may_bring(name, "scripts/node.py", discover(root, (".",)))


@pytest.fixture(scope="module")
def root(tmp_path_factory: pytest.TempPathFactory) -> Path:
    made = tmp_path_factory.mktemp("starred")
    for path, text in FILES.items():
        (made / path).parent.mkdir(parents=True, exist_ok=True)
        (made / path).write_text(text)
    return made


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("self", "from robot_msgs.msg import *\n"),
        ("Stats", "from robot_msgs.msg import *\n"),
        ("speed", "from robot_msgs.msg import *\nfrom robot_msgs.srv import *\n"),
        ("Twits", "from geometry_msgs.msg import *\n"),
        ("command", "from std_msgs.msg import *\nfrom math import *\n"),
        ("cosh_of", "from math import *\n"),
    ],
)
def test_not_brought(root: Path, name: str, text: str) -> None:
    assert not is_brought(root, name, text)


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("Status", "from robot_msgs.msg import *\n"),
        ("old_status", "from robot_msgs.msg import *\n"),
        ("startRequest", "from robot_msgs.srv import *\n"),
        ("startResponse", "from robot_msgs.srv import *\n"),
        ("DriveActionGoal", "from robot_msgs.msg import *\n"),
        ("DriveGoal", "from robot_msgs.msg import *\n"),
        ("Twist", "from geometry_msgs.msg import *\n"),
        ("std_msgs", "from geometry_msgs.msg import *\n"),
        ("robot_msgs", "from geometry_msgs.msg import *\n"),
        ("struct", "from geometry_msgs.msg import *\n"),
        ("genpy", "from geometry_msgs.msg import *\n"),
        ("Part", "from others_that_nobody_knows.msg import *\n"),
        ("part", "from others_that_nobody_knows.msg import *\n"),
        ("speed", "from names import *\n"),
        ("speed", "from .names import *\n"),
        ("speed", "from .msg import *\n"),
        ("speed", "from enum import *\n"),
        ("array", "from numpy import *\n"),
        ("Button", "from tkinter import *\n"),
        ("speed", "from robot_msgs.msg import *\nfrom numpy import *\n"),
        ("speed", "from robot_msgs.msg import *\nfrom robot_msgs.cfg import *\n"),
    ],
)
def test_may_be_brought(root: Path, name: str, text: str) -> None:
    assert is_brought(root, name, text)
