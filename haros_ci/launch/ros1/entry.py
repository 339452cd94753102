# SPDX-License-Identifier: Apache-2.0
"""Which launch files a workspace is started by: those that no other one includes."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping

from haros_ci.launch.ros1.arg import arg
from haros_ci.launch.ros1.dialect import is_ros1
from haros_ci.launch.ros1.scope import LoaderScope
from haros_ci.launch.ros1.state import RoslaunchState
from haros_ci.model.environment import NOTHING
from haros_ci.model.launch import LaunchElement, LaunchFile
from haros_ci.model.launch_commands import commanded
from haros_ci.model.location import Location
from haros_ci.model.loose_launches import is_loose_launch
from haros_ci.model.workspace import Workspace
from haros_ci.substitutions.files import Files, files_of
from haros_ci.substitutions.names import Text
from haros_ci.timing import timed


@timed("launch")
def entry_files(
    workspace: Workspace, load: Callable[[str], LaunchFile | None], environment: Mapping[str, str] = NOTHING
) -> tuple[str, ...]:
    """The ROS 1 launch files in packages that no other one there includes, and those beside packages (``loose_launches``), sorted.

    They are called ``*.launch``, or a command starts them (``launch_commands``). Paths of includes are followed with the args' defaults and in *environment*, whether or not their conditions
    hold; those that stay unknown do not count.
    """
    files = files_of(workspace)
    ros = {package.name: package.ros for package in workspace.packages}
    launches: dict[str, LaunchFile] = {}
    loose: dict[str, LaunchFile] = {}
    commands = commanded(workspace.files, workspace.text)
    for file in workspace.files:
        is_named = file.language == "launch"
        if file.path.endswith((".yaml", ".yml", ".py")) or file.language not in ("launch", "xml"):
            continue
        is_commanded = (not is_named or file.package is None) and commands.names(file)
        if not is_named and not is_commanded:
            continue
        if file.package is None and not is_loose_launch(
            file, workspace.packages, workspace.text(file.path), is_commanded=is_commanded
        ):
            continue
        launch = load(file.path)
        if launch is not None and is_ros1(launch, ros.get(file.package or "")):
            (loose if file.package is None else launches)[file.path] = launch

    def included(by: Mapping[str, LaunchFile]) -> set[str]:
        return {
            target
            for path, launch in by.items()
            for target, _, _ in includes_of(files, load, path, launch, environment)
            if target != path
        }

    return tuple(sorted((launches.keys() - included(launches)) | (loose.keys() - included({**launches, **loose}))))


def includes_of(
    files: Files,
    load: Callable[[str], LaunchFile | None],
    path: str,
    launch: LaunchFile,
    environment: Mapping[str, str],
) -> Iterator[tuple[str, Location, bool]]:
    """The files that *launch* itself includes, each with the tag, and whether a condition that is written as false stands around it."""
    state = RoslaunchState(files=files, load=load, environment=environment)
    top = LoaderScope(path=path, namespace=Text("/"), directory=files.directory_of(path))
    todo: list[tuple[LoaderScope, LaunchElement, bool]] = []
    if launch.root is not None:
        todo = [(top, child, False) for child in reversed(launch.root.children)]
    while todo:
        scope, tag, is_dead = todo.pop()
        is_dead = is_dead or _is_never(tag)
        if tag.tag == "arg":
            conditions = state.conditions(scope, tag)
            if conditions is not None:
                arg(state, scope, tag, conditions)
        elif tag.tag == "group":
            inner = scope.child(scope.namespace, ())
            todo.extend((inner, child, is_dead) for child in reversed(tag.children))
        elif tag.tag == "include":
            file = state.attribute(scope, tag, "file")
            place = files.place(file) if file is not None else None
            if place is not None and place.path is not None:
                yield place.path, Location(path, tag.line, tag.column), is_dead


def _is_never(tag: LaunchElement) -> bool:
    """Whether *tag* has a condition of a written value that does not hold."""
    return (tag.get("if") or "").strip().lower() in ("0", "false") or (tag.get("unless") or "").strip().lower() in (
        "1",
        "true",
    )
