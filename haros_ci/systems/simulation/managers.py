# SPDX-License-Identifier: Apache-2.0
"""Controller managers of ros2_control inside simulators: what their plug-in is given in the description, as a launch file would give it."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from haros_ci.graph.names import clean
from haros_ci.model.launch import LaunchedNode, ParameterRule
from haros_ci.model.location import Location
from haros_ci.robot.places import as_launched
from haros_ci.robot.unknown import UnknownValue as NotKnown
from haros_ci.systems.simulation.endpoints import Spawned, beside_name, namespace_of
from haros_ci.systems.simulation.table import KnownPlugin
from haros_ci.systems.simulation.uses import PluginUse

#: Package and type of the known node that is a controller manager.
MANAGER = ("controller_manager", "ros2_control_node")


def manager(
    use: PluginUse,
    known: KnownPlugin,
    spawned: Spawned,
    by: LaunchedNode,
    rules_of: Callable[[str, Location], Iterable[ParameterRule]],
) -> LaunchedNode:
    """The controller manager that a plug-in makes, brought *by* a launched node; *rules_of* reads a parameter file.

    It is given the files of ``<parameters>`` and the rules of ``<remapping>`` (gz_ros2_control_plugin.cpp, gazebo_ros2_control_plugin.cpp).
    """
    rules: list[ParameterRule] = []
    place = use.element.location
    for child in use.element.all("parameters"):
        if isinstance(child.text, str) and child.text.strip():
            rules += rules_of(as_launched(child.text.strip()), place)
    inner = next(use.element.all("ros"), use.element)
    remaps = [
        (source.strip(), target.strip(), place)
        for child in inner.all("remapping")
        if isinstance(child.text, str)
        for source, sign, target in (child.text.partition(":="),)
        if sign
    ]
    space = namespace_of(use, spawned)
    return LaunchedNode(
        kind="node",
        package=MANAGER[0],
        type=MANAGER[1],
        location=place,
        name=beside_name(use, known) or "?",
        namespace="/?" if isinstance(space, NotKnown) else clean(f"/{space or ''}"),
        parameters=tuple(rules),
        remaps=tuple(remaps),
        conditions=by.conditions,
        presence=by.presence,
    )
