# SPDX-License-Identifier: Apache-2.0
"""The plug-ins in a description that has been expanded: where each stands, and in which model and sensor.

What counts is sdformat's reading of URDF (``<gazebo>``, with a reference to a link or joint or without) and of SDF.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from haros_ci.records import dataclass
from haros_ci.robot.nodes import XmlNode
from haros_ci.robot.unknown import UnknownValue

#: Elements below one another that are looked into.
DEEPEST = 60
#: Parents whose plug-ins Gazebo loads, and what these are then.
_LOADING = {
    "world": "world",
    "model": "model",
    "actor": "model",
    "include": "model",
    "sensor": "sensor",
    "visual": "visual",
}
_THROUGH = ("sdf", "gazebo", "link", "joint", "collision", *_LOADING)


@dataclass(frozen=True, slots=True)
class PluginUse:
    """A ``<plugin>`` in a description.

    *filename* and *name* are None where they are not known. *at* is the kind of its parent, *model* the name of the model around
    (``?``: not known; "" in a world), *sensor* and *sensor_type* those of the sensor, *cameras* the names of its cameras. Its *element*
    is not certain below a condition that is not known.
    """

    filename: str | None
    name: str | None
    element: XmlNode
    at: str
    model: str = ""
    sensor: str | None = ""
    sensor_type: str | None = ""
    cameras: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class ModelInclude:
    """An ``<include>`` of a model by its *uri*, None where it is not known; it is called *name* there, if that is given."""

    uri: str | None
    name: str | None
    element: XmlNode


def found(root: XmlNode, model: str = "") -> Iterator[PluginUse | ModelInclude]:
    """The plug-ins and includes of a description; the outermost model of it is called *model*, if that is given."""
    start = PluginUse(None, None, root, "", model)
    if root.tag == "robot":
        yield from _of_urdf(root, replace(start, at="model", model=model or root.given("name") or "?"))
    elif root.tag in ("world", "model"):
        yield from _inside(XmlNode("sdf", {}, root.location, children=[root]), start, model, 0)
    else:
        yield from _inside(root, start, model, 0)


def value(element: XmlNode, name: str) -> str | UnknownValue | None:
    """The text of the first child called *name*, without blanks around it; None if there is none."""
    child = next(element.all(name), None)
    if child is None:
        return None
    return child.text.strip() if isinstance(child.text, str) and element.has_surely(child) else UnknownValue()


def _of_urdf(root: XmlNode, around: PluginUse) -> Iterator[PluginUse | ModelInclude]:
    for extension in root.all("gazebo"):
        reference = extension.given("reference")
        if reference == "":
            for plugin in extension.all("plugin"):
                yield _use(plugin, around)
        for tag in ("sensor", "visual"):
            for node in extension.all(tag):
                if reference != "":
                    yield from _inside(XmlNode("link", {}, node.location, children=[node]), around, around.model, 1)


def _inside(node: XmlNode, around: PluginUse, model: str, depth: int) -> Iterator[PluginUse | ModelInclude]:
    if depth > DEEPEST:
        return
    for child in node.children:
        if child.tag == "plugin":
            if node.tag in _LOADING:
                yield _use(child, replace(around, at=_LOADING[node.tag]))
        elif child.tag == "include":
            yield _include(child)
        elif child.tag in _THROUGH:
            yield from _inside(child, _entered(child, node, around, model), model, depth + 1)


def _entered(child: XmlNode, parent: XmlNode, around: PluginUse, model: str) -> PluginUse:
    """*around* as it is inside *child*, with the name of the model and the sensor that this is."""
    if child.tag in ("model", "actor"):
        is_outer = parent.tag in ("sdf", "gazebo", "world")
        text = child.given("name")
        name = (model if is_outer and parent.tag != "world" and model else text) or "?"
        return replace(around, model=name if is_outer else "?")
    if child.tag == "sensor":
        return replace(
            around,
            sensor=child.given("name"),
            sensor_type=child.given("type"),
            cameras=tuple(node.given("name") or "?" for node in child.all("camera")),
        )
    return around


def _use(plugin: XmlNode, around: PluginUse) -> PluginUse:
    return replace(
        around,
        filename=plugin.given("filename"),
        name=plugin.given("name"),
        element=plugin,
    )


def _include(element: XmlNode) -> ModelInclude:
    uri, name = value(element, "uri"), value(element, "name")
    return ModelInclude(uri if isinstance(uri, str) else None, name if isinstance(name, str) else None, element)
