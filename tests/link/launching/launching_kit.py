# SPDX-License-Identifier: Apache-2.0
"""Small workspaces of ROS 2 launch files in memory, and short views of what they start."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from haros_ci.extract.launch.ros2_xml import read_ros2_xml
from haros_ci.extract.launch.ros2_yaml import read_ros2_yaml
from haros_ci.extract.launch.xml import read_launch
from haros_ci.launch.ros2.dialect import description_reader
from haros_ci.launch.ros2.evaluate import launch_system
from haros_ci.launch.ros2.places import Places
from haros_ci.model.build import Build
from haros_ci.model.launch import LaunchedNode, LaunchedSystem
from haros_ci.model.launch_actions import Action, Description
from haros_ci.model.location import Location
from haros_ci.model.package import Package, SourceFile
from haros_ci.model.workspace import Workspace

MAIN = "bot/launch/main.launch.xml"
HERE = Location("bot/launch/main.launch.py", 1, 1)


@dataclass(frozen=True)
class Texts:
    texts: Mapping[str, str]

    def text(self, path: str) -> str:
        return self.texts.get(path, "")


def workspace(files: Mapping[str, str]) -> Workspace:
    """*files* by path, a package per first directory."""
    names = sorted({path.split("/")[0] for path in files})
    listed = tuple(SourceFile(path, "launch", 0, "", path.split("/")[0]) for path in sorted(files))
    return Workspace(Path("/nowhere"), tuple(Package(name, name, ros=2) for name in names), listed, Texts(files))


def loader(
    files: Mapping[str, str], python: Mapping[str, Description] | None = None
) -> Callable[[str], Description | None]:
    return description_reader(
        workspace(files),
        lambda path, environment: (python or {}).get(path),
        lambda path: read_launch(files[path]) if path in files else None,
        read_ros2_xml,
        read_ros2_yaml,
    )({})


def launch(
    body: str,
    files: Mapping[str, str] | None = None,
    *,
    args: Mapping[str, str] | None = None,
    env: Mapping[str, str] | None = None,
    builds: Mapping[str, Build] | None = None,
    python: Mapping[str, Description] | None = None,
) -> LaunchedSystem:
    """The launch file ``<launch>`` + *body* + ``</launch>`` of package ``bot``, launched beside *files*."""
    everything = {MAIN: f"<launch>{body}</launch>", **(files or {})}
    places = Places(workspace(everything), builds or {})
    return launch_system((MAIN,), places.workspace, loader(everything, python), args or {}, env or {}, places)


def perform(
    *actions: Action, files: Mapping[str, str] | None = None, env: Mapping[str, str] | None = None
) -> LaunchedSystem:
    """A description made of *actions*, as a Python launch file would give it."""
    path = HERE.path
    everything = {path: "#", **(files or {})}
    places = Places(workspace(everything))
    python = {path: Description(actions=actions)}
    return launch_system((path,), places.workspace, loader(everything, python), {}, env or {}, places)


def node(attributes: str = "", inner: str = "", name: str = "n") -> str:
    return f'<node pkg="p" exec="e" name="{name}" {attributes}>{inner}</node>'


def names(system: LaunchedSystem) -> list[str]:
    """Namespace and name of each node, ``-`` where nothing gives one."""
    return [f"{node.namespace or '-'} {node.name or '-'}" for node in system.nodes]


def only(system: LaunchedSystem) -> LaunchedNode:
    assert len(system.nodes) == 1
    return system.nodes[0]


def remaps(system: LaunchedSystem, index: int = 0) -> list[tuple[str, str]]:
    return [(source, target) for source, target, _ in system.nodes[index].remaps]


def values(system: LaunchedSystem, index: int = 0) -> list[tuple[str, str, Any]]:
    """Pattern, name and value of each parameter of a node, in order."""
    return [(rule.node, rule.name, rule.value) for rule in system.nodes[index].parameters]


def told(system: LaunchedSystem) -> list[str]:
    return [problem.message for problem in system.problems]
