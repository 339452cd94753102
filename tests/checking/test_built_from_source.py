# SPDX-License-Identifier: Apache-2.0
"""A library of the system that the repository's own pages build from source is a note; a package of ROS is to be declared all the same."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.api.testing import said
from haros_ci.checking.page import Example
from haros_ci.registry import checks
from haros_ci.results.rule import Level

MANIFEST = (
    '<package format="2"><name>demo</name><version>1.0.0</version><description>d</description>'
    '<maintainer email="a@example.org">m</maintainer><license>MIT</license><buildtool_depend>catkin</buildtool_depend>'
    "<depend>roscpp</depend></package>\n"
)
CMAKE = """cmake_minimum_required(VERSION 3.0.2)
project(demo)
find_package(catkin REQUIRED COMPONENTS roscpp)
catkin_package()
include_directories(${catkin_INCLUDE_DIRS})
add_executable(solve solve.cpp)
target_link_libraries(solve ${catkin_LIBRARIES})
"""
LIBRARY = "#include <ros/ros.h>\n#include <nlopt.hpp>\nint main() {}\n"
PACKAGE = "#include <ros/ros.h>\n#include <tf2_ros/buffer.h>\nint main() {}\n"
CLONE = "git clone -b v2 https://example.org/solvers/{}.git && cd {} && make && sudo make install\n"


@pytest.mark.parametrize(
    ("code", "more", "expected"),
    [
        (LIBRARY, {}, Level.ERROR),
        (LIBRARY, {"README.md": "It needs nlopt.\n"}, Level.ERROR),
        (LIBRARY, {"README.md": CLONE.replace("{}", "ipopt")}, Level.ERROR),
        (LIBRARY, {"README.md": CLONE.replace("{}", "nlopt")}, Level.NOTE),
        (LIBRARY, {"docker/Dockerfile": "RUN " + CLONE.replace("{}", "nlopt")}, Level.NOTE),
        (LIBRARY, {".gitlab-ci.yml": "  - " + CLONE.replace("{}", "nlopt")}, Level.NOTE),
        (PACKAGE, {"README.md": CLONE.replace("{}", "tf2_ros")}, Level.ERROR),
    ],
)
def test_levels(code: str, more: dict[str, str], expected: Level, tmp_path: Path) -> None:
    check = next(check for check in checks() if check.id == "undeclared-dependency")
    files = {"package.xml": MANIFEST, "CMakeLists.txt": CMAKE, "solve.cpp": code, **more}
    (result,) = said(check, Example("", True, files), tmp_path)
    assert result.level is expected


VENDOR = (
    '<package format="2"><name>{}</name><version>1.0.0</version><description>d</description>'
    '<maintainer email="a@example.org">m</maintainer><license>MIT</license><buildtool_depend>catkin</buildtool_depend>{}</package>\n'
)
DOWNLOAD = """cmake_minimum_required(VERSION 3.14)
project(solver_vendor)
find_package(catkin REQUIRED)
include(FetchContent)
FetchContent_Declare(solver GIT_REPOSITORY https://example.org/solver.git GIT_TAG v1)
FetchContent_MakeAvailable(solver)
catkin_package()
"""


def _beside(code: str, depend: str, vendor: str, between: str = "") -> dict[str, str]:
    """The package ``demo`` beside one that downloads (or not), and one that depends on that."""
    inner = "cmake_minimum_required(VERSION 3.0.2)\nproject(between)\nfind_package(catkin REQUIRED)\ncatkin_package()\n"
    return {
        "demo/package.xml": MANIFEST.replace("</package>", f"<depend>{depend}</depend></package>"),
        "demo/CMakeLists.txt": CMAKE,
        "demo/solve.cpp": code,
        "solver_vendor/package.xml": VENDOR.format("solver_vendor", ""),
        "solver_vendor/CMakeLists.txt": vendor,
        "between/package.xml": VENDOR.format("between", between),
        "between/CMakeLists.txt": inner,
    }


@pytest.mark.parametrize(
    ("files", "expected"),
    [
        (_beside(LIBRARY, "solver_vendor", DOWNLOAD), Level.NOTE),
        (
            _beside(
                LIBRARY, "solver_vendor", DOWNLOAD.replace("FetchContent_Declare(solver", "ExternalProject_Add(solver")
            ),
            Level.NOTE,
        ),
        (_beside(LIBRARY, "between", DOWNLOAD, "<depend>solver_vendor</depend>"), Level.NOTE),
        (_beside(LIBRARY, "between", DOWNLOAD), Level.ERROR),
        (_beside(LIBRARY, "between", DOWNLOAD, "<test_depend>solver_vendor</test_depend>"), Level.ERROR),
        (
            _beside(
                LIBRARY,
                "solver_vendor",
                CMAKE.split("add_executable")[0].replace("demo", "solver_vendor").replace(" COMPONENTS roscpp", ""),
            ),
            Level.ERROR,
        ),
        (_beside(PACKAGE, "solver_vendor", DOWNLOAD), Level.ERROR),
    ],
)
def test_a_package_that_downloads_may_bring_a_library(files: dict[str, str], expected: Level, tmp_path: Path) -> None:
    check = next(check for check in checks() if check.id == "undeclared-dependency")
    results = said(check, Example("", True, files), tmp_path)
    assert [one.level for one in results if one.location.path == "demo/package.xml"] == [expected]
