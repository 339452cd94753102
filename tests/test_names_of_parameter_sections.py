# SPDX-License-Identifier: Apache-2.0
"""Two nodes of one name that both have their parameters by it: with another name one of them would lose them."""

from __future__ import annotations

from pathlib import Path

import pytest
from test_check_levels import CMAKE, ROS2

from haros_ci.api.testing import said
from haros_ci.checking.page import Example
from haros_ci.registry import checks

READER = '#!/usr/bin/env python3\nimport rclpy\nrclpy.init()\nnode = rclpy.create_node("limits")\nnode.declare_parameter("speed", {})\n{}rclpy.spin(node)\n'
PUBLISHES = 'from std_msgs.msg import Empty\nend = node.create_publisher(Empty, "stop", 1)\n'
FILE = '<param from="$(find-pkg-share demo)/config/{}.yaml"/>'
SECTION = "{}:\n  ros__parameters:\n    speed: 1.0\n"
LIMITS = SECTION.format("limits")
OF_SECTION = "both have parameters of the section limits of config/a.yaml: give one of them another name, and a section"
OTHER_NAME = "the same names; give one of them another name or namespace;"


def _said(
    first: str, second: str, section: str, tmp_path: Path, *, more: str = "", space: str = "", twins: int = 0
) -> list[tuple[str, str]]:
    node = '<node pkg="demo" exec="{}.py"' + space + ">{}</node>"
    tags = [node.format("a", first), node.format("b", second)] + [node.format("b", second)] * twins
    files = {
        "package.xml": ROS2.replace("rclcpp", "rclpy"),
        "CMakeLists.txt": CMAKE.format(
            "install(PROGRAMS a.py b.py DESTINATION lib/demo)\ninstall(DIRECTORY config launch DESTINATION share/demo)"
        ),
        "a.py": READER.format("0.5", ""),
        "b.py": READER.format("0.6", more),
        "config/a.yaml": section,
        "config/b.yaml": section,
        "launch/a.launch.xml": "<launch>\n" + "\n".join(tags) + "\n</launch>\n",
    }
    check = next(check for check in checks() if check.id == "duplicate-node-name")
    return [(result.level.value, result.message) for result in said(check, Example("", True, files), tmp_path)]


@pytest.mark.parametrize(
    ("section", "space"),
    [
        (LIMITS, ""),
        (SECTION.format("/limits"), ""),
        (SECTION.format("'limits'"), ""),
        ("# limits of all\n" + LIMITS, ""),
        ("limits:\n  ros__parameters:\n    # more\n    speed: 1.0\nother:\n  ros__parameters:\n    speed: 2.0\n", ""),
        ("arm:\n  limits:\n    ros__parameters:\n      speed: 1.0\n", ' namespace="arm"'),
        ("/**:\n  ros__parameters:\n    depth: 1\n" + LIMITS, ""),
    ],
)
def test_what_both_have_by_their_name(section: str, space: str, tmp_path: Path) -> None:
    ((level, message),) = _said(FILE.format("a"), FILE.format("a"), section, tmp_path, space=space)
    assert level == "note"
    assert OF_SECTION.replace("limits of", ("/" if "/limits" in section else "") + "limits of") in message


@pytest.mark.parametrize("twins", [1, 2])
def test_more_than_two(twins: int, tmp_path: Path) -> None:
    ((level, message),) = _said(FILE.format("a"), FILE.format("a"), LIMITS, tmp_path, twins=twins)
    assert level == "note"
    assert OF_SECTION in message


def test_a_node_that_does_more_than_read_its_parameters(tmp_path: Path) -> None:
    ((level, message),) = _said(FILE.format("a"), FILE.format("a"), LIMITS, tmp_path, more=PUBLISHES)
    assert level == "warning"
    assert OF_SECTION in message


@pytest.mark.parametrize(
    ("first", "second", "section"),
    [
        ("", "", LIMITS),
        (FILE.format("a"), "", LIMITS),
        ("", FILE.format("a"), LIMITS),
        (FILE.format("a"), FILE.format("b"), LIMITS),
        (FILE.format("a"), FILE.format("a"), SECTION.format("/**")),
        (FILE.format("a"), FILE.format("a"), SECTION.format("'*'")),
        (FILE.format("a"), FILE.format("a"), SECTION.format("other")),
        (FILE.format("a"), FILE.format("a"), "speed: 1.0\n"),
        (FILE.format("a"), FILE.format("a"), ""),
        ('<param name="speed" value="1.0"/>', '<param name="speed" value="1.0"/>', LIMITS),
    ],
)
def test_what_is_not_theirs_by_their_name(first: str, second: str, section: str, tmp_path: Path) -> None:
    ((level, message),) = _said(first, second, section, tmp_path)
    assert level == "warning"
    assert OTHER_NAME in message
