# SPDX-License-Identifier: Apache-2.0
"""Controllers of ros_control in a simulator: what ``spawner`` asks the controller manager of its plug-in for works in the simulator's node.

What counts is controller_manager/scripts/spawner and controller_manager.cpp of ros-controls/ros_control: a controller called *name* has its parameters,
and among these its type, below the manager's namespace and *name*.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace

from haros_ci.graph.names import clean, resolve
from haros_ci.graph.parameters import ParameterServer
from haros_ci.graph.words import split
from haros_ci.model.architecture import Endpoint, Node, Unknown
from haros_ci.model.launch import Started
from haros_ci.records import dataclass, field
from haros_ci.robot.unknown import UNKNOWN, UnknownValue
from haros_ci.robot.yaml_values import yaml_value
from haros_ci.systems.known.entry import KnownNode
from haros_ci.systems.known.instantiate import instantiate
from haros_ci.systems.outside import as_data
from haros_ci.systems.simulation.simulators import SimulatorPlugins
from haros_ci.values.abstract import Known

PACKAGE = "controller_manager"
#: The plug-in of Gazebo that has a controller manager, and the service that tells where that is.
LIBRARY, SERVICE = "gazebo_ros_control", "controller_manager/load_controller"
#: Options of the spawner that a value follows.
TAKING = ("--wait-for", "--namespace", "--timeout", "--shutdown-timeout")
UNREAD = "its value in a file of the spawner is not known"
#: Verbs of ``controller_manager/controller_manager`` that load controllers.
LOADING = ("load", "spawn")


@dataclass(frozen=True, slots=True)
class Asked:
    """The controllers that a node *by* asks for, by their *names*, of the manager in *namespace*.

    *settings* are the parameters that it sets before, by their full names: of files that stand among its arguments.
    """

    by: Started
    namespace: str
    names: tuple[str, ...]
    settings: Mapping[str, object] = field(default_factory=dict)


def asked(nodes: Iterable[Started], read: Callable[[str], str]) -> Iterator[Asked]:
    """What the spawners among *nodes* ask for; *read* gives the text of a file that a launch file names, or ""."""
    for node in nodes:
        words = split(node.arguments).rest
        if node.package != PACKAGE:
            continue
        if node.type in ("spawner", "spawner.py"):
            space, written = _spawned(words)
            names: list[str] = []
            settings: dict[str, object] = {}
            for word in written:
                file = _file(read(word)) if "/" in word else None
                names += [word] if file is None else list(file)
                _set(settings, "", file or {})
            around = resolve(space, node.namespace, node.name) if space else clean(f"/{node.namespace}")
            yield Asked(node, around, tuple(names), settings)
        elif node.type == PACKAGE and words[:1] and words[0] in LOADING:
            yield Asked(node, clean(f"/{node.namespace}"), tuple(words[1:]))


def _spawned(words: Sequence[str]) -> tuple[str, tuple[str, ...]]:
    """The namespace and the controllers that a spawner's command line names."""
    names: list[str] = []
    space = option = ""
    for word in words:
        name, sign, value = word.partition("=")
        if option or (sign and name in TAKING):
            space = (value if not option else word) if (option or name) == "--namespace" else space
            option = ""
        elif word in TAKING:
            option = word
        elif not word.startswith("-"):
            names.append(word)
    return space, tuple(names)


def _file(text: str) -> dict[str, object] | None:
    """The controllers in a file of parameters, by name; None if *text* has none."""
    found = yaml_value(text, lambda number: UNKNOWN) if text else None
    if not isinstance(found, dict) or not all(isinstance(name, str) for name in found):
        return None
    return found


def _set(settings: dict[str, object], name: str, value: object) -> None:
    """Set the parameter *name*, or those below it, to a *value* of a file (rosparam.set_param)."""
    if not isinstance(value, dict):
        settings[name] = Unknown("value", UNREAD) if isinstance(value, UnknownValue) else value
        return
    for key, item in value.items():
        _set(settings, clean(f"{name}/{key}"), item)


def controllers(
    node: Node,
    made: Iterable[Endpoint],
    every: Iterable[Asked],
    server: ParameterServer,
    known: Callable[[str, str, int], KnownNode | None],
    into: SimulatorPlugins,
    ours: Collection[str] = (),
) -> Iterator[Endpoint]:
    """What the controllers make that the managers on *node*, which has *made* these endpoints, are asked for; *into* takes why one is not known.

    *ours* are the full names of those that the workspace builds: they are followed.
    """
    spaces = {end.name.removesuffix(f"/{SERVICE}") or "/" for end in made if end.name.endswith(f"/{SERVICE}")}
    for ask in every:
        if ask.namespace not in spaces and not any("?" in space for space in (ask.namespace, *spaces)):
            continue
        for name in ask.names if spaces else ():
            full = clean(f"{ask.namespace}/{name}")
            if full in ours:
                continue
            value = server.get(f"{full}/type")
            written = ask.settings.get(f"{full}/type", value.value if isinstance(value, Known) else None)
            kind = written if isinstance(written, str) else "?"
            found = known(kind.partition("/")[0], kind, 1) if "?" not in full else None
            if found is None:
                message = f": it is a {kind}" if kind != "?" else ""
                into.lose(f"what the controller {name} makes is not known{message}", ask.by.location)
                continue
            yield from _made(node, found, full, ask, server)


def _made(node: Node, found: KnownNode, full: str, ask: Asked, server: ParameterServer) -> Iterator[Endpoint]:
    remaps = dict(node.remaps)
    conditions = tuple(condition for condition in ask.by.conditions if condition not in node.conditions)
    ends = instantiate(
        found,
        name=full,
        namespace=ask.namespace,
        arguments=(),
        parameter=lambda name: ask.settings[name] if name in ask.settings else as_data(server.get(name)),
        remap=lambda name: remaps.get(name, name),
    )
    for end in ends:
        yield replace(end, location=ask.by.location, conditions=(*end.conditions, *conditions))
