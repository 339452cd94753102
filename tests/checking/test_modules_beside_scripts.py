# SPDX-License-Identifier: Apache-2.0
"""Modules beside a script of ROS 2 that CMake installs, and that nothing installs."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.api.testing import said
from haros_ci.checking.page import Example
from haros_ci.registry import checks
from haros_ci.results.result import Result
from haros_ci.results.rule import Level

MANIFEST = (
    '<package format="3"><name>heron</name><version>1.0.0</version><description>d</description><maintainer email="a@b.cd">m</maintainer>'
    "<license>Apache-2.0</license><exec_depend>rclpy</exec_depend><export><build_type>ament_cmake</build_type></export></package>\n"
)
CMAKE = "cmake_minimum_required(VERSION 3.8)\nproject(heron)\nfind_package(ament_cmake REQUIRED)\n{}\nament_package()\n"
SCRIPT = "#!/usr/bin/env python3\nimport rclpy\n{}\n\nrclpy.init()\n"
PROGRAM = "install(PROGRAMS scripts/swim.py DESTINATION lib/${PROJECT_NAME})"
PYTHON = "find_package(ament_cmake_python REQUIRED)\nament_python_install_package(heron)\n"
SCRIPTS = {"scripts/strokes.py": "long = 1\n", "scripts/gait/__init__.py": "", "scripts/gait/trot.py": "a = 1\n"}


LAUNCH = (
    "from launch import LaunchDescription\nfrom launch.actions import SetEnvironmentVariable\n\n\ndef generate_launch_description():\n"
    "    return LaunchDescription([SetEnvironmentVariable('PYTHONPATH', 'scripts')])\n"
)


def of_script(imports: str, folder: Path, more: dict[str, str] | None = None, cmake: str = PROGRAM) -> list[Result]:
    files = {
        "package.xml": MANIFEST,
        "CMakeLists.txt": CMAKE.format(cmake),
        "scripts/swim.py": SCRIPT.format(imports),
        **SCRIPTS,
        **(more or {}),
    }
    check = next(check for check in checks() if check.id == "module-not-installed")
    return list(said(check, Example("", True, files), folder))


@pytest.mark.parametrize(
    ("imports", "remedy"),
    [
        ("from strokes import long", "install scripts/strokes.py to lib/heron, too, or make it"),
        ("import strokes", "install scripts/strokes.py to lib/heron, too, or make it"),
        ("from gait.trot import a", "install scripts/gait to lib/heron, too, or make it"),
    ],
)
def test_a_module_beside_a_script(imports: str, remedy: str, tmp_path: Path) -> None:
    (result,) = of_script(imports, tmp_path)
    assert "it fails with ModuleNotFoundError, except after colcon build --symlink-install; " in result.message
    assert remedy in result.message and "(ament_python_install_package)" in result.message
    assert result.level is Level.WARNING and result.location.path == "scripts/swim.py"


def test_a_module_of_the_python_package_beside_the_script(tmp_path: Path) -> None:
    cmake = f"{PYTHON}install(PROGRAMS heron/glide.py DESTINATION lib/${{PROJECT_NAME}})"
    more = {"heron/__init__.py": "", "heron/glide.py": SCRIPT.format("import wings"), "heron/wings.py": ""}
    (result,) = of_script("", tmp_path, more, cmake)
    assert "; import it as heron.wings, which ament_python_install_package() installs" in result.message


def test_another_file_with_such_an_end_is_installed(tmp_path: Path) -> None:
    more = {"scripts/long_strokes.py": ""}
    assert (
        len(of_script("import strokes", tmp_path, more, PROGRAM.replace(" DEST", " scripts/long_strokes.py DEST"))) == 1
    )


QUIET_CMAKE = [
    PROGRAM.replace("swim.py", "swim.py scripts/strokes.py"),
    f"{PROGRAM}\ninstall(FILES scripts/strokes.py DESTINATION lib/${{PROJECT_NAME}})",
    f"{PROGRAM}\ninstall(DIRECTORY scripts/ DESTINATION lib/${{PROJECT_NAME}})",
    "install(DIRECTORY scripts/ DESTINATION lib/${PROJECT_NAME} USE_SOURCE_PERMISSIONS)",
    f"file(GLOB SCRIPTS scripts/*.py)\n{PROGRAM.replace('scripts/swim.py', '${SCRIPTS}')}",
    f"{PROGRAM}\nfind_package(ament_cmake_python REQUIRED)\nament_python_install_module(scripts/strokes.py)",
    f"{PROGRAM}\nament_environment_hooks(hooks/paths.dsv)",
    f"{PROGRAM}\nset(ENV{{PYTHONPATH}} scripts)",
    f"{PROGRAM}\nadd_custom_command(OUTPUT a COMMAND cp scripts/a b)",
    "",
]


@pytest.mark.parametrize("cmake", QUIET_CMAKE)
def test_quiet_where_cmake_brings_it(cmake: str, tmp_path: Path) -> None:
    assert of_script("import strokes", tmp_path, cmake=cmake) == []


@pytest.mark.parametrize(
    ("imports", "more"),
    [
        ("import numpy", {"scripts/numpy.py": ""}),
        ("import json", {"scripts/json.py": ""}),
        ("from .strokes import long", {}),
        ("try:\n    import strokes\nexcept ImportError:\n    strokes = None", {}),
        ("def late():\n    import strokes", {}),
        ("if True:\n    import strokes", {}),
        ("# import strokes", {}),
        ("'''\nimport strokes\n'''", {}),
        ("import sys, os\nsys.path.append(os.path.dirname(os.path.realpath(__file__)))\nimport strokes", {}),
        ("import importlib\nimport strokes", {}),
        ("import other", {"tools/other.py": ""}),
        ("import strokes", {"launch/a.launch.py": LAUNCH}),
        ("from heron.fins import a", {"heron/__init__.py": "", "heron/fins.py": "a = 1\n"}),
    ],
)
def test_quiet_on_other_imports(imports: str, more: dict[str, str], tmp_path: Path) -> None:
    assert of_script(imports, tmp_path, more) == []


@pytest.mark.parametrize(
    ("pages", "level"),
    [
        ({"README.md": "colcon build --symlink-install\n"}, Level.NOTE),
        ({"README.md": "colcon build\n"}, Level.WARNING),
        ({"README.md": "catkin_make\n"}, Level.WARNING),
        ({}, Level.WARNING),
    ],
)
def test_levels(pages: dict[str, str], level: Level, tmp_path: Path) -> None:
    assert [result.level for result in of_script("import strokes", tmp_path, pages)] == [level]
