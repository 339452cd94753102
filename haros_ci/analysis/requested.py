# SPDX-License-Identifier: Apache-2.0
"""The configurations that are requested: those of a project file with HAROS's keys, or one from the command line."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from haros_ci.errors import UserError
from haros_ci.model.environment import Environment
from haros_ci.model.workspace import Problem, Workspace
from haros_ci.systems.link import Requested
from haros_ci.workspace.environment import environment_files


def configurations(
    workspace: Workspace, project: Mapping[str, Any], problems: list[Problem], where: str
) -> tuple[Requested, ...] | None:
    """The configurations of a project file in HAROS's words; None if it has none."""
    declared = project.get("configurations")
    if not isinstance(declared, Mapping) or not declared:
        return None
    requested = []
    for name, entry in declared.items():
        if entry is None:
            continue
        launch = entry.get("launch") if isinstance(entry, Mapping) else entry
        paths = [launch_path(workspace, str(item)) for item in launch or ()]
        for item, path in zip(launch or (), paths, strict=True):
            if path is None:
                message = f"configuration {name}: no launch file {item} in the workspace; correct 'launch'"
                problems.append(Problem(where, message))
        requested.append(
            Requested(
                name=str(name),
                launch=tuple(path for path in paths if path is not None),
                arguments=_scalars(entry, "args"),
                environment=named_environment(workspace, entry, problems, where, f"configuration {name}: ").over(
                    _scalars(entry, "environment")
                ),
                user_data=entry.get("user_data") if isinstance(entry, Mapping) else None,
                closed=isinstance(entry, Mapping) and entry.get("closed") is True,
            )
        )
    return tuple(requested)


def named_environment(
    workspace: Workspace, entry: object, problems: list[Problem], where: str, who: str = ""
) -> Environment:
    """What the files under ``environment_files`` of a project file, or of a configuration of it, set."""
    provided = entry.get("environment_files") if isinstance(entry, Mapping) else None
    named = (
        [str(item) for item in provided] if isinstance(provided, (list, tuple)) else [str(provided)] if provided else []
    )
    found: list[str] = []
    for item in named:
        path = launch_path(workspace, item)
        if path is None:
            message = f"{who}no file {item} of environment variables in the workspace; correct 'environment_files'"
            problems.append(Problem(where, f"{message} (files called .env, *.env, *.env.*, *.sh or *.bash are read)"))
        else:
            found.append(path)
    return environment_files(workspace, found)


def _scalars(entry: object, key: str) -> dict[str, str]:
    provided = entry.get(key) if isinstance(entry, Mapping) else None
    return {str(name): written(value) for name, value in provided.items()} if isinstance(provided, Mapping) else {}


def written(value: object) -> str:
    """A value of YAML as one writes it on roslaunch's command line."""
    return str(value).lower() if isinstance(value, bool) else str(value)


def launch_path(workspace: Workspace, name: str) -> str | None:
    """The root-relative path that ``package/path`` (as HAROS writes it) or a path of the workspace means."""
    paths = {file.path for file in workspace.files}
    package, _, rest = name.partition("/")
    for other_package in workspace.packages:
        if other_package.name == package:
            path = rest if other_package.path == "." else f"{other_package.path}/{rest}"
            if path in paths:
                return path
    return name if name in paths else None


def chosen(
    workspace: Workspace, launch: Iterable[str], arguments: Mapping[str, str], name: str
) -> tuple[Requested, ...]:
    """One configuration from the command line; UserError names a launch file that is not there."""
    paths = []
    for item in launch:
        path = launch_path(workspace, item)
        if path is None:
            raise UserError(f"no launch file {item} in the workspace", help="name it as package/launch/file.launch")
        paths.append(path)
    return (Requested(name=name, launch=tuple(paths), arguments=arguments),)
