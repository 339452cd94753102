# SPDX-License-Identifier: Apache-2.0
"""Names of Python 2 in scripts of no package: what else the workspace has says which Python they are for."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.config.load import load
from haros_ci.config.selection import Selection
from haros_ci.linting import with_names
from haros_ci.model.location import Location
from haros_ci.registry import registry
from haros_ci.results.result import Result
from haros_ci.results.rule import Level
from haros_ci.workspace.discover import discover

MANIFEST = """<package format="2"><name>arm</name><version>1.0.0</version><description>x</description>
<maintainer email="a@b.cd">a</maintainer><license>BSD</license><buildtool_depend>{}</buildtool_depend>{}</package>
"""
ROS1, ROS2 = MANIFEST.format("catkin", ""), MANIFEST.format("ament_cmake", "")
SCRIPT = "answer = raw_input('go on?')\n"


def levels(tmp_path: Path, manifests: dict[str, str], script: str, name: str) -> list[Level]:
    for place, text in {**manifests, "tools/ask.py": script}.items():
        (tmp_path / place).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / place).write_text(text, encoding="utf-8")
    settings = load(tmp_path)
    selection = Selection(settings, registry(settings).rules_of)
    message = f"Undefined variable '{name}'"
    said = Result("pylint", "undefined-variable", Level.ERROR, message, Location("tools/ask.py", script.count("\n")))
    return [result.level for result in with_names([said], discover(tmp_path, (".",)), selection)]


@pytest.mark.parametrize(
    ("manifests", "script", "name", "expected"),
    [
        ({"arm/package.xml": ROS1}, SCRIPT, "raw_input", []),
        ({"arm/package.xml": ROS1}, f"#!/usr/bin/env python\n{SCRIPT}", "raw_input", []),
        ({"arm/package.xml": ROS1}, f"#!/usr/bin/env python3\n{SCRIPT}", "raw_input", [Level.WARNING]),
        ({"arm/package.xml": ROS1}, SCRIPT.replace("raw_", "row_"), "row_input", [Level.ERROR]),
        # nothing names the script
        ({"arm/package.xml": ROS2}, SCRIPT, "raw_input", [Level.NOTE]),
        ({"arm/package.xml": ROS1, "leg/package.xml": ROS2.replace("arm", "leg")}, SCRIPT, "raw_input", [Level.NOTE]),
        ({}, SCRIPT, "raw_input", [Level.NOTE]),
        ({"arm/package.xml": ROS2, "README.md": "Run tools/ask.py.\n"}, SCRIPT, "raw_input", [Level.ERROR]),
        ({"arm/package.xml": ROS2, "tools/b.py": "import ask\n"}, SCRIPT, "raw_input", [Level.ERROR]),
    ],
)
def test_a_script_of_no_package(
    tmp_path: Path, manifests: dict[str, str], script: str, name: str, expected: list[Level]
) -> None:
    assert levels(tmp_path, manifests, script, name) == expected
