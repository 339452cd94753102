# SPDX-License-Identifier: Apache-2.0
"""From a plug-in in a description and its row in the table to endpoints."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any

from haros_ci.graph.names import UNKNOWN, clean, resolve
from haros_ci.graph.ros2_process import RemappingRule, RosNode, named, ros_arguments
from haros_ci.model.architecture import Condition, Endpoint, Node, Unknown
from haros_ci.model.location import Location
from haros_ci.records import dataclass
from haros_ci.regex import regex
from haros_ci.robot.nodes import XmlNode as Element
from haros_ci.robot.unknown import UnknownValue as NotKnown
from haros_ci.systems.known.entry import KnownNode
from haros_ci.systems.known.instantiate import instantiate
from haros_ci.systems.ros2_implicit import implicit
from haros_ci.systems.simulation.table import KnownPlugin
from haros_ci.systems.simulation.uses import PluginUse, value

_FILLED = regex(r"\{(\w+)\}")
#: The element that names the controller manager that a plug-in makes.
MANAGER_NAME = "controller_manager_name"
_UNREAD = "its value in the description is not known"


@dataclass(frozen=True, slots=True, kw_only=True)
class Spawned:
    """How a description gets into the simulator: as a model called *model*, whose plug-ins are given *namespace* (None: none), under *conditions*."""

    model: str = ""
    namespace: str | None = None
    conditions: tuple[Condition, ...] = ()


def element(use: PluginUse, known: KnownPlugin, name: str) -> Any:
    """What a plug-in reads from the element called *name*: data, None if it is not there, or why it is not known."""
    if name == "model":
        return use.model if use.model != "?" else Unknown("name", "which model it is in, is not known")
    if name == "sensor_type":
        return use.sensor_type if use.sensor_type is not None else Unknown("conditions", _UNREAD)
    if name in ("has_left", "has_right"):
        return _cameras(use, name.removeprefix("has_"))
    if name == "cameras":
        return list(use.cameras)
    default = known.elements.get(name)
    text = value(use.element, name)
    if isinstance(text, NotKnown):
        return Unknown("name", f"<{name}> of the plug-in: {_UNREAD}", use.element.location)
    if text is None:
        return filled(default, use, known) if isinstance(default, str) else default
    if isinstance(default, bool):
        truth = {"true": True, "1": True, "false": False, "0": False}.get(text.lower())
        return truth if truth is not None else Unknown("value", f"<{name}> is neither true nor false")
    return text


def filled(text: str, use: PluginUse, known: KnownPlugin) -> str | Unknown:
    """*text* of a row with the elements that it has in braces; an Unknown if one is not known."""
    parts = _FILLED.split(text)
    for at in range(1, len(parts), 2):
        part = use.sensor if parts[at] == "sensor" else element(use, known, parts[at])
        if part is None or isinstance(part, Unknown):
            return part or Unknown("name", _UNREAD, use.element.location)
        parts[at] = str(part)
    return "".join(parts)


def is_idle(use: PluginUse, known: KnownPlugin) -> bool:
    """Whether the plug-in makes nothing for sure: it stands where it is not loaded, or lacks what it needs."""
    if known.at != use.at:
        return True
    return any(value(use.element, name) is None for name in known.requires)


def ros1_endpoints(
    use: PluginUse, known: KnownPlugin, node: Node, spawned: Spawned, parameter: Callable[[str], object | None]
) -> Iterator[Endpoint]:
    """What a ROS 1 plug-in makes on *node*, the simulator; *parameter* asks the parameter server."""
    space = _namespace(use, known, spawned)
    around = node.name.rpartition("/")[0] or "/"
    why = space if isinstance(space, Unknown) else None
    namespace = resolve(UNKNOWN if isinstance(space, Unknown) else space, around, node.name) if space else around
    start = f"{node.name}/"
    remaps = dict(node.remaps)

    def provided(full: str) -> object | None:
        return element(use, known, full[len(start) :]) if full.startswith(start) else parameter(full)

    ends = instantiate(
        known.node,
        name=node.name,
        namespace=namespace,
        arguments=(),
        parameter=provided,
        remap=lambda full: remaps.get(full, full),
    )
    for end in ends:
        more = (replace(why, field="name"),) if why is not None and UNKNOWN in end.name else ()
        yield _placed(end, use, spawned, more)


def ros2_nodes(
    use: PluginUse,
    known: KnownPlugin,
    simulator: Node,
    spawned: Spawned,
    process: tuple[RemappingRule, ...] = (),
    beside: KnownNode | None = None,
) -> Iterator[Node]:
    """The node that a ROS 2 plug-in makes, and the one *beside* it; *process* are the rules that the server is started with."""
    inner = next(use.element.all("ros"), use.element)
    text = namespace_of(use, spawned)
    name, why = known.called or use.name, None
    rules, unread = _rules(inner)
    rules = (*rules, *process)
    if name is None or isinstance(text, NotKnown) or unread:
        why = Unknown("name", "what the description gives it is not known", use.element.location)
    own = name if name is not None else UNKNOWN
    space = UNKNOWN if isinstance(text, NotKnown) else text or "/"
    full, space = named(own, clean(f"/{space}"), rules)
    places = [(full, known.node)]
    if beside is not None:
        last = beside_name(use, known)
        why = why or (
            None if last is not None else Unknown("name", f"<{MANAGER_NAME}>: {_UNREAD}", use.element.location)
        )
        places.append((clean(f"{space}/{last or UNKNOWN}"), beside))
    for place, what in places:
        node = replace(
            simulator,
            name=place,
            kind="node",
            location=use.element.location,
            package=known.package if what is known.node else what.package,
            type=known.library if what is known.node else what.type,
            arguments="",
            conditions=(*simulator.conditions, *spawned.conditions),
            remaps=(),
            rules=(),
            class_name=None,
            source="known-node",
            unknowns=tuple(unknown for unknown in (why, _doubt(use)) if unknown is not None),
        )
        yield replace(node, endpoints=tuple(_ros2_ends(use, known, what, node, space, rules, inner, spawned)))


def namespace_of(use: PluginUse, spawned: Spawned) -> str | NotKnown | None:
    """The namespace that a ROS 2 plug-in is given: by its spawner, else by ``<namespace>``."""
    inner = next(use.element.all("ros"), use.element)
    return value(inner, "namespace") if spawned.namespace in (None, "") else spawned.namespace


def beside_name(use: PluginUse, known: KnownPlugin) -> str | None:
    """What the node is called that a plug-in makes besides, a controller manager; None if that is not known."""
    name = element(use, known, MANAGER_NAME)
    return name if isinstance(name, str) else None


def on_server(known: KnownPlugin, node: Node, rules: tuple[RemappingRule, ...]) -> tuple[Endpoint, ...]:
    """What a plug-in on the server's command line makes on *node*."""
    space = node.name.rpartition("/")[0] or "/"
    itself = RosNode(node.name, space, space, "node", "", node.location or Location(""), rules=rules)
    ends = instantiate(
        known.node,
        name=node.name,
        namespace=space,
        arguments=(),
        parameter=lambda name: None,
        remap=itself.remap,
        ros=2,
    )
    return tuple(replace(end, location=node.location) for end in ends)


def by_simulated_time(node: Node) -> Node:
    """*node* as Gazebo makes one: its time is that of the simulation, whatever it is given."""
    ends = [replace(end, effective=True) if end.name == f"{node.name}:use_sim_time" else end for end in node.endpoints]
    if not any(end.kind == "subscribers" and end.name == "/clock" for end in ends):
        made = implicit(node.name, "node", {}, True, node.location)
        ends += [replace(end, source="known-node") for end in made if end.kind == "subscribers"]
    return replace(node, endpoints=tuple(ends))


def _ros2_ends(
    use: PluginUse,
    known: KnownPlugin,
    what: KnownNode,
    node: Node,
    space: str,
    rules: tuple[RemappingRule, ...],
    inner: Element,
    spawned: Spawned,
) -> Iterator[Endpoint]:
    itself = RosNode(node.name, space, space, "node", "", use.element.location, rules=rules)
    parameters = _parameters(inner)

    def requested(full: str) -> object | None:
        name = full.rpartition(":")[2]
        return parameters[name] if name in parameters else element(use, known, name)

    ends = instantiate(
        what, name=node.name, namespace=space, arguments=(), parameter=requested, remap=itself.remap, ros=2
    )
    has_qos = next(inner.all("qos"), None) is not None
    for end in ends:
        if has_qos and end.kind in ("publishers", "subscribers"):
            end = replace(end, qos=None, unknowns=(*end.unknowns, Unknown("qos", "<qos> of the plug-in may change it")))
        yield _placed(end, use, spawned, ())
    there = {(end.kind, end.name) for end in ends}
    for end in implicit(node.name, "node", {}, True, use.element.location, spawned.conditions):
        if (end.kind, end.name) not in there:
            yield replace(end, source="known-node")


def _placed(end: Endpoint, use: PluginUse, spawned: Spawned, more: tuple[Unknown, ...]) -> Endpoint:
    doubt = _doubt(use)
    unknowns = (*end.unknowns, *more, *((replace(doubt, field="conditions"),) if doubt is not None else ()))
    return replace(
        end, location=use.element.location, conditions=(*end.conditions, *spawned.conditions), unknowns=unknowns
    )


def _doubt(use: PluginUse) -> Unknown | None:
    if use.element.certain:
        return None
    why = "it stands in the description under a condition that is not known"
    return Unknown("conditions", why, use.element.location)


def _namespace(use: PluginUse, known: KnownPlugin, spawned: Spawned) -> str | Unknown:
    """The namespace as the plug-in gives it to its node handle."""
    rule = known.space
    if rule.ignored:
        return ""
    written = _given_namespace(use, spawned)
    if isinstance(written, Unknown):
        return written
    text: str | None = None  # what is given is taken as it is
    if written is None:
        text = rule.missing
    elif written == "":
        text = rule.empty
    elif not written.strip("/"):
        text = rule.slash
    parts = []
    for part in (rule.above, text, rule.below):
        made = filled(part, use, known) if part is not None else written or ""
        if isinstance(made, Unknown):
            return made
        parts.append(made)
    whole = "/".join(part for part in parts if part)
    return whole if not rule.above or whole.startswith("/") else whole.lstrip("/")


def _given_namespace(use: PluginUse, spawned: Spawned) -> str | Unknown | None:
    """``<robotNamespace>`` of the plug-in, else the namespace that its model is spawned with; None: neither is given."""
    text = value(use.element, "robotNamespace")
    if isinstance(text, NotKnown):
        return Unknown("name", f"<robotNamespace> of the plug-in: {_UNREAD}", use.element.location)
    if text is None:
        text = spawned.namespace
        if text is not None and UNKNOWN in text:
            return Unknown("name", "the namespace that its model is spawned with is not known")
    return text


def _cameras(use: PluginUse, side: str) -> object:
    if "?" in use.cameras or not use.cameras:
        return Unknown("conditions", "the cameras of the sensor are not known", use.element.location)
    return any(side in name for name in use.cameras)


def _rules(inner: Element) -> tuple[tuple[RemappingRule, ...], bool]:
    """The rules of ``<remapping>`` and ``<argument>``, and whether one of them is not known."""
    words: list[str] = []
    unread = False
    for child in inner.all("argument"):
        unread |= not isinstance(child.text, str)
        words += [child.text.strip()] if isinstance(child.text, str) else []
    words.append("--ros-args")
    for child in inner.all("remapping"):
        unread |= not isinstance(child.text, str)
        words += ["-r", child.text.strip()] if isinstance(child.text, str) else []
    return ros_arguments(words).rules, unread


def _parameters(inner: Element) -> dict[str, object]:
    found: dict[str, object] = {}
    kinds: dict[str, Callable[[str], object]] = {"int": int, "double": float, "float": float, "string": str}
    for child in inner.all("parameter"):
        name, kind = child.given("name"), child.given("type")
        if not name or not isinstance(child.text, str):
            continue
        text = child.text.strip()
        try:
            found[name] = text.lower() in ("true", "1") if kind == "bool" else kinds[kind or ""](text)
        except (KeyError, ValueError):
            continue
    return found
