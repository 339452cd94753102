# SPDX-License-Identifier: Apache-2.0
"""Webots in ROS 2: what the driver of a robot makes for the devices and plug-ins that its description names.

What counts is webots_ros2_driver/src/WebotsNode.cpp of cyberbotics/webots_ros2: ``<webots>`` in the description has ``<device reference="…">``, whose
``<ros>`` says how a device is published if the robot has it, and ``<plugin type="…">``. Which devices there are stands in the world of
Webots (``.wbt``, ``.proto``), which is not read: what is for a device is never certain, and the driver may have more.
"""

from __future__ import annotations

import shlex
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from functools import lru_cache
from pathlib import Path
from types import MappingProxyType

from haros_ci.graph.given_parameters import Parameters
from haros_ci.model.architecture import Endpoint, Node, Unknown
from haros_ci.model.launch import LaunchedNode
from haros_ci.model.workspace import Problem
from haros_ci.robot.nodes import XmlNode
from haros_ci.systems.known.instantiate import instantiate
from haros_ci.systems.known.load import parse
from haros_ci.systems.simulation.descriptions import DESCRIPTION, Descriptions, itself_of
from haros_ci.systems.simulation.endpoints import element
from haros_ci.systems.simulation.simulators import distinct
from haros_ci.systems.simulation.table import KnownPlugin, read_rows
from haros_ci.systems.simulation.trees import DescriptionTree
from haros_ci.systems.simulation.uses import PluginUse, value
from haros_ci.values.abstract import Known

PACKAGE, DRIVER = "webots_ros2_driver", "driver"
#: Devices and plug-ins of one description that are looked at.
MOST = 2_000
#: What the driver makes an underscore of in the name of a device (utils/Utils.cpp).
_REPLACED = str.maketrans(dict.fromkeys("-. )(", "_"))
_FILE = Path(__file__).parent / "plugins" / "webots" / "devices.yaml"


@lru_cache(maxsize=1)
def devices() -> Mapping[str, KnownPlugin]:
    """The table of devices, by their type, and of the driver's own plug-ins, by their class."""
    return MappingProxyType(_rows()[0])


def problems() -> list[Problem]:
    """What has a wrong shape in the table."""
    return _rows()[1]


def _rows() -> tuple[dict[str, KnownPlugin], list[Problem]]:
    return read_rows(parse(_FILE.read_text(encoding="utf-8")), _FILE.name, 2)


def drivers(nodes: Iterable[LaunchedNode]) -> list[LaunchedNode]:
    """The drivers of robots of Webots among launched *nodes*."""
    return [node for node in nodes if node.package == PACKAGE and node.type == DRIVER]


def called(launched: LaunchedNode) -> str:
    """The full name of a driver."""
    return itself_of(launched, DRIVER).name


def completed(node: Node, launched: LaunchedNode, texts: Descriptions) -> Node:
    """The driver's *node* with what its description names."""
    tree = _description(launched, texts)
    made: list[Endpoint] = []
    lost = [Unknown("endpoints", tree.reason, launched.location)] if tree.reason else []
    root = tree.root if tree.root is not None and tree.root.tag == "robot" else None
    section = next(root.all("webots"), None) if root is not None else None
    for child in section.children[:MOST] if section is not None else ():
        if child.tag == "plugin":
            made += _of_plugin(child, node, launched, lost)
        elif child.given("reference"):
            made += _of_device(child, node, launched)
    return replace(node, endpoints=distinct((*node.endpoints, *made)), unknowns=(*node.unknowns, *lost))


def _description(launched: LaunchedNode, texts: Descriptions) -> DescriptionTree:
    """The description that a driver is given: the path of a file, or the text itself."""
    provided = Parameters(launched.parameters)
    found = provided.get(called(launched), DESCRIPTION)
    if found is None or found == Known(""):
        return DescriptionTree(None)
    if isinstance(found, Known) and isinstance(found.value, str) and found.value.endswith(".urdf"):
        return texts.trees.of_file(found.value)
    if isinstance(found, Known) and isinstance(found.value, str) and found.value.endswith(".xacro"):
        mappings = provided.get(called(launched), "xacro_mappings")
        words = mappings.value if isinstance(mappings, Known) else None if mappings is not None else []
        if not isinstance(words, list) or not all(isinstance(word, str) for word in words):
            return DescriptionTree(None, f"the arguments that xacro is given for {found.value} are not known")
        return texts.trees.of_command(shlex.join(["xacro", found.value, *words]), texts.environment)
    return texts.of_parameter(found, launched.location, launched.name or DRIVER)


def _of_device(device: XmlNode, node: Node, launched: LaunchedNode) -> Iterator[Endpoint]:
    """What a *device* makes, if the robot has it and it is of the type that is written."""
    known, name = devices().get(device.given("type") or ""), device.given("reference") or ""
    inner = next(device.all("ros"), XmlNode("ros", {}, device.location))
    enabled = value(inner, "enabled")
    if known is None or known.at != "sensor" or enabled == "false":
        return
    why = f"whether the robot in the world of Webots has the device {name[:60]} is not read"
    use = PluginUse(None, name, inner, "sensor", sensor=name.translate(_REPLACED))
    for end in _ends(use, known, node, launched):
        yield replace(end, unknowns=(*end.unknowns, Unknown("conditions", why, device.location)))


def _of_plugin(plugin: XmlNode, node: Node, launched: LaunchedNode, lost: list[Unknown]) -> Iterator[Endpoint]:
    """What a *plugin* of the driver makes; *lost* takes why that is not known."""
    kind = plugin.given("type")
    known = devices().get(kind or "")
    if known is None or known.at != "model":
        what = f"the plug-in {kind[:100]}" if kind else "a plug-in of the driver"
        lost.append(Unknown("endpoints", f"what {what} makes is not known", plugin.location))
    elif all(value(plugin, name) is not None for name in known.requires):
        yield from _ends(PluginUse(None, kind, plugin, "model"), known, node, launched)


def _ends(use: PluginUse, known: KnownPlugin, node: Node, launched: LaunchedNode) -> Iterator[Endpoint]:
    itself = replace(itself_of(launched, DRIVER), name=node.name)
    ends = instantiate(
        known.node,
        name=node.name,
        namespace=node.name.rpartition("/")[0] or "/",
        arguments=(),
        parameter=lambda full: element(use, known, full.rpartition(":")[2]),
        remap=itself.remap,
        ros=2,
    )
    doubt = () if use.element.certain else (Unknown("conditions", "a condition of the description is not known"),)
    for end in ends:
        yield replace(end, location=use.element.location, unknowns=(*end.unknowns, *doubt))
