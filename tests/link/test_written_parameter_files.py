# SPDX-License-Identifier: Apache-2.0
"""Parameter files that a launch file of ROS 2 writes itself: what nodes and controllers read of them."""

from __future__ import annotations

import pytest
from follow_kit import ROS2_HEAD, ROS2_NODE, follow, ros2_files

from haros_ci.model.architecture import Node

BODY = 'publisher_ = create_publisher<String>(declare_parameter<std::string>("topic", "own"), 1);'
CODE = ROS2_HEAD + ROS2_NODE % (BODY, "rclcpp::Publisher<String>::SharedPtr publisher_;")
HEAD = """
import json, os, tempfile, shutil
import yaml
from pathlib import Path
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, OpaqueFunction
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node
DATA = {"n": {"ros__parameters": {"topic": "front", "rate": 5.0}}}
"""
AROUND = """
def generate_launch_description():
    path = "/tmp/params.yaml"
%s
    return LaunchDescription([Node(package="p", executable="n", parameters=[path]%s)])
"""


def started(lines: str, more: str = "", head: str = "", code: str = "") -> list[Node]:
    text = HEAD + head + (code or AROUND % ("\n".join(f"    {line}" for line in lines.splitlines()), more))
    found = follow(ros2_files(CODE, {"l.launch.py": text}), 2)
    return [node for item in found.configurations if item.launch for node in item.nodes]


def topics(nodes: list[Node]) -> list[str]:
    return [end.name for node in nodes for end in node.endpoints if end.kind == "publishers" and not end.implicit]


DUMPED = 'with open(path, "w") as f:\n    '
PLAIN = 'f"n:\\n  ros__parameters:\\n    topic: {topic}\\n"'


@pytest.mark.parametrize(
    "lines",
    [
        DUMPED + "yaml.dump(DATA, f)",
        DUMPED + "yaml.safe_dump(DATA, f, default_flow_style=False)",
        DUMPED + "yaml.dump(DATA, stream=f)",
        DUMPED + "json.dump(DATA, f)",
        DUMPED + "f.write(yaml.dump(DATA))",
        DUMPED + "f.write(json.dumps(DATA))",
        DUMPED + "f.write('n:\\n')\n    f.write('  ros__parameters:\\n    topic: front\\n')",
        DUMPED + "f.writelines(['n:\\n', '  ros__parameters:\\n', '    topic: front\\n'])",
        "topic = 'front'\n" + DUMPED + f"f.write({PLAIN})",
        "f = open(path, 'w')\nyaml.dump(DATA, f)\nf.close()",
        "Path(path).write_text(yaml.dump(DATA))",
        "with Path(path).open('w') as f:\n    yaml.dump(DATA, f)",
        "path = os.path.join(tempfile.mkdtemp(), 'x.yaml')\n" + DUMPED + "yaml.dump(DATA, f)",
        "path = os.path.join(tempfile.gettempdir(), 'x.yaml')\n" + DUMPED + "yaml.dump(DATA, f)",
        "fd, path = tempfile.mkstemp(suffix='.yaml')\nwith os.fdopen(fd, 'w') as f:\n    yaml.dump(DATA, f)",
        "f = tempfile.NamedTemporaryFile(mode='w', delete=False)\nyaml.dump(DATA, f)\nf.flush()\npath = f.name",
        "with tempfile.NamedTemporaryFile('w', suffix='.yaml', delete=False) as f:\n    yaml.dump(DATA, f)\n    path = f.name",
        "DATA['n']['ros__parameters']['topic'] = 'front'\n" + DUMPED + "yaml.dump(DATA, f)",
        "for word in ('rear', 'front'):\n    with open(path, 'w') as f:\n        yaml.dump({'n': {'ros__parameters': {'topic': word}}}, f)",
    ],
)
def test_what_is_written_is_read(lines: str) -> None:
    nodes = started(lines)
    assert topics(nodes) == ["/front"]
    assert not any(unknown.reason for node in nodes for unknown in node.unknowns if unknown.field == "parameters")


@pytest.mark.parametrize(
    "lines",
    [
        DUMPED + "DATA['n']['ros__parameters']['topic'] = os.environ['TOPIC']\n    yaml.dump(DATA, f)",
        DUMPED + "f.write(os.environ['ALL'])",
        "topic = os.environ['TOPIC']\n" + DUMPED + f"f.write({PLAIN})",
        DUMPED + "f.write('n:\\n  ros__parameters:\\n    ' + os.environ['KEY'] + ': front\\n')",
        DUMPED + "yaml.dump(DATA, f)\n    shutil.copyfileobj(open('x'), f)",
        DUMPED + "yaml.dump(DATA, f)\n    print('n2: 1', file=f)",
        DUMPED + "yaml.dump(DATA, f)\n    helper(f)",
        DUMPED + "yaml.dump(DATA, f)\n    f.seek(0)",
        DUMPED + "pass",
        "with open(path, 'a') as f:\n    yaml.dump(DATA, f)",
        "fd, path = tempfile.mkstemp()\nos.write(fd, yaml.dump(DATA).encode())",
        DUMPED + "for key in os.environ:\n        f.write(key)",
        DUMPED + "yaml.dump({'n': {'ros__parameters': {os.environ['KEY']: 'front'}}}, f)",
        "if os.environ['A']:\n    with open(path, 'w') as f:\n        yaml.dump(DATA, f)\nelse:\n    with open(path, 'w') as f:\n        yaml.dump({}, f)",
        "path = tempfile.mktemp()",
        "fd, path = tempfile.mkstemp()",
    ],
)
def test_what_is_not_known_to_be_written(lines: str) -> None:
    (topic,) = topics(started(lines, head="from elsewhere import helper\n"))
    assert topic == "/?"


def test_what_the_context_decides() -> None:
    code = """
def setup(context):
    topic = LaunchConfiguration("topic").perform(context)
    path = os.path.join(tempfile.mkdtemp(), "x.yaml")
    with open(path, "w") as f:
        yaml.dump({"/**": {"ros__parameters": {"topic": topic}}}, f)
    return [Node(package="p", executable="n", parameters=[path])]
def generate_launch_description():
    return LaunchDescription([DeclareLaunchArgument("topic", default_value="front"), OpaqueFunction(function=setup)])
"""
    assert topics(started("", code=code)) == ["/front"]


def test_a_file_for_each_of_several_nodes() -> None:
    code = """
def generate_launch_description():
    nodes = []
    for name in ("a", "b"):
        path = os.path.join(tempfile.mkdtemp(), "x.yaml")
        with open(path, "w") as f:
            yaml.dump({name: {"ros__parameters": {"topic": name + "_topic"}}}, f)
        nodes.append(Node(package="p", executable="n", name=name, parameters=[path]))
    return LaunchDescription(nodes)
"""
    assert sorted(topics(started("", code=code))) == ["/a_topic", "/b_topic"]


def test_the_type_of_a_controller() -> None:
    code = """
def generate_launch_description():
    path = os.path.join(tempfile.mkdtemp(), "c.yaml")
    with open(path, "w") as f:
        yaml.dump({"controller_manager": {"ros__parameters": {"arm": {"type": "p/Arm"}}}}, f)
    return LaunchDescription([
        Node(package="controller_manager", executable="ros2_control_node", parameters=[path]),
        Node(package="controller_manager", executable="spawner", arguments=["arm", "--param-file", path]),
    ])
"""
    assert [node.type for node in started("", code=code) if node.name == "/arm"] == ["p/Arm"]


def test_where_a_parameter_comes_from() -> None:
    found = follow(
        ros2_files(
            CODE,
            {"l.launch.py": HEAD + AROUND % ("    " + (DUMPED + "yaml.dump(DATA, f)").replace("\n", "\n    "), "")},
        ),
        2,
    )
    (configuration,) = (item for item in found.configurations if item.launch)
    (rate,) = (parameter for parameter in configuration.parameters if parameter.name.endswith("rate"))
    assert (rate.type, rate.value) == ("double", 5.0)
    assert rate.origin is not None and rate.origin.path == "p/launch/l.launch.py"
