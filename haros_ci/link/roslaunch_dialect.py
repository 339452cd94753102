# SPDX-License-Identifier: Apache-2.0
"""Telling ROS 1 launch files in XML from ROS 2 ones: both have a root ``<launch>``."""

from __future__ import annotations

import re

from haros_ci.model.launch import LaunchElement, LaunchFile

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
_ROS1_SUBSTITUTION = re.compile(r"\$\((find|arg|optenv)\s")
_ROS2_SUBSTITUTION = re.compile(r"\$\((var|find-pkg-share|find-pkg-prefix|exec-in-pkg|find-exec|command|not|and|or)\s")


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


def _sign(element: LaunchElement) -> int:
    sign = (element.tag in _ROS1_TAGS) - (element.tag in _ROS2_TAGS)
    for name, value in element.attributes:
        sign += name in _ROS1_ATTRIBUTES.get(element.tag, ())
        sign -= name in _ROS2_ATTRIBUTES.get(element.tag, ())
        if "$(" in value:
            sign += len(_ROS1_SUBSTITUTION.findall(value)) - len(_ROS2_SUBSTITUTION.findall(value))
    return sign
