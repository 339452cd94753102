# SPDX-License-Identifier: Apache-2.0
"""Files that are called as tests are, and what builds make of them."""

from __future__ import annotations

import pytest
from in_memory import workspace_of

from haros_ci.workspace.products import Products

MANIFEST = (
    '<package format="3"><name>demo</name><version>1.0.0</version><buildtool_depend>ament_cmake</buildtool_depend>'
    "<export><build_type>{}</build_type></export></package>"
)
SPEC = "src/motor_spec.cpp"


def has(cmake: str, path: str = SPEC) -> bool:
    files = {
        "package.xml": MANIFEST.format("ament_cmake"),
        "CMakeLists.txt": f"project(demo)\nfind_package(ament_cmake REQUIRED)\n{cmake}\nament_package()\n",
        "src/driver.cpp": "int main() {}\n",
        SPEC: "int f();\n",
    }
    return Products(workspace_of(files)).has(path)


@pytest.mark.parametrize(
    "cmake",
    [
        f"add_executable(driver src/driver.cpp {SPEC})",
        f"add_library(motor SHARED {SPEC})",
        "file(GLOB SOURCES src/*.cpp)\nadd_executable(driver ${SOURCES})",
        "aux_source_directory(src SOURCES)\nadd_executable(driver ${SOURCES})",
        f"add_executable(driver src/driver.cpp)\ntarget_sources(driver PRIVATE {SPEC})",
        f"if(NOT WITH_MOTOR)\nadd_executable(driver {SPEC})\nendif()",
        f"ament_auto_add_executable(driver {SPEC})",
        f"add_executable(inspector {SPEC})",
    ],
)
def test_part_of_a_program(cmake: str) -> None:
    assert has(cmake)


@pytest.mark.parametrize(
    "cmake",
    [
        "add_executable(driver src/driver.cpp)",
        f"add_executable(motor_test {SPEC})",
        f"add_executable(motor_spec {SPEC})",
        f"add_library(mock_motor {SPEC})",
        f"ament_add_gtest(motor {SPEC})",
        f"if(BUILD_TESTING)\nadd_executable(motor {SPEC})\nendif()",
        f"catkin_add_gtest(motor {SPEC})",
        f"# add_executable(driver {SPEC})",
        f"install(FILES {SPEC} DESTINATION share)",
    ],
)
def test_no_part_of_one(cmake: str) -> None:
    assert not has(cmake)
    assert not has(cmake, "src/other.cpp")


@pytest.mark.parametrize(
    ("entry", "expected"),
    [
        ("go = demo.test_rig:main", True),
        ("test_rig = demo.test_rig:main", False),
        ("go = demo.other:main", False),
        ("rig = demo:test_rig", False),
    ],
)
def test_an_entry_point(entry: str, expected: bool) -> None:
    files = {
        "package.xml": MANIFEST.format("ament_python"),
        "setup.py": f"setup(name='demo', packages=['demo'], entry_points={{'console_scripts': ['{entry}']}})\n",
        "demo/__init__.py": "",
        "demo/test_rig.py": "def main():\n    pass\n",
        "demo/other.py": "def main():\n    pass\n",
    }
    assert Products(workspace_of(files)).has("demo/test_rig.py") is expected


def test_a_file_of_no_package() -> None:
    assert not Products(workspace_of({"a_test.cpp": "int a;\n"})).has("a_test.cpp")
