# SPDX-License-Identifier: Apache-2.0
"""Modules that package.xml does not declare: one finding for a package and level, pip's own, and the key that is proposed."""

from __future__ import annotations

from pathlib import Path

import pytest
from test_check_levels import CMAKE, PACKAGE, ROS2, levels

from haros_ci.api.testing import said
from haros_ci.checking.page import Example
from haros_ci.registry import checks
from haros_ci.results.rule import Level


@pytest.mark.parametrize(
    ("path", "text", "expected"),
    [
        ("demo/requirements.txt", "numpy\nscipy>=1.9,<2\n", Level.NOTE),
        ("requirements.txt", "SciPy[all] == 1.9.3  # the last one\n", Level.NOTE),
        ("requirements-robot.txt", "scipy~=1.9; python_version > '3.8'\n", Level.NOTE),
        ("requirements/base.txt", "scipy==1.*\n", Level.NOTE),
        (
            "demo/setup.py",
            "from setuptools import setup\nsetup(install_requires=['setuptools', 'scipy>=1.9'])\n",
            Level.NOTE,
        ),
        ("demo/setup.cfg", "[options]\ninstall_requires =\n    scipy >= 1.9\n", Level.NOTE),
        ("pyproject.toml", '[project]\ndependencies = [\n  "scipy>=1.9",\n]\n', Level.NOTE),
        ("pyproject.toml", '[tool.poetry.dependencies]\npython = "^3.8"\nscipy = "^1.9"\n', Level.NOTE),
        ("demo/requirements.txt", "scipy\nnumpy==1.26\n", Level.ERROR),
        ("demo/requirements.txt", "scipy; python_version > '3.8'\n", Level.ERROR),
        ("demo/requirements.txt", "# scipy==1.9\nscipy-stubs==1.9\n", Level.ERROR),
        ("other/requirements.txt", "scipy==1.9\n", Level.ERROR),
        (
            "demo/setup.py",
            "from setuptools import setup\nsetup(extras_require={'plots': ['scipy']}, python_requires='>=3.8')\n",
            Level.ERROR,
        ),
        ("pyproject.toml", '[tool.black]\nscipy = "1"\n', Level.ERROR),
    ],
)
def test_modules_of_which_pip_is_asked_for_a_version(path: str, text: str, expected: Level, tmp_path: Path) -> None:
    files = {
        "demo/package.xml": ROS2.replace("rclcpp", "rclpy"),
        "demo/CMakeLists.txt": CMAKE.format("install(PROGRAMS n.py DESTINATION lib/demo)"),
        "demo/n.py": "#!/usr/bin/env python3\nimport scipy\n",
        path: text,
    }
    assert levels("undeclared-import", files, tmp_path) == [expected]


FROZEN = "numpy==1.22.1\nrclpy==3.3.21\nscipy==1.8.0\nstd-msgs==4.9.1\n"


@pytest.mark.parametrize(
    ("text", "readme", "expected"),
    [
        (FROZEN, "", Level.ERROR),
        (FROZEN, "pip install -r requirements.txt", Level.ERROR),
        (FROZEN.replace("rclpy", "rospy"), "", Level.ERROR),
        ("scipy==1.8.0\nrclpy == 3.3\n", "", Level.ERROR),
        (FROZEN.replace("rclpy", "rclpy-message-converter"), "", Level.NOTE),
        ("scipy==1.8.0\n# rclpy==3.3.21 comes with ROS\n", "", Level.NOTE),
        ("scipy==1.8.0\nrclpy\n", "", Level.NOTE),
        ("scipy\nrclpy\n", "pip install -r requirements.txt", Level.NOTE),
        ("--extra-index-url https://rospypi.github.io/simple/\n" + FROZEN.replace("rclpy", "rospy"), "", Level.NOTE),
        ("-f https://example.org/wheels\n" + FROZEN, "pip install -r requirements.txt", Level.NOTE),
        ("numpy==1.22.1\nscipy==1.8.0\nstd-msgs==4.9.1\n", "", Level.NOTE),
    ],
)
def test_what_a_machine_with_ros_has_chooses_nothing(text: str, readme: str, expected: Level, tmp_path: Path) -> None:
    files = {
        "demo/package.xml": ROS2.replace("rclcpp", "rclpy"),
        "demo/CMakeLists.txt": CMAKE.format("install(PROGRAMS n.py DESTINATION lib/demo)"),
        "demo/n.py": "#!/usr/bin/env python3\nimport scipy\n",
        "requirements.txt": text,
        "README.md": readme,
    }
    assert levels("undeclared-import", files, tmp_path) == [expected]


def messages(files: dict[str, str], tmp_path: Path) -> list[tuple[Level, str, tuple[str, ...]]]:
    check = next(check for check in checks() if check.id == "undeclared-import")
    found = said(check, Example("", True, files), tmp_path)
    return [(result.level, result.message, result.subject) for result in found]


def test_all_modules_of_a_level_are_one_finding(tmp_path: Path) -> None:
    modules = ("cv2", "laser_geometry", "matplotlib", "scipy", "serial", "diagnostic_updater", "carla")
    files = {
        "package.xml": ROS2.replace("rclcpp", "rclpy"),
        "CMakeLists.txt": CMAKE.format("install(PROGRAMS n.py DESTINATION lib/demo)"),
        "n.py": "#!/usr/bin/env python3\n" + "".join(f"import {module}\n" for module in modules),
        "requirements.txt": "pyserial==3.5\n",
    }
    (error, said_of_error, subject), (note, said_of_note, others) = sorted(
        messages(files, tmp_path), key=lambda m: m[0].value
    )
    assert (error, note) == (Level.ERROR, Level.NOTE)
    assert subject == ("cv2", "demo", "diagnostic_updater", "laser_geometry", "matplotlib", "scipy")
    assert others == ("carla", "demo", "serial")
    assert "imports cv2, laser_geometry, matplotlib, scipy and diagnostic_updater, but" in said_of_error
    assert "<exec_depend>python3-scipy</exec_depend>" in said_of_error
    assert "unless pip is to install it: requirements.txt:1 asks for a version" in said_of_note


@pytest.mark.parametrize(
    ("own", "sibling", "expected"),
    [
        ("", "", "python3-scipy"),
        ("python-numpy", "", "python-scipy"),
        ("python3-numpy", "python-numpy", "python3-scipy"),
        ("", "python-numpy", "python-scipy"),
        ("python-numpy", "python3-numpy", "python-scipy"),
    ],
)
def test_the_key_is_of_the_family_that_is_declared(own: str, sibling: str, expected: str, tmp_path: Path) -> None:
    def manifest(name: str, key: str) -> str:
        more = f"<depend>{key}</depend>" if key else ""
        return PACKAGE.format("catkin", "rospy", more).replace("demo", name)

    files = {
        "demo/package.xml": manifest("demo", own),
        "demo/CMakeLists.txt": "cmake_minimum_required(VERSION 3.0)\nproject(demo)\nfind_package(catkin REQUIRED)\n"
        "catkin_package()\ncatkin_install_python(PROGRAMS n.py DESTINATION lib/demo)\n",
        "demo/n.py": "#!/usr/bin/env python\nimport scipy\n",
        "other/package.xml": manifest("other", sibling),
    }
    ((_, message, _),) = messages(files, tmp_path)
    assert f"add <exec_depend>{expected}</exec_depend>" in message


@pytest.mark.parametrize("host", ["slicer", "bpy", "omni", "gdb", "FreeCAD"])
def test_scripts_of_a_program_with_its_own_python(host: str, tmp_path: Path) -> None:
    files = {
        "demo/package.xml": ROS2.replace("rclcpp", "rclpy"),
        "demo/CMakeLists.txt": CMAKE.format("install(PROGRAMS n.py DESTINATION lib/demo)"),
        "demo/n.py": f"#!/usr/bin/env python3\nimport {host}\nimport scipy\n",
    }
    assert messages(files, tmp_path / "host") == []
    files["demo/n.py"] = files["demo/n.py"].replace(host, "os")
    assert len(messages(files, tmp_path / "plain")) == 1


@pytest.mark.parametrize(
    ("manifest", "module", "expected"),
    [
        (ROS2, "RPi.GPIO", "add <exec_depend>python-rpi.gpio-pip</exec_depend>"),
        (ROS2, "serial", "add <exec_depend>python3-serial</exec_depend>"),
        (ROS2, "cv2", "add <exec_depend>python3-opencv</exec_depend>"),
        (PACKAGE.format("catkin", "rospy", ""), "RPi.GPIO", "add <exec_depend>python-rpi.gpio</exec_depend>"),
    ],
)
def test_no_key_of_python_2_where_there_is_none(manifest: str, module: str, expected: str, tmp_path: Path) -> None:
    if manifest is ROS2:
        cmake = CMAKE.format("install(PROGRAMS n.py DESTINATION lib/demo)")
    else:
        cmake = "cmake_minimum_required(VERSION 3.0)\nproject(demo)\nfind_package(catkin REQUIRED)\ncatkin_package()\n"
        cmake += "catkin_install_python(PROGRAMS n.py DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})\n"
    files = {"package.xml": manifest, "CMakeLists.txt": cmake, "n.py": f"#!/usr/bin/env python3\nimport {module}\n"}
    ((_, message, _),) = messages(files, tmp_path)
    assert message.rstrip(".").endswith(expected)


@pytest.mark.parametrize(
    ("modules", "count"),
    [("rospy, scipy", 0), ("roslib, scipy", 0), ("rclpy, rospy, scipy", 1), ("rospkg, scipy", 1), ("scipy", 1)],
)
def test_a_script_of_ros_1_in_a_package_of_ros_2(modules: str, count: int, tmp_path: Path) -> None:
    files = {
        "package.xml": ROS2,
        "CMakeLists.txt": CMAKE.format("install(PROGRAMS n.py DESTINATION lib/demo)"),
        "n.py": f"#!/usr/bin/env python3\nimport {modules}\n",
    }
    found = [message for _, message, _ in messages(files, tmp_path)]
    assert len([each for each in found if "scipy" in each]) == count
