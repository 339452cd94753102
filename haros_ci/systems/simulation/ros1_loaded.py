# SPDX-License-Identifier: Apache-2.0
"""Controllers of ros_control (ROS 1) that the workspace builds and a spawner asks for: they are followed, and what they make is on the manager's node.

Their handles are those of controller_manager.cpp of ros-controls/ros_control: the manager's, and one below it by the controller's name. The manager is the node
that has its services in the namespace in which the spawner looks for them, robot or simulator.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial

from haros_ci.graph.names import clean
from haros_ci.graph.parameters import ParameterServer
from haros_ci.model.architecture import Endpoint, Node, Unknown
from haros_ci.records import dataclass
from haros_ci.systems.following import Types
from haros_ci.systems.ros1_controllers import CONTROLLER, HOST, PluginOfControl, described, loaded
from haros_ci.systems.simulation.built import moved
from haros_ci.systems.simulation.ros1_managers import SERVICE, Asked
from haros_ci.systems.system import Job
from haros_ci.values.abstract import Known, Opaque, Value

#: Why the name of an endpoint is not known whose handle is below a namespace that is remapped.
BELOW = "the manager remaps a namespace around it, which counts if a node handle of that namespace was constructed"


@dataclass(frozen=True, slots=True)
class OwnController:
    """A controller called *name*, the manager of which is in *namespace*, and the *job* that follows it."""

    name: str
    namespace: str
    job: Job


def followed(types: Types, every: Iterable[Asked], server: ParameterServer) -> tuple[OwnController, ...]:
    """Those of the controllers that are asked for whose class the workspace builds; *server* has the parameters that are set."""
    requested = [ask for ask in every if ask.names]
    classes = described(types) if requested else {}
    found: dict[tuple[str, str], OwnController] = {}
    for ask in requested if classes else ():
        for own in _own(types, ask, server, classes):
            found.setdefault((own.namespace, own.name), own)
    return tuple(found.values())


def _own(
    types: Types, ask: Asked, server: ParameterServer, classes: Mapping[str, PluginOfControl]
) -> Iterator[OwnController]:
    parameter = partial(_parameter, ask.settings, server)
    for name in ask.names:
        full = clean(f"{ask.namespace}/{name}")
        kind = parameter(f"{full}/type") if "?" not in full else None
        item = classes.get(kind.of(str)) if isinstance(kind, Known) and issubclass(kind.kind, str) else None
        if item is not None and item.base == CONTROLLER:
            yield OwnController(full, ask.namespace, loaded(types, item, (ask.namespace, full), ask.by, parameter))


def _parameter(settings: Mapping[str, object], server: ParameterServer, name: str) -> Value | None:
    """What is set for the parameter *name*: by the spawner of its files, else by launch files."""
    if name not in settings:
        return server.get(name)
    value = settings[name]
    return Opaque(value.reason) if isinstance(value, Unknown) else Known(value)


def with_controllers(
    nodes: Iterable[Node], controllers: Sequence[Node], ours: Iterable[OwnController]
) -> tuple[Node, ...]:
    """*nodes* with what the *controllers* make on those of their managers; one whose manager is not seen stands by itself, on a node of no known name."""
    spaces = {own.name: own.namespace for own in ours}
    found = list(nodes)
    for controller in controllers:
        service = clean(f"{spaces.get(controller.name, '/')}/{SERVICE}")
        hosts = [
            number
            for number, node in enumerate(found)
            if any(end.kind == "servers" and end.name == service for end in node.endpoints)
        ]
        if len(hosts) != 1:
            unknowns = (*controller.unknowns, Unknown("name", HOST, controller.location))
            found.append(replace(controller, name="/?", kind="node", unknowns=unknowns))
            continue
        host = found[hosts[0]]
        ends = [_remapped(end, host) for end in moved(controller, host)]
        more = tuple(why for why in controller.unknowns if why.field == "endpoints" and why not in host.unknowns)
        found[hosts[0]] = replace(host, endpoints=(*host.endpoints, *ends), unknowns=(*host.unknowns, *more))
    return tuple(found)


def _remapped(end: Endpoint, host: Node) -> Endpoint:
    """*end* of a controller with the name that the *host* gives it: roscpp remaps the namespace of its handle where that is constructed, then its whole name."""
    remaps = dict(host.remaps)
    name = end.name
    written = end.written or ""
    is_below = written[:1] not in ("", "/", "~") and name.endswith(f"/{written}")
    space = name.removesuffix(f"/{written}") if is_below else ""
    if space in remaps and space != host.name:
        name = clean(f"{remaps[space]}/{written}")
    elif any(name.startswith(f"{source}/") for source in remaps) and written[:1] != "/":
        if not space or any(space.startswith(f"{source}/") for source in remaps):
            return replace(end, name="/?", unknowns=(*end.unknowns, Unknown("name", BELOW, end.location)))
    return replace(end, name=remaps.get(name, name))
