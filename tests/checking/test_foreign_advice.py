# SPDX-License-Identifier: Apache-2.0
"""foreign-dependency says what to do: write the counterpart, or remove what has none, is declared already or is not needed."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.api.testing import said
from haros_ci.checking.page import Example
from haros_ci.registry import checks

MANIFEST = (
    '<package format="3"><name>demo</name><version>1.0.0</version><description>d</description>'
    '<maintainer email="a@example.org">m</maintainer><license>MIT</license><buildtool_depend>{tool}</buildtool_depend>'
    "{depends}<export><build_type>{kind}</build_type></export></package>\n"
)


@pytest.mark.parametrize(
    ("depends", "files", "kind", "expected"),
    [
        ("roscpp", {}, "ament_cmake", "write rclcpp for roscpp"),
        ("roscpp rclcpp", {}, "ament_cmake", "remove roscpp"),
        ("roscpp rospy rclpy", {}, "ament_cmake", "remove rospy, and write rclcpp for roscpp"),
        ("dynamic_reconfigure rclcpp", {}, "ament_cmake", "remove dynamic_reconfigure"),
        ("message_generation message_runtime", {}, "ament_python", "remove message_generation and message_runtime"),
        (
            "message_generation",
            {"msg/A.msg": "int8 a\n"},
            "ament_cmake",
            "write rosidl_default_generators for message_generation",
        ),
        (
            "message_generation rosidl_default_generators",
            {"msg/A.msg": "int8 a\n"},
            "ament_cmake",
            "remove message_generation",
        ),
        ("actionlib rclpy", {}, "ament_python", "remove actionlib"),
        ("actionlib", {}, "ament_python", "write rclpy for actionlib"),
        ("actionlib", {}, "ament_cmake", "write rclcpp_action for actionlib"),
        ("rospy rclcpp", {"src/a.cpp": ""}, "ament_cmake", "remove rospy"),
        ("rospy rclcpp", {"src/a.cpp": "", "launch/a.launch.py": ""}, "ament_cmake", "remove rospy"),
        ("roscpp rclpy", {"demo/a.py": ""}, "ament_python", "remove roscpp"),
        ("rospy", {"src/a.cpp": "", "scripts/a.py": ""}, "ament_cmake", "write rclpy for rospy"),
        ("rospy", {"demo/a.py": ""}, "ament_python", "write rclpy for rospy"),
        ("rospy", {"launch/a.launch.py": ""}, "ament_cmake", "write rclpy for rospy"),
        ("roscpp", {"src/a.cpp": "", "setup.py": ""}, "ament_cmake", "write rclcpp for roscpp"),
        ("gmapping rclcpp", {}, "ament_cmake", "nothing in the package names it: remove it, or add the sources to the workspace"),
    ],
)  # fmt: skip
def test_advice(depends: str, files: dict[str, str], kind: str, expected: str, tmp_path: Path) -> None:
    tool = "ament_cmake" if kind == "ament_cmake" else "python3-setuptools"
    manifest = MANIFEST.format(
        tool=tool, kind=kind, depends="".join(f"<depend>{name}</depend>" for name in depends.split())
    )
    check = next(check for check in checks() if check.id == "foreign-dependency")
    (result,) = said(check, Example("", True, {"package.xml": manifest, **files}), tmp_path)
    assert result.message.rstrip(".").endswith(f"rosdep stops here; {expected}")
