# SPDX-License-Identifier: Apache-2.0
"""Containers that components are loaded into by the action that starts them, and arguments that launch_ros has dropped."""

from __future__ import annotations

from pathlib import Path

from launch_python_kit import HEAD

from haros_ci.launch.python import interpret
from haros_ci.launch.ros2.evaluate import launch_system
from haros_ci.launch.ros2.places import Places
from haros_ci.model.launch import LaunchedSystem
from haros_ci.model.package import Package, SourceFile
from haros_ci.model.workspace import Workspace

PATH = "bot/launch/main.launch.py"


class Texts:
    def text(self, path: str) -> str:
        return ""


def launched(body: str) -> LaunchedSystem:
    """What ``generate_launch_description`` with *body* starts."""
    lines = "\n".join(f"    {line}" for line in body.strip("\n").splitlines())
    text = f"{HEAD}\ndef generate_launch_description():\n{lines}\n"
    files = (SourceFile(PATH, "launch", 0, "", "bot"),)
    places = Places(Workspace(Path("/nowhere"), (Package("bot", "bot", ros=2),), files, Texts()))
    description = interpret(PATH, text, lambda path: None, {})
    return launch_system((PATH,), places.workspace, lambda path: description, {}, {}, places)


CONTAINER = (
    "ComposableNodeContainer(name='c', namespace={}, package='rclcpp_components', executable='component_container', "
)
COMPONENT = "ComposableNode(package='p', plugin='A', name='{}')"


def test_a_container_is_the_one_that_was_started_wherever_it_is_loaded_into() -> None:
    body = f"""
def made(space):
    c = {CONTAINER.format("''")} composable_node_descriptions=[])
    load = LoadComposableNodes(target_container=c, composable_node_descriptions=[{COMPONENT.format("a")}])
    return [GroupAction([PushRosNamespace(space), c]), GroupAction([PushRosNamespace('t'), load])]
return LaunchDescription(made('r') + made('s'))
"""
    found = [(node.kind, node.namespace, node.container) for node in launched(body).nodes]
    assert found == [
        ("container", "/r", None),
        ("component", "/t", "/r/c"),
        ("container", "/s", None),
        ("component", "/t", "/s/c"),
    ]


def test_one_that_has_not_been_started_is_named_as_it_would_be_here() -> None:
    body = f"""
c = {CONTAINER.format("'/n'")} composable_node_descriptions=[])
return LaunchDescription([LoadComposableNodes(target_container=c, composable_node_descriptions=[{COMPONENT.format("a")}]), c])
"""
    assert [node.container for node in launched(body).nodes] == ["/n/c", None]


def test_arguments_that_launch_ros_has_dropped_put_the_whole_file_in_doubt() -> None:
    body = """
return LaunchDescription([Node(package='p', executable='e'), Node(package='p', node_executable='f', node_name='n')])
"""
    found = [(node.type, node.name, [c.condition for c in node.conditions]) for node in launched(body).nodes]
    doubts = [f"launch_ros takes node_{name}= (it does up to ROS 2 Foxy)" for name in ("executable", "name")]
    assert found == [("e", None, doubts), ("f", "n", doubts)]


def test_the_same_in_an_opaque_function_puts_that_in_doubt() -> None:
    body = """
def setup(context):
    return [Node(package='p', node_executable='f')]
return LaunchDescription([Node(package='p', executable='e'), OpaqueFunction(function=setup)])
"""
    assert [(node.type, len(node.conditions)) for node in launched(body).nodes] == [("e", 0), ("f", 1)]
