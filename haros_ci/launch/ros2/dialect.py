# SPDX-License-Identifier: Apache-2.0
"""Launch files of ROS 2 in any dialect: XML, YAML or Python, by what they are called and what they hold."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace

from haros_ci.launch.ros1.dialect import foreign_constructs, is_ros1
from haros_ci.model.environment import key_of
from haros_ci.model.faults import FAULTS, fault
from haros_ci.model.launch import LaunchFile
from haros_ci.model.launch_actions import Description
from haros_ci.model.workspace import Workspace


def description_reader(
    workspace: Workspace,
    read_python: Callable[[str, Mapping[str, str]], Description | None],
    read_launch: Callable[[str], LaunchFile | None],
    read_xml: Callable[[LaunchFile, str], Description],
    read_yaml: Callable[[str, str], Description | None],
) -> Callable[[Mapping[str, str]], Callable[[str], Description | None]]:
    """For an environment a function from a root-relative path to the description of the launch file there; None if it is no ROS 2 one.

    *read_launch* gives the tags of an XML file, *read_xml* and *read_yaml* make descriptions of tags and text,
    *read_python* interprets the Python file at a path in an environment. Each file is read once, a Python file once in each environment.
    """
    packages = {package.name: package.ros for package in workspace.packages}
    ros = {file.path: packages.get(file.package or "") for file in workspace.files}
    known: dict[str, Description | None] = {}
    loaders: dict[tuple[object, ...], Callable[[str], Description | None]] = {}

    def read(path: str) -> Description | None:
        text = workspace.text(path)
        if path.endswith((".yaml", ".yml")) or (not path.endswith(".xml") and not text.lstrip().startswith("<")):
            return read_yaml(text, path) if text else None
        launch = read_launch(path)
        if launch is None or is_ros1(launch, ros.get(path)):
            return None
        return replace(
            read_xml(launch, path),
            foreign=tuple(foreign_construct[:3] for foreign_construct in foreign_constructs(launch, path, 2)),
        )

    def loader(environment: Mapping[str, str]) -> Callable[[str], Description | None]:
        key = key_of(environment)
        if key not in loaders:
            loaders[key] = loader_in(environment)
        return loaders[key]

    def loader_in(environment: Mapping[str, str]) -> Callable[[str], Description | None]:
        interpreted: dict[str, Description | None] = {}

        def load(path: str) -> Description | None:
            kept = interpreted if path.endswith(".py") else known
            if path not in kept:
                try:
                    kept[path] = read_python(path, environment) if kept is interpreted else read(path)
                except FAULTS as err:
                    kept[path] = Description(problems=((1, fault("the launch file could not be read", err)),))
            return kept[path]

        return load

    return loader


def is_ros2_file(workspace: Workspace) -> Callable[[str], bool]:
    """Whether a launch file may be one of ROS 2: one in a package that is not of ROS 1 alone."""
    packages = {package.name: package.ros for package in workspace.packages}
    owners = {file.path: packages.get(file.package or "") for file in workspace.files}
    return lambda path: owners.get(path) != 1
