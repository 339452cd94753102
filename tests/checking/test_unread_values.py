# SPDX-License-Identifier: Apache-2.0
"""A missing file that an argument names is a note where the argument is given to a parameter that no code names."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.api.testing import said
from haros_ci.checking.page import Example
from haros_ci.registry import checks
from haros_ci.results.rule import Level

MANIFEST = (
    '<package format="2"><name>demo</name><version>1.0.0</version><description>d</description>'
    '<maintainer email="a@b.cd">m</maintainer><license>MIT</license><buildtool_depend>catkin</buildtool_depend>'
    "<depend>rospy</depend></package>\n"
)
CMAKE = "cmake_minimum_required(VERSION 3.0)\nproject(demo)\nfind_package(catkin REQUIRED)\ncatkin_package()\n"
WALK = "#!/usr/bin/env python3\nimport rospy\n\nrospy.init_node('walk')\nrospy.get_param('~{}')\n"
ARGUMENT = '<arg name="names" {}="$(find demo)/config/names.yaml"/>\n'.format("value")
NODE = '<node pkg="demo" type="walk.py" name="walk"><param name="file" value="$(arg names)"/></node>\n'
ADVICE = "remove the argument and the parameter"


@pytest.mark.parametrize(
    ("parts", "read", "expected"),
    [
        ((ARGUMENT, NODE), "speed", Level.NOTE),
        ((ARGUMENT.replace("value=", "default="), NODE), "speed", Level.NOTE),
        ((ARGUMENT, NODE, NODE.replace('name="walk"', 'name="again"')), "speed", Level.NOTE),
        ((ARGUMENT, NODE, "<!-- $(arg names) -->\n"), "speed", Level.NOTE),
        ((ARGUMENT, NODE.replace('"file"', '"~file"')), "speed", Level.NOTE),
        ((ARGUMENT, NODE), "file", Level.WARNING),
        ((ARGUMENT, NODE.replace("demo", "elsewhere")), "speed", Level.WARNING),
        ((ARGUMENT, '<param name="file" value="$(arg names)"/>\n'), "speed", Level.WARNING),
        ((ARGUMENT, NODE, '<param name="file" value="$(arg names)"/>\n'), "speed", Level.WARNING),
        ((ARGUMENT, NODE.replace("<param", '<env name="N" value="$(arg names)"/><param')), "speed", Level.WARNING),
        ((ARGUMENT, NODE.replace('name="walk"', 'name="walk" args="$(arg names)"')), "speed", Level.WARNING),
        ((ARGUMENT, NODE, NODE.replace('"file"', '"speed"').replace('"walk"', '"w"')), "speed", Level.WARNING),
        ((ARGUMENT, NODE, '<arg name="more" value="$(eval arg(\'names\'))"/>\n'), "speed", Level.WARNING),
        ((ARGUMENT, NODE, '<include file="$(find b)/b.launch" pass_all_args="true"/>\n'), "speed", Level.WARNING),
    ],
)
def test_levels(parts: tuple[str, ...], read: str, expected: Level, tmp_path: Path) -> None:
    files = {
        "package.xml": MANIFEST,
        "CMakeLists.txt": CMAKE,
        "walk.py": WALK.format(read),
        "config/other.yaml": "a: 1\n",
        "launch/a.launch": f"<launch>\n{''.join(parts)}</launch>\n",
    }
    check = next(check for check in checks() if check.id == "missing-launch-file")
    found = [one for one in said(check, Example("", True, files), tmp_path) if "names.yaml" in one.message]
    assert [one.level for one in found] == [expected]
    assert (ADVICE in found[0].message) == (expected is Level.NOTE)
