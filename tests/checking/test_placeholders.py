# SPDX-License-Identifier: Apache-2.0
"""Plug-ins of robots that are still to be put in, as a comment says; and which plug-ins are proposed."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.api.testing import said
from haros_ci.checking.page import Example
from haros_ci.registry import checks
from haros_ci.results.rule import Level

MANIFEST = (
    '<package format="3"><name>demo</name><version>1.0.0</version><description>d</description>'
    '<maintainer email="a@example.org">m</maintainer><license>MIT</license><buildtool_depend>ament_cmake</buildtool_depend>'
    "<depend>pluginlib</depend><export><build_type>ament_cmake</build_type></export></package>\n"
)
COMPONENT = "rclcpp_components_register_nodes(gear demo::Reader)\n"
PLUGINS = "pluginlib_export_plugin_description_file(hardware_interface plugins.xml)\n"
CMAKE = "cmake_minimum_required(VERSION 3.8)\nproject(demo)\nadd_library(gear SHARED gear.cpp)\n{}ament_package()\n"
DESCRIPTION = (
    '<library path="gear"><class name="demo/LowGear" type="demo::LowGear" base_class_type="hardware_interface::SystemInterface"/>'
    "</library>\n"
)
ROBOT = '<robot name="r">\n  <ros2_control name="s" type="system">\n    <hardware>\n{}      <plugin>demo/{}</plugin>{}\n    </hardware>\n  </ros2_control>\n</robot>\n'


def found(before: str, name: str, after: str, rules: str, tmp_path: Path) -> list[tuple[Level, str]]:
    check = next(check for check in checks() if check.id == "unknown-plugin")
    files = {
        "package.xml": MANIFEST,
        "CMakeLists.txt": CMAKE.format(rules),
        "gear.cpp": "",
        "plugins.xml": DESCRIPTION,
        "urdf/r.urdf": ROBOT.format(before, name, after),
    }
    return [(result.level, result.message) for result in said(check, Example("", True, files), tmp_path)]


@pytest.mark.parametrize(
    ("before", "name", "after", "expected"),
    [
        ("      <!-- TODO: the driver of the real robot -->\n", "Wheels", "", Level.NOTE),
        ("", "Wheels", " <!-- FIXME -->", Level.NOTE),
        ("", "Wheels", "", Level.ERROR),
        ("      <!-- the driver -->\n", "Wheels", "", Level.ERROR),
        ("      <!-- TODO: later -->\n\n", "Wheels", "", Level.ERROR),
        ('      <param name="TODO">1</param>\n', "Wheels", "", Level.ERROR),
        ("      <!-- TODO: test -->\n", "LowGaer", "", Level.ERROR),  # a slip for one that is there
    ],
)
def test_what_is_still_to_be_done(before: str, name: str, after: str, expected: Level, tmp_path: Path) -> None:
    ((level, message),) = found(before, name, after, PLUGINS, tmp_path)
    assert level is expected
    assert ("a comment says that this is still to be done" in message) == (expected is Level.NOTE)


@pytest.mark.parametrize(
    ("rules", "expected"),
    [
        (PLUGINS + COMPONENT, "there are demo/LowGear"),
        (COMPONENT, "the package has components alone: write the name of a plug-in, or export this one"),
    ],
)
def test_components_are_not_proposed(rules: str, expected: str, tmp_path: Path) -> None:
    ((_, message),) = found("", "Wheels", "", rules, tmp_path)
    assert message.rstrip(".").endswith(expected)
