# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

import pytest

from haros_ci.model.package import Package
from haros_ci.workspace.build import builds
from haros_ci.workspace.discover import discover

ONE = "<package><name>{}</name><buildtool_depend>catkin</buildtool_depend></package>"
TWO = "<package format='3'><name>{}</name><export><build_type>ament_cmake</build_type></export></package>"
NEITHER = "<package><name>{}</name></package>"
BOTH = """<package format="3"><name>{}</name>
  <buildtool_depend condition="$ROS_VERSION == 1">catkin</buildtool_depend>
  <buildtool_depend condition="$ROS_VERSION == 2">ament_cmake</buildtool_depend>
  <depend condition="$ROS_VERSION == 1">roscpp</depend>
  <depend condition="$ROS_VERSION == 2">rclcpp</depend>
  <export>
    <build_type condition="$ROS_VERSION == 1">catkin</build_type>
    <build_type condition="$ROS_VERSION == 2">ament_cmake</build_type>
  </export></package>"""
BRIDGE = "<package format='3'><name>{}</name><depend>roscpp</depend><depend>rclcpp</depend></package>"


def write(root: Path, manifests: Iterable[tuple[str, str]]) -> None:
    for name, manifest in manifests:
        (root / name).mkdir(parents=True)
        (root / name / "package.xml").write_text(manifest.format(name))


def packages(root: Path, *manifests: str) -> list[Package]:
    write(root, ((f"p{number}", manifest) for number, manifest in enumerate(manifests)))
    return list(discover(root, ()).packages)


@pytest.mark.parametrize(
    ("manifests", "expected"),
    [
        ((ONE, TWO, NEITHER), [1, 2, None]),
        ((BOTH,), [2]),
        ((BOTH, NEITHER), [2, None]),
        ((BOTH, BOTH), [2, 2]),
        ((BOTH, TWO), [2, 2]),
        ((BOTH, ONE), [None, 1]),
        ((ONE, BOTH), [1, None]),
        ((BOTH, ONE, TWO), [2, 1, 2]),
        ((BRIDGE,), [2]),
        ((BRIDGE, ONE), [None, 1]),
    ],
)
def test_which_ros_packages_are_of(tmp_path: Path, manifests: tuple[str, ...], expected: list[int | None]) -> None:
    assert [package.ros for package in packages(tmp_path, *manifests)] == expected


def test_a_package_for_both_keeps_its_dependencies(tmp_path: Path) -> None:
    (found,) = packages(tmp_path, BOTH)
    assert found.build_type == "ament_cmake"
    assert [(d.name, d.condition) for d in found.dependencies] == [
        ("catkin", "$ROS_VERSION == 1"),
        ("ament_cmake", "$ROS_VERSION == 2"),
        ("roscpp", "$ROS_VERSION == 1"),
        ("rclcpp", "$ROS_VERSION == 2"),
    ]


CMAKE = """\
if($ENV{ROS_VERSION} EQUAL 1)
  add_executable(one a.cpp)
elseif($ENV{ROS_VERSION} EQUAL 2)
  add_executable(two a.cpp)
endif()
"""


@pytest.mark.parametrize(
    ("others", "targets"),
    [((), [("two", False)]), ((TWO,), [("two", False)]), ((ONE,), [("one", True), ("two", True)])],
)
def test_the_build_of_a_package_for_both(
    tmp_path: Path, others: tuple[str, ...], targets: list[tuple[str, bool]]
) -> None:
    write(tmp_path, [("arm", BOTH), *((f"p{number}", manifest) for number, manifest in enumerate(others))])
    (tmp_path / "arm/CMakeLists.txt").write_text(CMAKE)
    (tmp_path / "arm/a.cpp").write_text("int main() {}\n")
    build = builds(discover(tmp_path, ()))["arm"]
    assert [(target.name, target.is_conditional) for target in build.targets] == targets


@pytest.mark.parametrize("marker", ["COLCON_IGNORE", "AMENT_IGNORE", "CATKIN_IGNORE"])
def test_packages_that_build_tools_pass_over_are_not_there(tmp_path: Path, marker: str) -> None:
    write(tmp_path, [("a", ONE), ("b", TWO), ("b/inner", TWO)])
    (tmp_path / "b" / marker).write_text("")
    assert [package.path for package in discover(tmp_path, ()).packages] == ["a"]


def test_metapackages(tmp_path: Path) -> None:
    (found,) = packages(tmp_path, TWO.replace("<export>", "<export><metapackage/>"))
    assert (found.is_metapackage, found.ros) == (True, 2)
