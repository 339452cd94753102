# SPDX-License-Identifier: Apache-2.0
"""Plug-ins of Gazebo that the workspace builds, as a started simulator loads them: what each is given, and what the simulator's node has by it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from haros_ci.follow.libraries.gazebo import SPACE, Sdf
from haros_ci.model.architecture import Endpoint, Node, Unknown
from haros_ci.robot.nodes import XmlNode as Element
from haros_ci.systems.gazebo_plugins import Given
from haros_ci.systems.simulation.endpoints import Spawned
from haros_ci.systems.simulation.uses import PluginUse

#: Elements of one plug-in that are read, and how deep in one another.
MOST, DEEPEST = 2_000, 20
UNCERTAIN = "it stands in the description under a condition that is not known"


def given(use: PluginUse, spawned: Spawned) -> Given:
    """What a plug-in is given; a spawner adds its namespace (gazebo_ros_api_plugin.cpp, walkChildAddRobotNamespace)."""
    sdf = _sdf(use.element, [MOST], 0, certain=True)
    if spawned.namespace and sdf.child(SPACE) is None:
        space = None if "?" in spawned.namespace else spawned.namespace
        sdf = replace(sdf, children=(*sdf.children, Sdf(SPACE, text=space)))
    name = use.sensor if use.at == "sensor" else use.model
    return Given(sdf, None if name is None or "?" in name else name)


def _sdf(element: Element, left: list[int], depth: int, *, certain: bool) -> Sdf:
    """*element* as data, as far as it is not too large; *left* counts the elements that may still be read."""
    left[0] -= len(element.children)
    inside = element.children if left[0] >= 0 and depth < DEEPEST else []
    return Sdf(
        element.tag,
        {name: value if isinstance(value, str) else None for name, value in element.attributes.items()},
        element.text if isinstance(element.text, str) else None,
        tuple(_sdf(child, left, depth + 1, certain=element.has_surely(child)) for child in inside),
        certain,
    )


def under(host: Node, use: PluginUse, spawned: Spawned) -> Node:
    """The *host* of a plug-in under the conditions of what brings it."""
    doubt = () if use.element.certain else (Unknown("conditions", UNCERTAIN, use.element.location),)
    return replace(host, conditions=(*host.conditions, *spawned.conditions), unknowns=doubt)


def moved(plugin: Node, host: Node) -> Iterator[Endpoint]:
    """The endpoints of a followed *plugin* as the *host* has them."""
    conditions = tuple(condition for condition in plugin.conditions if condition not in host.conditions)
    doubt = tuple(unknown for unknown in plugin.unknowns if unknown.field == "conditions")
    for end in plugin.endpoints:
        yield replace(end, conditions=(*end.conditions, *conditions), unknowns=(*end.unknowns, *doubt))
