# SPDX-License-Identifier: Apache-2.0
"""What a user has to write is in the message as a whole, in words that fit what is there."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.api.testing import said
from haros_ci.checking.page import Example
from haros_ci.checking.wording import NAMED, WRITTEN, listed, spelled_out
from haros_ci.registry import checks

MANIFEST = (
    '<package format="3"><name>demo</name><version>1.0.0</version><description>d</description><maintainer email="a@b.cd">m</maintainer>'
    "<license>Apache-2.0</license>{}<export><build_type>{}</build_type></export></package>\n"
)
SETUP = (
    "from setuptools import setup\nsetup(name='demo', version='1.0.0', packages=['demo'], data_files=[('share/demo/launch', ['launch/a.launch.xml'])],\n"
    "      entry_points={'console_scripts': ['run = demo.run:main']})\n"
)
RUN = "import rclpy\n\n\ndef main():\n    rclpy.init()\n    rclpy.spin(rclpy.create_node('a'))\n"
PACKAGES = ("turtlesim", "joy", "joy_teleop", "rviz2", "robot_state_publisher", "tf2_ros", "slam_toolbox", "nav2_amcl")


def messages(check_id: str, files: dict[str, str], folder: Path) -> list[str]:
    check = next(check for check in checks() if check.id == check_id)
    return [result.message for result in said(check, Example("", True, files), folder)]


@pytest.mark.parametrize("count", [1, 2, NAMED, NAMED + 1, WRITTEN, WRITTEN + 1])
def test_names_in_words(count: int) -> None:
    names = [f"n{i}" for i in range(count)]
    assert ("more" in listed(names)) == (count > NAMED)
    assert ("more" in spelled_out(names)) == (count > WRITTEN)
    assert all(name in spelled_out(names) for name in names[:WRITTEN])


def test_all_dependencies_to_add_are_named(tmp_path: Path) -> None:
    nodes = "".join(f'<node pkg="{name}" exec="n"/>' for name in PACKAGES)
    files = {
        "package.xml": MANIFEST.format("<exec_depend>rclpy</exec_depend>", "ament_python"),
        "setup.py": SETUP,
        "demo/__init__.py": "",
        "demo/run.py": RUN
        + "".join(f"import {name}\n" for name in ("requests", "cv2", "pandas", "scipy", "serial", "PIL")),
        "launch/a.launch.xml": f"<launch>{nodes}</launch>\n",
    }
    (message,) = messages("undeclared-launch-dependency", files, tmp_path / "a")
    assert all(f"<exec_depend>{name}</exec_depend>" in message for name in PACKAGES)
    (message,) = messages("undeclared-import", files, tmp_path / "b")
    assert message.count("<exec_depend>") == 6 and "add <" in message
    assert "more" not in message.partition("; add ")[2]


@pytest.mark.parametrize(
    ("setup_cfg", "words"),
    [
        (None, ["package demo has no setup.cfg, which sets", "install_scripts=$base/lib/demo under [install]"]),
        ("[metadata]\n", ["setup.cfg of package demo does not set", "; write install_scripts=$base/lib/demo under"]),
        ("", ["setup.cfg of package demo does not set", "; write install_scripts=$base/lib/demo under"]),
        ("[develop]\nscript_dir=$base/lib/demo\n[install]\ninstall_scripts=$base/lib/demo\n", []),
        # misspelt
        ("[develope]\nscript_dir=$base/lib/demo\n[install]\ninstall_scripts=$base/lib/demo\n", ["setup.cfg of package demo has [develope], which setuptools does not know: with colcon build --symlink-install", "; write [develop]"]),
        ("[Develop]\nscript_dir=$base/lib/demo\n[install]\ninstall_scripts=$base/lib/demo\n", ["has [Develop], which", "; write [develop]"]),
        ("[develop]\nscript_dirs=$base/lib/demo\n[install]\ninstall_scripts=$base/lib/demo\n", ["has script_dirs, which", "; write script_dir"]),
        ("[develop]\nscript_dir=$base/lib/demo\n[instal]\ninstall_scripts=$base/lib/demo\n", ["has [instal], which setuptools does not know, and so does not set the directory", "; write [install]"]),
        ("[develop]\nscript_dir=$base/lib/demo\n[install]\ninstall-script=$base/lib/demo\n", ["has install-script, which", "; write install_scripts"]),
        # nothing is nearly called so, or it is set
        ("[install]\ninstall_scripts=$base/lib/demo\n", []),
        ("[options]\nscript_dir=a\n[install]\ninstall_scripts=$base/lib/demo\n", []),
        ("[develops]\na=b\n[develop]\nscript_dir=$base/lib/demo\n[install]\ninstall_scripts=$base/lib/demo\n", []),
        ("[develop]\nscript-dir=$base/lib/demo\n[install]\ninstall-scripts=$base/lib/demo\n", []),
        ("# [develope]\n[install]\ninstall_scripts=$base/lib/demo\n", []),
        ("[develop]\nuser=1\n[install]\ninstall_scripts=$base/lib/demo\n", []),
    ],
)  # fmt: skip
def test_a_setup_cfg_that_is_not_there(setup_cfg: str | None, words: list[str], tmp_path: Path) -> None:
    files = {
        "package.xml": MANIFEST.format("<exec_depend>rclpy</exec_depend>", "ament_python"),
        "resource/demo": "",
        "setup.py": SETUP.replace(
            "data_files=[",
            "data_files=[('share/ament_index/resource_index/packages', ['resource/demo']), ('share/demo', ['package.xml']), ",
        ),
        "demo/__init__.py": "",
        "demo/run.py": RUN,
        "launch/a.launch.xml": "<launch/>\n",
    }
    found = messages(
        "python-package-incomplete", {**files, **({} if setup_cfg is None else {"setup.cfg": setup_cfg})}, tmp_path
    )
    assert len(found) == bool(words)
    assert all(word in message for message in found for word in words)


TOOL = "cmake_minimum_required(VERSION 3.8)\nproject(demo)\nfind_package(ament_cmake REQUIRED)\nament_package()\n"


@pytest.mark.parametrize(
    ("needs", "count"),
    [
        ("<depend>house_of_robots</depend>", 1),
        ("", 1),
        ("<depend>rclcpp</depend>", 0),
        ("<buildtool_depend>ament_cmake</buildtool_depend>", 0),
        ("<buildtool_depend>ament_cmake_auto</buildtool_depend>", 0),
        ("<buildtool_depend>house_cmake</buildtool_depend>", 0),
        ("<build_depend>ament_cmake</build_depend>", 0),
        ("<depend>ament_cmake</depend>", 0),
        ("<buildtool_depend>rosidl_default_generators</buildtool_depend>", 0),
    ],
)
def test_a_manifest_without_its_build_tool(needs: str, count: int, tmp_path: Path) -> None:
    files = {"package.xml": MANIFEST.format(needs, "ament_cmake"), "CMakeLists.txt": TOOL}
    found = messages("undeclared-dependency", files, tmp_path / "a")
    assert len(found) == count and all("add <buildtool_depend>ament_cmake</buildtool_depend>" in one for one in found)
    assert messages("wrong-build-type", files, tmp_path / "b") == []


@pytest.mark.parametrize(
    ("module", "name", "other"),
    [("tf2_ros", "tf2_ros_py", "tf2_ros"), ("sensor_msgs_py", "sensor_msgs_py", "sensor_msgs")],
)
def test_the_package_of_python_is_proposed(module: str, name: str, other: str, tmp_path: Path) -> None:
    """From Galactic on tf2_ros is of C++ alone: who adds it has the failing import still."""
    files = {
        "package.xml": MANIFEST.format("<exec_depend>rclpy</exec_depend>", "ament_python"),
        "setup.py": SETUP,
        "demo/__init__.py": "",
        "demo/run.py": f"{RUN}import {module}\n",
    }
    (message,) = messages("undeclared-import", files, tmp_path)
    assert f"<exec_depend>{name}</exec_depend>" in message
    assert f"<exec_depend>{other}</exec_depend>" not in message and f"(or {other})" not in message


@pytest.mark.parametrize(
    ("name", "key"),
    [("Qt6", "qt6-base-dev"), ("Qt5", "qtbase5-dev"), ("Eigen3", "eigen"), ("PCL", "libpcl-all-dev")],
)
def test_what_brings_the_whole_is_proposed(name: str, key: str, tmp_path: Path) -> None:
    files = {
        "package.xml": MANIFEST.format("<buildtool_depend>ament_cmake</buildtool_depend>", "ament_cmake"),
        "CMakeLists.txt": f"cmake_minimum_required(VERSION 3.8)\nproject(demo)\nfind_package(ament_cmake REQUIRED)\nfind_package({name} REQUIRED COMPONENTS Core)\nament_package()\n",
    }
    (message,) = messages("undeclared-dependency", files, tmp_path)
    assert f"demo needs {key} to build" in message


@pytest.mark.parametrize(
    ("name", "is_open"),
    [
        ("opencv4", False),
        ("OpenCV 3.4.12", False),
        ("Boost", False),
        ("our.tools", False),
        ("our_tools", True),
        ("our_tools2", True),
    ],
)
def test_a_name_that_is_no_package_brings_none(name: str, is_open: bool, tmp_path: Path) -> None:
    """A package that nobody knows may bring std_msgs; a library of the system under a wrong name does not."""
    files = {
        "package.xml": MANIFEST.format(
            f"<buildtool_depend>ament_cmake</buildtool_depend><depend>{name}</depend>", "ament_cmake"
        ),
        "CMakeLists.txt": "cmake_minimum_required(VERSION 3.8)\nproject(demo)\nfind_package(ament_cmake REQUIRED)\nfind_package(std_msgs REQUIRED)\nament_package()\n",
    }
    assert bool(messages("undeclared-dependency", files, tmp_path)) is not is_open
