# SPDX-License-Identifier: Apache-2.0
"""What undeclared-dependency advises: the parts of Boost, what stands inside of another element, and what is better left in find_package()."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.api.testing import said
from haros_ci.checking.page import Example
from haros_ci.registry import checks

PACKAGE = (
    '<package format="2">\n<name>demo</name><version>1.0.0</version><description>d</description>\n'
    '<maintainer email="a@example.org">m</maintainer><license>MIT</license>\n{0}\n</package>\n'
)
ROS1 = "<buildtool_depend>catkin</buildtool_depend>"
ROS2 = "<buildtool_depend>ament_cmake</buildtool_depend>{}<export><build_type>ament_cmake</build_type>{}</export>"
CMAKE = "cmake_minimum_required(VERSION 3.8)\nproject(demo)\n{}\nadd_executable(demo a.cpp)\n"


def messages(check_id: str, package: str, cmake: str, source: str, tmp_path: Path) -> list[str]:
    files = {"package.xml": PACKAGE.format(package), "CMakeLists.txt": CMAKE.format(cmake), "a.cpp": source}
    check = next(check for check in checks() if check.id == check_id)
    return [result.message for result in said(check, Example("", True, files), tmp_path)]


@pytest.mark.parametrize(
    ("find", "keys"),
    [
        ("REQUIRED", ["libboost-dev"]),
        ("1.65 REQUIRED", ["libboost-dev"]),
        ("REQUIRED COMPONENTS headers", ["libboost-dev"]),
        ("REQUIRED COMPONENTS iostreams", ["libboost-iostreams-dev"]),
        ("COMPONENTS system filesystem REQUIRED", ["libboost-filesystem-dev", "libboost-system-dev"]),
        ("REQUIRED date_time", ["libboost-date-time-dev"]),
        ("REQUIRED COMPONENTS program_options OPTIONAL_COMPONENTS thread", ["libboost-program-options-dev"]),
        ("REQUIRED COMPONENTS python38", ["libboost-python-dev"]),
        ("REQUIRED COMPONENTS iostreams unit_test_framework", ["boost"]),
    ],
)
def test_parts_of_boost(find: str, keys: list[str], tmp_path: Path) -> None:
    cmake = f"find_package(ament_cmake REQUIRED)\nfind_package(Boost {find})"
    source = "#include <boost/format.hpp>\nint main() {}\n"
    (message,) = messages("undeclared-dependency", ROS2.format("", ""), cmake, source, tmp_path)
    assert message.startswith(f"demo needs {' and '.join(keys)} to build")
    assert all(f"<depend>{key}</depend>" in message for key in keys)
    declared = "".join(f"<depend>{key}</depend>" for key in keys)
    assert messages("undeclared-dependency", ROS2.format(declared, ""), cmake, source, tmp_path / "declared") == []


def test_a_header_of_boost_with_the_key_of_a_part(tmp_path: Path) -> None:
    package = ROS2.format("<depend>libboost-thread-dev</depend>", "")
    cmake = "find_package(ament_cmake REQUIRED)"
    assert (
        messages("undeclared-dependency", package, cmake, "#include <boost/format.hpp>\nint main() {}\n", tmp_path)
        == []
    )


@pytest.mark.parametrize(
    ("inside", "expected"),
    [
        ("\n<depend>nav_msgs</depend>\n", "(line 5 has it inside <export>, where no tool reads it: move it out)"),
        ("<other><build_depend> nav_msgs </build_depend></other>", "has it inside <other>"),
        ("<depend>std_msgs</depend>", ""),
        ("<depend/>", ""),
        ("", ""),
    ],
)
def test_a_dependency_inside_of_another_element(inside: str, expected: str, tmp_path: Path) -> None:
    cmake = "find_package(ament_cmake REQUIRED)\nfind_package(nav_msgs REQUIRED)"
    (message,) = messages("undeclared-dependency", ROS2.format("", inside), cmake, "int main() {}\n", tmp_path)
    assert expected in message and ("inside <" in message) == bool(expected)


@pytest.mark.parametrize(
    ("find", "source", "is_idle"),
    [
        ("catkin REQUIRED COMPONENTS tf_conversions", "int main() {}\n", True),
        ("catkin REQUIRED COMPONENTS tf_conversions", "#include <Eigen/Dense>\nint main() {}\n", False),
        ("catkin REQUIRED COMPONENTS tf_conversions", "#include <vector>\nint main() {}\n", True),
        (
            "catkin REQUIRED COMPONENTS tf_conversions)\nfind_package(Eigen3 REQUIRED",
            "#include <Eigen/Dense>\nint main() {}\n",
            True,
        ),
    ],
)
@pytest.mark.parametrize("declared", ["", "<depend>eigen</depend>"])
def test_what_the_headers_of_another_library_come_with(
    find: str, source: str, is_idle: bool, declared: str, tmp_path: Path
) -> None:
    found = messages(
        "undeclared-dependency", ROS1 + declared, f"find_package({find})\ncatkin_package()", source, tmp_path
    )
    (message,) = (each for each in found if "needs tf_conversions" in each)
    assert ("remove it from find_package()" in message) == is_idle
