# SPDX-License-Identifier: Apache-2.0
"""What is not installed is a note in a workspace of ROS 1 whose pages and scripts use the devel space alone."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.api.testing import said
from haros_ci.checking.page import Example
from haros_ci.registry import checks
from haros_ci.results.rule import Level

NAME = "quail_arm_driver"
MANIFEST = (
    f'<package format="2"><name>{NAME}</name><version>1.0.0</version><description>d</description>'
    '<maintainer email="a@example.org">m</maintainer><license>MIT</license><buildtool_depend>catkin</buildtool_depend>'
    "<depend>roscpp</depend></package>\n"
)
CMAKE = """cmake_minimum_required(VERSION 3.0.2)
project(quail_arm_driver)
find_package(catkin REQUIRED COMPONENTS roscpp)
catkin_package(INCLUDE_DIRS include LIBRARIES arm)
include_directories(include ${catkin_INCLUDE_DIRS})
add_library(arm SHARED arm.cpp)
add_executable(driver driver.cpp)
add_executable(reader driver.cpp)
target_link_libraries(driver ${catkin_LIBRARIES})
target_link_libraries(reader ${catkin_LIBRARIES})
install(TARGETS arm driver ARCHIVE DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
  LIBRARY DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION} RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
install(DIRECTORY launch DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})
"""
NODE = '#include <ros/ros.h>\nint main(int argc, char ** argv) { ros::init(argc, argv, "n"); ros::spin(); }\n'
LAUNCH = (
    f'<launch><node pkg="{NAME}" type="reader" name="reader"><rosparam command="load" file="$(find {NAME})/config/a.yaml"/>'
    "</node></launch>\n"
)
FILES = {
    "package.xml": MANIFEST,
    "CMakeLists.txt": CMAKE,
    "arm.cpp": "int arm() { return 1; }\n",
    "driver.cpp": NODE,
    "include/quail_arm_driver/arm.h": "int arm();\n",
    "config/a.yaml": "rate: 1\n",
    "launch/a.launch": LAUNCH,
}
IDS = ("directory-not-installed", "target-not-installed")
NOTES, WARNINGS = [Level.NOTE] * 3, [Level.WARNING] * 3


def levels(files: dict[str, str], tmp_path: Path) -> list[Level]:
    found = [
        result
        for check in checks()
        if check.id in IDS
        for result in said(check, Example("", True, files), tmp_path / check.id)
    ]
    return [result.level for result in found]


@pytest.mark.parametrize(
    "more",
    [
        {"README.md": "catkin_make\nsource devel/setup.bash\n"},
        {"README.rst": "Build it with ``catkin build``.\n"},
        {"docker/arm.Dockerfile": "RUN apt-get install -y ros-noetic-roscpp python3-catkin-tools\nRUN catkin_make\n"},
        {"scripts/build.sh": "pip install numpy\ncatkin b\n"},
        {"init/arm.service": "ExecStart=/bin/bash -c 'source /home/a/ws/devel/setup.bash && roslaunch a a.launch'\n"},
        {".gitlab-ci.yml": "build:\n  script:\n    - catkin_make -j2\n"},
        {"README.md": "catkin_make\n", "CHANGELOG.md": "catkin_make install is gone\n"},
        {"README.md": "sudo update-alternatives --install /usr/bin/gcc gcc /usr/bin/gcc-9 1\ncatkin_make\n"},
    ],
)
def test_notes(more: dict[str, str], tmp_path: Path) -> None:
    assert levels({**FILES, **more}, tmp_path) == NOTES


@pytest.mark.parametrize(
    "more",
    [
        {},
        {"README.md": "An arm.\n"},
        {"notes/plan.txt": "catkin_make\n"},
        {"README.md": "catkin_make\n", "docs/robot.md": "source install/setup.bash\n"},
        {"README.md": "catkin_make\ncatkin_make install\n"},
        {"README.md": "catkin_make \\\n  -DCMAKE_BUILD_TYPE=Release \\\n  install\n"},
        {"README.md": "catkin config --extend /opt/ros/noetic --install\ncatkin build\n"},
        {"Dockerfile": "RUN catkin_make_isolated --install --install-space /opt/arm\n"},
        {"README.md": "catkin build\n", "debian/rules": "#!/usr/bin/make -f\n"},
        {"README.md": "catkin build\n", ".travis.yml": "script: industrial_ci/travis.sh\n"},
        {"README.md": "catkin build\n", ".gitlab-ci.yml": "script: ./action-ros-ci\n"},
        {"README.md": "catkin build\n", "release.sh": "bloom-release quail --track noetic\n"},
    ],
)
def test_levels_that_stay(more: dict[str, str], tmp_path: Path) -> None:
    assert levels({**FILES, **more}, tmp_path) == WARNINGS


def test_a_package_that_a_distribution_has_is_installed_by_others(tmp_path: Path) -> None:
    files = {path: text.replace(NAME, "actionlib") for path, text in FILES.items()}
    files["include/actionlib/arm.h"] = files.pop("include/quail_arm_driver/arm.h")
    assert levels({**files, "README.md": "catkin_make\n"}, tmp_path) == WARNINGS


def test_a_change_alone_shows_nothing(tmp_path: Path) -> None:
    readme = "README.md"
    for base, expected in (({readme: "An arm.\n"}, WARNINGS), ({readme: "catkin_make\n"}, NOTES)):
        found = [
            result.level
            for check in checks()
            if check.id in IDS
            for result in said(
                check,
                Example("", True, {**FILES, readme: "catkin_make\n"}, base=base),
                tmp_path / check.id / str(len(expected[0].value)),
            )
        ]
        assert found == expected


def test_a_rule_that_is_wrong_counts_all_the_same(tmp_path: Path) -> None:
    cmake = CMAKE.replace("${CATKIN_PACKAGE_BIN_DESTINATION}", "${CATKIN_GLOBAL_BIN_DESTINATION}")
    launch = LAUNCH.replace('type="reader"', 'type="driver"')
    files = {**FILES, "CMakeLists.txt": cmake, "launch/a.launch": launch, "README.md": "catkin_make\n"}
    (check,) = (check for check in checks() if check.id == "target-not-installed")
    found = {
        result.message.partition(",")[0]: result.level for result in said(check, Example("", True, files), tmp_path)
    }
    assert sorted(level.value for level in found.values()) == ["note", "warning"]


@pytest.mark.parametrize(
    ("library", "name", "expected"),
    [("arm", NAME, Level.WARNING), ("other", NAME, Level.NOTE), ("other", "actionlib", Level.WARNING)],
)
def test_headers_that_no_other_package_includes(library: str, name: str, expected: Level, tmp_path: Path) -> None:
    files = {
        path: text.replace(NAME, name) for path, text in FILES.items() if "launch" not in path and "config" not in path
    }
    files["CMakeLists.txt"] = files["CMakeLists.txt"].replace("LIBRARIES arm", f"LIBRARIES {library}")
    (check,) = (check for check in checks() if check.id == "directory-not-installed")
    (result,) = said(check, Example("", True, files), tmp_path)
    assert result.level is expected


def test_a_module_beside_a_script(tmp_path: Path) -> None:
    rule = "install(PROGRAMS scripts/swim.py DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})\n"
    files = {
        "package.xml": MANIFEST.replace("roscpp", "rospy"),
        "CMakeLists.txt": f"cmake_minimum_required(VERSION 3.0.2)\nproject({NAME})\nfind_package(catkin REQUIRED)\ncatkin_package()\n{rule}",
        "scripts/swim.py": "#!/usr/bin/env python3\nimport rospy\nimport strokes\n",
        "scripts/strokes.py": "long = 1\n",
    }
    check = next(check for check in checks() if check.id == "module-not-installed")
    for page, level in (("catkin_make\n", Level.NOTE), ("catkin_make install\n", Level.WARNING)):
        example = Example("", True, {**files, "README.md": page})
        assert [result.level for result in said(check, example, tmp_path / level.value)] == [level]
