# SPDX-License-Identifier: Apache-2.0
"""Which file or program is meant by a name that is not there, and where none is."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.api.testing import said
from haros_ci.checking.page import Example
from haros_ci.checking.wording import alternatives
from haros_ci.model.similar_files import similar_files, similar_names
from haros_ci.model.slips import equally_near
from haros_ci.registry import checks


@pytest.mark.parametrize(
    ("wanted", "paths", "owner", "expected"),
    [
        ("launch/a/scan.launch", ["launch/scan.launch", "launch/a/scam.launch"], "", "launch/scan.launch"),
        ("launch/b/scan.launch", ["a/scan.launch", "launch/scan.launch"], "", "launch/scan.launch"),
        (
            "launch/detection.launch",
            ["launch/all_detections.launch", "launch/quail_detection.launch"],
            "quail_detection",
            "launch/quail_detection.launch",
        ),
        (
            "launch/scan.launch",
            ["launch/scans.launch", "launch/quail_scan.launch"],
            "quail",
            "launch/quail_scan.launch",
        ),
        (
            "launch/start_cameras.launch.xml",
            ["launch/start_cameras_north.launch"],
            "",
            "launch/start_cameras_north.launch",
        ),
        ("launch/arm.launch", ["launch/arm.launch.py"], "", "launch/arm.launch.py"),
        ("meshes/Base.stl", ["meshes/base.STL"], "", "meshes/base.STL"),
        ("meshes/left_arm.min.dae", ["meshes/arm.min.dae", "meshes/hand.min.dae"], "", None),
        (
            "meshes/left_base_link_2.dae",
            ["meshes/base_link_1.dae", "meshes/base_link_2.dae"],
            "",
            "meshes/base_link_2.dae",
        ),
        ("config/drive_param.yaml", ["config/drive.param.yaml"], "", "config/drive.param.yaml"),
        ("config/navigation.yaml", ["config/navigaton.yaml"], "", "config/navigaton.yaml"),
        # weak: the directory, the ending and a word are the same
        ("launch/inc/start_cameras.launch.xml", ["launch/inc/start_compass_driver.launch.xml"], "", None),
        ("launch/scan.launch", ["launch/drive.launch", "launch/scan.yaml"], "", None),
        ("meshes/link_7.stl", ["meshes/link_1.stl", "meshes/link_2.stl"], "", None),
        ("meshes/left_wheel.stl", ["meshes/right_wheel.stl"], "", None),
        ("launch/robot.launch", ["launch/robot_with_a_very_long_arm.launch"], "", None),
        ("launch/robot.launch", [], "", None),
        ("launch/start_vel_selector.launch", ["launch/start_mode_selector.launch"], "", None),  # another word
        ("launch/navigation_planner_ros.launch", ["launch/navigation_ui_planner.launch"], "", None),
        ("config/sim_costmap_params.yaml", ["config/new_costmap_params.yaml"], "", None),
        ("launch/depthimage_to_scan.launch", ["launch/depth_image_scan.launch"], "", "launch/depth_image_scan.launch"),
        ("param/frontie_last_params.yaml", ["param/frontier_last_params.yaml"], "", "param/frontier_last_params.yaml"),
        ("", ["launch/robot.launch"], "", None),
        (".launch", ["launch/robot.launch", ""], "", None),
    ],
)
def test_files(wanted: str, paths: list[str], owner: str, expected: str | None) -> None:
    assert similar_files(wanted, paths, owner) == ((expected,) if expected is not None else ())


@pytest.mark.parametrize(
    ("wanted", "names", "expected"),
    [
        ("talker", ["talker.py", "listener.py"], "talker.py"),
        ("gripper_equipment_set.py", ["GripperEquipment.py", "set.py"], "GripperEquipment.py"),
        ("arm_node", ["arm_nodes"], "arm_nodes"),
        ("camera_1", ["camera_2"], None),
        ("talker", ["walker_of_the_dog"], None),
        ("", ["a"], None),
        ("talker", [], None),
    ],
)
def test_names(wanted: str, names: list[str], expected: str | None) -> None:
    assert similar_names(wanted, names) == ((expected,) if expected is not None else ())


PACKAGE = (
    '<package format="2"><name>{0}</name><version>1.0.0</version><description>d</description>'
    '<maintainer email="a@example.org">m</maintainer><license>MIT</license><buildtool_depend>catkin</buildtool_depend>{1}</package>\n'
)
CMAKE = "cmake_minimum_required(VERSION 3.0)\nproject({0})\nfind_package(catkin REQUIRED)\n{1}\n"


def message(check_id: str, files: dict[str, str], tmp_path: Path) -> str:
    check = next(check for check in checks() if check.id == check_id)
    (result,) = said(check, Example("", True, files), tmp_path)
    return result.message


def test_a_file_of_the_name_in_another_package(tmp_path: Path) -> None:
    files = {
        "quail/package.xml": PACKAGE.format("quail", ""),
        "quail/CMakeLists.txt": CMAKE.format("quail", "catkin_package()"),
        "quail/launch/all.launch": '<launch><include file="$(find quail)/launch/gantry.launch"/></launch>\n',
        "robin/package.xml": PACKAGE.format("robin", ""),
        "robin/CMakeLists.txt": CMAKE.format("robin", "catkin_package()"),
        "robin/launch/gantry.launch": "<launch/>\n",
    }
    assert "lies outside of the package, at '../robin/launch/gantry.launch': name" in message(
        "missing-launch-file", files, tmp_path
    )


@pytest.mark.parametrize("exported", [True, False])
def test_a_file_that_the_manifest_exports(exported: bool, tmp_path: Path) -> None:
    export = '<export><rviz plugin="${prefix}/quail_plugin.xml"/></export>' if exported else ""
    files = {
        "package.xml": PACKAGE.format("demo", export),
        "CMakeLists.txt": CMAKE.format(
            "demo", "catkin_package()\ninstall(FILES plugin.xml DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})"
        ),
        "quail_plugin.xml": "<library/>\n",
        "a_plugin.xml": "<library/>\n",
    }
    assert ("did you mean quail_plugin.xml?" in message("missing-install-source", files, tmp_path)) == exported


def test_the_only_library_that_is_installed(tmp_path: Path) -> None:
    text = (
        "catkin_package(LIBRARIES demo)\nadd_library(demos a.cpp)\nadd_library(quail_plugin a.cpp)\n"
        "install(TARGETS quail_plugin LIBRARY DESTINATION lib)"
    )
    files = {
        "package.xml": PACKAGE.format("demo", ""),
        "CMakeLists.txt": CMAKE.format("demo", text),
        "a.cpp": "int a;\n",
    }
    assert "did you mean quail_plugin?" in message("unknown-target", files, tmp_path)
    files["CMakeLists.txt"] += "install(TARGETS demos LIBRARY DESTINATION lib)\n"
    assert "did you mean demos?" in message("unknown-target", files, tmp_path / "both")


@pytest.mark.parametrize("ros", [1, 2])
def test_a_library_that_is_started(ros: int, tmp_path: Path) -> None:
    launch = '<launch><node pkg="demo" {}="arm" name="arm"/></launch>\n'
    package = PACKAGE.format("demo", "")
    if ros == 2:
        package = package.replace("catkin", "ament_cmake").replace(
            "</package>", "<export><build_type>ament_cmake</build_type></export></package>"
        )
    files = {
        "package.xml": package,
        "CMakeLists.txt": f"cmake_minimum_required(VERSION 3.8)\nproject(demo)\nfind_package({'catkin' if ros == 1 else 'ament_cmake'} REQUIRED)\nadd_library(arm a.cpp)\n",
        "a.cpp": "int a;\n",
        **({"launch/a.launch": launch.format("type")} if ros == 1 else {"launch/a.launch.xml": launch.format("exec")}),
    }
    assert ("into a container" in message("unknown-executable", files, tmp_path)) == (ros == 2)


def test_a_file_that_is_written_without_its_ending(tmp_path: Path) -> None:
    files = {
        "package.xml": PACKAGE.format("demo", ""),
        "CMakeLists.txt": "project(demo)\nfind_package(catkin REQUIRED)\ncatkin_package()\n"
        "install(PROGRAMS scripts/split_bag DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})\n",
        "scripts/split_bag.py": "print(1)\n",
        "scripts/split_bag.pyc": "compiled\n",
        "scripts/split_bag.bak": "print(1)\n",
        "scripts/splitter_bag": "print(1)\n",
    }
    assert "did you mean split_bag.py?" in message("missing-install-source", files, tmp_path)


@pytest.mark.parametrize(
    ("wanted", "paths", "expected"),
    [
        # one name in directories of which none is nearer
        ("robots/rover/view.rviz", ["robots/a-rover/view.rviz", "robots/b-rover/view.rviz"], 2),
        ("robots/rover/view.rviz", [f"robots/{one}-rover/view.rviz" for one in "abcdefg"], 4),
        ("launch/display.launch", ["launch/display_real.launch", "launch/display_lab.launch"], 2),
        ("config/arm_lefs.yaml", ["config/arm_lefd.yaml", "config/arm_lefa.yaml"], 2),
        # one of them is nearer
        ("lanch/robot.launch", ["launch/robot.launch", "archive/robot.launch"], 1),
        ("launch/robot.launch", ["launch/robots.launch", "launch/robot_with_arm.launch"], 1),
        ("launch/robot.launch", ["launch/Robot.launch", "launch/robots.launch"], 1),
        ("cfg/robot.yaml", ["config/robot.yaml", "a_place_of_its_own/robot.yaml"], 1),
    ],
)
def test_files_that_are_equally_near(wanted: str, paths: list[str], expected: int) -> None:
    found = similar_files(wanted, paths)
    assert (set(found) <= set(paths), len(found)) == (True, expected)
    assert expected > 1 or found == (paths[0],)


@pytest.mark.parametrize(
    ("word", "known", "expected"),
    [
        ("scan_frot", ["scan_front", "scan_rear"], ("scan_front",)),
        ("pose_x", ["pose_a", "pose_b", "odom"], ("pose_b", "pose_a")),
        ("speeds", ["speed", "speed_limit"], ("speed",)),
        ("speeds", ["rate"], ()),
        ("speeds", [], ()),
    ],
)
def test_words_that_are_equally_near(word: str, known: list[str], expected: tuple[str, ...]) -> None:
    assert equally_near(word, known) == expected


@pytest.mark.parametrize(
    ("names", "expected"),
    [((), ""), (("a",), "a"), (("a", "b"), "a or b"), (("a", "b", "c"), "a, b or c"), (("a", "b", "c", "d"), "")],
)
def test_of_too_many_none_is_named(names: tuple[str, ...], expected: str) -> None:
    assert alternatives(names) == expected
