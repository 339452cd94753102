# SPDX-License-Identifier: Apache-2.0
"""Telling ROS 1 launch files in XML from ROS 2 ones: both have a root ``<launch>``."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from haros_ci.model.launch import LaunchElement, LaunchFile
from haros_ci.model.location import Location
from haros_ci.regex import regex

_ROS1_TAGS = frozenset(("machine", "rosparam", "test", "master"))
_ROS2_TAGS = frozenset(("let", "executable", "timer", "shutdown", "log", "log_info", "ros_timer", "reset", "reset_env"))
_ROS2_TAGS |= {"node_container", "load_composable_node", "composable_node", "push-ros-namespace", "push_ros_namespace"}
_ROS2_TAGS |= {"set_remap", "set_parameter", "set_parameters_from_file", "set_use_sim_time", "set_ros_log_dir"}
_ROS2_TAGS |= {"set_env", "unset_env", "append_env"}
#: Attributes that only one of the dialects has, by tag.
_ROS1_ATTRIBUTES = {
    "node": frozenset(("type", "ns", "clear_params", "machine", "required")),
    "include": frozenset(("ns", "clear_params", "pass_all_args")),
    "group": frozenset(("ns", "clear_params")),
    "param": frozenset(("textfile", "binfile", "command")),
    "arg": frozenset(("doc",)),
}
_ROS2_ATTRIBUTES = {
    "node": frozenset(("exec", "namespace", "ros_args", "exec_name", "node-name")),
    "group": frozenset(("scoped", "forwarding")),
    "param": frozenset(("from", "allow_substs", "sep", "value-sep")),
    "arg": frozenset(("description",)),
}
_ROS1_SUBSTITUTION = regex(r"\$\((find|arg|optenv)\s")
_ROS2_SUBSTITUTION = regex(r"\$\((var|find-pkg-share|find-pkg-prefix|exec-in-pkg|find-exec|command|not|and|or)\s")


def is_ros1(launch: LaunchFile, package_ros: int | None) -> bool:
    """Whether *launch* is a ROS 1 launch file: a root ``<launch>``, and more signs of ROS 1 than of ROS 2.

    A sign is a tag, an attribute of a tag or a substitution that only one of them has: ``type=`` or ``exec=`` of a
    node, ``<rosparam>`` or ``<let>``, ``$(arg`` or ``$(var``. Where they are even, the package's *package_ros* decides.
    """
    if launch.root is None or launch.root.tag != "launch":
        return False
    balance = 0
    todo = [launch.root]
    while todo:
        element = todo.pop()
        balance += _sign(element)
        todo.extend(element.children)
    return balance > 0 if balance else package_ros != 2


#: What to write in ROS 2 for what is of ROS 1, and the other way round.
_IN_ROS2 = {
    "type": "exec",
    "ns": "namespace, or <push_ros_namespace>",
    "doc": "description",
    "textfile": "$(file-content ...)",
    "command": "value with $(command ...)",
    "pass_all_args": "nothing: arguments are inherited",
    "rosparam": "<param from=...>",
    "find": "$(find-pkg-share ...)",
    "arg": "$(var ...)",
    "optenv": "$(env NAME default)",
}
_IN_ROS1 = {
    "exec": "type",
    "namespace": "ns",
    "description": "doc",
    "from": "<rosparam file=...>",
    "let": "<arg>",
    "push-ros-namespace": "ns of a <group>",
    "push_ros_namespace": "ns of a <group>",
    "find-pkg-share": "$(find ...)",
    "var": "$(arg ...)",
}


class Foreign(NamedTuple):
    """A construct of the other ROS: its place, the construct, and what to write instead, "" where there is no such thing.

    *stops*: launch rejects the file for it. roslaunch passes over tags and attributes that it does not know, with a warning
    (``XmlLoader._check_attrs``); then the system is another one only if it *matters*.
    """

    location: Location
    text: str
    instead: str
    stops: bool
    matters: bool


#: The attributes that roslaunch reads, by tag; it resolves no substitution in others.
_READ = {
    "node": frozenset(
        "pkg type machine name args output respawn respawn_delay cwd ns clear_params launch-prefix required".split()
    ),
    "rosparam": frozenset(("command", "ns", "file", "param", "subst_value")),
    "param": frozenset(("name", "value", "type", "textfile", "binfile", "command")),
    "arg": frozenset(("name", "value", "default", "doc")),
    "machine": frozenset(("name", "address", "env-loader", "ssh-port", "user", "password", "default", "timeout")),
    "remap": frozenset(("from", "to")),
    "env": frozenset(("name", "value")),
    "include": frozenset(("file", "ns", "clear_params", "pass_all_args")),
    "group": frozenset(("ns", "clear_params")),
}
_READ["test"] = _READ["node"] | {"test-name", "time-limit", "retry"}
#: An attribute of ROS 2 that stands where roslaunch wants one of these: without any of them it stops.
_INSTEAD_OF = {
    ("node", "exec"): frozenset(("type",)),
    ("node", "node-name"): frozenset(("name",)),
    ("param", "from"): frozenset(("value", "textfile", "binfile", "command")),
}
#: What roslaunch can pass over without another system for it.
_IDLE = frozenset(
    ("description", "scoped", "forwarding", "exec", "exec_name", "node-name", "allow_substs", "sep", "value-sep")
)
_IDLE |= {"log", "log_info"}


def foreign_constructs(launch: LaunchFile, path: str, native: int) -> Iterator[Foreign]:
    """The constructs in the file at *path* that only the other ROS version than *native* has."""
    tags = _ROS1_TAGS if native == 2 else _ROS2_TAGS
    attributes = _ROS1_ATTRIBUTES if native == 2 else _ROS2_ATTRIBUTES
    words = _ROS1_SUBSTITUTION if native == 2 else _ROS2_SUBSTITUTION
    instead = _IN_ROS2 if native == 2 else _IN_ROS1
    todo = [launch.root] if launch.root is not None and launch.root.tag == "launch" else []
    while todo:
        element = todo.pop()
        place = Location(path, element.line, element.column)
        if element.tag in tags:
            matters = element.tag not in _IDLE
            yield Foreign(place, f"<{element.tag}>", instead.get(element.tag, ""), native == 2, matters)
            if native == 1:
                continue  # roslaunch does not look into it
        for name, value in element.attributes:
            if name in attributes.get(element.tag, ()):
                stops = native == 2 or _is_missed(element, name)
                yield Foreign(place, f"{name}= of <{element.tag}>", instead.get(name, ""), stops, name not in _IDLE)
            for match in words.finditer(value) if _is_resolved(element, name, native) else ():
                yield Foreign(place, f"$({match[1]} ...)", instead.get(match[1], ""), True, True)
        todo.extend(reversed(element.children))


def _is_resolved(element: LaunchElement, name: str, native: int) -> bool:
    """Whether launch resolves the substitutions of the attribute *name*."""
    return native == 2 or name in ("if", "unless") or name in _READ.get(element.tag, ())


def _is_missed(element: LaunchElement, name: str) -> bool:
    """Whether roslaunch stops because the attribute *name* of ROS 2 stands instead of one that it requires."""
    requested = _INSTEAD_OF.get((element.tag, name))
    return requested is not None and all(element.get(item) is None for item in requested)


def _sign(element: LaunchElement) -> int:
    sign = (element.tag in _ROS1_TAGS) - (element.tag in _ROS2_TAGS)
    for name, value in element.attributes:
        sign += name in _ROS1_ATTRIBUTES.get(element.tag, ())
        sign -= name in _ROS2_ATTRIBUTES.get(element.tag, ())
        if "$(" in value:
            sign += len(_ROS1_SUBSTITUTION.findall(value)) - len(_ROS2_SUBSTITUTION.findall(value))
    return sign
