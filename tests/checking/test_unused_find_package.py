# SPDX-License-Identifier: Apache-2.0
"""undeclared-dependency advises to remove a package that CMake alone names, and from which commands; never one that anything uses."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.api.testing import said
from haros_ci.checking.page import Example
from haros_ci.registry import checks

MANIFEST = (
    '<package format="3"><name>demo</name><version>1.0.0</version><description>d</description><maintainer email="a@example.org">m</maintainer>'
    "<license>MIT</license><buildtool_depend>ament_cmake</buildtool_depend><depend>rclcpp</depend>"
    "<export><build_type>ament_cmake</build_type></export></package>\n"
)
CMAKE = (
    "cmake_minimum_required(VERSION 3.8)\nproject(demo)\nfind_package(ament_cmake REQUIRED)\nfind_package(rclcpp REQUIRED)\n"
    "find_package(tf2 REQUIRED)\nadd_executable(talk talk.cpp)\n{}\ninstall(TARGETS talk DESTINATION lib/demo)\nament_package()\n"
)
TALK = "#include <rclcpp/rclcpp.hpp>\nint main() { return 0; }\n"
PASSING = "ament_target_dependencies(talk rclcpp tf2)"


def message(commands: str, code: str, tmp_path: Path) -> str:
    files = {"package.xml": MANIFEST, "CMakeLists.txt": CMAKE.format(commands), "talk.cpp": code}
    check = next(check for check in checks() if check.id == "undeclared-dependency")
    (result,) = said(check, Example("", True, files), tmp_path)
    return result.message


@pytest.mark.parametrize(
    ("commands", "where"),
    [
        ("ament_target_dependencies(talk rclcpp)", "find_package(), or add"),
        (PASSING, "find_package() and ament_target_dependencies(), or add"),
        (
            f"{PASSING}\nament_target_dependencies(talk PUBLIC tf2)",
            "find_package() and ament_target_dependencies(), or add",
        ),
        (
            f"{PASSING}\nament_export_dependencies(tf2)",
            "find_package(), ament_target_dependencies() and ament_export_dependencies(), or add",
        ),
    ],
)
def test_what_cmake_alone_names(commands: str, where: str, tmp_path: Path) -> None:
    assert f"nothing else here uses it: remove it from {where}" in message(commands, TALK, tmp_path)


@pytest.mark.parametrize(
    ("commands", "code"),
    [
        (PASSING, f"#include <tf2/time.h>\n{TALK}"),
        (PASSING, f"// a tf2 buffer\n{TALK}"),
        (f"{PASSING}\ntarget_link_libraries(talk tf2::tf2)", TALK),
        (f"{PASSING}\ntarget_include_directories(talk PRIVATE ${{tf2_INCLUDE_DIRS}})", TALK),
        (f"{PASSING}\ntf2_make_something(talk)", TALK),
        (f"{PASSING}\nmake_something(talk)", TALK),
    ],
)
def test_what_something_uses(commands: str, code: str, tmp_path: Path) -> None:
    assert "remove it" not in message(commands, code, tmp_path)


@pytest.mark.parametrize(("header", "count"), [("gtest/gtest.h", 0), ("gmock/gmock.h", 0), ("tf2/time.h", 1)])
def test_headers_of_frameworks_of_tests(header: str, count: int, tmp_path: Path) -> None:
    cmake = CMAKE.replace("find_package(tf2 REQUIRED)\n", "").format("")
    files = {"package.xml": MANIFEST, "CMakeLists.txt": cmake, "talk.cpp": f"#include <{header}>\n{TALK}"}
    check = next(check for check in checks() if check.id == "undeclared-dependency")
    assert len(said(check, Example("", True, files), tmp_path)) == count
