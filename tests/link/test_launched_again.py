# SPDX-License-Identifier: Apache-2.0
"""Processes of launch files that launch others (``ros2 launch``), and programs that the interpreter is given by file or module."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.analysis.architecture import architecture
from haros_ci.config.settings import Settings
from haros_ci.model.architecture import Architecture
from haros_ci.workspace.cache import MemoryCache
from haros_ci.workspace.discover import discover

AMENT = '<package format="3"><name>arm</name><export><build_type>ament_python</build_type></export></package>'
SETUP = (
    "from setuptools import setup\nsetup(name='arm', packages=['arm'], data_files=[('share/arm/launch', ['launch/main.launch.py'])],\n"
    "      entry_points={'console_scripts': ['talk = arm.talker:main', 'quiet = arm.quiet:main']})\n"
)
TALKER = (
    "import rclpy\nfrom rclpy.node import Node\nfrom std_msgs.msg import String\n\n\ndef main():\n    rclpy.init()\n    node = Node('talker')\n"
    "    node.create_publisher(String, 'chatter', 1)\n    rclpy.spin(node)\n"
)
STARTED = "\n\nif __name__ == '__main__':\n    main()\n"
MAIN = """
from launch import LaunchDescription
from launch.actions import ExecuteProcess, GroupAction, SetLaunchConfiguration
from launch.substitutions import FindExecutable, LaunchConfiguration
from launch_ros.actions import Node, PushRosNamespace, SetRemap
from ament_index_python.packages import get_package_share_directory, get_package_prefix
import sys
SHARE = get_package_share_directory('arm')
def generate_launch_description():
    return LaunchDescription([{}])
"""
INNER = """
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node
def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument('ns', default_value='own'),
        Node(package='arm', executable='talk', namespace=LaunchConfiguration('ns'))])
"""


def found(root: Path, action: str, **others: str) -> Architecture:
    files = {
        "package.xml": AMENT,
        "setup.py": SETUP,
        "arm/__init__.py": "",
        "arm/talker.py": TALKER + STARTED,
        "arm/quiet.py": TALKER,
        "scripts/by_hand.py": "#!/usr/bin/env python3\n" + TALKER + STARTED,
        "launch/main.launch.py": MAIN.format(action),
        "launch/inner.launch.py": INNER,
        **{path.replace("__", "/").replace("_py", ".py"): text for path, text in others.items()},
    }
    for path, text in files.items():
        (root / "arm" / path).parent.mkdir(parents=True, exist_ok=True)
        (root / "arm" / path).write_text(text, encoding="utf-8")
    return architecture(discover(root, ()), Settings(root=root), MemoryCache())


def topics(made: Architecture) -> list[str]:
    """The topics of what the main launch file starts."""
    main = next(each for each in made.configurations if each.name == "arm/launch/main.launch.py")
    return sorted(
        end.name for node in main.nodes for end in node.endpoints if end.kind == "publishers" and not end.implicit
    )


@pytest.mark.parametrize(
    ("action", "expected"),
    [
        ("ExecuteProcess(cmd=['ros2', 'launch', 'arm', 'inner.launch.py'])", ["/own/chatter"]),
        ("ExecuteProcess(cmd=['ros2', 'launch', 'arm', 'inner.launch.py', 'ns:=a'])", ["/a/chatter"]),
        (
            "ExecuteProcess(cmd=['ros2', 'launch', '-n', '--launch-prefix', 'nice', 'arm', 'inner.launch.py'])",
            ["/own/chatter"],
        ),
        ("ExecuteProcess(cmd=['ros2 launch arm inner.launch.py ns:=a'], shell=True)", ["/a/chatter"]),
        (
            "ExecuteProcess(cmd=[[FindExecutable(name='ros2'), ' launch arm ', 'inner.launch.py']], shell=True)",
            ["/own/chatter"],
        ),
        ("ExecuteProcess(cmd=['bash', '-c', 'sleep 2; ros2 launch arm inner.launch.py &'])", ["/own/chatter"]),
        ("ExecuteProcess(cmd=['ros2', 'launch', SHARE + '/launch/inner.launch.py'])", ["/own/chatter"]),
        # nothing but the command line and the environment comes to it
        (
            "SetLaunchConfiguration('ns', 'b'), PushRosNamespace('c'), SetRemap('chatter', 'd'), "
            "ExecuteProcess(cmd=['ros2', 'launch', 'arm', 'inner.launch.py'])",
            ["/own/chatter"],
        ),
        (
            "ExecuteProcess(cmd=['ros2', 'launch', 'arm', 'inner.launch.py', 'ns:=a']), "
            "Node(package='arm', executable='talk', namespace=LaunchConfiguration('ns', default='z'))",
            ["/a/chatter", "/z/chatter"],
        ),
        ("ExecuteProcess(cmd=['ros2', 'launch', 'arm', 'absent.launch.py'])", []),
        ("ExecuteProcess(cmd=['ros2', 'launch', 'leg', 'inner.launch.py'])", []),
        ("ExecuteProcess(cmd=['ros2', 'launch', 'arm', 'main.launch.py'])", []),
        ("ExecuteProcess(cmd=['ros2', 'launch', 'arm'])", []),
        ("ExecuteProcess(cmd=['echo', 'ros2', 'launch', 'arm', 'inner.launch.py'])", []),
        ("ExecuteProcess(cmd=['ros2', 'launch', LaunchConfiguration('p'), 'inner.launch.py'])", []),
    ],
)
def test_ros2_launch(tmp_path: Path, action: str, expected: list[str]) -> None:
    assert topics(found(tmp_path, action)) == expected


def test_an_argument_that_is_not_known(tmp_path: Path) -> None:
    action = "ExecuteProcess(cmd=['ros2', 'launch', 'arm', 'inner.launch.py', ['ns:=', LaunchConfiguration('n')]])"
    assert topics(found(tmp_path, action)) == ["/?/chatter"]


@pytest.mark.parametrize(
    ("file", "words"),
    [
        ("'arm', 'absent.launch.py'", "the package has no file of that name"),
        ("'leg', 'inner.launch.py'", "package 'leg' is not in the workspace"),
        ("LaunchConfiguration('p'), 'inner.launch.py'", "a part of the command line is not known"),
        ("'arm', 'main.launch.py'", "launches this again, without end"),
    ],
)
def test_what_is_not_found_is_named(tmp_path: Path, file: str, words: str) -> None:
    made = found(tmp_path, f"ExecuteProcess(cmd=['ros2', 'launch', {file}])")
    assert [words in problem.message for problem in made.problems if "launches" in problem.message] == [True]


def test_what_is_launched_is_no_configuration_of_its_own(tmp_path: Path) -> None:
    made = found(tmp_path, "ExecuteProcess(cmd=['ros2', 'launch', 'arm', 'inner.launch.py'])")
    assert [each.name for each in made.configurations if each.launch] == ["arm/launch/main.launch.py"]


@pytest.mark.parametrize(
    ("command", "expected"),
    [
        ("['python3', '-m', 'arm.talker']", ["/chatter"]),
        ("['python3', '-u', '-m', 'arm.talker', '--ros-args', '-r', '__ns:=/a']", ["/a/chatter"]),
        ("['python3 -m arm.talker'], shell=True", ["/chatter"]),
        ("[sys.executable, '-m', 'arm.talker']", ["/chatter"]),
        ("[sys.executable, SHARE + '/scripts/by_hand.py']", ["/chatter"]),
        ("['python3', SHARE + '/../../lib/arm/talk']", []),
        ("['python3', get_package_prefix('arm') + '/lib/arm/talk']", ["/chatter"]),
        ("['python3', SHARE + '/scripts/by_hand.py']", ["/chatter"]),
        ("[SHARE + '/scripts/by_hand.py']", ["/chatter"]),
        # no program of a package, or one that does nothing
        ("['python3', '-m', 'arm.quiet']", []),
        ("['python3', '-m', 'arm.absent']", []),
        ("['python3', '-m', 'http.server']", []),
        ("['python3', '-m']", []),
        ("['python3', '-c', 'import arm.talker']", []),
        ("['python3']", []),
        ("['python3', '/tmp/arm/talker.py']", []),
        ("['cat', SHARE + '/scripts/by_hand.py']", []),
        ("['-m', 'arm.talker']", []),
        ("['python3', '-m', LaunchConfiguration('m')]", []),
    ],
)
def test_programs_of_python(tmp_path: Path, command: str, expected: list[str]) -> None:
    assert topics(found(tmp_path, f"ExecuteProcess(cmd={command})")) == expected
