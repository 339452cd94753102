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
        **{
            path if "/" in path else path.replace("__", "/").replace("_py", ".py"): text
            for path, text in others.items()
        },
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


OF_ROS = TALKER + STARTED


def started(made: Architecture) -> list[str]:
    """The programs that the main launch file starts."""
    main = next(each for each in made.configurations if each.name == "arm/launch/main.launch.py")
    return [f"{node.package}/{node.type}" for node in main.nodes]


@pytest.mark.parametrize(
    ("action", "program", "topic"),
    [
        ("Node(executable='python3', arguments=['-m', 'arm.talker'])", "arm/talk", "/chatter"),
        ("Node(executable='python', arguments=['-u', '-m', 'arm.by_file'])", "arm/arm/by_file.py", "/chatter"),
        (
            "Node(executable='python3', arguments=['-m', 'arm.by_file'], namespace='a')",
            "arm/arm/by_file.py",
            "/a/chatter",
        ),
        ("Node(executable='python3', arguments=['-m', 'arm.more'])", "arm/arm/more/__main__.py", "/chatter"),
        ("Node(executable=sys.executable, arguments=['-m', 'arm.by_file'])", "arm/arm/by_file.py", "/chatter"),
        ("Node(executable='python3', arguments=[SHARE + '/scripts/tool.py', '-v'])", "arm/scripts/tool.py", "/chatter"),
        ("Node(executable='ros2', arguments=['run', 'arm', 'talk'])", "arm/talk", "/chatter"),
        (
            "Node(executable='python3', arguments=['-m', 'arm.by_file'], remappings=[('chatter', 'told')])",
            "arm/arm/by_file.py",
            "/told",
        ),
        ("ExecuteProcess(cmd=['python3', '-m', 'arm.by_file'])", "arm/arm/by_file.py", "/chatter"),
        ("ExecuteProcess(cmd=['python3', SHARE + '/scripts/tool.py'])", "arm/scripts/tool.py", "/chatter"),
        ("ExecuteProcess(cmd=['python3 -u -m arm.by_file --fast'], shell=True)", "arm/arm/by_file.py", "/chatter"),
        (
            "ExecuteProcess(cmd=['python3', SHARE + '/scripts/tool.py', '--ros-args', '-r', '__ns:=/b'])",
            "arm/scripts/tool.py",
            "/b/chatter",
        ),
    ],
)
def test_files_that_the_interpreter_runs(tmp_path: Path, action: str, program: str, topic: str) -> None:
    files = {"arm__by_file_py": OF_ROS, "arm/more/__main__.py": OF_ROS, "scripts__tool_py": OF_ROS}
    made = found(tmp_path, action, **files)
    assert (started(made), topics(made)) == ([program], [topic])
    own = {each.name for each in made.configurations if each.name != "arm/launch/main.launch.py"}
    assert f"{program.partition('/')[0]}/{program.rpartition('/')[2]} (script)" not in own
    assert [each.message for each in made.problems] == []


@pytest.mark.parametrize(
    "action",
    [
        # no ROS in it, nothing that is run, no file of the workspace, no file at all
        "ExecuteProcess(cmd=['python3', SHARE + '/scripts/plain.py'])",
        "ExecuteProcess(cmd=['python3', SHARE + '/scripts/library.py'])",
        "ExecuteProcess(cmd=['python3', '-m', 'arm.quiet'])",
        "ExecuteProcess(cmd=['python3', '-m', 'http.server'])",
        "ExecuteProcess(cmd=['python3', '/opt/tool.py'])",
        "ExecuteProcess(cmd=['python3', '-c', 'import arm.by_file'])",
        "ExecuteProcess(cmd=['python3', '--version'])",
        "ExecuteProcess(cmd=['cat', SHARE + '/scripts/tool.py'])",
        "ExecuteProcess(cmd=['python3'])",
    ],
)
def test_processes_of_python_that_are_no_nodes(tmp_path: Path, action: str) -> None:
    files = {"scripts__tool_py": OF_ROS, "scripts__plain_py": "print(1)\n", "scripts__library_py": TALKER}
    made = found(tmp_path, action, **files)
    assert (started(made), [each.message for each in made.problems]) == ([], [])


@pytest.mark.parametrize(
    ("command", "words"),
    [
        ("['python3', '-m', 'arm.absent']", "starts 'python3 -m arm.absent': no file of the workspace is that module"),
        ("['python3', '-m', LaunchConfiguration('m')]", "a part of the command line is not known"),
        ("['python3', LaunchConfiguration('m')]", "a part of the command line is not known"),
        ("['python3', SHARE + '/scripts/absent.py']", "it is not in the workspace"),
        ("['python3', 'tool.py']", "depends on where launch is started"),
    ],
)
def test_programs_of_python_that_are_not_found_are_named(tmp_path: Path, command: str, words: str) -> None:
    made = found(tmp_path, f"ExecuteProcess(cmd={command})", scripts__tool_py=OF_ROS)
    assert (started(made), [words in each.message for each in made.problems]) == ([], [True])


@pytest.mark.parametrize(
    ("action", "program", "reason"),
    [
        (
            "Node(executable='python3', arguments=['-m', 'leg.walk'])",
            "/python3",
            "the program that python3 runs was not found in the workspace",
        ),
        ("Node(executable='/opt/walk')", "//opt/walk", "the code of /opt/walk is not in the workspace"),
        # a name is looked for in the package, a path below it is none
        (
            "Node(package='arm', executable='scripts/tool.py')",
            "arm/scripts/tool.py",
            "package arm is in the workspace, but no C++ or Python program called scripts/tool.py was found in it",
        ),
        (
            "Node(package='arm', executable='python3', arguments=['-m', 'arm.talker'])",
            "arm/python3",
            "package arm is in the workspace, but no C++ or Python program called python3 was found in it",
        ),
    ],
)
def test_nodes_without_a_package_that_are_not_found(tmp_path: Path, action: str, program: str, reason: str) -> None:
    made = found(tmp_path, action, scripts__tool_py=OF_ROS)
    main = next(each for each in made.configurations if each.name == "arm/launch/main.launch.py")
    reasons = [each.reason for node in main.nodes for each in node.unknowns if each.field == "endpoints"]
    assert (started(made), reasons) == ([program], [reason])
