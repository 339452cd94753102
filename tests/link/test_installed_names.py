# SPDX-License-Identifier: Apache-2.0
"""Programs under the names that they are installed under, and programs that are not followed where they are started."""

from __future__ import annotations

import pytest
from follow_kit import CMAKE, ROS2_CMAKE, ROS2_HEAD, ROS2_NODE, explicit, follow, main, ros2_files, script

CATKIN = CMAKE.format("p")
AMENT = ROS2_CMAKE.format("p")
ROS2_SCRIPT = "#!/usr/bin/env python3\nimport rclpy\nfrom rclpy.node import Node\nrclpy.init()\nn = Node('n')\n"


@pytest.mark.parametrize(("ros", "cmake", "text"), [(1, CATKIN, script('PUB("a")\n')), (2, AMENT, ROS2_SCRIPT)])
@pytest.mark.parametrize(
    ("install", "names"),
    [
        ("install(PROGRAMS s/a.py DESTINATION lib/p RENAME b)", ["p/b"]),
        ("install(PROGRAMS s/a.py DESTINATION lib/p)", ["p/a.py"]),
        ("install(PROGRAMS s/a.py DESTINATION lib/p)\ninstall(PROGRAMS s/a.py DESTINATION lib/p RENAME b)", ["p/a.py", "p/b"]),
    ],
)  # fmt: skip
def test_a_program_counts_under_the_names_that_it_is_installed_under(
    ros: int, cmake: str, text: str, install: str, names: list[str]
) -> None:
    found = follow({"p/CMakeLists.txt": f"{cmake}{install}\n", "p/s/a.py": text}, ros)
    assert [configuration.name for configuration in found.configurations] == names


def test_a_launch_file_of_ros_1_may_start_a_script_by_its_own_name() -> None:
    install = "install(PROGRAMS s/a.py DESTINATION lib/p RENAME b)\n"
    launch = '<launch><node pkg="p" type="a.py" name="q"/></launch>'
    files = {"p/CMakeLists.txt": CATKIN + install, "p/s/a.py": script('PUB("a")\n'), "p/l.launch": launch}
    (node,) = next(c for c in follow(files, 1).configurations if c.launch).nodes
    assert [end.name for end in node.endpoints if end.kind == "publishers"] == ["/a"]


LAUNCH = '<launch><node pkg="p" type="n" name="q"/></launch>'


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("int main() { return 0; }\n", "p/n (p/CMakeLists.txt:4) is a program of the other ROS"),
        ("int other() { return 0; }\n", "no main function was found in the sources of p/n (p/CMakeLists.txt:4)"),
    ],
)
def test_why_a_program_is_not_followed(text: str, reason: str) -> None:
    cmake = AMENT + "add_executable(n src/n.cpp)\nament_auto_package()\n"
    found = follow({"p/CMakeLists.txt": cmake, "p/src/n.cpp": text, "p/l.launch": LAUNCH}, 2)
    (node,) = next(c for c in found.configurations if c.launch).nodes
    assert [unknown.reason for unknown in node.unknowns] == [reason]


def test_a_program_of_this_ros_is_followed() -> None:
    cmake = CATKIN + "add_executable(n src/n.cpp)\n"
    found = follow({"p/CMakeLists.txt": cmake, "p/src/n.cpp": main('ADV("a", 1);'), "p/l.launch": LAUNCH}, 1)
    (node,) = found.configurations[0].nodes
    assert node.unknowns == () and len(node.endpoints) == 1


@pytest.mark.parametrize(("file", "is_told"), [("l.launch", True), ("l.launch.xml", False)])
def test_a_program_that_the_other_ros_starts_is_told_by_itself(file: str, is_told: bool) -> None:
    """Launch files of ROS 1 that a package has kept do not start what it builds for ROS 2."""
    files = ros2_files(ROS2_HEAD + ROS2_NODE % ('create_publisher<String>("/x", 1);', ""))
    launch = LAUNCH if is_told else LAUNCH.replace("type", "exec")
    found = follow(files | {f"p/launch/{file}": launch}, 2)
    own = [one for one in found.configurations if one.name == "p/n"]
    assert [[end.name for end in explicit(node)] for one in own for node in one.nodes] == ([["/x"]] if is_told else [])
    (node,) = next(one for one in found.configurations if one.launch).nodes
    reasons = [unknown.reason for unknown in node.unknowns if unknown.field == "endpoints"]
    expected = ["p/n (p/CMakeLists.txt:5) runs N, a component of ROS 2, and is not followed here"]
    assert reasons == (expected if is_told else [])
