# SPDX-License-Identifier: Apache-2.0
"""Gazebo in ROS 1: its plug-ins work in the simulator's own node, and ``spawn_model`` brings models to it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from haros_ci.graph.names import clean, resolve
from haros_ci.graph.parameters import ParameterServer
from haros_ci.graph.words import Words, split
from haros_ci.model.architecture import Node, Parameter
from haros_ci.model.launch import Launched, Started
from haros_ci.systems.known.entry import KnownNode
from haros_ci.systems.outside import as_data
from haros_ci.systems.simulation.endpoints import ros1_endpoints
from haros_ci.systems.simulation.ros1_managers import asked, controllers
from haros_ci.systems.simulation.simulators import (
    PACKAGE,
    SERVERS,
    Completes,
    Found,
    completed,
    gather,
    of_file_or_model,
    of_server,
    option,
    spawned_by,
    unpredictable,
)
from haros_ci.systems.simulation.trees import Tree, Trees

SPAWNERS = frozenset(("spawn_model", "spawn_urdf", "spawn_gazebo_model"))
#: Plug-ins of the server's command line that make nothing but what the data on known nodes says of the simulator.
ACCOUNTED = frozenset(("gazebo_ros_api_plugin", "gazebo_ros_paths_plugin"))


def simulation(
    launched: Launched,
    trees: Trees,
    environment: Mapping[str, str],
    known: Callable[[str, str, int], KnownNode | None],
) -> Completes | None:
    """What completes the simulators of what was *launched*; None if there is none. *known* looks up nodes that the data describes."""
    servers = [each for each in launched.nodes if each.package == PACKAGE and each.type in SERVERS]
    if not servers:
        return None
    parameters: dict[str, list[Parameter]] = {}
    for each in launched.parameters:
        parameters.setdefault(each.name, []).append(each)
    spawners = [
        (each, split(each.arguments)) for each in launched.nodes if each.package == PACKAGE and each.type in SPAWNERS
    ]
    return _Simulation(launched, servers, spawners, parameters, trees, environment, known).complete


@dataclass(frozen=True, slots=True)
class _Simulation:
    launched: Launched
    servers: list[Started]
    spawners: list[tuple[Started, Words]]
    #: What is set on the parameter server, by name.
    parameters: Mapping[str, list[Parameter]]
    trees: Trees
    environment: Mapping[str, str]
    known: Callable[[str, str, int], KnownNode | None]

    def complete(self, nodes: Sequence[Node]) -> tuple[Node, ...]:
        server = ParameterServer(self.launched.parameters)
        by_place: dict[tuple[str, object], Started] = {(each.name, each.location): each for each in self.servers}
        reasons = tuple(unpredictable(nodes, SPAWNERS))
        done = []
        for node in nodes:
            started = by_place.get((node.name, node.location)) if node.source == "launch" and node.ros == 1 else None
            if started is None:
                done.append(node)
                continue
            into = self._found(started)
            for reason in reasons:
                into.lose(reason, node.location)
            made = [
                end
                for use, known, spawned in into.uses
                for end in ros1_endpoints(use, known, node, spawned, lambda name: as_data(server.get(name)))
            ]
            made += controllers(
                node, made, asked(self.launched.nodes), server, self.known, lambda why, by: into.lose(why, by.location)
            )
            done.append(completed(node, made, into.lost))
        return tuple(done)

    def _found(self, server: Started) -> Found:
        into = of_server(self.trees, server, 1, ACCOUNTED)
        for spawner, words in self.spawners:
            self._spawn(spawner, words, server, into)
        return into

    def _spawn(self, spawner: Started, words: Words, server: Started, into: Found) -> None:
        target = option(words.rest, "-gazebo_namespace")
        if target is not None and "?" not in target and clean(target) != server.name and len(self.servers) > 1:
            return
        if target is None and len(self.servers) > 1 and server.name != "/gazebo":
            return
        space = option(words.rest, "-robot_namespace")
        if space is None:
            space = next((value for name, value in words.special if name == "ns"), spawner.namespace)
        spawned = spawned_by(spawner, server, option(words.rest, "-model"), space)
        gather(self.trees, self._description(spawner, words), spawned, 1, into, spawner.location)

    def _description(self, spawner: Started, words: Words) -> Tree:
        tree = of_file_or_model(self.trees, words.rest)
        if tree is not None:
            return tree
        parameter = option(words.rest, "-param")
        if parameter is None:
            return Tree(None, f"what {spawner.name} spawns is not known")
        name = resolve(parameter, spawner.namespace, spawner.name)
        given = self.parameters.get(name, ())
        if len(given) != 1 or given[0].conditions or "?" in parameter:
            why = "is set by no launch file" if not given else "is not known"
            return Tree(None, f"the parameter {name} that {spawner.name} spawns {why}")
        return self._text(given[0])

    def _text(self, parameter: Parameter) -> Tree:
        if parameter.command:
            return self.trees.of_command(parameter.command, self.environment)
        if isinstance(parameter.value, str) and not parameter.unknowns and parameter.location is not None:
            return self.trees.of_text(parameter.value, parameter.location)
        why = next((each.reason for each in parameter.unknowns), "it is no text")
        return Tree(None, f"the value of {parameter.name} is not known: {why}")
