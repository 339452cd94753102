# SPDX-License-Identifier: Apache-2.0
"""Tags without ``xacro:``: what xacro took before ROS Noetic, and what no xacro takes any more."""

from __future__ import annotations

from haros_ci.robot.nodes import XmlNode
from haros_ci.robot.scopes import XacroMacro

LEGACY = frozenset(("arg", "include", "insert_block", "macro", "property", "if", "unless"))
#: The tags that a URDF has below its root (and those of Gazebo and SRDF), which are no calls whatever macros are called.
_OWN = frozenset(
    (
        "link",
        "joint",
        "material",
        "transmission",
        "gazebo",
        "sensor",
        "ros2_control",
        "group",
        "group_state",
        "end_effector",
        "virtual_joint",
        "passive_joint",
        "disable_collisions",
        "link_sphere_approximation",
        "plugin",
        "visual",
        "collision",
        "inertial",
        "origin",
        "chain",
    )
)


def fits(node: XmlNode, macro: XacroMacro) -> bool:
    """Whether *node*, whose tag is the name of *macro*, gives what it wants: xacro up to ROS Melodic took it for a call, wherever it stood."""
    parameters = {name for name in macro.parameters if not name.startswith("*")}
    attributes = set(node.attributes)
    return (
        node.tag not in _OWN
        and attributes <= parameters
        and all(name in attributes or name in macro.defaults for name in parameters)
    )


def is_call(node: XmlNode, macro: XacroMacro, into: XmlNode) -> bool:
    """Whether *node*, whose tag is the name of *macro*, is meant to call it: it stands where links do, and gives what it wants."""
    is_there = into.tag in ("robot", "macro", "xacro:macro") and bool(node.attributes or node.children)
    return is_there and fits(node, macro)
