# SPDX-License-Identifier: Apache-2.0
"""Templates of exercises beside their solution, and headers that nobody can include."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.api.testing import said
from haros_ci.checking.page import Example
from haros_ci.registry import checks
from haros_ci.results.rule import Level

MANIFEST = (
    '<package format="3"><name>demo</name><version>1.0.0</version><description>d</description>'
    '<maintainer email="a@b.cd">m</maintainer><license>MIT</license>{}</package>\n'
)
ROS2 = "<buildtool_depend>ament_cmake</buildtool_depend><export><build_type>ament_cmake</build_type></export>"
ROS1 = "<buildtool_depend>catkin</buildtool_depend><depend>roscpp</depend>"
CMAKE = """cmake_minimum_required(VERSION 3.8)
project(demo)
find_package(ament_cmake REQUIRED)
add_executable({name} src/wall.cpp)
install(TARGETS {name} DESTINATION lib/demo)
install(PROGRAMS scripts/wall.py DESTINATION lib/demo)
ament_package()
"""
TEMPLATE = """#!/usr/bin/env python3
import rclpy


def main():
    rclpy.init()
    # TODO: make a subscription
    # TODO: set the gains
    node = rclpy.create_node('wall')  #TODO: and its name
    rclpy.spin(node)


if __name__ == '__main__':
    main()
"""
CALLED = "int main() { return 0; }\n"


@pytest.mark.parametrize(
    ("name", "text", "source", "expected"),
    [
        ("wall", TEMPLATE, "src/wall.cpp", Level.NOTE),
        ("wall", TEMPLATE.replace("# TODO: set the gains\n", "pass\n"), "src/wall.cpp", Level.WARNING),
        ("wall", TEMPLATE.replace("TODO", "Later"), "src/wall.cpp", Level.WARNING),
        ("walls", TEMPLATE, "src/wall.cpp", Level.WARNING),
        ("wall", TEMPLATE, "src/walls.cpp", Level.WARNING),
    ],
)
def test_a_template_beside_its_solution(name: str, text: str, source: str, expected: Level, tmp_path: Path) -> None:
    files = {
        "package.xml": MANIFEST.format(ROS2),
        "CMakeLists.txt": CMAKE.format(name=name).replace("src/wall.cpp", source),
        source: CALLED,
        "scripts/wall.py": text,
        "tools/run.sh": "#!/bin/sh\ndate\n",
    }
    check = next(check for check in checks() if check.id == "script-not-runnable")
    found = said(check, Example("", True, files, executables=frozenset({"tools/run.sh"})), tmp_path)
    assert [(one.level, one.location.path) for one in found] == [(expected, "scripts/wall.py")]


EXPORT = """cmake_minimum_required(VERSION 3.0.2)
project(demo)
find_package(catkin REQUIRED COMPONENTS roscpp message_generation)
{lists}
catkin_package(INCLUDE_DIRS include LIBRARIES demo)
include_directories(include ${{catkin_INCLUDE_DIRS}})
add_library(demo src/demo.cpp)
install(TARGETS demo LIBRARY DESTINATION lib)
"""
LISTS = "add_message_files(FILES State.msg)\ngenerate_messages()"
REMNANT = "#include <ros/ros.h>\n#include <demo/Setup.h>\nclass Demo {};\n"


@pytest.mark.parametrize(
    ("headers", "more", "expected"),
    [
        ({"include/demo/sim.h": REMNANT}, {}, False),
        (
            {
                "include/demo/sim.h": REMNANT,
                "include/demo/old.h": REMNANT.replace("<demo/S", '"demo/S').replace("p.h>", 'p.h"'),
            },
            {},
            False,
        ),
        ({"include/demo/sim.h": REMNANT, "include/demo/demo.h": "class More {};\n"}, {}, True),
        ({"include/demo/sim.h": REMNANT.replace("Setup", "State")}, {}, True),
        ({"include/demo/sim.h": REMNANT.replace("demo/Setup", "other/Setup")}, {}, True),
        ({"include/demo/sim.h": REMNANT.replace("demo/Setup", "demo/setup")}, {}, True),
        ({"include/demo/sim.h": REMNANT, "include/demo/Setup.h": "class Setup {};\n"}, {}, True),
        ({"include/demo/sim.h": REMNANT}, {"action/Set.action": "---\n---\n"}, True),
    ],
)
def test_headers_that_nobody_can_include(
    headers: dict[str, str], more: dict[str, str], expected: bool, tmp_path: Path
) -> None:
    lists = LISTS if not more else f"add_action_files(FILES Set.action)\n{LISTS}"
    files = {
        "package.xml": MANIFEST.format(ROS1),
        "CMakeLists.txt": EXPORT.format(lists=lists),
        "src/demo.cpp": "int demo() { return 0; }\n",
        "msg/State.msg": "int32 a\n",
        **headers,
        **more,
    }
    check = next(check for check in checks() if check.id == "directory-not-installed")
    assert bool(said(check, Example("", True, files), tmp_path)) is expected
