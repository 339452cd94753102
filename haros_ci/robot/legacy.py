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


def is_call(node: XmlNode, macro: XacroMacro, into: XmlNode) -> bool:
    """Whether *node*, whose tag is the name of *macro*, is meant to call it: it stands where links do, and gives what it wants."""
    if node.tag in _OWN or into.tag not in ("robot", "macro", "xacro:macro"):
        return False
    parameters = {name for name in macro.parameters if not name.startswith("*")}
    attributes = set(node.attributes)
    return (
        attributes <= parameters
        and all(name in attributes or name in macro.defaults for name in parameters)
        and bool(attributes or node.children)
    )
