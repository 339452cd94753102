# SPDX-License-Identifier: Apache-2.0
"""CMakeLists.txt beside the setup.py of a package that is built with ament_python, and directories of which files are installed one by one."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.api.testing import said
from haros_ci.checking.page import Example
from haros_ci.registry import checks

MANIFEST = (
    '<package format="3"><name>demo</name><version>1.0.0</version><description>d</description><maintainer email="a@b.cd">m</maintainer>'
    "<license>Apache-2.0</license><exec_depend>rclpy</exec_depend><export><build_type>{}</build_type></export></package>\n"
)
CMAKE = (
    "cmake_minimum_required(VERSION 3.8)\nproject(other)\nfind_package(ament_cmake REQUIRED)\nfind_package(rosidl_default_generators REQUIRED)\n"
    'rosidl_generate_interfaces(${PROJECT_NAME} "msg/Gone.msg")\nament_package()\n'
)
SETUP = "from glob import glob\nfrom setuptools import setup\nsetup(name='demo', version='1.0.0', packages=['demo'], data_files=[{}])\n"
RULES = ("wrong-package-name", "interface-not-generated", "incomplete-interface-package")


def messages(check_id: str, files: dict[str, str], folder: Path) -> list[str]:
    check = next(check for check in checks() if check.id == check_id)
    return [result.message for result in said(check, Example("", True, files), folder / check_id)]


@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize("kind", ["ament_cmake", "ament_python"])
def test_what_only_cmake_would_stop_at(kind: str, rule: str, tmp_path: Path) -> None:
    files = {
        "package.xml": MANIFEST.format(kind),
        "CMakeLists.txt": CMAKE,
        "setup.py": SETUP.format(""),
        "demo/__init__.py": "",
    }
    assert bool(messages(rule, files, tmp_path)) == (kind == "ament_cmake")


@pytest.mark.parametrize(
    ("kind", "setup", "cmake", "count"),
    [
        ("ament_python", SETUP.format(""), CMAKE, 1),
        ("ament_cmake", SETUP.format(""), CMAKE, 0),
        ("ament_python", SETUP.format(""), CMAKE.replace("rosidl_generate_interfaces", "# "), 0),
        ("ament_python", SETUP.format(""), "", 0),
    ],
)
def test_interfaces_that_are_not_generated(kind: str, setup: str, cmake: str, count: int, tmp_path: Path) -> None:
    files = {
        "package.xml": MANIFEST.format(kind),
        "setup.py": setup,
        "demo/__init__.py": "",
        **({"CMakeLists.txt": cmake} if cmake else {}),
    }
    found = messages("wrong-build-type", files, tmp_path)
    assert len(found) == count and all("so its interfaces are not generated" in message for message in found)


INSTALLS = CMAKE.replace(
    "rosidl_generate",
    "install(DIRECTORY gone DESTINATION share/demo)\ninstall(FILES scripts/run.py DESTINATION lib/demo)\n# ",
)


@pytest.mark.parametrize(
    ("rule", "kind", "setup", "count"),
    [
        ("missing-install-source", "ament_cmake", True, 1),
        ("missing-install-source", "ament_python", True, 0),
        ("missing-install-source", "ament_python", False, 1),
        ("script-not-runnable", "ament_cmake", True, 1),
        ("script-not-runnable", "ament_python", True, 0),
        ("merge-conflict", "ament_python", True, 1),
    ],
)
def test_what_only_cmake_would_install(rule: str, kind: str, setup: bool, count: int, tmp_path: Path) -> None:
    conflict = "<<<<<<< HEAD\n# a\n=======\n# b\n>>>>>>> other\n" if rule == "merge-conflict" else ""
    files = {
        "package.xml": MANIFEST.format(kind),
        "CMakeLists.txt": INSTALLS + conflict,
        "demo/__init__.py": "",
        "scripts/run.py": "#!/usr/bin/env python3\nimport rclpy\nrclpy.init()\n",
        **({"setup.py": SETUP.format("")} if setup else {}),
    }
    assert len(messages(rule, files, tmp_path)) == count


ARM = '<robot name="arm"><property name="folder" value="package://demo/meshes/arm"/><link name="a"/></robot>\n'


@pytest.mark.parametrize(
    ("row", "count"),
    [
        ("('share/demo/meshes/arm', glob('meshes/arm/*')), ('share/demo/urdf', ['urdf/arm.urdf'])", 0),
        ("('share/demo/meshes/arm', ['meshes/arm/a.stl']), ('share/demo/urdf', ['urdf/arm.urdf'])", 0),
        ("('share/demo/urdf', ['urdf/arm.urdf'])", 1),
        ("('share/demo/mesh', glob('meshes/arm/*')), ('share/demo/urdf', ['urdf/arm.urdf'])", 1),
    ],
)
def test_a_directory_whose_files_are_installed(row: str, count: int, tmp_path: Path) -> None:
    files = {
        "package.xml": MANIFEST.format("ament_python"),
        "setup.py": SETUP.format(row),
        "demo/__init__.py": "",
        "meshes/arm/a.stl": "solid a\n",
        "urdf/arm.urdf": ARM,
    }
    assert len(messages("directory-not-installed", files, tmp_path)) == count
