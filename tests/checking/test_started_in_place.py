# SPDX-License-Identifier: Apache-2.0
"""What launch files of a package start or include, and its build does not install; exported libraries that nothing makes."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.api.testing import said
from haros_ci.checking.page import Example
from haros_ci.registry import checks

MANIFEST = (
    '<package format="2"><name>heron</name><version>1.0.0</version><description>d</description>'
    '<maintainer email="a@example.org">m</maintainer><license>MIT</license><buildtool_depend>catkin</buildtool_depend>'
    "<depend>rospy</depend></package>\n"
)
CMAKE = "cmake_minimum_required(VERSION 3.0.2)\nproject(heron)\nfind_package(catkin REQUIRED COMPONENTS rospy)\n{}\n"
PACKAGE = "catkin_package()\ncatkin_python_setup()\n"
SETUP = "from setuptools import setup\nsetup(packages=['heron'], package_dir={'': 'src'})\n"
SCRIPT = "#!/usr/bin/env python3\n{}\nif __name__ == '__main__':\n    print(1)\n"
LAUNCH = '<launch><node pkg="heron" type="{}" name="n"/></launch>\n'
INSTALL = "install(PROGRAMS {} DESTINATION ${{CATKIN_PACKAGE_BIN_DESTINATION}})\n"
SHARE = "install(DIRECTORY {} DESTINATION ${{CATKIN_PACKAGE_SHARE_DESTINATION}}{})\n"


def messages(check_id: str, files: dict[str, str], folder: Path) -> list[str]:
    check = next(check for check in checks() if check.id == check_id)
    return [result.message for result in said(check, Example("", True, {"package.xml": MANIFEST, **files}), folder)]


@pytest.mark.parametrize(
    ("cmake", "count"),
    [
        ("catkin_package(LIBRARIES heron)\nadd_library(filters a.cpp)\n", 1),
        ("catkin_package(LIBRARIES heron)\nadd_library(filters a.cpp)\ncatkin_install_python(PROGRAMS s.py DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})\n", 1),
        ("catkin_package(LIBRARIES heron)\nadd_library(heron a.cpp)\ncatkin_install_python(PROGRAMS s.py DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})\n", 0),
        ("catkin_package(LIBRARIES ${PROJECT_NAME})\nadd_library(${PROJECT_NAME} a.cpp)\n", 0),
        ("catkin_package(LIBRARIES heron)\nadd_heron(heron a.cpp)\n", 0),
        ("catkin_package(LIBRARIES heron)\nadd_custom_command(OUTPUT libheron.so COMMAND make)\n", 0),
        ("catkin_package(LIBRARIES m)\nadd_library(filters a.cpp)\n", 0),
    ],
)  # fmt: skip
def test_an_exported_library(cmake: str, count: int, tmp_path: Path) -> None:
    files = {"CMakeLists.txt": CMAKE.format(cmake), "a.cpp": "int a;\n", "s.py": SCRIPT.format("import rospy")}
    assert len(messages("unknown-target", files, tmp_path)) == count


@pytest.mark.parametrize(
    ("path", "started", "imports", "cmake", "names"),
    [
        # fires: a launch file starts the script, which is not installed and runs in place
        ("scripts/walk.py", "walk.py", "import geometry_msgs.msg", "", ["geometry_msgs"]),
        ("src/heron/walk.py", "walk.py", "from geometry_msgs.msg import Pose", PACKAGE, ["geometry_msgs"]),
        # stays quiet
        ("scripts/walk.py", "walk.py", "import rospy", "", []),
        ("scripts/walk.py", "walk.py", "import sys", "", []),
        ("scripts/walk.py", "other.py", "import geometry_msgs.msg", "", []),
        ("scripts/walk.py", "walk", "import geometry_msgs.msg", "", []),
        ("scripts/walk.py", "walk.py", "try:\n    import geometry_msgs.msg\nexcept ImportError:\n    pass", "", []),
        ("test/walk.py", "walk.py", "import geometry_msgs.msg", "", []),
        ("scripts/walk.py", "walk.py", "import walk_of_nobody", "", []),
    ],
)
def test_imports_of_a_script_that_is_started(
    path: str, started: str, imports: str, cmake: str, names: list[str], tmp_path: Path
) -> None:
    files = {
        "CMakeLists.txt": CMAKE.format(cmake or "catkin_package()\n"),
        "setup.py": SETUP,
        "src/heron/__init__.py": "",
        path: SCRIPT.format(imports),
        "launch/a.launch": LAUNCH.format(started),
    }
    found = messages("undeclared-import", files, tmp_path)
    assert len(found) == len(names) and all(name in found[0] for name in names)


def test_imports_of_a_copy_beside_the_script_that_is_installed(tmp_path: Path) -> None:
    files = {
        "CMakeLists.txt": CMAKE.format("catkin_package()\n" + INSTALL.format("scripts/walk.py")),
        "scripts/walk.py": SCRIPT.format("import rospy"),
        "old/walk.py": SCRIPT.format("import geometry_msgs.msg"),
        "launch/a.launch": LAUNCH.format("walk.py"),
    }
    assert messages("undeclared-import", files, tmp_path) == []


@pytest.mark.parametrize(
    ("path", "started", "cmake", "setup", "script", "is_told"),
    [
        ("src/heron/walk.py", "walk.py", PACKAGE + INSTALL.format("s.py"), SETUP, SCRIPT, True),
        ("src/heron/walk.py", "walk.py", PACKAGE + SHARE.format("launch", "/launch"), SETUP, SCRIPT, True),
        # stays quiet: nothing starts it, or it is installed, or it is a module
        ("src/heron/walk.py", "s.py", PACKAGE + INSTALL.format("s.py"), SETUP, SCRIPT, False),
        ("src/heron/walk.py", "walk.py", PACKAGE + INSTALL.format("s.py src/heron/walk.py"), SETUP, SCRIPT, False),
        (
            "src/heron/walk.py",
            "walk.py",
            "execute_process(COMMAND ls OUTPUT_VARIABLE PARTS)\n" + PACKAGE + INSTALL.format("s.py ${PARTS}"),
            SETUP,
            SCRIPT,
            False,
        ),
        (
            "src/heron/walk.py",
            "walk.py",
            PACKAGE + INSTALL.format("s.py"),
            SETUP.replace("setup(", "setup(scripts=['src/heron/walk.py'], "),
            SCRIPT,
            False,
        ),
        ("src/heron/walk.py", "walk.py", PACKAGE + INSTALL.format("s.py"), SETUP, "import rospy\n{}", False),
        ("src/heron/walk.py", "walk.py", PACKAGE + INSTALL.format("s.py scripts/walk.py"), SETUP, SCRIPT, False),
    ],
)
def test_a_module_that_a_launch_file_starts(
    path: str, started: str, cmake: str, setup: str, script: str, is_told: bool, tmp_path: Path
) -> None:
    files = {
        "CMakeLists.txt": CMAKE.format(cmake),
        "setup.py": setup,
        "src/heron/__init__.py": "",
        "s.py": SCRIPT.format("import rospy"),
        "scripts/walk.py": SCRIPT.format("import rospy") if "scripts/walk.py" in cmake else "X = 1\n",
        path: script.format("import rospy"),
        "launch/a.launch": LAUNCH.format(started),
    }
    found = [message for message in messages("target-not-installed", files, tmp_path) if path in message]
    assert bool(found) is is_told, found


INCLUDE = '<launch><arg name="robot"{}/><include file="$(find heron)/{}"/></launch>\n'


@pytest.mark.parametrize(
    ("default", "include", "cmake", "is_told"),
    [
        ("", "robots/$(arg robot)/$(arg robot).launch", SHARE.format("launch", ""), True),
        (' default="$(optenv ROBOT !!NONE!!)"', "robots/$(arg robot).launch", SHARE.format("launch", ""), True),
        (' default="grey"', "robots/$(arg robot).launch", SHARE.format("launch", ""), True),
        ("", "robots/$(env ROBOT).launch", SHARE.format("launch", ""), True),
        # stays quiet
        ("", "robots/$(arg robot).launch", SHARE.format("launch robots", ""), False),
        ("", "robots/$(arg robot).launch", SHARE.format("launch", "") + SHARE.format("robots/", "/robots"), False),
        ("", "robots/$(arg robot).launch", SHARE.format("launch", "") + SHARE.format("robots/grey", "/robots"), False),
        (
            "",
            "robots/$(arg robot).launch",
            SHARE.format("launch", "")
            + "execute_process(COMMAND ls OUTPUT_VARIABLE PARTS)\n"
            + SHARE.format("${PARTS}", ""),
            False,
        ),
        ("", "robots/$(arg robot).launch", SHARE.format(".", ""), False),
        ("", "robots-$(arg robot)/a.launch", SHARE.format("launch", ""), False),
        ("", "$(arg robot)/a.launch", SHARE.format("launch", ""), False),
        ("", "gone/$(arg robot).launch", SHARE.format("launch", ""), False),
        ("", "launch/$(arg robot).launch", SHARE.format("launch", ""), False),
        ("", "robots/$(arg robot).launch", SHARE.format("launch", "") + "# install(DIRECTORY robots)\n", False),
    ],
)
def test_a_directory_of_which_a_file_is_chosen(
    default: str, include: str, cmake: str, is_told: bool, tmp_path: Path
) -> None:
    files = {
        "CMakeLists.txt": CMAKE.format("catkin_package()\n" + cmake),
        "launch/a.launch": INCLUDE.format(default, include),
        "robots/grey/grey.launch": "<launch/>\n",
        "robots/grey.launch": "<launch/>\n",
    }
    found = [message for message in messages("directory-not-installed", files, tmp_path) if "robots" in message]
    assert bool(found) is is_told, found


def test_a_directory_in_a_comment_is_not_used(tmp_path: Path) -> None:
    files = {
        "CMakeLists.txt": CMAKE.format("catkin_package()\n" + SHARE.format("launch", "")),
        "launch/a.launch": f"<launch><!-- {INCLUDE.format('', 'robots/$(arg robot).launch')} --></launch>\n",
        "robots/grey.launch": "<launch/>\n",
    }
    assert messages("directory-not-installed", files, tmp_path) == []
