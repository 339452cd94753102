# SPDX-License-Identifier: Apache-2.0
"""Recordings and command-line tools in launch files: nodes with the topics of their command lines."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import pytest

from haros_ci.analysis.architecture import architecture
from haros_ci.config.settings import Settings
from haros_ci.model.architecture import Node
from haros_ci.workspace.cache import MemoryCache
from haros_ci.workspace.discover import discover

CATKIN = "<package><name>arm</name><buildtool_depend>catkin</buildtool_depend></package>"
AMENT = '<package format="3"><name>arm</name><export><build_type>ament_cmake</build_type></export></package>'
METADATA = """
rosbag2_bagfile_information:
  version: 5
  storage_identifier: sqlite3
  topics_with_message_count:
    - topic_metadata: {name: /arm/state, type: sensor_msgs/msg/JointState, serialization_format: cdr, offered_qos_profiles: ""}
      message_count: 10
    - topic_metadata: {name: /tf, type: tf2_msgs/msg/TFMessage, serialization_format: cdr, offered_qos_profiles: ""}
      message_count: 3
"""
HEAD = """
from launch import LaunchDescription
from launch.actions import ExecuteProcess
from launch.substitutions import FindExecutable, LaunchConfiguration, PathJoinSubstitution
from launch_ros.substitutions import FindPackageShare
from ament_index_python.packages import get_package_share_directory
import os, pathlib
SHARE = get_package_share_directory('arm')
def generate_launch_description():
    return LaunchDescription([ExecuteProcess({})])
"""


def nodes(root: Path, files: Mapping[str, str]) -> list[Node]:
    for path, text in files.items():
        (root / "arm" / path).parent.mkdir(parents=True, exist_ok=True)
        (root / "arm" / path).write_text(text, encoding="utf-8")
    found = architecture(discover(root, ()), Settings(root=root), MemoryCache())
    return [node for each in found.configurations if each.launch for node in each.nodes]


def ends(node: Node, *kinds: str) -> dict[str, str | None]:
    """Topics with their types."""
    return {
        each.name: each.type
        for each in node.endpoints
        if each.kind in (kinds or ("publishers", "subscribers"))
        and not each.implicit
        and "_write" not in each.name
        and "write_" not in each.name
    }


def ros1(root: Path, type_: str, args: str, more: str = "") -> Node:
    pkg, _, name = type_.partition("/")
    launch = f'<launch><node name="tool" pkg="{pkg}" type="{name}" args="{args}" {more}/></launch>'
    (node,) = nodes(root, {"package.xml": CATKIN, "launch/a.launch": launch})
    return node


def ros2(root: Path, process: str, metadata: str = METADATA) -> list[Node]:
    files = {"package.xml": AMENT, "launch/a.launch.py": HEAD.format(process), "bags/walk/metadata.yaml": metadata}
    return nodes(root, files)


@pytest.mark.parametrize(
    ("type_", "args", "expected"),
    [
        ("rosbag/record", "-O /tmp/x /arm/state tf", {"/arm/state": None, "/tf": None}),
        ("rosbag/record", "--split --size=1024 -o x -b 0 /a", {"/a": None}),
        ("rosbag/record", "/a -j -q /b/c", {"/a": None, "/b/c": None}),
        ("rosbag/rosbag", "record -o x /a", {"/a": None}),
        ("rosbag/record", "-a", {"/?": None}),
        ("rosbag/record", "-e /arm/.*", {"/?": None}),
        ("rosbag/record", "-o $(env WHERE) /a", {"/a": None}),
        ("rosbag/record", "$(env TOPICS) /a", {"/?": None, "/a": None}),
        ("rosbag/play", "x.bag --topics /a /b -r 2", {"/clock": "rosgraph_msgs/Clock", "/a": None, "/b": None}),
        ("rosbag/play", "-l x.bag", {"/clock": "rosgraph_msgs/Clock", "/?": None}),
        ("rosbag/rosbag", "play x.bag --topics /a", {"/clock": "rosgraph_msgs/Clock", "/a": None}),
        ("rostopic/rostopic", "pub /a std_msgs/Bool true", {"/a": "std_msgs/Bool"}),
        ("rostopic/rostopic", "pub -r 10 /a std_msgs/Bool true", {"/a": "std_msgs/Bool"}),
        ("rostopic/rostopic", "pub -r10 --latch /a std_msgs/Bool true", {"/a": "std_msgs/Bool"}),
        ("rostopic/rostopic", "pub a geometry_msgs/Twist -- '[1, 0, 0]' '[0, 0, -1]'", {"/a": "geometry_msgs/Twist"}),
        ("rostopic/rostopic", "pub $(env TOPIC) std_msgs/Bool true", {"/?": "std_msgs/Bool"}),
        ("rostopic/rostopic", "echo -n 1 /a", {"/a": None}),
        ("rostopic/rostopic", "hz -w 10 /a /b", {"/a": None, "/b": None}),
        ("rostopic/rostopic", "echo /a/field/x", {"/?": None}),
        ("rostopic/rostopic", f"echo /{'a' * 2000}", {f"/{'a' * 2000}": None}),
        ("rostopic/rostopic", "echo /a{arg:0}", {"/?": None}),
        ("rostopic/rostopic", "list", {}),
        ("topic_tools/relay", "/a /b", {"/a": None, "/b": None}),
        ("topic_tools/throttle", "messages /a 1.0", {"/a": None, "/a_throttle": None}),
    ],
)
def test_ros1(tmp_path: Path, type_: str, args: str, expected: dict[str, str | None]) -> None:
    assert ends(ros1(tmp_path, type_, args)) == expected


@pytest.mark.parametrize(
    ("args", "latched"),
    [("/a std_msgs/Bool true", True), ("-r 1 /a std_msgs/Bool true", False), ("-l -r 1 /a std_msgs/Bool 1", True)]
    + [("/a std_msgs/Bool", None), ("-f x.yaml /a std_msgs/Bool", None)],
)
def test_what_rostopic_latches(tmp_path: Path, args: str, latched: bool | None) -> None:
    node = ros1(tmp_path, "rostopic/rostopic", f"pub {args}")
    assert [each.latched for each in node.endpoints if each.kind == "publishers" and not each.implicit] == [latched]


@pytest.mark.parametrize(
    ("process", "name", "expected"),
    [
        ("cmd=['ros2', 'topic', 'pub', '/a', 'std_msgs/msg/Bool', '{data: true}']", "/?", {"/a": "std_msgs/msg/Bool"}),
        ("cmd=['ros2 topic pub -r 5 a std_msgs/Bool \"data: true\"'], shell=True", "/?", {"/a": "std_msgs/msg/Bool"}),
        (
            "cmd=[FindExecutable(name='ros2'), 'topic', 'pub', '-1', '-n', 'told', '/a', 'std_msgs/msg/Empty']",
            "/told",
            {"/a": "std_msgs/msg/Empty"},
        ),
        (
            "cmd=['ros2', 'topic', 'pub', LaunchConfiguration('t'), 'std_msgs/msg/Bool']",
            "/?",
            {"/?": "std_msgs/msg/Bool"},
        ),
        ("cmd=['ros2', 'topic', 'echo', '/a']", "/?", {"/a": None}),
        ("cmd=['ros2', 'topic', 'hz', '--window', '5', '/a']", "/?", {"/a": None}),
        ("cmd=['ros2', 'bag', 'record', '-o', 'x', '/a', '/b/c']", "/rosbag2_recorder", {"/a": None, "/b/c": None}),
        ("cmd=['ros2', 'bag', 'record', '--node-name', 'tape', '--topics', '/a', '-s', 'mcap']", "/tape", {"/a": None}),
        ("cmd=['ros2', 'bag', 'record', '-a']", "/rosbag2_recorder", {"/?": None}),
        ("cmd=['ros2', 'bag', 'record', LaunchConfiguration('t')]", "/rosbag2_recorder", {"/?": None}),
        (
            "cmd=['ros2', 'bag', 'play', os.path.join(SHARE, 'bags', 'walk')]",
            "/rosbag2_player",
            {"/arm/state": "sensor_msgs/msg/JointState", "/tf": "tf2_msgs/msg/TFMessage"},
        ),
        (
            "cmd=['ros2', 'bag', 'play', '-l', SHARE + '/bags/walk/walk_0.db3', '--clock', '--topics', '/tf']",
            "/rosbag2_player",
            {"/clock": "rosgraph_msgs/msg/Clock", "/tf": "tf2_msgs/msg/TFMessage"},
        ),
        (
            "cmd=['ros2', 'bag', 'play', PathJoinSubstitution([FindPackageShare('arm'), 'bags', 'walk']), "
            "'--remap', '/tf:=/old/tf', 'arm/state:=/state', '-r', '2']",
            "/rosbag2_player",
            {"/state": "sensor_msgs/msg/JointState", "/old/tf": "tf2_msgs/msg/TFMessage"},
        ),
        (
            "cmd=['ros2', 'bag', 'play', str(pathlib.Path(__file__).parent.parent / 'bags' / 'walk')]",
            "/rosbag2_player",
            {"/arm/state": "sensor_msgs/msg/JointState", "/tf": "tf2_msgs/msg/TFMessage"},
        ),
        (
            "cmd=['ros2', 'bag', 'play', SHARE + '/bags/walk', '--exclude-topics', '/tf']",
            "/rosbag2_player",
            {"/arm/state": "sensor_msgs/msg/JointState"},
        ),
        ("cmd=['ros2', 'bag', 'play', '/data/walk']", "/rosbag2_player", {"/?": None}),
        ("cmd=['ros2', 'bag', 'play', LaunchConfiguration('bag')]", "/rosbag2_player", {"/?": None}),
        ("cmd=['ros2', 'bag', 'play', SHARE + '/bags/absent']", "/rosbag2_player", {"/?": None}),
        ("cmd=['ros2', 'bag', 'play', SHARE + '/bags/walk', '-e', 'arm.*']", "/rosbag2_player", {"/?": None}),
        ("cmd=['ros2', 'bag', 'play', '/data/walk', '--topics', '/a']", "/rosbag2_player", {"/a": None}),
        ("cmd=['ros2', 'run', 'topic_tools', 'relay', '/a', '/b']", "/relay", {"/a": None, "/b": None}),
    ],
)
def test_ros2(tmp_path: Path, process: str, name: str, expected: dict[str, str | None]) -> None:
    (node,) = ros2(tmp_path, process)
    assert (node.name, ends(node)) == (name, expected)


SPAWN = "turtlesim/srv/Spawn"
FIBONACCI = "example_interfaces/action/Fibonacci"


@pytest.mark.parametrize(
    ("process", "kind", "expected"),
    [
        (f"cmd=['ros2', 'service', 'call', '/spawn', '{SPAWN}', '{{x: 2}}']", "clients", {"/spawn": SPAWN}),
        (f"cmd=['ros2 service call -r 1 spawn {SPAWN} \"{{x: 2}}\"'], shell=True", "clients", {"/spawn": SPAWN}),
        (
            f"cmd=[[FindExecutable(name='ros2'), ' service call ', '/spawn ', '{SPAWN} ', '\"{{x: 2}}\"']], shell=True",
            "clients",
            {"/spawn": SPAWN},
        ),
        (f"cmd=['bash', '-c', 'sleep 1; ros2 service call /spawn {SPAWN}']", "clients", {"/spawn": SPAWN}),
        (f"cmd=['ros2', 'service', 'call', LaunchConfiguration('s'), '{SPAWN}']", "clients", {"/?": SPAWN}),
        ("cmd=['ros2', 'service', 'call', '/spawn', LaunchConfiguration('t')]", "clients", {"/spawn": None}),
        (
            f"cmd=['ros2', 'action', 'send_goal', '-f', '/a', '{FIBONACCI}', '{{order: 5}}']",
            "action_clients",
            {"/a": FIBONACCI},
        ),
    ],
)
def test_services_and_actions(tmp_path: Path, process: str, kind: str, expected: dict[str, str | None]) -> None:
    (node,) = ros2(tmp_path, process)
    assert ends(node, kind) == expected


@pytest.mark.parametrize(
    ("args", "expected"),
    [
        ("call /reset", {"/reset": None}),
        ("call --wait reset 1", {"/reset": None}),
        ("call $(env SERVICE)", {"/?": None}),
        ("list", {}),
        ("info /reset", {}),
    ],
)
def test_rosservice(tmp_path: Path, args: str, expected: dict[str, str | None]) -> None:
    assert ends(ros1(tmp_path, "rosservice/rosservice", args), "clients") == expected


@pytest.mark.parametrize(
    "process",
    [
        "cmd=['ros2', 'service', 'list']",
        "cmd=['ros2', 'service', 'type', '/spawn']",
        "cmd=['ros2', 'action', 'info', '/a']",
        "cmd=['ros2', 'bag', 'info', 'x']",
        "cmd=['ros2', 'topic', 'list']",
        "cmd=['ros2', 'launch', 'bag', 'play']",
        "cmd=['echo', 'ros2', 'topic', 'pub', '/a', 'std_msgs/msg/Bool']",
        "cmd=['ros2', 'topic']",
    ],
)
def test_commands_that_are_no_nodes(tmp_path: Path, process: str) -> None:
    assert ros2(tmp_path, process) == []


@pytest.mark.parametrize(
    "metadata", ["", "[]", "rosbag2_bagfile_information: 3", "a: [", METADATA.replace("name: /tf", "n: /tf")]
)
def test_metadata_that_cannot_be_read(tmp_path: Path, metadata: str) -> None:
    (node,) = ros2(tmp_path, "cmd=['ros2', 'bag', 'play', SHARE + '/bags/walk']", metadata)
    assert ends(node) == {"/?": None}


def test_an_executable_of_xml(tmp_path: Path) -> None:
    launch = '<launch><executable cmd="ros2 bag record -o x /a"/><executable cmd="ros2 topic pub /b std_msgs/msg/Bool"/></launch>'
    found = nodes(tmp_path, {"package.xml": AMENT, "launch/a.launch.xml": launch})
    assert [ends(node) for node in found] == [{"/a": None}, {"/b": "std_msgs/msg/Bool"}]
