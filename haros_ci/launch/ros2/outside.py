# SPDX-License-Identifier: Apache-2.0
"""Launch files of packages outside the workspace of which it is known what they start: those that start Gazebo.

Only what matters for the system is here (https://github.com/ros-simulation/gazebo_ros_pkgs/tree/ros2/gazebo_ros/launch,
https://github.com/gazebosim/ros_gz/tree/jazzy/ros_gz_sim/launch).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from haros_ci.launch.facts import ros2
from haros_ci.launch.facts.record import Recorder
from haros_ci.launch.ros2 import outside_gz
from haros_ci.launch.ros2.outside_gz import argument, value
from haros_ci.model.architecture import Condition
from haros_ci.model.launch_actions import Action, Phrase, Substitution, Test
from haros_ci.model.launch_facts import IncludeUse, PassedArgument
from haros_ci.model.location import Location
from haros_ci.substitutions.names import Text

if TYPE_CHECKING:
    from haros_ci.launch.ros2.run import LaunchEvaluation

_SHARE = "$(find-pkg-share gazebo_ros)"
_SERVER = f"{_SHARE}/launch/gzserver.launch.py"
#: Plug-ins of the server, each by the argument that leaves it out.
_PLUGINS = ("init", "factory", "force_system")


def _server(place: Location) -> tuple[Action, ...]:
    provided: tuple[tuple[str, str], ...] = (
        ("world", f"{_SHARE}/worlds/empty.world"),
        ("extra_gazebo_args", ""),
        *((name, "true") for name in _PLUGINS),
    )
    words: list[str | Substitution] = [value("world")]
    for name in _PLUGINS:
        words += [" ", Substitution("if", ((value(name),), (f"-s libgazebo_ros_{name}.so",), ()))]
    args: Phrase = (*words, " ", value("extra_gazebo_args"))
    node = Action(
        kind="node",
        location=place,
        phrases=(("package", ("gazebo_ros",)), ("executable", ("gzserver",)), ("args", args)),
    )
    return (*(argument(name, default, place) for name, default in provided), node)


def _both(place: Location) -> tuple[Action, ...]:
    test = Test(kind="if", phrases=((value("server"),),), text="server", location=place)
    include = Action(kind="include", location=place, phrases=(("file", (_SERVER,)),), tests=(test,))
    return (argument("gui", "true", place), argument("server", "true", place), include)


def _nothing(place: Location) -> tuple[Action, ...]:
    """It starts no ROS node."""
    return ()


_FILES = {
    _SERVER: _server,
    f"{_SHARE}/launch/gazebo.launch.py": _both,
    f"{_SHARE}/launch/gzclient.launch.py": _nothing,
    "$(find-pkg-share ros_gz_sim)/launch/gz_sim.launch.py": _nothing,
    **outside_gz.FILES,
    "$(find-pkg-share ros_ign_gazebo)/launch/ign_gazebo.launch.py": _nothing,
}


def include_known(
    run: LaunchEvaluation,
    action: Action,
    file: Text,
    passed: list[tuple[Text, Phrase]],
    conditions: tuple[Condition, ...],
) -> bool:
    """Perform a launch file outside the workspace, at the place of the include; False if it is not known."""
    actions = _FILES.get(file.raw) if file.known else None
    if actions is None:
        return False
    context = run.context
    for name, phrase in passed:
        if name.known:
            made = context.scope.configurations[name.raw] = context.text(phrase)
            ros2.given(context, name.raw, made)
    facts = context.facts
    names = tuple(PassedArgument(name.raw, action.location) for name, _ in passed if name.known)
    ros2.note(context, IncludeUse, action.location, text=file.shown, passed=names)
    context.facts = Recorder()
    try:
        run.inside(context.path, actions(action.location), conditions)
    finally:
        facts.read |= context.facts.read
        facts.is_open = True  # it reads more arguments than matter here, and inherits them
        context.facts = facts
    return True
