# SPDX-License-Identifier: Apache-2.0
"""Launch files of packages outside the workspace of which it is known what they start: those that start Gazebo.

Only what matters for the system is here: arguments, parameters and nodes (https://wiki.ros.org/gazebo_ros, noetic-devel).
"""

from __future__ import annotations

from dataclasses import replace

from haros_ci.model.launch import LaunchElement
from haros_ci.substitutions.names import Text


def _tag(tag: str, *children: LaunchElement, **attributes: str) -> LaunchElement:
    written = {"condition": "if", "kind": "type"}
    return LaunchElement(
        tag, 1, 1, tuple((written.get(key, key), value) for key, value in attributes.items()), children=children
    )


def _either(flag: str, name: str, yes: str, no: str = "") -> tuple[LaunchElement, ...]:
    """The argument *name* with one of two values by the argument *flag*."""
    return (
        _tag("arg", condition=f"$(arg {flag})", name=name, value=yes),
        _tag("arg", unless=f"$(arg {flag})", name=name, value=no),
    )


_DEFAULTS = {
    "paused": "false",
    "use_sim_time": "true",
    "extra_gazebo_args": "",
    "gui": "true",
    "recording": "false",
    "headless": "false",
    "debug": "false",
    "physics": "ode",
    "verbose": "false",
    "output": "screen",
    "world_name": "worlds/empty.world",
    "respawn_gazebo": "false",
    "use_clock_frequency": "false",
    "pub_clock_frequency": "100",
    "enable_ros_network": "true",
    "server_required": "false",
    "gui_required": "false",
}
_SERVER = "$(arg command_arg1) $(arg command_arg2) $(arg command_arg3) -e $(arg physics) $(arg extra_gazebo_args) $(arg world_name)"
_EMPTY_WORLD = _tag(
    "launch",
    *(_tag("arg", name=name, default=default) for name, default in _DEFAULTS.items()),
    _tag("param", name="/use_sim_time", value="$(arg use_sim_time)"),
    *_either("paused", "command_arg1", "-u"),
    *_either("recording", "command_arg2", "-r"),
    *_either("verbose", "command_arg3", "--verbose"),
    *_either("debug", "script_type", "debug", "gzserver"),
    _tag(
        "group",
        _tag("param", name="gazebo/pub_clock_frequency", value="$(arg pub_clock_frequency)"),
        condition="$(arg use_clock_frequency)",
    ),
    _tag("group", _tag("param", name="gazebo/enable_ros_network", value="$(arg enable_ros_network)")),
    _tag("node", name="gazebo", pkg="gazebo_ros", kind="$(arg script_type)", args=_SERVER),
    _tag(
        "group",
        _tag("node", name="gazebo_gui", pkg="gazebo_ros", kind="gzclient", args="$(arg command_arg3)"),
        condition="$(arg gui)",
    ),
)


def _of_world(world: str) -> LaunchElement:
    """A launch file that starts Gazebo with a *world* of its own."""
    names = ("paused", "use_sim_time", "gui", "headless", "debug")
    passed = (_tag("arg", name=name, value=f"$(arg {name})") for name in names)
    return _tag(
        "launch",
        *(_tag("arg", name=name, default=_DEFAULTS[name]) for name in names),
        _tag(
            "include",
            _tag("arg", name="world_name", value=world),
            *passed,
            file="$(find gazebo_ros)/launch/empty_world.launch",
        ),
    )


_FILES = {
    "$(find gazebo_ros)/launch/empty_world.launch": _EMPTY_WORLD,
    **{
        f"$(find gazebo_ros)/launch/{name}_world.launch": _of_world(f"worlds/{name}.world")
        for name in ("mud", "rubble", "shapes")
    },
    "$(find gazebo_ros)/launch/willowgarage_world.launch": _of_world("worlds/willowgarage.world"),
}


def known(file: Text, include: LaunchElement) -> LaunchElement | None:
    """The ``<launch>`` of a *file* outside the workspace, all of it at the place of the *include*; None if it is not known."""
    found = _FILES.get(file.raw) if file.known else None
    return None if found is None else _moved(found, include)


def _moved(element: LaunchElement, include: LaunchElement) -> LaunchElement:
    return replace(
        element,
        line=include.line,
        column=include.column,
        children=tuple(_moved(child, include) for child in element.children),
    )
