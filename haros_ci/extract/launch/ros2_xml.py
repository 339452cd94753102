# SPDX-License-Identifier: Apache-2.0
"""ROS 2 launch files in XML as actions (launch_xml): tags in the order of the file, nothing resolved."""

from __future__ import annotations

from haros_ci.extract.launch.ros2_actions import Builder
from haros_ci.extract.launch.ros2_entity import Entity
from haros_ci.model.launch import LaunchElement, LaunchFile
from haros_ci.model.launch_actions import Description
from haros_ci.model.location import Location


def read_ros2_xml(launch_file: LaunchFile, path: str) -> Description:
    """The actions of the launch file at *path*, whose tags are *launch_file*; never raises.

    A tag that launch refuses is left out, with a problem; the rest is kept.
    """
    root = launch_file.root
    if root is None:
        return Description(problems=launch_file.problems)
    if root.tag != "launch":
        message = f"not a launch file: its root is <{root.tag}>, not <launch>"
        return Description(problems=(*launch_file.problems, (root.line, message)))
    builder = Builder()
    top = _entity(root, path)
    builder.check(top, ("deprecated", "version"), None)
    actions = builder.actions(top.children)
    return Description(actions=actions, problems=(*launch_file.problems, *builder.problems))


def _entity(element: LaunchElement, path: str) -> Entity:
    """*element* and what is in it; reading the tags has bounded the depth."""
    return Entity(
        element.tag,
        Location(path, element.line, element.column),
        element.attributes,
        tuple(_entity(child, path) for child in element.children),
    )
