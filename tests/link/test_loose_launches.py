# SPDX-License-Identifier: Apache-2.0
"""Launch files in no package, beside packages whose nodes they start: they are configurations as those of packages are."""

from __future__ import annotations

from pathlib import Path

import pytest
from follow_kit import CMAKE, ROS2_CMAKE, ROS2_HEAD, Nothing, main

from haros_ci.analysis.architecture import architecture
from haros_ci.config.settings import Settings
from haros_ci.model.loose_launches import starts_any
from haros_ci.workspace.discover import discover

MANIFEST = "<package format='3'><name>p</name><buildtool_depend>{0}</buildtool_depend><export><build_type>{0}</build_type></export></package>"
PACKAGE = {
    "src/p/package.xml": MANIFEST.format("catkin"),
    "src/p/CMakeLists.txt": CMAKE.format("p") + "add_executable(n src/n.cpp)\n",
    "src/p/src/n.cpp": main('ADV("a", 1);'),
}
NODE = '<launch><node pkg="p" type="n" name="one"/></launch>'
ALONE = ["p/n"]


def configurations(root: Path, files: dict[str, str]) -> list[str]:
    for path, text in files.items():
        (root / path).parent.mkdir(parents=True, exist_ok=True)
        (root / path).write_text(text)
    found = architecture(discover(root, (".",)), Settings(root=root), Nothing(), environment={}, known_nodes=False)
    return [configuration.name for configuration in found.configurations]


@pytest.mark.parametrize(
    ("files", "expected"),
    [
        ({"src/launch/a.launch": NODE}, ["src/launch/a.launch"]),
        ({"launch/a.launch": NODE}, ["launch/a.launch"]),
        ({"a.launch": NODE}, ["a.launch"]),
        ({"src/launch/a.launch": NODE, "src/launch/b.launch": NODE}, ["src/launch/a.launch", "src/launch/b.launch"]),
        # one of them includes the other
        (
            {
                "src/launch/a.launch": '<launch><include file="$(dirname)/b.launch"/></launch>',
                "src/launch/b.launch": NODE,
            },
            ["src/launch/b.launch"],
        ),
        (
            {
                "src/launch/a.launch": NODE.replace("</launch>", '<include file="$(dirname)/b.launch"/></launch>'),
                "src/launch/b.launch": NODE,
            },
            ["src/launch/a.launch"],
        ),
        # what a package has stays one
        (
            {
                "src/launch/a.launch": '<launch><include file="$(find p)/launch/b.launch"/></launch>',
                "src/p/launch/b.launch": NODE,
            },
            ["src/launch/a.launch", "p/launch/b.launch"],
        ),
        # those that start nothing of the workspace, or are not beside a package
        ({"src/launch/a.launch": NODE.replace('"p"', '"rviz"')}, ALONE),
        ({"src/launch/a.launch": '<launch><param name="p" textfile="$(find p)/a.txt"/></launch>'}, ALONE),
        ({"docs/launch/a.launch": NODE}, ALONE),
        ({"other/launch/deep/a.launch": NODE}, ALONE),
        ({"other/launch/a.launch": NODE}, ALONE),
        # tests, examples and what is put aside
        ({"test/a.launch": NODE}, ALONE),
        ({"src/old/a.launch": NODE}, ALONE),
        ({"examples/a.launch": NODE}, ALONE),
    ],
)
def test_launch_files_beside_packages(tmp_path: Path, files: dict[str, str], expected: list[str]) -> None:
    assert configurations(tmp_path, {**PACKAGE, **files}) == expected


NEWER = {
    "src/p/package.xml": MANIFEST.format("ament_cmake"),
    "src/p/CMakeLists.txt": ROS2_CMAKE.format("p") + "ament_auto_add_executable(n src/n.cpp)\nament_auto_package()\n",
    "src/p/src/n.cpp": ROS2_HEAD
    + 'int main(int argc, char** argv) { rclcpp::init(argc, argv); auto n = rclcpp::Node::make_shared("n"); rclcpp::spin(n); }\n',
}
PYTHON = (
    "from launch import LaunchDescription\nfrom launch_ros.actions import Node\n"
    "def generate_launch_description():\n    return LaunchDescription([Node(package='p', executable='n')])\n"
)


@pytest.mark.parametrize(
    ("files", "expected"),
    [
        ({"launch/all.launch.py": PYTHON}, ["launch/all.launch.py"]),
        ({"src/bring_up/all_launch.py": PYTHON}, ["src/bring_up/all_launch.py"]),
        ({"launch/a.launch.xml": '<launch><node pkg="p" exec="n"/></launch>'}, ["launch/a.launch.xml"]),
        ({"launch/a.launch.yaml": "launch:\n- node:\n    pkg: p\n    exec: n\n"}, ["launch/a.launch.yaml"]),
        ({"launch/all.py": PYTHON}, ALONE),
        ({"launch/test_all.launch.py": PYTHON}, ALONE),
        ({"launch/all.launch.py": PYTHON.replace("'p'", "'rviz2'")}, ALONE),
        ({"launch/all.launch.py": "# package='p'\n"}, ALONE),
    ],
)
def test_launch_files_of_ros2_beside_packages(tmp_path: Path, files: dict[str, str], expected: list[str]) -> None:
    assert configurations(tmp_path, {**NEWER, **files}) == expected


def test_they_are_not_said_to_be_none(tmp_path: Path) -> None:
    for path, text in {**PACKAGE, "launch/a.launch": NODE, "docs/launch/a.launch": NODE}.items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text(text)
    found = [problem for problem in discover(tmp_path, (".",)).problems if "no package" in problem.message]
    assert [problem.path for problem in found] == ["docs/launch/a.launch"]
    assert found[0].message.startswith("a launch file that lies")


@pytest.mark.parametrize(
    ("text", "is_one"),
    [
        ('<node name="a" pkg = "p" type="n"/>', True),
        ('<include file="$(find-pkg-share p)/launch/a.launch.xml"/>', True),
        ("IncludeLaunchDescription(get_package_share_directory('p'))", True),
        ('PathJoinSubstitution([FindPackageShare("p"), "launch"])', True),
        ("- node:\n    pkg: p\n", True),
        ('<node pkg="pp"/>', False),
        ('<rosparam file="$(find p)/a.yaml"/>', False),
        ("package = p", False),
        ("", False),
    ],
)
def test_what_is_started(text: str, is_one: bool) -> None:
    assert starts_any(text, {"p"}) is is_one
